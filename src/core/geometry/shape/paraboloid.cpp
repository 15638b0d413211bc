// Texels even in angle round a local light: places by where the light's rays meet a paraboloid, which does to
// slopes what a stereographic projection does. Based on: Heidrich, Seidel, "View-Independent Environment
// Maps", 1998, and Brabec, Annen, Seidel, "Shadow Mapping for Hemispherical and Omnidirectional Light
// Sources", 2002. Edges are curved there; maps of this shape are drawn texel by texel (Gascuel, Holzschuch,
// Fournier, Peroche, "Fast Non-Linear Projections Using Graphics Hardware", 2008), so that long ones stay
// right.
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "gnomon/extend/shape.hpp"

// A ray of slopes s off the light's axis lies at u = s / (1 + sqrt(1 + s s)), which is the tangent of half
// its angle. parameters[0, 1]: slopes at the middle of the square; [2, 3]: from there to its sides; [4, 5]
// and [6, 7]: u where the margins end, low and high, less that of the middle; [8]: the margin, texels. Sides
// of 0: linear texels. All counts from the middle, so that a narrow map is exact in single precision.
namespace gnomon::shapes {
namespace {

// Largest |u| that has a slope: that of a ray 89.4 degrees off the axis.
constexpr double kLongest = 0.99;

/// The parameters by their names.
struct Frame {
  glm::dvec2 middle, half, low, extent;
  double margin;

