// How small a map may be for a bound of its aliasing error.
// Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006 (the error at a body's
// vertices); the bound of m in any direction is this project's: a texel's longest extent across the light
// ray, over a pixel's shortest extent across the eye ray.
#include "map/size.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "lanes/point_pair.hpp"
#include "map/shared_views.hpp"

namespace gnomon {
namespace {

// Sizes come and go with the view, and images are reallocated for them: less is not worth another size.
constexpr double kWorthASize = 0.95;

int in_steps(double side, int least, int full) noexcept {
  const double steps = std::ceil(side / kSizeStep) * kSizeStep;
  if (!(steps < full)) return full;
  return static_cast<int>(max_of(steps, least < full ? least : full));
}

/// Squared length of the ray to the image's farthest corner, per unit of depth.
double longest_ray(const Camera& k) noexcept {
  const double x = max_of(std::abs(k.left), std::abs(k.right)),
               y = max_of(std::abs(k.bottom), std::abs(k.top));
  return 1.0 + x * x + y * y;
}

}  // namespace

int border_texels(const PlanOptions& options, int size, double share) noexcept {
  double wanted = options.filter.texels;
  if (options.filter.world > 0.0) {
    // Kernels wider than the side end up with the most there is; the border makes the side itself smaller.
    const double reach = options.filter.world * min_of(share, 1.0 / options.filter.world);
    wanted = max_of(wanted, reach * size / (1.0 + 2.0 * reach));
  }
  return static_cast<int>(std::ceil(min_of(wanted, 0.25 * size)));
}

double border_share(const PlanContext& c, const MapRequest& request, const LightBody& body,
                    const PlaneMap& plane) noexcept {
  if (!(c.options.filter.world > 0.0)) return 0.0;
  const double share = share_per_unit(plane, body.points());
  if (!request.space.perspective) return share;
  // A step across the ray at a distance is, as a slope, at most this step over the distance over the cosine
  // to the light's axis.
  double steepest = 0.0;
  for (const WarpInput::Point& p : body.points()) steepest = max_of(steepest, p.x * p.x + p.y * p.y);
  // In whole powers of two, so that a stable grid does not follow the nearest surface in view.
  const double nearest = c.how.stable ? std::ldexp(1.0, std::ilogb(body.nearest)) : body.nearest;
  return share * std::sqrt(1.0 + steepest) / nearest;
}

int border_of(const PlanOptions& options, int width, int height, double share) noexcept {
  // A kernel in world units has more texels along the longer side. The shorter side has room for no more than
  // a quarter of its own.
  const int longer = width > height ? width : height, shorter = width + height - longer;
  const int border = border_texels(options, longer, share);
  return border < shorter / 4 ? border : border_texels(options, shorter, share);
}

double pixel_obliquity(const PlanContext& c, const Polytope& body) noexcept {
  if (c.camera.orthographic) return 1.0;
  if (!c.views.empty()) {
    double longest = 1.0;
    for (const SharedView& view : c.views) longest = max_of(longest, longest_ray(view.camera));
    return std::sqrt(longest);
  }
  const DotPair along_view(c.axes.forward);
  const Pair near_depth(c.camera.near_depth);
  Pair most(1.0);
  for_each_two<VertexPair>(body.vertices(), [&](std::size_t, const VertexPair& two) {
    const Pair depth = max_of(along_view(two), near_depth);
    most = max_of(most, (two.x * two.x + two.y * two.y + two.z * two.z) / (depth * depth));
  });
  // Rounding beside the eye may tilt a ray beyond the image's corners.
  return std::sqrt(min_of(max_of(most.low(), most.high()), longest_ray(c.camera)));
}

double pixels_per_slope(const Camera& camera) noexcept {
  return max_of(camera.width / (camera.right - camera.left), camera.height / (camera.top - camera.bottom));
}

MapSize map_size(const PlanContext& c, const MapRequest& request, const PlaneMap& plane,
                 const TexelsNeeded& needed, double obliquity, double share) noexcept {
  const int full_width = request.slot.width, full_height = request.slot.height;
  MapSize size{full_width, full_height, border_of(c.options, full_width, full_height, share), 0.0};
  if (!(c.how.error_bound > 0.0)) return size;
  const auto bound = [&](const MapSize& s) {
    return needed.bound(glm::dvec2(s.width, s.height) - 2.0 * s.border, obliquity);
  };
  size.full_error = bound(size);
  const MapSize full = size;
  // A kernel in world units takes the same share of both sides; local lights keep squares.
  const bool square = c.options.filter.world > 0.0 || request.space.perspective;
  const double most_border = request.space.perspective && plane.stretch > 1.0
                                 ? max_of(kBorderGrowth / (plane.stretch - 1.0),
                                          static_cast<double>(full.border) / (full_width - 2.0 * full.border))
                                 : std::numeric_limits<double>::infinity();
  const auto holds = [&](const MapSize& s) {
    return bound(s) <= c.how.error_bound && s.border <= most_border * (s.width - 2.0 * s.border);
  };
  if (!holds(size)) return size;
  glm::dvec2 inside = needed.sides;
  if (square) inside = glm::dvec2(max_of(inside.x, inside.y));
  inside *= needed.bound(inside, obliquity) / c.how.error_bound;
  const double reach = c.options.filter.world > 0.0 ? c.options.filter.world * share : 0.0;
  const double texels = 2.0 * c.options.filter.texels;
  const int least = least_budget_side(c.options);
  const auto side = [&](double texels_inside, int most) {
    return in_steps(max_of(texels_inside + texels, texels_inside * (1.0 + 2.0 * reach)), least, most);
  };
  size.width = side(inside.x, full_width);
  size.height = side(inside.y, full_height);
  size.border = border_of(c.options, size.width, size.height, share);
  while (!holds(size)) {
    // One step along the side that is farther from what it needs.
    const bool wider = needed.sides.x * (size.height - 2.0 * size.border) >=
                       needed.sides.y * (size.width - 2.0 * size.border);
    if (square || (wider && size.width < full_width) || size.height >= full_height)
      size.width = in_steps(size.width + 1.0, least, full_width);
    if (square || (!wider && size.height < full_height) || size.width >= full_width)
      size.height = in_steps(size.height + 1.0, least, full_height);
    if (size.width >= full_width && size.height >= full_height) return full;
    size.border = border_of(c.options, size.width, size.height, share);
  }
  if (!(size.width < kWorthASize * full_width)) size.width = full_width;
  if (!(size.height < kWorthASize * full_height)) size.height = full_height;
  size.border = border_of(c.options, size.width, size.height, share);
  size.full_error = full.full_error;
  return holds(size) ? size : full;
}

}  // namespace gnomon
