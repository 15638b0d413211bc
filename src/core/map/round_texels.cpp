// When do texels of a local light's map lie even in angle?
#include "map/round_texels.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "geometry/vector.hpp"
#include "map/gain.hpp"
#include "map/row_shape.hpp"
#include "warp/plane_error.hpp"
#include "warp/registry.hpp"

namespace gnomon {
namespace {

/// Of an unwarped plane: slopes off the light's axis, from which the image counts.
glm::dvec2 first_slopes(const PlaneMap& plane) noexcept {
  return {plane.choice.centre, plane.u_min};
}

/// How long texels are over the body in pixels: the length that a twentieth exceeds, or the longest.
double length_over(const PixelLanes& samples, const PlaneMap& plane, const TexelGrid& grid,
                   bool longest) noexcept {
  const glm::dvec2 low{plane.a_min, plane.b_min},
      ndc_per_slope = 2.0 / (glm::dvec2(plane.a_max, plane.b_max) - low);
  const glm::dvec2 axis = plane.choice.axis;
  std::array<double, PixelLanes::kMost> length;
  for (std::size_t i = 0; i < samples.count; ++i) {
    const glm::dvec2 ndc = (plane.image(samples.x[i], samples.y[i]) - low) * ndc_per_slope - 1.0;
    // The image is the light plane turned.
    const glm::dmat2 image_from_pixel =
        glm::dmat2(axis.y, axis.x, -axis.x, axis.y) *
        glm::dmat2(samples.xx[i], samples.yx[i], samples.xy[i], samples.yy[i]);
    const glm::dmat2 pixel_from_texel =
        glm::inverse(grid.place(ndc).texel_from_ndc * glm::dmat2(ndc_per_slope.x, 0.0, 0.0, ndc_per_slope.y) *
                     image_from_pixel);
    length[i] = max_of(glm::length(pixel_from_texel[0]), glm::length(pixel_from_texel[1]));
  }
  const auto end = length.begin() + static_cast<std::ptrdiff_t>(samples.count);
  const std::size_t above = longest ? 0 : samples.count / 20;
  const auto at = end - 1 - static_cast<std::ptrdiff_t>(above);
  std::nth_element(length.begin(), at, end);
  return *at;
}

}  // namespace

RoundTexels round_texels(const PlanContext& c, const MapRequest& request, const LightBody& body,
                         const PlaneMap& plane, MapResult& result, PlaneMap& whole) noexcept {
  RoundTexels texels;
  const Shape& shape = requested_shape(c.options);
  if (!request.space.perspective || keeps_linear_texels(c) || sizes_follow_error(c)) return texels;
  ShadowMap& map = result.map;
  // A map that is smaller as its error is small everywhere would not keep it so.
  const bool full = map.width >= request.slot.width && map.height >= request.slot.height;
  const bool unwarped = full && plane.choice.kappa == 0.0 && plane.choice.row_a == glm::dvec2(1.0, 0.0) &&
                        plane.choice.row_b == glm::dvec2(0.0, 1.0);
  double ratio = 1.0;
  ShapeParameters parameters{};
  if (unwarped) {
    const glm::dvec2 first = first_slopes(plane), size(map.width, map.height);
    const ShapeRectangle slopes{first + glm::dvec2(plane.a_min, plane.b_min),
                                first + glm::dvec2(plane.a_max, plane.b_max)};
    const RoundShape round = shape.round(slopes, size, map.filter_margin_texels);
    parameters = round.parameters;
    whole = plane;
    whole.a_min = round.slopes.low.x - first.x;
    whole.a_max = round.slopes.high.x - first.x;
    whole.b_min = round.slopes.low.y - first.y;
    whole.b_max = round.slopes.high.y - first.y;
    const glm::dvec2 beyond =
        glm::max(slopes.low - round.slopes.low, round.slopes.high - slopes.high) / (slopes.high - slopes.low);
    texels.border = max_of(beyond.x, beyond.y);
    texels.longest = round.longest;
    // By storage as well: the one worst texel, in a corner, says little of the others.
    const bool longest = c.options.warp.objective == Objective::max;
    WarpQuestion question(c, request, body);
    if (!longest) question.in.objective = Objective::p95;
    const PlaneError error(question.in, true);
    const int margin = 2 * map.filter_margin_texels;
    if (error.counted().count > 0)
      ratio =
          length_over(error.counted(), whole, {map.width, map.height, &shape, round.parameters}, longest) /
          length_over(error.counted(), plane, {map.width - margin, map.height - margin}, longest);
  }
  texels.used = ratio < 1.0 - kLeastWarpGain;
  if (!texels.used) {
    result.omit({OmissionKind::shape_without_gain, map.cascade, ratio, 0.0, 0});
    return {};
  }
  map.shape = &shape;
  map.shape_parameters = parameters;
  return texels;
}

}  // namespace gnomon
