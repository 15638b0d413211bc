// What does the plan do at one point of the picture, and what do exact rays report there?
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/measure.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/trace/tracer.hpp"
#include "lines.hpp"

namespace gnomon::tool::view {

struct Probed {
  bool hit = false;  ///< false: the sky, and the rest is unset
  glm::dvec3 point{0.0}, normal{0.0};
  double view_depth = 0.0;
  std::uint32_t instance = 0;  ///< of the scene, that the point lies on
  int map = -1;                ///< map or page that serves the point; -1: none
  std::optional<Page> page;    ///< that it is, where pages serve
  PointAliasing aliasing;      ///< in it
  glm::dvec2 texel{0.0};       ///< of that map, or of the page's level
  bool shadow = false;         ///< by an exact ray
  bool turned_away = false;    ///< from the light: dark without any map
  std::vector<WorldLine>
      footprint;  ///< the texel's outline on the surface's plane; empty where there is none
};

/// `x`, `y`: pixels from the upper left corner of the camera's image. `plan`: as it was drawn. `pages`: those
/// that were drawn in its place, or nullptr.
[[nodiscard]] Probed probe(const trace::Tracer& tracer, const ShadowPlan& plan, const Camera& camera,
                           const Light& light, double x, double y, const PagePlan* pages = nullptr);

}  // namespace gnomon::tool::view
