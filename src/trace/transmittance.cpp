// How much of the light passes the panes between this point and the light, exactly?
// Based on: Lokovic and Veach, "Deep Shadow Maps", 2000 (the transmittance function along a ray of light,
// here by the ray itself).
#include "gnomon/trace/transmittance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "bvh.hpp"
#include "light_ray.hpp"
#include "sampling.hpp"
#include "world_triangles.hpp"

namespace gnomon::trace {
namespace {

float linear_of(std::uint8_t encoded) noexcept {
  const double v = encoded / 255.0;
  return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

/// The colour of a picture at a texture coordinate, linear; white without a picture.
class Picture {
 public:
  explicit Picture(const Image& image) : width_(image.width), height_(image.height) {
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linear_of(static_cast<std::uint8_t>(i));
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
      texels_.push_back({linear[image.rgba[i]], linear[image.rgba[i + 1]], linear[image.rgba[i + 2]],
                         static_cast<float>(image.rgba[i + 3]) / 255.0f});
  }
  [[nodiscard]] glm::dvec4 at(const Material& material, const glm::dvec2& texcoord) const noexcept {
    if (texels_.empty()) return glm::dvec4(1.0);
    // Beyond this a coordinate is no place in a picture any more; the cast to int needs some bound.
    constexpr double kFarTexel = 1e9;
    const double x = std::clamp(texcoord.x * width_ - 0.5, -kFarTexel, kFarTexel);
    const double y = std::clamp(texcoord.y * height_ - 0.5, -kFarTexel, kFarTexel);
    const double left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
    const auto texel = [&](int column, int row) {
      const int u = wrapped(column, width_, material.wrap_u), v = wrapped(row, height_, material.wrap_v);
      return glm::dvec4(texels_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(u)]);
    };
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const glm::dvec4 upper = texel(column, row) * (1.0 - fx) + texel(column + 1, row) * fx;
    const glm::dvec4 lower = texel(column, row + 1) * (1.0 - fx) + texel(column + 1, row + 1) * fx;
    return upper * (1.0 - fy) + lower * fy;
  }

 private:
  int width_, height_;
  std::vector<glm::vec4> texels_;
};

/// The panes' triangles are all there, so that they keep the order of the instances.
Scene without_masks(Scene panes) {
  for (Material& material : panes.materials) material.alpha_mode = AlphaMode::opaque;
  return panes;
}

}  // namespace

struct PaneTracer::Impl {
  struct Triangle {
    std::array<glm::vec2, 3> texcoords;
    std::uint32_t material;
  };
  WorldTriangles triangles;
  Bvh bvh;
  std::vector<Triangle> looks;
  std::vector<Material> materials;
  std::vector<Picture> pictures;

  explicit Impl(const Scene& panes)
      : triangles(without_masks(panes)), bvh(triangles), materials(panes.materials) {
    for (const Image& image : panes.images) pictures.emplace_back(image);
    for (const Instance& instance : panes.instances) {
      const Primitive& primitive = panes.primitives[instance.primitive];
      for (std::uint32_t i = 0; i + 2 < primitive.index_count; i += 3) {
        Triangle& look = looks.emplace_back();
        look.material = static_cast<std::uint32_t>(primitive.material);
        for (std::uint32_t k = 0; k < 3; ++k)
          look.texcoords[k] = panes.texcoords[panes.indices[primitive.first_index + i + k]];
      }
    }
  }

  [[nodiscard]] glm::dvec3 of(std::uint32_t triangle, double b1, double b2) const noexcept {
    const Triangle& look = looks[triangle];
    const Material& material = materials[look.material];
    glm::dvec4 color(material.base_color);
    if (material.base_color_image >= 0) {
      const glm::dvec2 at = (1.0 - b1 - b2) * glm::dvec2(look.texcoords[0]) +
                            b1 * glm::dvec2(look.texcoords[1]) + b2 * glm::dvec2(look.texcoords[2]);
      color *= pictures[static_cast<std::size_t>(material.base_color_image)].at(material, at);
    }
    return glm::dvec3(gnomon::transmittance(material, glm::vec4(color)));
  }
};

PaneTracer::PaneTracer(const Scene& panes) : impl_(std::make_unique<Impl>(panes)) {}
PaneTracer::~PaneTracer() = default;

glm::dvec3 PaneTracer::transmittance(const Ray& ray) const {
  glm::dvec3 left(1.0);
  impl_->bvh.each_hit(ray, [&](std::uint32_t triangle, double b1, double b2) {
    if (impl_->triangles.casts[triangle]) left *= impl_->of(triangle, b1, b2);
  });
  return left;
}

PaneReference pane_reference(const PaneTracer& panes, const SurfacePoints& points, const Light& light) {
  PaneReference result{points.width, points.height,
                       std::vector<glm::dvec3>(points.pixels.size(), glm::dvec3(1.0))};
  for_each_row(points.height, [&](int row) {
    const auto width = static_cast<std::size_t>(points.width), first = static_cast<std::size_t>(row) * width;
    for (std::size_t i = first; i < first + width; ++i) {
      const SurfacePoint& point = points.pixels[i];
      if (point.state != PixelState::facing || !point.receives) continue;
      const LightRay to_light = light_ray(light, point.position);
      Ray ray;
      ray.origin = point.position;
      ray.direction = to_light.direction;
      ray.end = to_light.distance;
      result.pixels[i] = panes.transmittance(ray);
    }
  });
  return result;
}

}  // namespace gnomon::trace
