// What the user asked for on the command line.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

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
  double light_elevation_deg = 38.0;
  double light_azimuth_deg = 140.0;
  std::optional<std::filesystem::path> path;
  std::vector<const gnomon::Warp*> compared_warps;  ///< nullptr: chosen by the plan; none: no comparison
};

/// Prints help or the version and answers nothing where those were asked for. Throws UsageError.
[[nodiscard]] std::optional<Options> parse_options(int argc, char** argv);

/// The way the light travels. Azimuth 0: the sun stands over -Z; 90: over +X.
[[nodiscard]] gnomon::DirectionalLight sun(const Options& options) noexcept;

}  // namespace flythrough
