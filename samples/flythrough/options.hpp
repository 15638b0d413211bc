// What the user asked for on the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/light.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/filter.hpp"

namespace flythrough {

/// Bad input: one line that names what is wrong and where. The program ends with exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Options {
  std::string scene = "builtin:city";
  int frames = 8;
  bool frames_given = false;
  int width = 960, height = 540;
  std::filesystem::path out = "out/flythrough";
  gnomon::render::ContextKind context = gnomon::render::ContextKind::automatic;
  gnomon::PlanOptions plan;
  gnomon::render::FilterSettings filter = gnomon::render::default_settings(gnomon::render::filters::pcf);
  /// The map size is chosen: the smallest whose texels the filter hides, in every frame.
  bool perceptual_resolution = false;
  /// From a shadow to what casts it, world units, for filters with penumbras; 0: half the scene's height.
  double blocker_distance = 0.0;
  /// Frames are steps of one flight: texels change smoothly from each to the next.
  bool history = false;
  /// Every frame is drawn twice: the first tells which depths show a surface, the second's maps cover those.
  bool visible_depths = false;
  enum class LightKind { sun, spot, point } light = LightKind::sun;
  double light_elevation_deg = 38.0;
  double light_azimuth_deg = 140.0;
  std::optional<std::filesystem::path> path;
  std::vector<const gnomon::Warp*> compared_warps;  ///< nullptr: chosen by the plan; none: no comparison
};

/// Prints help or the version and answers nothing where those were asked for. Throws UsageError.
[[nodiscard]] std::optional<Options> parse_options(int argc, char** argv);

/// The sun, or a lamp in its direction over the middle of the scene. Azimuth 0: it stands over -Z; 90: over
/// +X.
[[nodiscard]] gnomon::Light light_of(const Options& options, const gnomon::Box& scene) noexcept;

}  // namespace flythrough
