// How do a map's texels lie along its warp?
// Based on: Lloyd, Govindaraju, Quammen, Molnar, Manocha, "Logarithmic Perspective Shadow Maps", 2008: texels
// even in ln(w) behind a perspective projection. 1 / w is linear over the image, so that a shape needs no
// more than w's growth over it.
#include "map/row_shape.hpp"

#include <cmath>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"
#include "map/seen_texels.hpp"
#include "warp/registry.hpp"

namespace gnomon {
namespace {

// Logarithm of the growth of w over a body, 1998-fold, that leaves room for a border below kMostLogGrowth.
constexpr double kMostOverBody = 7.6;
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

}  // namespace

double RowShape::lengthening(const PlaneMap& plane, double x, double y) const noexcept {
  if (!bent()) return 1.0;
  const double b = plane.choice.row_b.y * plane.image(x, y).y;
  const double share = (b - plane.b_min) / (plane.b_max - plane.b_min);
  const ShapedPoint p = shape->place(shape->undoing(log_growth), kUnit, {0.0, 2.0 * share - 1.0});
  return 0.5 / p.texel_from_ndc[1][1];
}

bool ignores_shape(const PlanContext& c, bool local_light) noexcept {
  const Shape& shape = requested_shape(c.options);
  if (shape.serving != nullptr) return local_light || !follows_seen(c);
  if (shape.round != nullptr && (!local_light || sizes_follow_error(c))) return true;
  return !shape.affine && keeps_linear_texels(c);
}

bool keeps_linear_texels(const PlanContext& c) noexcept {
  return c.options.fit != Fit::tight || c.remembers;
}

bool sizes_follow_error(const PlanContext& c) noexcept {
  return c.options.resolution.max_error > 0.0 || c.options.resolution.texel_budget > 0;
}

RowShape row_shape(const PlanContext& c, const PlaneMap& plane, double border) noexcept {
  const Shape& shape = requested_shape(c.options);
  const glm::dvec2 row = plane.choice.row_b;
  if (!undoes_warps(shape) || keeps_linear_texels(c) || !(plane.choice.kappa > 0.0) || row.x != 0.0 ||
      !(row.y > 0.0) || plane.choice.row_a != glm::dvec2(1.0, 0.0))
    return {};
  const double near = inverse_w(plane, plane.b_min), far = inverse_w(plane, plane.b_max);
  if (!(far > 0.0) || !(near > far)) return {};
  const double log_growth = elementary::log(near / far);
  if (log_growth < kLeastGrowth || !(log_growth_of_map(log_growth, border) <= kMostLogGrowth)) return {};
  return {&shape, log_growth};
}

void limit_to_shape(const PlanContext& c, std::span<const WarpInput::Point> body, PlaneMap& plane) noexcept {
  if (!undoes_warps(requested_shape(c.options)) || keeps_linear_texels(c)) return;
  const double most = elementary::exp(kMostOverBody);
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

}  // namespace gnomon
