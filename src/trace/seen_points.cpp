// Where does the camera see a surface on which the light could fall?
#include "gnomon/trace/seen_points.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "light_ray.hpp"
#include "sampling.hpp"
#include "surface_rays.hpp"

namespace gnomon::trace {
std::vector<glm::dvec3> seen_points(const Tracer& tracer, const Camera& camera, const Light& light,
                                    int columns, int rows) {
  struct Seen {
    glm::dvec3 point;
    bool counts = false;
  };
  const auto width = static_cast<std::size_t>(std::max(columns, 0));
  std::vector<Seen> seen(width * static_cast<std::size_t>(std::max(rows, 0)));
  const CameraAxes axes = camera_axes(camera);
  for_each_row(seen.empty() ? 0 : rows, [&](int row) {
    for (std::size_t column = 0; column < width; ++column) {
      const Ray ray =
          eye_ray(camera, axes, (static_cast<double>(column) + 0.5) / columns, (row + 0.5) / rows);
      const Hit hit = tracer.first_hit(ray);
      if (hit.triangle == kNoTriangle) continue;
      const glm::dvec3 point = ray.origin + ray.direction * hit.t;
      const glm::dvec3 normal = glm::dot(hit.normal, ray.direction) > 0.0 ? -hit.normal : hit.normal;
      const LightRay to_light = light_ray(light, point);
      seen[static_cast<std::size_t>(row) * width + column] = {
          point, to_light.lit && glm::dot(normal, to_light.direction) > 0.0};
    }
  });
  std::vector<glm::dvec3> points;
  for (const Seen& one : seen) {
    if (one.counts) points.push_back(one.point);
  }
  return points;
}

}  // namespace gnomon::trace
