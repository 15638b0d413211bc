// The results of `gnomon compare` as points of error against time, and the settings that each stands for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/report/row.hpp"
#include "state.hpp"

namespace gnomon::tool::view {

/// One technique on one scene, over all frames that were measured.
struct ResultPoint {
  report::Technique technique;
  double ratio = 0.0;     ///< time to that of hard shadows from one unwarped map, measured in the same rounds
  double ms = 0.0;        ///< the same time
  double wrong = 0.0;     ///< share of misclassified pixels, 0..1
  bool on_front = false;  ///< no other technique has both less time and fewer misclassified pixels
};

struct SceneResults {
  std::string scene;                ///< as on the command line
  std::vector<ResultPoint> points;  ///< by rising time
};

struct SweepResults {
  std::string measured;              ///< picture size, renderer
  std::vector<SceneResults> scenes;  ///< each with at least one point
};

/// Reads a folder of results, or its file of rows. Throws report::ReportError with file and line.
[[nodiscard]] SweepResults read_sweep_results(const std::filesystem::path& path);
/// nullptr: none of them are of this scene.
[[nodiscard]] const SceneResults* results_of(const SweepResults& results, const std::string& scene) noexcept;
/// Throws std::runtime_error where a technique's name means nothing, or stands for what the viewer does not
/// draw.
[[nodiscard]] Settings settings_of(const report::Technique& technique, LightKind light);

}  // namespace gnomon::tool::view
