// How do a map's texels lie along its warp?
// Based on: Lloyd, Govindaraju, Quammen, Molnar, Manocha, "Logarithmic Perspective Shadow Maps", 2008: texels
// even in ln(w) behind a perspective projection. 1 / w is linear over the image, so that a shape needs no
// more than w's growth over it.
// Based on: Rosen, "Rectilinear Texture Warping for Fast Adaptive Shadow Mapping", 2012: importance of what
#include "map/texel_shape.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/extend/warp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "map/gain.hpp"
#include "map/size.hpp"
#include "warp/plane_error.hpp"

namespace gnomon {
namespace {

// Logarithm of the growth of w over a body, 1998-fold, that leaves room for a border below kMaxLogGrowth.
constexpr double kMaxOverBody = 7.6;
// Below it rows are straight but for a few thousandths.
constexpr double kLeastGrowth = 1.0 / 32.0;

constexpr glm::dvec2 kUnit{1.0};

/// 1 / w over its value at u_min, where the image's B is `b`.
double inverse_w(const PlaneMap& plane, double b) noexcept {
  return 1.0 - plane.choice.kappa * b / (plane.choice.row_b.y * plane.stretch);
}

/// Growth over the whole map, whose border is part of it.
double log_growth_of_map(double log_growth, double border) noexcept {
  return log_growth / (1.0 - 2.0 * border);
}

/// The slopes off the light's axis from which the image of an unwarped plane counts.
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

/// How many lengths there are of each size, in steps of a fiftieth.
class Lengths {
 public:
  void add(double length) noexcept {
    const double bin = kPerOctave * std::log2(length) + 0.5 * kBins;
    ++count_[static_cast<std::size_t>(max_of(0.0, min_of(bin, kBins - 1.0)))];
    ++all_;
  }
  /// The length that this share of all does not exceed.
  [[nodiscard]] double quantile(double share) const noexcept {
    std::int64_t beyond = all_ - static_cast<std::int64_t>(share * static_cast<double>(all_));
    std::size_t bin = kBins;
    while (bin > 0 && (beyond -= std::int64_t{count_[bin - 1]}) >= 0) --bin;
    return std::exp2((static_cast<double>(bin) - 0.5 * kBins) / kPerOctave);
  }

