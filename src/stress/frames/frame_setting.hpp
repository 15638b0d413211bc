// How is a random frame drawn? The words of its JSON as the renderer's own types.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "gnomon/casefile/casefile.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::stress {

struct FrameSetting {
  Case input;             ///< camera, light and options; its boxes are those of the scene
  render::Source source;  ///< of the shadows
  render::FilterSettings filter;
  render::FrameOptions options;  ///< with the rules of "frame.prune"
  PageOptions pages;             ///< for Source::pages
  bool panes = false;            ///< surfaces that blend tint the light in place of stopping it
  bool visible_points = false;   ///< the plan is told what the picture shows
  int accumulated = 0;           ///< frames that the mask is the mean of, all of one view; 0: none
  int steps = 1;                 ///< frames, each after a move
  std::uint64_t move_seed = 1;   ///< of the instances that move, and where to
  glm::dvec3 camera_step{0.0};   ///< of the eye from frame to frame, world units
  double scale = 1.0;            ///< of the scene: an instance moves by shares of it
};

/// Throws CaseError for a word or a value that is none.
[[nodiscard]] FrameSetting read_frame(const nlohmann::ordered_json& frame);

}  // namespace gnomon::stress
