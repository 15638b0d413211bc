// One map of a spot's whole cone, or one for each face of a cube round it?
//
// By the angle alone: one map is tan(angle) times as wide as a face, and five faces have the texels of one
// map where its tangent is the root of five. By the picture: whichever has the smaller sum of m over what the
// camera sees at as many texels. A view that sees one face's part of a wide cone, or the edge of a narrow
// one, moves the bound either way.
#include "plan/spot_maps.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/first_hits.hpp"
#include "geometry/usable.hpp"
#include "geometry/vector.hpp"
#include "gnomon/measure.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {
namespace {

// Half angle from which the five faces that a cone reaches need fewer texels than one map, about 66 degrees.
constexpr double kWidestSingle = 1.1502619915109316;
// The same for texels that are even in angle, 85 degrees: at 90 the image plane is at infinity.
constexpr double kWidestRound = 1.4835298641951802;
// Half angles between which the view decides: 40 degrees, below which nearly all of a cone is in one face,
// and 75. At 82 the texels of one map were so long far off its axis that their bias lit all of a shadow
// (city), which no m counts.
constexpr double kNarrowestFaces = 0.6981317007977318, kWidestCone = 1.3089969389957472;

/// What a spot lights.
class Cone {
 public:
  explicit Cone(const SpotLight& spot) noexcept
      : spot_(spot),
        direction_(safe_normalize(spot.direction, {0.0, -1.0, 0.0})),
        cosine_(elementary::cos(spot.outer_radians)) {}
  [[nodiscard]] bool lights(const glm::dvec3& world) const noexcept {
    const glm::dvec3 offset = world - spot_.position;
    const double distance = std::sqrt(glm::dot(offset, offset));
    return distance <= spot_.range && glm::dot(offset, direction_) >= cosine_ * distance;
  }

 private:
  const SpotLight& spot_;
  glm::dvec3 direction_;
  double cosine_;
};

}  // namespace

bool shown_by_faces(const SpotLight& spot, const PlanOptions& options) noexcept {
  const Shape* shape = options.warp.shape;
  const bool round = shape != nullptr && shape->round != nullptr;
  return !(spot.outer_radians < (round ? kWidestRound : kWidestSingle));
}

LocalMaps maps_by_angle(const Light& light, const Resolved& resolved) noexcept {
  if (resolved.tetrahedron) return LocalMaps::tetrahedron;
  const auto* spot = std::get_if<SpotLight>(&light);
  return spot != nullptr && !shown_by_faces(*spot, resolved.options) ? LocalMaps::cone : LocalMaps::cube;
}

bool weighs_both(const PlanContext& c, const SpotLight& spot, const Resolved& resolved) noexcept {
  if (c.options.resolution.texel_budget == 0 || !resolved.counts_seen || c.how.has_history ||
      !(spot.outer_radians > kNarrowestFaces && spot.outer_radians < kWidestCone))
    return false;
  const Cone cone(spot);
  std::size_t lit = 0;
  for (const glm::dvec3& point : c.seen) lit += cone.lights(c.camera.position + point) ? 1 : 0;
  return lit >= SeenPoints::kFewest;
}

double seen_error(const PlanContext& c, const SpotLight& spot, const ShadowPlan& fitted,
                  const MapSizes& sizes) noexcept {
  const Cone cone(spot);
  double sum = 0.0;
  for (const glm::dvec3& point : c.seen) {
    const glm::dvec3 world = c.camera.position + point;
    // Maps show more than the cone, and not the same.
    if (!cone.lights(world)) continue;
    const int serving = map_serving(fitted, world, glm::dot(c.axes.forward, point));
    if (serving < 0) continue;  // no caster: right without texels
    const ShadowMap& map = fitted.map[static_cast<std::size_t>(serving)];
    const PointAliasing m = measure_perspective(map, c.camera, world);
    const double squares = m.perspective_s * m.perspective_s + m.perspective_t * m.perspective_t;
    if (!(squares < kLargest)) continue;
    const double border = 2.0 * map.filter_margin_texels;
    const int side = sizes.of[static_cast<std::size_t>(map.cascade)].width;
    sum += std::sqrt(0.5 * squares) * (map.width - border) / max_of(side - border, 1.0);
  }
  return sum;
}

}  // namespace gnomon
