// Chooses who traces, and says how exact it is.
#include "gnomon/trace/tracer.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "bvh.hpp"
#include "embree_scene.hpp"
#include "world_triangles.hpp"

namespace gnomon::trace {
namespace {

// Rounding units of the scene's diameter by which an answer may be off, both engines being of the same kind:
// corners and origin are rounded to half a unit per axis (2 sqrt(3) / 2 together), a direction likewise over
// the whole way (sqrt(3) / 2), and the edge tests subtract, multiply and add with 5 roundings of terms up to
// the diameter. 16 is twice their sum.
constexpr double kRoundings = 16.0;

/// Coordinates relative to the scene's centre.
double error_in_single(const Box& box, double reach) noexcept {
  return kRoundings * static_cast<double>(std::numeric_limits<float>::epsilon()) * 0.5 *
         (glm::length(box.max - box.min) + reach);
}

/// Half of the triangles are smaller across.
double median_size(const WorldTriangles& triangles) {
  std::vector<double> sizes;
  sizes.reserve(triangles.corners.size());
  for (const WorldTriangles::Corners& c : triangles.corners)
    sizes.push_back(
        std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])}));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return sizes.empty() ? 0.0 : *middle;
}

/// One triangle far from all others makes the roundings larger than what casts.
bool single_is_fine(const WorldTriangles& triangles) {
  constexpr double kLargestShare = 0.125;  // of a triangle
  return triangles.bounds.empty() ||
         error_in_single(triangles.bounds, 0.0) <= kLargestShare * median_size(triangles);
}

}  // namespace

std::string_view to_string(Engine engine) noexcept {
  switch (engine) {
    case Engine::automatic:
      return "auto";
    case Engine::embree:
      return "embree";
    case Engine::own:
      return "own";
  }
  return "";
}

struct Tracer::Impl {
  WorldTriangles triangles;
  Bvh bvh;
  std::unique_ptr<EmbreeScene> embree;

  Impl(const Scene& scene, Engine engine) : triangles(scene), bvh(triangles) {
    if (engine == Engine::embree ||
        (engine == Engine::automatic && built_with_embree() && single_is_fine(triangles)))
      embree = make_embree_scene(triangles);
  }
};

Tracer::Tracer(const Scene& scene, Engine engine) : impl_(std::make_unique<Impl>(scene, engine)) {}
Tracer::~Tracer() = default;

Engine Tracer::engine() const noexcept {
  return impl_->embree ? Engine::embree : Engine::own;
}

std::size_t Tracer::triangle_count() const noexcept {
  return impl_->triangles.corners.size();
}

std::uint32_t Tracer::instance_of(std::uint32_t triangle) const noexcept {
  return impl_->triangles.instance_of[triangle];
}

bool Tracer::receives(std::uint32_t triangle) const noexcept {
  return impl_->triangles.receives[triangle];
}

void Tracer::occluded(std::span<const Ray> rays, std::span<std::uint8_t> out) const {
  if (impl_->embree) {
    impl_->embree->occluded(rays, out);
    return;
  }
  for (std::size_t i = 0; i < rays.size(); ++i) out[i] = impl_->bvh.occluded(rays[i]) ? 1 : 0;
}

Hit Tracer::first_hit(const Ray& ray) const noexcept {
  return impl_->bvh.first_hit(ray);
}

Hit Tracer::first_caster(const Ray& ray) const noexcept {
  return impl_->bvh.first_caster(ray);
}

Hit Tracer::first_seen(const Ray& ray) const noexcept {
  return impl_->bvh.first_seen(ray);
}

Hit Tracer::hit_nearest_to(const Ray& ray, double t) const noexcept {
  return impl_->bvh.hit_nearest_to(ray, t);
}

double Tracer::error_world(double reach) const noexcept {
  const Box& box = impl_->triangles.bounds;
  if (box.empty()) return 0.0;
  if (impl_->embree) return error_in_single(box, reach);
  const double diameter = glm::length(box.max - box.min) + reach;
  // In double the coordinates themselves are not relative to the scene's centre.
  const double far = glm::length(glm::max(glm::abs(box.min), glm::abs(box.max)));
  return kRoundings * std::numeric_limits<double>::epsilon() * 0.5 * (diameter + far);
}

}  // namespace gnomon::trace
