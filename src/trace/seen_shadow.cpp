// The exact hard shadow as a camera sees it, without a renderer.
#include "gnomon/trace/seen_shadow.hpp"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "light_ray.hpp"
#include "sampling.hpp"
#include "surface_rays.hpp"

namespace gnomon::trace {

OccluderSearch LightOccluders::search() const noexcept {
  if (tracer_ == nullptr) return {};
  return {[](const void* scene, const glm::dvec3& point_world) noexcept {
            const auto& of = *static_cast<const LightOccluders*>(scene);
            const LightRay to_light = light_ray(of.light_, point_world);
            Ray ray;
            ray.origin = point_world;
            ray.direction = -to_light.direction;
            ray.begin = -to_light.distance;
            const Hit hit = of.tracer_->first_caster(ray);
            return hit.triangle == kNoTriangle ? -std::numeric_limits<double>::infinity() : -hit.t;
          },
          this};
}

SeenShadow seen_shadow(const Tracer& tracer, const Camera& camera, const Light& light) {
  SeenShadow seen{camera, {}, {}, {}, LightOccluders(tracer, light)};
  const auto width = static_cast<std::size_t>(std::max(camera.width, 0)),
             height = static_cast<std::size_t>(std::max(camera.height, 0));
  seen.mask.assign(width * height, -1.0f);
  seen.view_depths.assign(width * height, 0.0f);
  seen.normals_world.assign(width * height, glm::vec3(0.0f));
  const CameraAxes axes = camera_axes(camera);
  for_each_row(width > 0 ? camera.height : 0, [&](int row) {
    const std::size_t begin = static_cast<std::size_t>(row) * width;
    std::vector<Ray> rays;
    std::vector<std::size_t> pixels;
    for (std::size_t column = 0; column < width; ++column) {
      const SurfacePoint point =
          met_by(tracer,
                 eye_ray(camera, axes, (static_cast<double>(column) + 0.5) / camera.width,
                         (row + 0.5) / camera.height),
                 light);
      if (point.state == PixelState::sky) continue;
      seen.view_depths[begin + column] =
          static_cast<float>(glm::dot(axes.forward, point.position - camera.position));
      seen.normals_world[begin + column] = glm::vec3(point.normal);
      if (point.state != PixelState::facing) continue;
      if (!point.receives) {
        seen.mask[begin + column] = 1.0f;
        continue;
      }
      const LightRay to_light = light_ray(light, point.position);
      pixels.push_back(begin + column);
      rays.push_back(ray_off_plane(point, point.position, to_light.direction, to_light.distance,
                                   error_of(tracer, light, point)));
    }
    std::vector<std::uint8_t> stopped(rays.size());
    tracer.occluded(rays, stopped);
    for (std::size_t i = 0; i < pixels.size(); ++i) seen.mask[pixels[i]] = stopped[i] != 0 ? 0.0f : 1.0f;
  });
  return seen;
}

SeenShadow seen_shadow(const Tracer& tracer, const Camera& camera, const Light& light,
                       const SurfacePoints& points, std::vector<float> mask) {
  SeenShadow seen{camera, std::move(mask), {}, {}, LightOccluders(tracer, light)};
  const glm::dvec3 forward = camera_axes(camera).forward;
  for (const SurfacePoint& point : points.pixels) {
    const bool surface = point.state != PixelState::sky;
    seen.view_depths.push_back(
        surface ? static_cast<float>(glm::dot(forward, point.position - camera.position)) : 0.0f);
    seen.normals_world.emplace_back(point.normal);
  }
  return seen;
}

}  // namespace gnomon::trace
