// One ray per pixel, through its centre.
#include "picture.hpp"

#include <glm/geometric.hpp>

namespace gnomon::trace {

Picture picture_of(const Tracer& tracer, const Camera& camera) {
  const CameraAxes axes = camera_axes(camera);
  Picture picture;
  for (FloatImage* image : {&picture.positions, &picture.normals}) {
    image->width = camera.width;
    image->height = camera.height;
    image->channels = 4;
  }
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      const double x = camera.left + (camera.right - camera.left) * (column + 0.5) / camera.width;
      const double y = camera.top + (camera.bottom - camera.top) * (row + 0.5) / camera.height;
      Ray ray;
      ray.origin = camera.position + (camera.orthographic ? x * axes.right + y * axes.up : glm::dvec3(0.0));
      ray.direction = axes.forward + (camera.orthographic ? glm::dvec3(0.0) : x * axes.right + y * axes.up);
      ray.begin = camera.near_depth;
      ray.end = camera.far_depth;
      const Hit hit = tracer.first_hit(ray);
      const bool seen = hit.triangle != kNoTriangle;
      const glm::vec3 p(seen ? ray.origin + hit.t * ray.direction - camera.position : glm::dvec3(0.0));
      const glm::vec3 n(glm::dot(hit.normal, ray.direction) > 0.0 ? -hit.normal : hit.normal);
      picture.positions.values.insert(picture.positions.values.end(),
                                      {p.x, p.y, p.z, static_cast<float>(hit.t)});
      picture.normals.values.insert(picture.normals.values.end(), {n.x, n.y, n.z, seen ? 1.0f : 0.0f});
    }
  }
  return picture;
}

}  // namespace gnomon::trace
