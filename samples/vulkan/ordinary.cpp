// An ordinary engine's cascades.
#include "ordinary.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace sample {
namespace {

struct Sphere {
  double depth = 0.0, radius = 0.0;  // centre on the view axis, world units
};

/// The smallest sphere round a slice of the frustum. Its radius does not change under a moving camera.
Sphere sphere_round(const gnomon::Camera& camera, double begin, double end) {
  const double slope2 = camera.right * camera.right + camera.top * camera.top;
  const double middle = std::min(0.5 * (begin + end) * (1.0 + slope2), end);
  return {middle, std::sqrt((end - middle) * (end - middle) + slope2 * end * end)};
}

}  // namespace

OrdinaryCascades ordinary_cascades(const gnomon::Camera& camera, const glm::dvec3& light_direction,
                                   std::span<const gnomon::Box> casters, int map_size, double lambda,
                                   const gnomon::ClipSpace& clip_space) {
  const gnomon::CameraAxes axes = gnomon::camera_axes(camera);
  const glm::dmat4 light_from_world = glm::lookAtRH({0, 0, 0}, glm::normalize(light_direction), {0, 1, 0});
  double nearest = HUGE_VAL, farthest = -HUGE_VAL;  // of all casters, along the light
  for (const gnomon::Box& box : casters) {
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 at{(corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                          (corner & 4 ? box.max : box.min).z};
      const double depth = -(light_from_world * glm::dvec4(at, 1.0)).z;
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  OrdinaryCascades out{};
  const double near = camera.near_depth, far = camera.far_depth;
  for (int i = 0; i < OrdinaryCascades::kCount; ++i) {
    const auto split = [&](int at) {
      const double share = static_cast<double>(at) / OrdinaryCascades::kCount;
      return lambda * near * std::pow(far / near, share) + (1.0 - lambda) * (near + (far - near) * share);
    };
    const double begin = split(i), end = split(i + 1);
    const Sphere sphere = sphere_round(camera, begin, end);
    glm::dvec3 centre(light_from_world * glm::dvec4(camera.position + sphere.depth * axes.forward, 1.0));
    // A texel more on each side, for the snap and the filter.
    const double radius = sphere.radius * map_size / (map_size - 4.0), texel = 2.0 * radius / map_size;
    centre.x = std::floor(centre.x / texel) * texel;
    centre.y = std::floor(centre.y / texel) * texel;
    out.clip_from_world[static_cast<std::size_t>(i)] =
        gnomon::clip_from_gl_clip(clip_space) *
        glm::orthoRH_NO(centre.x - radius, centre.x + radius, centre.y - radius, centre.y + radius, nearest,
                        farthest) *
        light_from_world;
    out.ends[static_cast<std::size_t>(i)] = end;
  }
  return out;
}

}  // namespace sample
