// Columns and rows of texels that are narrow where visible receivers need them: each axis has its own scale.
// Based on: Rosen, "Rectilinear Texture Warping for Fast Adaptive Shadow Mapping", 2012: importance of what
// is seen, projected onto both axes, gives a warp along each. There the warp is drawn by moving vertices;
// maps of this shape are drawn texel by texel, so that long edges stay right.
#include <algorithm>
#include <cmath>

#include "geometry/vector.hpp"
#include "gnomon/extend/shape.hpp"

// An axis without its margin is cut into kPieces pieces of as many texels each. parameters[0..6]: how far
// beyond the even place i / kPieces piece i begins, i from 1 on, as a share of the axis in ndc; [7..13]: the
// same for y; [14]: the margin, texels.
namespace gnomon::shapes {
namespace {

constexpr int kPieces = 8, kKnots = kPieces - 1;
// Narrowest piece, as a share of the axis: texels are at most this much shorter than linear ones, so that
// places in single precision stay a thousandth of a texel of 2048.
constexpr double kMaxShortening = 32.0, kNarrowest = 1.0 / (kPieces * kMaxShortening);
// Share of the largest need that is taken for what nobody sees: texels there are at most this much longer.
constexpr double kUnseen = 1.0 / 16.0;

/// One axis of a map: where its pieces begin, 0..1 without the margin.
struct Axis {
  std::array<double, kPieces + 1> begin;
  double margin;  // share of the whole axis
};

Axis axis_of(const ShapeParameters& parameters, int first, double size) noexcept {
  constexpr double kMaxMargin = 0.49;
  Axis axis;
  axis.margin = max_of(0.0, min_of(parameters[2 * kKnots] / size, kMaxMargin));
  axis.begin[0] = 0.0;
  axis.begin[kPieces] = 1.0;
  for (int i = 1; i < kPieces; ++i)
    axis.begin[static_cast<std::size_t>(i)] =
        static_cast<double>(i) / kPieces + parameters[static_cast<std::size_t>(first + i - 1)];
  return axis;
}

/// A share of one side, and its derivative over the other's.
struct Share {
  double at, slope;
};

/// Of the texels, from that of the square. The margin and what lies beyond it is linear.
Share texels_of(const Axis& axis, double square) noexcept {
  const double inside = 1.0 - 2.0 * axis.margin, at = (square - axis.margin) / inside;
  if (!(at > 0.0 && at < 1.0)) return {square, 1.0};
  std::size_t i = 0;
  while (i + 1 < kPieces && at >= axis.begin[i + 1]) ++i;
  const double slope = 1.0 / (kPieces * (axis.begin[i + 1] - axis.begin[i]));
  return {axis.margin + inside * (static_cast<double>(i) / kPieces + (at - axis.begin[i]) * slope), slope};
}

/// Of the square, from that of the texels.
double square_of(const Axis& axis, double texels) noexcept {
  const double inside = 1.0 - 2.0 * axis.margin, at = (texels - axis.margin) / inside;
  if (!(at > 0.0 && at < 1.0)) return texels;
  const auto i = static_cast<std::size_t>(min_of(at * kPieces, kPieces - 1.0));
  const double within = at * kPieces - static_cast<double>(i);
  return axis.margin + inside * (axis.begin[i] + (axis.begin[i + 1] - axis.begin[i]) * within);
}

ShapedPoint place(const ShapeParameters& parameters, const glm::dvec2& size, const glm::dvec2& ndc) noexcept {
  const Share x = texels_of(axis_of(parameters, 0, size.x), ndc.x * 0.5 + 0.5);
  const Share y = texels_of(axis_of(parameters, kKnots, size.y), ndc.y * 0.5 + 0.5);
  return {{x.at * size.x, y.at * size.y}, {0.5 * size.x * x.slope, 0.0, 0.0, 0.5 * size.y * y.slope}};
}

glm::dvec2 ndc_of(const ShapeParameters& parameters, const glm::dvec2& size,
                  const glm::dvec2& texel) noexcept {
  const glm::dvec2 share = texel / size;
  return glm::dvec2(square_of(axis_of(parameters, 0, size.x), share.x),
                    square_of(axis_of(parameters, kKnots, size.y), share.y)) *
             2.0 -
         1.0;
}

// Both axes are monotone: a rectangle's corners are its image's.
ShapeRectangle texel_bounds(const ShapeParameters& parameters, const glm::dvec2& size,
                            const ShapeRectangle& ndc) noexcept {
  return {place(parameters, size, ndc.low).texel, place(parameters, size, ndc.high).texel};
}

ShapeRectangle ndc_bounds(const ShapeParameters& parameters, const glm::dvec2& size,
                          const ShapeRectangle& texels) noexcept {
  return {ndc_of(parameters, size, texels.low), ndc_of(parameters, size, texels.high)};
}

// It follows what is seen, not the warp.
ShapeParameters undoing(double) noexcept {
  return {};
}

ShapeParameters mirrored(const ShapeParameters& parameters, bool x, bool y) noexcept {
  ShapeParameters result = parameters;
  for (std::size_t i = 0; i < kKnots; ++i) {
    if (x) result[i] = -parameters[kKnots - 1 - i];
    if (y) result[kKnots + i] = -parameters[2 * kKnots - 1 - i];
  }
  return result;
}

using Strips = std::array<double, kNeedStrips>;

/// Where a piece that begins at `begin` ends when length times the largest need in it is `most`.
double end_of(const Strips& need, double begin, double most) noexcept {
  constexpr double kStrip = 1.0 / kNeedStrips;
  double largest = 0.0;
  for (auto i = static_cast<std::size_t>(begin * kNeedStrips); i < kNeedStrips; ++i) {
    const double strip = static_cast<double>(i) * kStrip;
    if (need[i] > largest) {
      if (strip > begin && strip - begin >= most / need[i]) return strip;
      largest = need[i];
    }
    const double end = begin + most / largest;
    if (end < strip + kStrip) return end;
  }
  return 1.0;
}

/// Cuts the axis so that no piece exceeds `most`. False where more pieces would be needed.
bool cut(const Strips& need, double most, std::array<double, kPieces + 1>& begin) noexcept {
  int count = 0;
  begin[0] = 0.0;
  while (count < kPieces && begin[static_cast<std::size_t>(count)] < 1.0) {
    const double from = begin[static_cast<std::size_t>(count)], to = end_of(need, from, most);
    begin[static_cast<std::size_t>(++count)] = min_of(1.0, max_of(to, from + kNarrowest));
  }
  if (begin[static_cast<std::size_t>(count)] < 1.0) return false;
  // Pieces that are not needed: the last is cut further.
  const int last = count - 1;
  const double from = begin[static_cast<std::size_t>(last)], parts = kPieces - last;
  for (int i = count; i <= kPieces; ++i)
    begin[static_cast<std::size_t>(i)] = from + (1.0 - from) * static_cast<double>(i - last) / parts;
  return true;
}

/// The largest of the needs, 0 where there is none that counts.
double largest_of(const Strips& need) noexcept {
  double largest = 0.0;
  for (const double n : need) largest = std::isfinite(n) ? max_of(largest, n) : largest;
  return largest;
}

/// Each strip with its neighbours, and a little for what nobody sees.
Strips spread(const Strips& need, double largest) noexcept {
  Strips result;
  for (std::size_t i = 0; i < kNeedStrips; ++i) {
    double most = kUnseen * largest;
    for (std::size_t k = i > 0 ? i - 1 : 0; k <= std::min(i + 1, kNeedStrips - 1); ++k)
      most = need[k] <= largest ? max_of(most, need[k]) : most;
    result[i] = most;
  }
  return result;
}

/// Cuts one axis where that lowers its largest need, and says by how much.
void serve(const Strips& needs, int first, ShapeParameters& parameters, double& left,
           double& longest) noexcept {
  const double largest = largest_of(needs);
  if (!(largest > 0.0)) return;
  const Strips need = spread(needs, largest);
  std::array<double, kPieces + 1> begin, best;
  double low = 0.0, high = largest / kPieces;
  // Even pieces are one way to do it, so that there is always an end.
  for (int i = 0; i <= kPieces; ++i) best[static_cast<std::size_t>(i)] = static_cast<double>(i) / kPieces;
  constexpr int kHalvings = 24;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    if (cut(need, middle, begin)) {
      best = begin;
      high = middle;
    } else {
      low = middle;
    }
  }
  double widest = 0.0, most = 0.0;
  for (std::size_t i = 0; i < kPieces; ++i) {
    const double width = best[i + 1] - best[i];
    widest = max_of(widest, width);
    const auto end =
        static_cast<std::size_t>(min_of(std::ceil(best[i + 1] * kNeedStrips), 1.0 * kNeedStrips));
    for (auto k = static_cast<std::size_t>(best[i] * kNeedStrips); k < end; ++k)
      most = max_of(most, width * need[k]);
  }
  const double ratio = kPieces * most / largest;
  if (!(ratio < 1.0)) return;
  for (int i = 1; i < kPieces; ++i)
    parameters[static_cast<std::size_t>(first + i - 1)] =
        best[static_cast<std::size_t>(i)] - static_cast<double>(i) / kPieces;
  left = ratio;
  longest = kPieces * widest;
}

ServingShape serving(const TexelNeeds& needs) noexcept {
  ServingShape result;
  serve(needs.x, 0, result.parameters, result.left.x, result.longest.x);
  serve(needs.y, kKnots, result.parameters, result.left.y, result.longest.y);
  result.parameters[2 * kKnots] = needs.margin_texels;
  return result;
}

}  // namespace

const Shape rectilinear{"rectilinear", "columns and rows each as narrow as visible points need them",
                        false,         place,
                        ndc_of,        texel_bounds,
                        ndc_bounds,    undoing,
                        mirrored,      2 * kKnots + 1,
                        serving};

}  // namespace gnomon::shapes
