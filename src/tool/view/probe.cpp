// What does the plan do at one point of the picture, and what do exact rays report there?
#include "probe.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "base/travel.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/trace/reference.hpp"

namespace gnomon::tool::view {
namespace {

/// Outline of the texel, where its light rays meet the surface's plane.
std::vector<WorldLine> footprint_of(const ClipSpace& clip_space, const ShadowMap& map,
                                    const glm::dvec2& texel, const glm::dvec3& point,
                                    const glm::dvec3& normal) {
  // Other shapes have no inverse in closed form.
  if (map.shape != &shapes::linear) return {};
  const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
  const double nearest = clip_space.ndc_depth == NdcDepth::zero_to_one ? 0.0 : -1.0;
  const glm::dvec2 corner = glm::floor(texel);
  std::array<glm::dvec3, 4> on_plane;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 at = corner + glm::dvec2(i == 1 || i == 2 ? 1.0 : 0.0, i >= 2 ? 1.0 : 0.0);
    const glm::dvec2 ndc = map.texels().ndc_of(at);
    const glm::dvec4 a = world_from_clip * glm::dvec4(ndc, nearest, 1.0),
                     b = world_from_clip * glm::dvec4(ndc, 1.0, 1.0);
    const glm::dvec3 from = glm::dvec3(a) / a.w, along = glm::dvec3(b) / b.w - from;
    const double t = glm::dot(point - from, normal) / glm::dot(along, normal);
    if (!std::isfinite(t)) return {};
    on_plane[i] = from + along * t;
  }
  std::vector<WorldLine> lines;
  for (std::size_t i = 0; i < 4; ++i)
    lines.push_back({on_plane[i], on_plane[(i + 1) % 4], {230, 159, 0, 255}, 2.0});
  return lines;
}

trace::Ray ray_to_light(const trace::Tracer& tracer, const Light& light, const glm::dvec3& point,
                        const glm::dvec3& normal, double reach) {
  trace::Ray ray;
  ray.origin = point + normal * (4.0 * tracer.error_world(reach));
  if (const auto* sun = std::get_if<DirectionalLight>(&light)) {
    ray.direction = -glm::normalize(sun->direction);
    return ray;
  }
  ray.direction = position_of(light) - ray.origin;
  ray.end = 1.0;
  return ray;
}

}  // namespace

Probed probe(const trace::Tracer& tracer, const ShadowPlan& plan, const Camera& camera, const Light& light,
             double x, double y, const PagePlan* pages) {
  Probed result;
  const trace::Ray eye = trace::eye_ray(camera, camera_axes(camera), x / camera.width, y / camera.height);
  const trace::Hit hit = tracer.first_hit(eye);
  if (hit.triangle == trace::kNoTriangle) return result;
  result.hit = true;
  result.view_depth = hit.t;
  result.instance = tracer.instance_of(hit.triangle);
  result.point = eye.origin + eye.direction * hit.t;
  result.normal = glm::dot(hit.normal, eye.direction) > 0.0 ? -hit.normal : hit.normal;
  const trace::Ray sun =
      ray_to_light(tracer, light, result.point, result.normal, glm::length(eye.direction) * hit.t);
  result.turned_away = glm::dot(sun.direction, result.normal) <= 0.0;
  std::uint8_t stopped = 0;
  tracer.occluded({&sun, 1}, {&stopped, 1});
  result.shadow = stopped != 0;
  result.map = pages != nullptr ? page_serving(*pages, result.point) : map_serving(plan, result.point, hit.t);
  if (result.map < 0) return result;
  const auto index = static_cast<std::size_t>(result.map);
  if (pages != nullptr) result.page = pages->pages[index];
  const ShadowMap& map = result.page ? pages->levels[result.page->level] : plan.map[index];
  result.aliasing = measure_point(map, camera, result.point, result.normal);
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(result.point, 1.0);
  result.texel = map.texels().place(glm::dvec2(clip) / clip.w).texel;
  const ClipSpace& clip_space = pages != nullptr ? pages->clip_space : plan.clip_space;
  result.footprint = footprint_of(clip_space, map, result.texel, result.point, result.normal);
  return result;
}

}  // namespace gnomon::tool::view
