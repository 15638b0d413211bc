// The camera, the maps and the boxes of a plan as lines in the picture of another camera.
#pragma once

#include <vector>

#include "canvas.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"
#include "state.hpp"

namespace gnomon::tool::view {

/// A line of the world.
struct WorldLine {
  glm::dvec3 from{0.0}, to{0.0};
  glm::u8vec4 color{255};
  double width = 1.5;  ///< pixels
};

/// The part of the lines that the camera sees.
[[nodiscard]] std::vector<ScreenLine> on_screen(const std::vector<WorldLine>& lines, const Camera& camera);

/// What `drawn` asks for, of a plan made for `frozen`.
[[nodiscard]] std::vector<WorldLine> plan_lines(const ShadowPlan& plan, const Camera& frozen,
                                                const std::vector<Box>& boxes, const Box& scene,
                                                const Drawn& drawn);

/// The same of pages: in place of the maps' volumes each page's outline behind all casters and receivers, in
/// its level's colour; no bodies.
[[nodiscard]] std::vector<WorldLine> page_lines(const PagePlan& plan, const Camera& frozen,
                                                const std::vector<Box>& boxes, const Drawn& drawn);

/// Edges of the receivers' body of one map: its slice of the frustum within the scene.
[[nodiscard]] std::vector<WorldLine> body_lines(const ShadowMap& map, const Camera& camera, const Box& scene,
                                                const glm::u8vec4& color);

/// Edges of what a map's casters are culled to, of the scene's box; none where the planes leave nothing.
[[nodiscard]] std::vector<WorldLine> culling_lines(const ShadowMap& map, const Box& scene,
                                                   const glm::u8vec4& color);
/// A plan made for the camera `frozen` as a renderer may draw it with another one: each map serves the depths
/// of the frozen view that it was planned for, wherever the new camera stands.
[[nodiscard]] ShadowPlan from_frozen(ShadowPlan plan, const Camera& frozen, const Camera& camera) noexcept;

}  // namespace gnomon::tool::view
