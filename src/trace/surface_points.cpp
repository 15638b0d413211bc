// Which triangle does each pixel show, and does it face the light?
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/trace/reference.hpp"
#include "light_ray.hpp"
#include "sampling.hpp"

namespace gnomon::trace {
namespace {

// How far along the view a picture's point may lie from its triangle, of its distance from the eye. Its
// coordinates are rounded to single precision and interpolated from corners that may lie a hundred times as
// far off as the point: 1e-3 leaves room for ten thousand roundings.
constexpr double kSearch = 1e-3;
// How far off its triangle's plane, of the same distance. A picture's point that lies farther off is one of
// another triangle, whose edge the ray from the eye missed by rounding: a thousand roundings remain.
constexpr double kOffPlane = 1e-4;
// Cosine between the picture's normal and the triangle's, below which they are two surfaces: a picture takes
// its normals from differences between pixels, good to a hundredth.
constexpr double kSameNormal = 0.95;

SurfacePoint located(const Tracer& tracer, const Camera& camera, const Light& light, const float* position,
                     const float* normal) {
  SurfacePoint point;
  if (normal[3] == 0.0f) return point;
  const glm::dvec3 relative(position[0], position[1], position[2]);
  point.position = camera.position + relative;
  const glm::dvec3 seen_normal(normal[0], normal[1], normal[2]);
  const LightRay to_light = light_ray(light, point.position);
  point.state = PixelState::undecided;
  Ray view;
  view.origin = point.position;
  view.direction =
      camera.orthographic ? camera_axes(camera).forward * static_cast<double>(position[3]) : relative;
  view.begin = -kSearch;
  view.end = kSearch;
  const Hit hit = tracer.hit_nearest_to(view, 0.0);
  if (hit.triangle == kNoTriangle) return point;
  point.triangle = hit.triangle;
  point.receives = tracer.receives(hit.triangle);
  point.normal = glm::dot(hit.normal, view.direction) > 0.0 ? -hit.normal : hit.normal;
  point.above = -hit.t * glm::dot(view.direction, point.normal);
  if (glm::dot(seen_normal, point.normal) < kSameNormal) return point;
  if (std::abs(point.above) > kOffPlane * glm::length(view.direction)) return point;
  const double cosine = glm::dot(point.normal, to_light.direction);
  // Either normal may be the wrong one where a triangle is seen edge-on: only where they agree is the side
  // known.
  const bool agree = (cosine > 0.0) == (glm::dot(seen_normal, to_light.direction) > 0.0);
  if (!agree || std::abs(cosine) < kGrazingCosine) return point;
  point.state = cosine <= 0.0  ? PixelState::turned_away
                : to_light.lit ? PixelState::facing
                               : PixelState::unlit;
  return point;
}

}  // namespace

Ray eye_ray(const Camera& camera, const CameraAxes& axes, double column_share, double row_share) noexcept {
  const double x = camera.left + (camera.right - camera.left) * column_share,
               y = camera.top + (camera.bottom - camera.top) * row_share;
  const glm::dvec3 image = axes.right * x + axes.up * y;
  Ray ray;
  ray.origin = camera.orthographic ? camera.position + image : camera.position;
  ray.direction = camera.orthographic ? axes.forward : axes.forward + image;
  ray.begin = camera.near_depth;
  ray.end = camera.far_depth;
  return ray;
}

SurfacePoints surface_points(const Tracer& tracer, const Camera& camera, const Light& light,
                             const FloatImage& positions, const FloatImage& normals) {
  SurfacePoints points{positions.width, positions.height, {}};
  const auto width = static_cast<std::size_t>(points.width);
  points.pixels.resize(width * static_cast<std::size_t>(points.height));
  for_each_row(points.height, [&](int row) {
    for (std::size_t i = static_cast<std::size_t>(row) * width, end = i + width; i < end; ++i)
      points.pixels[i] = located(tracer, camera, light, &positions.values[4 * i], &normals.values[4 * i]);
  });
  return points;
}

}  // namespace gnomon::trace
