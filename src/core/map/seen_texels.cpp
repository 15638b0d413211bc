// Where do receivers that are seen need short texels?
// Based on: Rosen, "Rectilinear Texture Warping for Fast Adaptive Shadow Mapping", 2012: importance of what
// is seen, collapsed onto both axes of the map. Importance is the error itself: a linear texel's length there
// over a pixel's.
#include "map/seen_texels.hpp"

#include <cmath>

#include "geometry/jacobian.hpp"
#include "geometry/vector.hpp"
#include "map/row_shape.hpp"
#include "map/size.hpp"
#include "warp/registry.hpp"

namespace gnomon {
namespace {

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
    while (bin > 0 && (beyond -= count_[bin - 1]) >= 0) --bin;
    return std::exp2((static_cast<double>(bin) - 0.5 * kBins) / kPerOctave);
  }

 private:
  static constexpr std::size_t kBins = 1024;  // from 2^-16 to 2^16 pixels
  static constexpr double kPerOctave = 32.0;
  std::array<std::int64_t, kBins> count_{};
  std::int64_t all_ = 0;
};

/// A point that the camera sees and the map serves.
struct SeenTexel {
  glm::dvec2 ndc;
  glm::dvec2 share;   // place in the map without its margin, 0..1
  glm::dvec2 length;  // of a linear texel along x and y across the light, pixels
};

/// Calls `visit` with each point seen in the map's depths and rectangle.
template <class Visit>
void each_seen(const PlanContext& c, const MapRequest& request, const glm::dmat4& gl_from_relative,
               const ShadowMap& map, Visit&& visit) noexcept {
  const TexelGrid linear{map.width, map.height};
  const glm::dvec2 margin = static_cast<double>(map.filter_margin_texels) / linear.size();
  const glm::dvec3 travel = -request.space.frame.z;
  const double per_slope = pixels_per_slope(c.camera);
  for (const glm::dvec3& point : c.seen_points) {
    const glm::dvec3 relative = point - c.camera.position;
    const double depth = glm::dot(c.axes.forward, relative);
    if (!(depth >= request.begin && depth <= request.end)) continue;
    const TexelJacobian j = texel_jacobian(gl_from_relative, linear, relative);
    if (!(j.w > 0.0)) continue;
    SeenTexel seen{{j.ndc_x, j.ndc_y}, {}, {}};
    seen.share = (seen.ndc * 0.5 + 0.5 - margin) / (1.0 - 2.0 * margin);
    if (!(seen.share.x >= 0.0 && seen.share.x <= 1.0 && seen.share.y >= 0.0 && seen.share.y <= 1.0)) continue;
    const glm::dvec3 x = glm::cross(j.y, travel), y = glm::cross(travel, j.x);
    const double pixels =
        (c.camera.orthographic ? per_slope : per_slope / depth) / std::abs(glm::dot(j.x, x));
    seen.length = glm::dvec2(glm::length(x), glm::length(y)) * pixels;
    if (!(largest_component({seen.length.x, seen.length.y, 0.0}) < 1e30)) continue;
    if (seen.length.x > 0.0 && seen.length.y > 0.0) visit(seen);
  }
}

/// What linear texels leave to be done.
struct Seen {
  TexelNeeds needs;
  Lengths x, y, longer;  // along both axes, and the longer of both
};

void raise(double share, double length, std::array<double, kNeedStrips>& strips) noexcept {
  const auto strip = static_cast<std::size_t>(min_of(share * kNeedStrips, kNeedStrips - 1.0));
  strips[strip] = max_of(strips[strip], length);
}

/// The needs with none larger than that of this share of the points.
TexelNeeds without_extremes(const Seen& seen, double share) noexcept {
  TexelNeeds needs = seen.needs;
  const double most_x = seen.x.quantile(share), most_y = seen.y.quantile(share);
  for (double& length : needs.x) length = min_of(length, most_x);
  for (double& length : needs.y) length = min_of(length, most_y);
  return needs;
}

}  // namespace

bool follows_seen(const PlanContext& c) noexcept {
  return requested_shape(c.options).serving != nullptr && !c.seen_points.empty() && c.views.empty() &&
         c.options.filter.world == 0.0 && !keeps_linear_texels(c) && !sizes_follow_error(c);
}

glm::dvec2 serve_seen(const PlanContext& c, const MapRequest& request, const glm::dmat4& gl_from_relative,
                      MapResult& result) noexcept {
  if (!follows_seen(c)) return glm::dvec2(1.0);
  ShadowMap& map = result.map;
  if (map.width < request.slot.width || map.height < request.slot.height) {
    // Smaller as its error is small everywhere, which it would not stay.
    result.omit({OmissionKind::shape_without_gain, map.cascade, 1.0, 0.0, 0});
    return glm::dvec2(1.0);
  }
  const Shape& shape = requested_shape(c.options);
  Seen seen;
  seen.needs.margin_texels = map.filter_margin_texels;
  each_seen(c, request, gl_from_relative, map, [&](const SeenTexel& at) {
    raise(at.share.x, at.length.x, seen.needs.x);
    raise(at.share.y, at.length.y, seen.needs.y);
    seen.x.add(at.length.x);
    seen.y.add(at.length.y);
    seen.longer.add(max_of(at.length.x, at.length.y));
  });
  // A few points of great need would take the texels from all others. How few are too few differs from scene
  // to scene.
  constexpr std::array kShares{1.0, 0.95, 0.8};
  const double counted = c.options.warp.objective == Objective::max ? 1.0 : 0.95;
  const double before = seen.longer.quantile(counted);
  // Points have no normals. By those of the surfaces, less than a fifth is as often a loss.
  constexpr double kLeastGain = 0.2;
  const TexelGrid linear{map.width, map.height};
  ServingShape best;
  double least = before;
  for (const double share : kShares) {
    const ServingShape tried = shape.serving(without_extremes(seen, share));
    const TexelGrid grid{map.width, map.height, &shape, tried.parameters};
    Lengths longer;
    each_seen(c, request, gl_from_relative, map, [&](const SeenTexel& at) {
      const glm::dmat2 shaped = grid.place(at.ndc).texel_from_ndc, even = linear.place(at.ndc).texel_from_ndc;
      longer.add(max_of(at.length.x * even[0][0] / shaped[0][0], at.length.y * even[1][1] / shaped[1][1]));
    });
    const double after = longer.quantile(counted);
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
