// How far a plan is from what exact arithmetic makes of the same parameters, and what of it survives in
// float.
#pragma once

#include <string>
#include <vector>

#include "base/stress_rows.hpp"
#include "exact.hpp"
#include "input.hpp"

namespace gnomon::stress {

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
