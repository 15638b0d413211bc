// How do texel grids move from frame to frame, so that frames together see more than one? Sub-texel jitter of
// a plan's maps, for temporal accumulation (render::Accumulation).
// Based on: Scherzer, Jeschke, Wimmer, "Pixel-Correct Shadow Maps with Temporal Reprojection and Shadow Test
// Confidence", 2007.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "gnomon/plan.hpp"

namespace gnomon {

/// A jittered map reads so much farther than its plan, texels: add it to FilterOptions::texels
/// (`filter.texels`) before planning, so that no kernel leaves its map.
inline constexpr double kJitterReachTexels = 0.5;

/// Frames after which the offsets repeat: as many as Accumulation::memory counts.
inline constexpr std::uint32_t kJitterFrames = 64;

/// Offset of the grid in a frame, texels, each in (-0.5, 0.5): a lattice of 64 points, in an order in which
/// the first 8, 16 and 32 are lattices as well. Any kJitterFrames frames in a row hold all of it, so that
/// what has converged stays as it is.
[[nodiscard]] glm::dvec2 jitter_texels(std::uint32_t frame_index) noexcept;

/// The plan with the texel grid of every map moved by `offset_texels` across the light, at most
/// kJitterReachTexels along each axis; larger offsets and not-a-number are clamped. The maps serve the same
/// points and casters as before. Moved maps cannot be reused by the next frame: their snap keys are
/// invalid.
[[nodiscard]] ShadowPlan jittered(const ShadowPlan& plan, const glm::dvec2& offset_texels) noexcept;

}  // namespace gnomon