 private:
  static constexpr std::size_t kBins = 1024;  // from 2^-16 to 2^16 pixels
  static constexpr double kPerOctave = 32.0;
  std::array<std::uint32_t, kBins> count_{};
  std::int64_t all_ = 0;
};

/// A point that the camera sees and the map serves.
struct VisibleTexel {
  glm::dvec2 ndc;
  glm::dvec2 share;   // place in the map without its margin, 0..1
  glm::dvec2 length;  // of a linear texel along x and y across the light, pixels
};

/// Calls `visit` with each visible point in the map's depths and rectangle.
template <class Visit>
void each_visible(const PlanContext& c, const MapRequest& request, const glm::dmat4& gl_from_relative,
                  const ShadowMap& map, Visit&& visit) noexcept {
  const TexelGrid linear{map.width, map.height};
  const glm::dvec2 margin = static_cast<double>(map.filter_margin_texels) / linear.size();
  const glm::dvec3 travel = -request.space.frame.z;
  const double per_slope = pixels_per_slope(c.camera);
  for (const glm::dvec3& point : c.visible_points) {
    const glm::dvec3 relative = point - c.camera.position;
    const double depth = glm::dot(c.axes.forward, relative);
    if (!(depth >= request.begin && depth <= request.end)) continue;
    const TexelJacobian j = texel_jacobian(gl_from_relative, linear, relative);
    if (!(j.w > 0.0)) continue;
    VisibleTexel at{{j.ndc_x, j.ndc_y}, {}, {}};
    at.share = (at.ndc * 0.5 + 0.5 - margin) / (1.0 - 2.0 * margin);
    if (!(at.share.x >= 0.0 && at.share.x <= 1.0 && at.share.y >= 0.0 && at.share.y <= 1.0)) continue;
    const glm::dvec3 x = glm::cross(j.y, travel), y = glm::cross(travel, j.x);
    const double pixels =
        (c.camera.orthographic ? per_slope : per_slope / depth) / std::abs(glm::dot(j.x, x));
    at.length = glm::dvec2(glm::length(x), glm::length(y)) * pixels;
    if (!(largest_component({at.length.x, at.length.y, 0.0}) < 1e30)) continue;
    if (at.length.x > 0.0 && at.length.y > 0.0) visit(at);
  }
}

/// What linear texels leave to be done.
struct VisibleNeeds {
  TexelNeeds needs;
  Lengths x, y, longer;  // along both axes, and the longer of both
};

void raise(double share, double length, std::array<double, kNeedStrips>& strips) noexcept {
  const auto strip = static_cast<std::size_t>(min_of(share * kNeedStrips, kNeedStrips - 1.0));
  strips[strip] = max_of(strips[strip], length);
}

/// How long texels of this shape are, in pixels, by this share of the points. Out of line, as are the errors
/// below: who asks need not make room for them.
[[gnu::noinline]] double length_under(const PlanContext& c, const MapRequest& request,
                                      const glm::dmat4& gl_from_relative, const ShadowMap& map,
                                      const TexelGrid& grid, double share) noexcept {
  const TexelGrid linear{map.width, map.height};
  Lengths longer;
  each_visible(c, request, gl_from_relative, map, [&](const VisibleTexel& at) {
    const glm::dmat2 shaped = grid.place(at.ndc).texel_from_ndc, even = linear.place(at.ndc).texel_from_ndc;
    longer.add(max_of(at.length.x * even[0][0] / shaped[0][0], at.length.y * even[1][1] / shaped[1][1]));
  });
  return longer.quantile(share);
}

/// The needs with none larger than that of this share of the points.
TexelNeeds without_extremes(const VisibleNeeds& visible, double share) noexcept {
  TexelNeeds needs = visible.needs;
  const double most_x = visible.x.quantile(share), most_y = visible.y.quantile(share);
  for (double& length : needs.x) length = min_of(length, most_x);
  for (double& length : needs.y) length = min_of(length, most_y);
  return needs;
}

}  // namespace

double RowShape::lengthening(const PlaneMap& plane, double x, double y) const noexcept {
  if (!bent()) return 1.0;
  const double b = plane.choice.row_b.y * plane.image(x, y).y;
  const double share = (b - plane.b_min) / (plane.b_max - plane.b_min);
  const ShapedPoint p = shape->place(shape->undoing(log_growth), kUnit, {0.0, 2.0 * share - 1.0});
  return 0.5 / p.texel_from_ndc[1][1];
}

RowShape row_shape(const PlanContext& c, const PlaneMap& plane, double border) noexcept {
  const Shape& shape = *c.how.shape;
  const glm::dvec2 row = plane.choice.row_b;
  if (!undoes_warps(shape) || !(plane.choice.kappa > 0.0) || row.x != 0.0 || !(row.y > 0.0) ||
      plane.choice.row_a != glm::dvec2(1.0, 0.0))
    return {};
  const double near = inverse_w(plane, plane.b_min), far = inverse_w(plane, plane.b_max);
  if (!(far > 0.0) || !(near > far)) return {};
  const double log_growth = elementary::log(near / far);
  if (log_growth < kLeastGrowth || !(log_growth_of_map(log_growth, border) <= kMaxLogGrowth)) return {};
  return {&shape, log_growth};
}

void limit_to_shape(const PlanContext& c, std::span<const WarpInput::Point> body, PlaneMap& plane) noexcept {
  if (!undoes_warps(*c.how.shape)) return;
  const double most = elementary::exp(kMaxOverBody);
  if (!(plane.stretch > most)) return;
  WarpChoice choice = plane.choice;
  choice.kappa = (most - 1.0) / plane.length;
  plane = plane_map(body, choice);
}

void texels_needed(const RowShape& rows, std::span<const WarpInput::Point> body, const PlaneMap& plane,
                   TexelsNeeded& needed) noexcept {
  if (!rows.bent()) return;
  // Along the warp an extent is a product of two linear functions over depth, as w w is without the shape:
  // largest at a vertex.
  double longest = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(needed.count); ++i) {
    glm::dvec2& b = needed.vertex[i].b;
    b *= rows.lengthening(plane, body[i].x, body[i].y);
    longest = max_of(longest, b.x * b.x + b.y * b.y);
  }
  needed.sides.y = std::sqrt(longest);
}

