// How much light falls on what a pixel shows, over all of the pixel and not at its centre alone?
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/trace/reference.hpp"
#include "light_ray.hpp"
#include "sampling.hpp"
#include "surface_rays.hpp"

namespace gnomon::trace {
namespace {

/// Cosine between normals from which on two points are of one surface: a bend of 18 degrees, as for pictures.
constexpr double kSameNormal = 0.95;

/// The longer side of a pixel at the depth of a point, across the view, world units.
double pixel_side(const Camera& camera, const CameraAxes& axes, const glm::dvec3& point) noexcept {
  const double depth = camera.orthographic ? 1.0 : glm::dot(axes.forward, point - camera.position);
  return depth *
         std::max((camera.right - camera.left) / camera.width, (camera.top - camera.bottom) / camera.height);
}

}  // namespace

PixelReference pixel_reference(const Tracer& tracer, const Camera& camera, const SurfacePoints& points,
                               const Light& light, int samples) {
  PixelReference result{points.width, points.height, {}, {}};
  result.pixels.assign(points.pixels.size(), -1.0f);
  result.several.assign(points.pixels.size(), 0);
  const auto width = static_cast<std::size_t>(points.width);
  const CameraAxes axes = camera_axes(camera);
  for_each_row(points.height, [&](int row) {
    struct Count {
      std::size_t pixel, rays, lit;  ///< `lit`: without a ray
    };
    std::vector<Ray> rays;
    std::vector<Count> counts;
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row) * width + column;
      const SurfacePoint& centre = points.pixels[pixel];
      if (centre.state != PixelState::facing) continue;
      const double side = pixel_side(camera, axes, centre.position);
      const std::size_t before = rays.size();
      std::size_t lit = 0;
      for (int s = 0; s < samples; ++s) {
        const glm::dvec2 at = stratified(static_cast<std::uint32_t>(pixel), s, samples);
        const SurfacePoint point =
            met_by(tracer,
                   eye_ray(camera, axes, (static_cast<double>(column) + at.x) / points.width,
                           (row + at.y) / points.height),
                   light);
        const bool lightable = point.state == PixelState::facing;
        const bool same = lightable && glm::dot(point.normal, centre.normal) >= kSameNormal &&
                          std::abs(glm::dot(centre.normal, point.position - centre.position)) <= side;
        if (!same) result.several[pixel] = 1;
        if (!lightable) continue;
        if (!point.receives) {
          ++lit;
          continue;
        }
        const LightRay to_light = light_ray(light, point.position);
        rays.push_back(ray_off_plane(point, point.position, to_light.direction, to_light.distance,
                                     error_of(tracer, light, point)));
      }
      if (rays.size() - before + lit > 0) counts.push_back({pixel, rays.size() - before, lit});
    }
    std::vector<std::uint8_t> stopped(rays.size());
    tracer.occluded(rays, stopped);
    std::size_t next = 0;
    for (const Count& count : counts) {
      std::size_t lit = count.lit;
      for (std::size_t i = 0; i < count.rays; ++i) lit += stopped[next++] == 0 ? 1 : 0;
      result.pixels[count.pixel] = static_cast<float>(lit) / static_cast<float>(count.rays + count.lit);
    }
  });
  return result;
}

}  // namespace gnomon::trace
