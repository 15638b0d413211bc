// The arithmetic of metric_kernel.hpp in loops without branches, each over all points of a block.
#include "measure/metric_lanes.hpp"
#include "gnomon/extend/shape.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "lanes/lanes.hpp"
#include "lanes/wide.hpp"
#include "measure/map_light.hpp"
#include "measure/metric_kernel.hpp"

namespace gnomon {
namespace {

// A map holds its receivers to this share of its half width (tests/laws/receivers_law_test.cpp): strong warps
// of thin bodies round by more than a few units in the last place.
constexpr double kRim = 1.0 + 1e-7;
// Keeps 1 / w away from zero, and changes no bit of a w above 1e-44.
constexpr double kLeastW = 1e-60;

/// Unit vector along v, and `fallback` where v vanishes; without branches.
inline glm::dvec3 direction(const glm::dvec3& v, const glm::dvec3& fallback) noexcept {
  constexpr double kNothing = 1e-300;  // its inverse is still finite
  const double x = std::abs(v.x), y = std::abs(v.y), z = std::abs(v.z);
  const double scale = max_of(max_of(x, y), z);
  const bool some = scale > kNothing;
  // A sum, not a choice: compilers divide first and choose then, and dividing by zero raises a flag. It
  // changes no bit of what is not tiny itself.
  const glm::dvec3 scaled = v * (1.0 / (scale + kNothing));
  const double inverse = 1.0 / std::sqrt(glm::dot(scaled, scaled) + kNothing);
  return {some ? scaled.x * inverse : fallback.x, some ? scaled.y * inverse : fallback.y,
          some ? scaled.z * inverse : fallback.z};
}

GNOMON_WIDE void find_eye_rays(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  const glm::dvec3 eye = f.eye, forward = f.forward;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 offset = b.point[i] - eye;
    b.depth[i] = glm::dot(offset, forward);
    b.eye_ray.set(i, direction(offset, forward));
  }
}

GNOMON_WIDE void find_light_rays(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  const glm::dvec3 light(f.light_world);
  const double w = f.light_world.w;
  for (std::size_t i = 0; i < count; ++i)
    b.light_ray.set(i, direction(b.point[i] * w - light, {0.0, -1.0, 0.0}));
}

/// All points of a light ray have one place in the map: the ray lies across both gradients.
GNOMON_WIDE void find_light_rays_of_matrix(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  const double sense = f.light_sense;
  for (std::size_t i = 0; i < count; ++i)
    b.light_ray.set(i, direction(glm::cross(b.texel_x[i], b.texel_y[i]) * sense, {0.0, -1.0, 0.0}));
}

GNOMON_WIDE void find_places(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  const glm::dmat4 m = f.clip_from_world;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 p = b.point[i];
    const double w = m[0][3] * p.x + m[1][3] * p.y + m[2][3] * p.z + m[3][3];
    // What lies behind is outside, whatever comes out; at w = 0 gradients of 1e120 would overflow.
    const double inverse = 1.0 / (w + (w > 0.0 ? kLeastW : 1.0 - w));
    const double x = (m[0][0] * p.x + m[1][0] * p.y + m[2][0] * p.z + m[3][0]) * inverse;
    const double y = (m[0][1] * p.x + m[1][1] * p.y + m[2][1] * p.z + m[3][1]) * inverse;
    b.inverse_w[i] = inverse;
    b.ndc_x[i] = x;
    b.ndc_y[i] = y;
    const double in_x = std::abs(x) <= kRim ? 1.0 : 0.0, in_y = std::abs(y) <= kRim ? in_x : 0.0;
    b.inside[i] = w > 0.0 ? in_y : 0.0;
  }
}

void find_shape(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  const auto set = [&b](std::size_t i, const glm::dmat2& d) {
    b.shape[0][i] = d[0][0];
    b.shape[1][i] = d[1][0];
    b.shape[2][i] = d[0][1];
    b.shape[3][i] = d[1][1];
  };
  if (f.texels.shape->affine) {
    const glm::dmat2 everywhere = f.texels.place(glm::dvec2(0.0)).texel_from_ndc;
    for (std::size_t i = 0; i < count; ++i) set(i, everywhere);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) set(i, f.texels.place({b.ndc_x[i], b.ndc_y[i]}).texel_from_ndc);
}

GNOMON_WIDE void find_texels(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  const glm::dmat4 m = f.clip_from_world;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = b.ndc_x[i], y = b.ndc_y[i], inverse = b.inverse_w[i];
    const glm::dvec3 over_x{m[0][0] - x * m[0][3], m[1][0] - x * m[1][3], m[2][0] - x * m[2][3]};
    const glm::dvec3 over_y{m[0][1] - y * m[0][3], m[1][1] - y * m[1][3], m[2][1] - y * m[2][3]};
    b.texel_x.set(i, over_x * (b.shape[0][i] * inverse) + over_y * (b.shape[1][i] * inverse));
    b.texel_y.set(i, over_x * (b.shape[2][i] * inverse) + over_y * (b.shape[3][i] * inverse));
  }
}