  explicit Frame(const ShapeParameters& p) noexcept
      : middle(p[0], p[1]),
        half(p[2], p[3]),
        low(p[4], p[5]),
        extent(p[6] - p[4], p[7] - p[5]),
        margin(p[8]) {}
  [[nodiscard]] bool linear() const noexcept {
    return !(half.x > 0.0 && half.y > 0.0 && extent.x > 0.0 && extent.y > 0.0);
  }
  [[nodiscard]] glm::dvec2 texels_per_u(const glm::dvec2& size) const noexcept {
    return (size - 2.0 * margin) / extent;
  }
};

glm::dvec2 u_of(const glm::dvec2& slope) noexcept {
  return slope / (1.0 + std::sqrt(1.0 + glm::dot(slope, slope)));
}

glm::dvec2 slope_of(glm::dvec2 u) noexcept {
  const double length = glm::length(u);
  if (length > kLongest) u *= kLongest / length;
  return u * (2.0 / (1.0 - glm::dot(u, u)));
}

/// u at slopes that are `step` beyond the middle's, less that of the middle.
glm::dvec2 u_beyond(const glm::dvec2& middle, const glm::dvec2& step) noexcept {
  const glm::dvec2 slope = middle + step;
  const double first = std::sqrt(1.0 + glm::dot(middle, middle)),
               root = std::sqrt(1.0 + glm::dot(slope, slope));
  const double longer = glm::dot(middle + slope, step) / (root + first);
  return (step * (1.0 + first) - middle * longer) / ((1.0 + root) * (1.0 + first));
}

/// The inverse.
glm::dvec2 slope_beyond(const glm::dvec2& middle, glm::dvec2 step) noexcept {
  const glm::dvec2 first = u_of(middle);
  glm::dvec2 u = first + step;
  const double length = glm::length(u);
  if (length > kLongest) {
    u *= kLongest / length;
    step = u - first;
  }
  const double left = 1.0 - glm::dot(first, first);
  return (step * left + first * glm::dot(first + u, step)) * (2.0 / ((1.0 - glm::dot(u, u)) * left));
}

/// The place of a range that is nearest to 0.
double nearest_to_zero(double low, double high) noexcept {
  return max_of(low, min_of(0.0, high));
}
/// The end of a range that is farthest from 0.
double farthest_from_zero(double low, double high) noexcept {
  return -low > high ? low : high;
}

/// Bounds of u over a rectangle of slopes. Each coordinate grows with the slope of its name, and shrinks with
/// the length of the other.
ShapeRectangle u_bounds(const glm::dvec2& low, const glm::dvec2& high) noexcept {
  const glm::dvec2 near{nearest_to_zero(low.x, high.x), nearest_to_zero(low.y, high.y)};
  const glm::dvec2 far{farthest_from_zero(low.x, high.x), farthest_from_zero(low.y, high.y)};
  return {{u_of({low.x, low.x < 0.0 ? near.y : far.y}).x, u_of({low.y < 0.0 ? near.x : far.x, low.y}).y},
          {u_of({high.x, high.x > 0.0 ? near.y : far.y}).x, u_of({high.y > 0.0 ? near.x : far.x, high.y}).y}};
}

/// Bounds of the slopes over a rectangle of u: each grows with the u of its name and with the other's length.
ShapeRectangle slope_bounds(const glm::dvec2& low, const glm::dvec2& high) noexcept {
  const glm::dvec2 near{nearest_to_zero(low.x, high.x), nearest_to_zero(low.y, high.y)};
  const glm::dvec2 far{farthest_from_zero(low.x, high.x), farthest_from_zero(low.y, high.y)};
  return {
      {slope_of({low.x, low.x < 0.0 ? far.y : near.y}).x, slope_of({low.y < 0.0 ? far.x : near.x, low.y}).y},
      {slope_of({high.x, high.x > 0.0 ? far.y : near.y}).x,
       slope_of({high.y > 0.0 ? far.x : near.x, high.y}).y}};
}

ShapedPoint place(const ShapeParameters& parameters, const glm::dvec2& size, const glm::dvec2& ndc) noexcept {
  const Frame f(parameters);
  if (f.linear()) return linear.place({}, size, ndc);
  const glm::dvec2 step = f.half * ndc, s = f.middle + step, scale = f.texels_per_u(size);
  const double root = std::sqrt(1.0 + glm::dot(s, s)), inverse = 1.0 / (1.0 + root);
  const double bend = inverse * inverse / root;
  const double cross = -s.x * s.y * bend;
  return {f.margin + (u_beyond(f.middle, step) - f.low) * scale,
          {(inverse - s.x * s.x * bend) * f.half.x * scale.x, cross * f.half.x * scale.y,
           cross * f.half.y * scale.x, (inverse - s.y * s.y * bend) * f.half.y * scale.y}};
}

glm::dvec2 ndc_of(const ShapeParameters& parameters, const glm::dvec2& size,
                  const glm::dvec2& texel) noexcept {
  const Frame f(parameters);
  if (f.linear()) return linear.ndc_of({}, size, texel);
  return slope_beyond(f.middle, f.low + (texel - f.margin) / f.texels_per_u(size)) / f.half;
}

ShapeRectangle texel_bounds(const ShapeParameters& parameters, const glm::dvec2& size,
                            const ShapeRectangle& ndc) noexcept {
  const Frame f(parameters);
  if (f.linear()) return linear.texel_bounds({}, size, ndc);
  const ShapeRectangle u = u_bounds(f.middle + f.half * ndc.low, f.middle + f.half * ndc.high);
  const glm::dvec2 scale = f.texels_per_u(size), low = u_of(f.middle) + f.low;
  return {f.margin + (u.low - low) * scale, f.margin + (u.high - low) * scale};
}

ShapeRectangle ndc_bounds(const ShapeParameters& parameters, const glm::dvec2& size,
                          const ShapeRectangle& texels) noexcept {
  const Frame f(parameters);
  if (f.linear()) return linear.ndc_bounds({}, size, texels);
  const glm::dvec2 scale = f.texels_per_u(size), low = u_of(f.middle) + f.low;
  const ShapeRectangle slopes =
      slope_bounds(low + (texels.low - f.margin) / scale, low + (texels.high - f.margin) / scale);
  return {(slopes.low - f.middle) / f.half, (slopes.high - f.middle) / f.half};
}

// It follows the light's rays, not the warp.
ShapeParameters undoing(double) noexcept {
  return {};
}

ShapeParameters mirrored(const ShapeParameters& parameters, bool x, bool y) noexcept {
  ShapeParameters result = parameters;
  const auto mirror = [&](std::size_t axis) {
    result[axis] = -parameters[axis];
    result[4 + axis] = -parameters[6 + axis];
    result[6 + axis] = -parameters[4 + axis];
  };
  if (x) mirror(0);
  if (y) mirror(1);
  return result;
}

RoundShape round(const ShapeRectangle& slopes, const glm::dvec2& size, int margin_texels) noexcept {
  const ShapeRectangle u = u_bounds(slopes.low, slopes.high);
  const glm::dvec2 extent = u.high - u.low;
  const glm::dvec2 margin = extent * static_cast<double>(margin_texels) / (size - 2.0 * margin_texels);
  // How far the rectangle's own edges reach when their texels are a margin farther out. Its corners lie
  // within the rectangle of u, and the farthest of all is next to one of them or where an edge passes the
  // axis.
  ShapeRectangle whole = slopes;
  const glm::dvec2 near{nearest_to_zero(slopes.low.x, slopes.high.x),
                        nearest_to_zero(slopes.low.y, slopes.high.y)};
  for (const double x : {slopes.low.x, near.x, slopes.high.x}) {
    for (const double y : {slopes.low.y, near.y, slopes.high.y}) {
      const glm::dvec2 at = u_of({x, y});
      const ShapeRectangle reach = slope_bounds(at - margin, at + margin);
      whole.low = glm::min(whole.low, reach.low);
      whole.high = glm::max(whole.high, reach.high);
    }
  }
  const glm::dvec2 middle = 0.5 * (whole.low + whole.high), half = 0.5 * (whole.high - whole.low);
  const glm::dvec2 far{farthest_from_zero(slopes.low.x, slopes.high.x),
                       farthest_from_zero(slopes.low.y, slopes.high.y)};
  // Along a ray's slope texels are longest in slopes, by the root R of 1 + s s: R (1 + R) for one of u.
  const double root = std::sqrt(1.0 + glm::dot(far, far));
  const glm::dvec2 low = u.low - u_of(middle), high = u.high - u_of(middle);
  return {
      {middle.x, middle.y, half.x, half.y, low.x, low.y, high.x, high.y, static_cast<double>(margin_texels)},
      whole,
      extent * (root * (1.0 + root)) / (slopes.high - slopes.low)};
}

}  // namespace

const Shape paraboloid{"paraboloid", "even in angle round a local light, as on a paraboloid",
                       false,        place,
                       ndc_of,       texel_bounds,
                       ndc_bounds,   undoing,
                       mirrored,     9,
                       nullptr,      round};

}  // namespace gnomon::shapes
