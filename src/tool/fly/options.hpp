// What the user asked for on the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera_words.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/edit.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/study/technique.hpp"
#include "page_setting.hpp"
#include "scene_words.hpp"

namespace gnomon::tool::fly {

/// SplitOptions::overlap where maps pass into each other: the step between their texels is hidden, and a
/// tenth of the texels is all it costs.
inline constexpr double kTransitionShare = 0.1;

struct Options {
  std::string scene = "builtin:city";
  int frames = 8;
  bool frames_given = false;
  int width = 960, height = 540;
  bool size_given = false;  ///< else a camera of the file may change it
  std::filesystem::path out = "out/flythrough";
  bool json = false;  ///< files and numbers as one line of JSON, in place of text
  /// The pictures are the shadow alone: black, its alpha the share of light that is missing.
  bool shadow_only = false;
  render::ContextKind context = render::ContextKind::automatic;
  PlanOptions plan;
  PageSetting pages;  ///< in place of maps; off by default
  render::FilterSettings filter = render::default_settings(render::filters::pcf);
  /// Other than cut: maps overlap by kTransitionShare of the cascade before the split.
  render::SplitTransition transition = render::SplitTransition::cut;
  render::DepthLayer layer = render::DepthLayer::front;  ///< that the maps store
  render::MapPasses map_passes = render::MapPasses::automatic;
  /// Steps of 8 bits by which the filter's answers may differ where it stores less than it was asked to; 0:
  /// it stores all of it.
  double filter_precision = 0.0;
  /// The map size is chosen: the smallest whose texels the filter hides, in every frame.
  bool perceptual_resolution = false;
  /// Maps and filter are chosen: the least error within it, or the cheapest at its error.
  Budget budget;
  std::optional<std::filesystem::path> cost_model;  ///< of gnomon calibrate; none: texels are what counts
  /// From a shadow to what casts it, world units, for filters with penumbras; 0: half the scene's height.
  double blocker_distance = 0.0;
  /// Frames are steps of one flight: texels change smoothly from each to the next.
  bool history = false;
  /// Every frame is drawn twice: the first tells which depths show a surface, the second's maps cover those.
  bool visible_depths = false;
  /// The same without a frame drawn before: by a coarse pass on the CPU.
  bool coarse_depths = false;
  /// The animation that the flight plays, by name or number; empty: the scene stays at rest.
  std::string animation;
  double animation_fps = 30.0;   ///< frames in a second of the animation
  double animation_start = 0.0;  ///< time of the first frame, seconds
  LightPlacement light;
  std::string light_of_file;  ///< by name or number, in place of it; kAllLights: all; empty: none
  /// What may be left out, of plans and of drawing.
  PruneRules prune;
  CameraWords camera;
  /// Maps that take more together are halved until they fit, with a warning; 0: as much as there is.
  double map_memory_mib = 0.0;
  /// Scenes of more triangles, over all instances, are refused before they take the machine's memory.
  std::uint64_t max_triangles = LoadLimits{}.triangles;
  SceneEdits edits;
  std::vector<const Warp*> compared_warps;  ///< nullptr: chosen by the plan; none: no comparison

  /// All lights of the file shine, in place of one.
  [[nodiscard]] bool all_lights() const { return light_of_file == kAllLights; }
};

/// The first option given that only means the whole maps of one light; empty: none.
[[nodiscard]] std::string_view for_whole_maps(const Options& options);

/// The light of a flight through this scene. Throws std::runtime_error where the file has not the one named.
[[nodiscard]] Light light_of(const Options& options, const Scene& scene);

/// Flies as the options say. Returns the exit code.
int run(Options options);

}  // namespace gnomon::tool::fly