inline void store(ExtentLanes& lanes, std::size_t i, const Jacobian2& j) noexcept {
  const Extents e = extents(j);
  lanes.longest[i] = e.longest;
  lanes.shortest[i] = e.shortest;
  lanes.s[i] = e.s;
  lanes.t[i] = e.t;
  lanes.area[i] = std::sqrt(e.longest * e.shortest);
  constexpr double kInfinite = std::numeric_limits<double>::infinity(), kLargest = 1e100;
  const double ratio = min_of(e.longest, kLargest) / divisor(min_of(e.shortest, kLargest), 1.0 / kLargest);
  lanes.anisotropy[i] = e.longest < kInfinite ? ratio : e.shortest < kInfinite ? kInfinite : 1.0;
}

inline Jacobian2 jacobian(const MetricBlock& b, std::size_t i, const glm::dvec3& px,
                          const glm::dvec3& py) noexcept {
  const glm::dvec3 x = b.texel_x[i], y = b.texel_y[i];
  return {glm::dot(x, px), glm::dot(x, py), glm::dot(y, px), glm::dot(y, py)};
}

GNOMON_WIDE void find_perspective(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  const glm::dvec3 pixel_x = f.pixel_x, pixel_y = f.pixel_y;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 ray = b.eye_ray[i], sum = ray + b.light_ray[i];
    const double sum2 = glm::dot(sum, sum);
    // Opposed rays are done anew, with branches.
    const double twice = 2.0 / (sum2 + std::numeric_limits<double>::min());
    const auto turned = [&](const glm::dvec3& pixel) {
      const glm::dvec3 across = pixel - ray * glm::dot(ray, pixel);
      return across - sum * (twice * glm::dot(sum, across));
    };
    b.sum2[i] = sum2;
    store(b.perspective, i, jacobian(b, i, turned(pixel_x * b.depth[i]), turned(pixel_y * b.depth[i])));
  }
}

GNOMON_WIDE void find_surface(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  const glm::dvec3 pixel_x = f.pixel_x, pixel_y = f.pixel_y;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 ray = b.eye_ray[i], normal = b.normal[i];
    const double along = glm::dot(ray, normal);
    // Edge-on, the extents tend to limits; their fourth powers must not overflow on the way.
    constexpr double kEdgeOn = 1e-60;
    const double facing = 1.0 / (along + kEdgeOn);
    b.cos_eye[i] = -along;
    b.cos_light[i] = -glm::dot(normal, b.light_ray[i]);
    const auto slid = [&](const glm::dvec3& pixel) {
      return pixel - ray * (glm::dot(normal, pixel) * facing);
    };
    store(b.surface, i, jacobian(b, i, slid(pixel_x * b.depth[i]), slid(pixel_y * b.depth[i])));
  }
}

}  // namespace

MetricFrame::MetricFrame(const ShadowMap& map, const Camera& camera, const CameraAxes& axes) noexcept
    : clip_from_world(map.clip_from_world),
      texels(map.texels()),
      eye(camera.position),
      forward(axes.forward),
      pixel_x(axes.right * ((camera.right - camera.left) / camera.width)),
      pixel_y(axes.up * ((camera.top - camera.bottom) / camera.height)),
      light_world(map.light_world),
      light_from_matrix(!is_light_of(map.clip_from_world, map.light_world)),
      light_sense(gnomon::light_sense(map)),
      orthographic(camera.orthographic) {}

void judge_perspective(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  if (f.orthographic) {
    for (std::size_t i = 0; i < count; ++i) b.eye_ray.set(i, f.forward);
    for (std::size_t i = 0; i < count; ++i) b.depth[i] = 1.0;
  } else {
    find_eye_rays(f, b, count);
  }
  find_places(f, b, count);
  find_shape(f, b, count);
  find_texels(f, b, count);
  if (f.light_from_matrix) {
    find_light_rays_of_matrix(f, b, count);
  } else if (f.light_world.w == 0.0) {
    for (std::size_t i = 0; i < count; ++i) b.light_ray.set(i, -glm::dvec3(f.light_world));
  } else {
    find_light_rays(f, b, count);
  }
  find_perspective(f, b, count);
  // Where both rays oppose each other any mirror across them serves, and it takes branches to find one.
  for (std::size_t i = 0; i < count; ++i) {
    if (b.sum2[i] > kOpposedRays) continue;
    const TexelJacobian texel{b.texel_x[i], b.texel_y[i], 0.0, 0.0, 0.0};
    const ViewPoint view{b.eye_ray[i], f.pixel_x * b.depth[i], f.pixel_y * b.depth[i]};
    store(b.perspective, i, perspective_jacobian(texel, view, b.light_ray[i]));
  }
}

void judge_surface(const MetricFrame& f, MetricBlock& b, std::size_t count) noexcept {
  find_surface(f, b, count);
}

}  // namespace gnomon
