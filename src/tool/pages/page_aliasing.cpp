// The aliasing error m of each pixel of a frame with pages, as numbers and as colours.
#include "page_aliasing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "base/grazing.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/render/picture.hpp"
#include "picture_colors.hpp"

namespace gnomon::tool {
namespace {

glm::dvec3 vector_at(const FloatImage& image, std::size_t pixel) {
  return {image.values[4 * pixel], image.values[4 * pixel + 1], image.values[4 * pixel + 2]};
}

bool is_surface(const PageFrameImages& images, std::size_t pixel) {
  return images.normals.values[4 * pixel + 3] > 0.0f;
}

/// Direction in which light travels at a point relative to the camera.
glm::dvec3 light_at(const PagePlan& plan, const ShadowMap& level, const glm::dvec3& point_world) {
  return level.light_world.w != 0.0 ? glm::normalize(point_world - glm::dvec3(level.light_world))
                                    : plan.light_direction;
}

const ShadowMap* level_at(const PagePlan& plan, const PageFrameImages& images, std::size_t pixel) {
  const auto page = static_cast<std::ptrdiff_t>(images.mask.values[2 * pixel + 1]);
  if (page < 0 || page >= static_cast<std::ptrdiff_t>(plan.pages.size())) return nullptr;
  return &plan.levels[plan.pages[static_cast<std::size_t>(page)].level];
}

float pixel_aliasing(const PagePlan& plan, const Camera& camera, const PageFrameImages& images,
                     std::size_t pixel) {
  const ShadowMap* const level = level_at(plan, images, pixel);
  if (level == nullptr || !is_surface(images, pixel)) return 0.0f;
  const glm::dvec3 point = camera.position + vector_at(images.positions, pixel),
                   normal = vector_at(images.normals, pixel);
  if (glm::dot(normal, light_at(plan, *level, point)) > -kGrazingCosine) return 0.0f;
  return static_cast<float>(measure_point(*level, camera, point, normal).m_max);
}

}  // namespace

std::vector<float> page_aliasing(const PagePlan& plan, const Camera& camera, const PageFrameImages& images) {
  std::vector<float> m(images.mask.values.size() / 2);
  const auto measure = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) m[i] = pixel_aliasing(plan, camera, images, i);
  };
  // Fewer pixels are measured before a thread has started.
  constexpr std::size_t kLeastPart = 4096, kMaxThreads = 16;
  const std::size_t cores = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMaxThreads),
                    parts = std::clamp<std::size_t>(m.size() / kLeastPart, 1, cores);
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < parts; ++i)
    threads.emplace_back(measure, m.size() * i / parts, m.size() * (i + 1) / parts);
  measure(0, m.size() / parts);
  threads.clear();  // waits for them
  return m;
}

Image page_heat_map(const PagePlan& plan, const std::vector<float>& m, const PageFrameImages& images) {
  // As heat.frag has them.
  constexpr render::Color kSkyGrey{158, 158, 158};
  constexpr double kDark = 0.36, kRise = 0.10, kLeast = 0.90;
  Image image = render::blank_image(images.mask.width, images.mask.height, kSkyGrey);
  constexpr render::Color kBlack{0, 0, 0}, kWhite{255, 255, 255};
  for (std::size_t i = 0; i < m.size(); ++i) {
    if (!is_surface(images, i)) continue;
    const glm::dvec3 at = vector_at(images.positions, i), normal = vector_at(images.normals, i);
    if (!(m[i] > 0.0f)) {
      const double facing = std::abs(glm::dot(normal, at)) / std::max(glm::length(at), 1e-30);
      set_pixel(image, i, mixed(kBlack, kWhite, kDark + kRise * facing));
      continue;
    }
    const ShadowMap* const level = level_at(plan, images, i);
    const glm::dvec3 travel =
        level != nullptr ? light_at(plan, *level, plan.origin_world + at) : plan.light_direction;
    const double cosine = std::max(-glm::dot(normal, travel), 0.0);
    const double shape = kLeast + (1.0 - kLeast) * static_cast<double>(images.mask.values[2 * i]) * cosine;
    set_pixel(image, i, mixed(kBlack, render::heat_color(static_cast<double>(m[i])), shape));
  }
  return image;
}

}  // namespace gnomon::tool
