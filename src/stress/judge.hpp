// How far a plan is from what exact arithmetic makes of the same parameters, and what of it survives in
// float.
#pragma once

#include <string>
#include <vector>

#include "exact.hpp"
#include "input.hpp"

namespace gnomon::stress {

/// The largest of each over the maps of a plan, at the corners of what each map shows and at points between.
/// Errors in texels; 0 where there is no map.
struct Judgement {
  bool finite = true;  ///< every number of the plan
  /// Doubles, as a consumer evaluates them, against long double: the place of a point in the map (its
  /// rectangle refitted to the exact body, its divisor, its grid), and how far a shadow lands from where the
  /// exact light ray leads.
  double error_texels = 0.0;
  double error_ulp = 0.0;              ///< the same in units of the last place of a double of the map's size
  double drift_texels = 0.0;           ///< the part of it that is the light ray's
  double float_absolute_texels = 0.0;  ///< world points and matrix in float
  double float_relative_texels = 0.0;  ///< offsets from the camera and clip_from_camera_relative
  double condition = 0.0;              ///< of the matrix over the map's own body: the map itself
  double condition_world = 0.0;  ///< over all coordinates up to the body's: what absolute coordinates add
};
[[nodiscard]] Judgement judge(const Input& input, const ShadowPlan& plan);

/// Points of a map: corners of what it shows and points between them, in world units.
[[nodiscard]] std::vector<glm::dvec3> points_of(const Input& input, const ShadowPlan& plan, int map,
                                                int between, std::uint64_t seed);

/// Texels per unit of area across the light at a point; 0 behind the map's projection.
[[nodiscard]] double texel_density(const ShadowMap& map, const glm::dvec3& point);

/// True where every number of the plan is finite.
[[nodiscard]] bool all_finite(const ShadowPlan& plan);

/// What the toolkit did: the warps that were used, or what stood in for a map ("optimal", "none", "cube, 5
/// faces", "nothing_visible", "refused: options.resolution.max_size").
[[nodiscard]] std::string used_by(const Input& input, const ShadowPlan& plan);
/// What the plan left out, by kind, with how often: "warp without gain x2".
[[nodiscard]] std::string left_out_of(const ShadowPlan& plan);

}  // namespace gnomon::stress