BorderedPlane with_border(const RowShape& rows, const PlaneMap& plane, double border) noexcept {
  BorderedPlane result{plane, rows.shape->undoing(log_growth_of_map(rows.log_growth, border)), 0.0};
  // Shares of the whole map's rectangle where the body's begins and ends.
  const auto share = [&](double texels) {
    return 0.5 + 0.5 * rows.shape->ndc_of(result.parameters, kUnit, {0.0, texels}).y;
  };
  const double begin = share(border), end = share(1.0 - border);
  const double whole = (plane.b_max - plane.b_min) / (end - begin);
  result.plane.b_min = plane.b_min - begin * whole;
  result.plane.b_max = plane.b_max + (1.0 - end) * whole;
  result.log_w = border * log_growth_of_map(rows.log_growth, border);
  return result;
}

namespace {

/// How long round texels are over linear ones, over the body.
[[gnu::noinline]] double round_ratio(const WarpInput& in, const TexelGrid& round, const PlaneMap& whole,
                                     const TexelGrid& linear, const PlaneMap& plane, bool longest) noexcept {
  const PlaneError error(in, true);
  if (error.counted().count == 0) return 1.0;
  return length_over(error.counted(), whole, round, longest) /
         length_over(error.counted(), plane, linear, longest);
}

[[gnu::noinline]] double round_ratio(const PlanContext& c, const MapRequest& request, const LightBody& body,
                                     const TexelGrid& round, const PlaneMap& whole, const TexelGrid& linear,
                                     const PlaneMap& plane) noexcept {
  // By storage as well: the one worst texel, in a corner, says little of the others.
  const bool longest = c.options.warp.objective == Objective::max;
  return with_question(c, request, body, [&](WarpQuestion& question) {
    if (!longest) question.in.objective = Objective::p95;
    return round_ratio(question.in, round, whole, linear, plane, longest);
  });
}

}  // namespace

RoundTexels round_texels(const PlanContext& c, const MapRequest& request, const LightBody& body,
                         const PlaneMap& plane, MapResult& result, PlaneMap& whole) noexcept {
  RoundTexels texels;
  const Shape& shape = *c.how.shape;
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
    const int margin = 2 * map.filter_margin_texels;
    ratio = round_ratio(c, request, body, {map.width, map.height, &shape, round.parameters}, whole,
                        {map.width - margin, map.height - margin}, plane);
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

glm::dvec2 serve_visible(const PlanContext& c, const MapRequest& request, const glm::dmat4& gl_from_relative,
                         MapResult& result) noexcept {
  ShadowMap& map = result.map;
  if (map.width < request.slot.width || map.height < request.slot.height) {
    // Smaller as its error is small everywhere, which it would not stay.
    result.omit({OmissionKind::shape_without_gain, map.cascade, 1.0, 0.0, 0});
    return glm::dvec2(1.0);
  }
  const Shape& shape = *c.how.shape;
  VisibleNeeds visible;
  visible.needs.margin_texels = map.filter_margin_texels;
  each_visible(c, request, gl_from_relative, map, [&](const VisibleTexel& at) {
    raise(at.share.x, at.length.x, visible.needs.x);
    raise(at.share.y, at.length.y, visible.needs.y);
    visible.x.add(at.length.x);
    visible.y.add(at.length.y);
    visible.longer.add(max_of(at.length.x, at.length.y));
  });
  // A few points of great need would take the texels from all others. How few are too few differs from scene
  // to scene.
  constexpr std::array kShares{1.0, 0.95, 0.8};
  const double counted = c.options.warp.objective == Objective::max ? 1.0 : 0.95;
  const double before = visible.longer.quantile(counted);
  // Points have no normals. By those of the surfaces, less than a fifth is as often a loss.
  constexpr double kLeastGain = 0.2;
  ServingShape best;
  double least = before;
  for (const double share : kShares) {
    const ServingShape tried = shape.serving(without_extremes(visible, share));
    const TexelGrid grid{map.width, map.height, &shape, tried.parameters};
    const double after = length_under(c, request, gl_from_relative, map, grid, counted);
    if (!(after < least)) continue;
    best = tried;
    least = after;
  }
  if (!(least < (1.0 - kLeastGain) * before)) {
    result.omit({OmissionKind::shape_without_gain, map.cascade, least / before, 0.0, 0});
    return glm::dvec2(1.0);
  }
  map.shape = &shape;
  map.shape_parameters = best.parameters;
  return best.longest;
}

}  // namespace gnomon
