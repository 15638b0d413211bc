// World-unit biases from the map's own texel footprint, and which bias suits which class of filter.
// Based on: the Jacobian of the map; Scherzer, Wimmer, Purgathofer, survey 2011, section 5 (bias terms);
// Isidoro 2006 (receiver plane); Holbert 2011 (normal offset); Dou et al. 2014 (adaptive). That a plane of
// the world is a plane of ndc, which makes them exact under a warp, is this project's use of it. The advice:
// the survey, section 5; Lauritzen 2007 (biasing of moments); tests/laws/bias_law_test.cpp verifies its rows
// on filters that compare.
#include "gnomon/study/bias.hpp"
#include "gnomon/extend/shape.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"

namespace gnomon {

namespace {

/// Gradients of ndc x, y and z over the world at a point, and the point's ndc.
struct NdcJacobian {
  glm::dvec3 x, y, z, ndc;
  double w;
};

NdcJacobian ndc_jacobian(const glm::dmat4& m, const glm::dvec3& p) noexcept {
  const glm::dvec4 h = m * glm::dvec4(p, 1.0);
  const glm::dvec3 ndc = glm::dvec3(h) / h.w;
  const auto gradient = [&](int row) {
    return (glm::dvec3(m[0][row], m[1][row], m[2][row]) - glm::dvec3(m[0][3], m[1][3], m[2][3]) * ndc[row]) /
           h.w;
  };
  return {gradient(0), gradient(1), gradient(2), ndc, h.w};
}

/// The normal itself, or one in the same direction across the light that is as steep as allowed.
glm::dvec3 capped_normal(const glm::dvec3& normal, const glm::dvec3& light_direction,
                         double max_slope) noexcept {
  const double cosine = -glm::dot(normal, light_direction);
  const glm::dvec3 across = normal + light_direction * cosine;
  const double sine = std::sqrt(glm::dot(across, across));
  if (cosine > 0.0 && sine <= cosine * max_slope) return normal;
  const glm::dvec3 spare = glm::cross(light_direction, least_aligned_axis(light_direction));
  return safe_normalize(
      safe_normalize(across, safe_normalize(spare, {1.0, 0.0, 0.0})) * max_slope - light_direction,
      -light_direction);
}

Receiver capped(const Receiver& r, double max_slope) noexcept {
  Receiver result = r;
  result.normal = capped_normal(r.normal, r.light_direction, max_slope);
  return result;
}

/// Change of ndc depth, without sign, between a point of the plane and the farthest texel centre of the
/// kernel, plus the constant part.
double lift_ndc(const BiasOptions& options, double texels, const Receiver& r) noexcept {
  const ReceiverPlane plane = receiver_plane(r);
  if (!plane.valid) return 0.0;
  const glm::dvec2 extent = texel_extent_world(r.clip_from_world, r.texels, r.light_direction, r.point);
  const double per_world = ndc_depth_per_world_unit(r.clip_from_world, r.light_direction, r.point);
  return texels * (std::abs(plane.gradient.x) + std::abs(plane.gradient.y)) +
         options.constant_texels * max_of(extent.x, extent.y) * std::abs(per_world);
}

}  // namespace

double ndc_depth_per_world_unit(const glm::dmat4& m, const glm::dvec3& light_direction,
                                const glm::dvec3& point) noexcept {
  return -glm::dot(ndc_jacobian(m, point).z, light_direction);
}

glm::dvec2 texel_extent_world(const glm::dmat4& clip_from_world, const TexelGrid& texels,
                              const glm::dvec3& light_direction, const glm::dvec3& point) noexcept {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  // Asked first: the Jacobian divides by it.
  if (!(w_at(clip_from_world, point) > 0.0)) return {kInfinite, kInfinite};
  const TexelJacobian b = texel_jacobian(clip_from_world, texels, point);
  if (!(b.w > 0.0)) return {kInfinite, kInfinite};
  // Rows across the light; the inverse of the 2x2 map they span gives a texel's two edges.
  const glm::dvec3 x = b.x - light_direction * glm::dot(b.x, light_direction);
  const glm::dvec3 y = b.y - light_direction * glm::dot(b.y, light_direction);
  const double xx = glm::dot(x, x), yy = glm::dot(y, y);
  const glm::dvec3 across = glm::cross(x, y);
  const double area = std::sqrt(glm::dot(across, across));
  if (!(area > 0.0)) return {kInfinite, kInfinite};
  return {std::sqrt(yy) / area, std::sqrt(xx) / area};
}

double slope_bias_world(const BiasOptions& options, double texel_world, double kernel_radius_texels,
                        const glm::dvec3& normal, const glm::dvec3& light_direction) noexcept {
  const double cosine = -glm::dot(normal, light_direction);
  double slope = options.max_slope;
  if (cosine > 0.0) {
    const glm::dvec3 across = glm::cross(normal, light_direction);
    const double sine = std::sqrt(glm::dot(across, across));
    if (sine < cosine * options.max_slope) slope = sine / cosine;
  }
  return texel_world * (options.constant_texels + (options.slope_texels + kernel_radius_texels) * slope);
}

namespace {

/// The plane over ndc x and y, where it is one plane whatever the texels.
ReceiverPlane plane_over_ndc(const Receiver& r, const NdcJacobian& b) noexcept {
  constexpr double kEdgeOn = 1e-12;
  if (!(b.w > 0.0)) return {};
  // Along the plane: dz = gx dx + gy dy, so b.z - gx b.x - gy b.y is along the normal; Cramer's rule.
  const glm::dvec3 ray = glm::cross(b.x, b.y);
  const double det = glm::dot(ray, r.normal);
  if (!(std::abs(det) > kEdgeOn * std::sqrt(glm::dot(ray, ray) * glm::dot(r.normal, r.normal)))) return {};
  const double x = glm::dot(glm::cross(b.z, b.y), r.normal) / det;
  const double y = glm::dot(glm::cross(b.x, b.z), r.normal) / det;
  return {{x, y}, true};
}

}  // namespace

ReceiverPlane receiver_plane(const Receiver& r) noexcept {
  const NdcJacobian b = ndc_jacobian(r.clip_from_world, r.point);
  const ReceiverPlane over_ndc = plane_over_ndc(r, b);
  if (!over_ndc.valid) return {};
  const double x = over_ndc.gradient.x, y = over_ndc.gradient.y;
  // Per texel: through the inverse of the shape's derivative.
  const glm::dmat2 d = r.texels.place(b.ndc).texel_from_ndc;
  const double area = d[0][0] * d[1][1] - d[0][1] * d[1][0];
  if (!(area != 0.0)) return {};
  return {{(x * d[1][1] - y * d[0][1]) / area, (y * d[0][0] - x * d[1][0]) / area}, true};
}

ReceiverPlane receiver_plane_from_derivatives(const glm::dvec3& d_dx, const glm::dvec3& d_dy) noexcept {
  constexpr double kSilhouette = 1e-12;
  const double det = d_dx.x * d_dy.y - d_dx.y * d_dy.x;
  const double scale = std::sqrt((d_dx.x * d_dx.x + d_dx.y * d_dx.y) * (d_dy.x * d_dy.x + d_dy.y * d_dy.y));
  if (!(std::abs(det) > kSilhouette * scale)) return {};
  return {glm::dvec2(d_dy.y * d_dx.z - d_dx.y * d_dy.z, d_dx.x * d_dy.z - d_dy.x * d_dx.z) / det, true};
}

double plane_bias_ndc(const BiasOptions& options, const Receiver& receiver,
                      double kernel_radius_texels) noexcept {
  const double lift =
      lift_ndc(options, options.slope_texels + kernel_radius_texels, capped(receiver, options.max_slope));
  const double per_world =
      ndc_depth_per_world_unit(receiver.clip_from_world, receiver.light_direction, receiver.point);
  return per_world < 0.0 ? -lift : lift;
}

double plane_bias_world(const BiasOptions& options, const Receiver& receiver,
                        double kernel_radius_texels) noexcept {
  const double bias = plane_bias_ndc(options, receiver, kernel_radius_texels);
  const double per_world =
      ndc_depth_per_world_unit(receiver.clip_from_world, receiver.light_direction, receiver.point);
  // A light direction across the map's own has no depth to move along.
  return bias == 0.0 || per_world == 0.0 ? 0.0 : bias / per_world;
}

glm::dvec3 normal_offset_world(const BiasOptions& options, const Receiver& receiver,
                               double kernel_radius_texels) noexcept {
  const Receiver r = capped(receiver, options.max_slope);
  const double lift = lift_ndc(options, options.normal_offset_texels + kernel_radius_texels, r);
  if (!(lift > 0.0)) return glm::dvec3(0.0);
  const double per_world = std::abs(ndc_depth_per_world_unit(r.clip_from_world, r.light_direction, r.point));
  const glm::dmat4& m = r.clip_from_world;
  const glm::dvec3 row_w{m[0][3], m[1][3], m[2][3]};
  const double w = glm::dot(row_w, r.point) + m[3][3];
  // An offset o along the normal lies o / cos above the plane along the light, where a world unit is worth
  // per_world w / (w + o dw) of depth: o / cos * per_world w / (w + o dw) = lift, solved for o.
  const double cosine = -glm::dot(r.normal, r.light_direction), dw = glm::dot(row_w, receiver.normal);
  const double worth = per_world / cosine, loss = lift * dw / w;
  // A warp so strong that no offset would do: the first-order one.
  return receiver.normal * (lift / (worth > loss ? worth - loss : worth));
}

double adaptive_bias_ndc(const Receiver& receiver, double epsilon_world) noexcept {
  const Receiver r = capped(receiver, kSteepestPlane);
  const NdcJacobian b = ndc_jacobian(r.clip_from_world, r.point);
  const ReceiverPlane plane = plane_over_ndc(r, b);
  if (!plane.valid) return 0.0;
  const glm::dvec2 texel = r.texels.place(b.ndc).texel;
  const glm::dvec2 to_centre = r.texels.ndc_of(glm::floor(texel) + 0.5) - glm::dvec2(b.ndc);
  return glm::dot(plane.gradient, to_centre) - epsilon_world * glm::dot(b.z, r.light_direction);
}

double depth_rounding(DepthFormat format, double depth) noexcept {
  switch (format) {
    case DepthFormat::unorm16:
      return 0.5 / 65535.0;
    case DepthFormat::unorm24:
      return 0.5 / 16777215.0;
    case DepthFormat::float32:
      break;
  }
  // Half a unit of the last of 24 bits; zero and depths below the smallest normal number share its step.
  constexpr int kSmallestExponent = -125;
  int exponent = kSmallestExponent;
  if (depth != 0.0) (void)std::frexp(depth, &exponent);
  return std::ldexp(1.0, (exponent < kSmallestExponent ? kSmallestExponent : exponent) - 25);
}

double depth_rounding_world(DepthFormat format, const ClipSpace& clip_space,
                            const Receiver& receiver) noexcept {
  const NdcJacobian b =
      ndc_jacobian(texture_from_clip(clip_space) * receiver.clip_from_world, receiver.point);
  const double per_world = std::abs(glm::dot(b.z, receiver.light_direction));
  if (!(b.w > 0.0) || !(per_world > 0.0)) return std::numeric_limits<double>::infinity();
  return depth_rounding(format, b.ndc.z) / per_world;
}

// ---- Which bias goes with which filter ----

namespace {

using enum BiasKind;
using enum FilterClass;

constexpr std::size_t kFilters = 4, kBiases = 5;
constexpr std::array<BiasAdvice, kBiases* kFilters> kAdvice = {{
    {constant, single_compare, false, "what a texel's centre needs grows with the slope, without end"},
    {constant, wide_kernel, false, "the same, times the kernel's reach"},
    {constant, blocker_search, false, "the surface itself is found as its own blocker"},
    {constant, prefiltered, true, "averaged moments of a plane are the plane's; rounding is what remains"},

    {slope, single_compare, true, "half a texel of slope reaches the centre from anywhere in the texel"},
    {slope, wide_kernel, true, "with the kernel's radius in it; contact shadows move off by as much"},
    {slope, blocker_search, true, "with the search's radius in it; blockers nearer than that are missed"},
    {slope, prefiltered, true, "moves all moments alike; more than the filter needs"},

    {normal_offset, single_compare, true, "lifts the fragment off its plane by half a texel of slope"},
    {normal_offset, wide_kernel, true, "with the kernel's radius in it; shadows shift along the surface"},
    {normal_offset, blocker_search, true,
     "with the search's radius in it; distances to blockers shrink by it"},
    {normal_offset, prefiltered, true, "a look-up from above the surface; more than the filter needs"},

    {receiver_plane, single_compare, true,
     "the plane's own depth at the texel's centre: adaptive, no epsilon"},
    {receiver_plane, wide_kernel, true, "each tap gets the plane's own depth at its texel's centre"},
    {receiver_plane, blocker_search, true, "each tap gets the plane's own depth; blockers are never missed"},
    {receiver_plane, prefiltered, false,
     "texels are averaged before the comparison: no tap to give a depth to"},

    {adaptive, single_compare, true, "the plane's own depth at the one centre that is compared"},
    {adaptive, wide_kernel, false, "one depth for one centre; for each tap it is the receiver plane"},
    {adaptive, blocker_search, false, "one depth for one centre; for each tap it is the receiver plane"},
    {adaptive, prefiltered, false, "a filtered texel has no centre ray to meet the plane"},
}};

}  // namespace

std::span<const BiasAdvice> bias_advice() noexcept {
  return kAdvice;
}

const BiasAdvice& bias_with_filter(BiasKind bias, FilterClass filter) noexcept {
  return kAdvice[static_cast<std::size_t>(bias) * kFilters + static_cast<std::size_t>(filter)];
}

}  // namespace gnomon
