// A view of a sweep as the planner sees it: what it predicts of each technique, and which it picks.
#pragma once

#include <string>
#include <vector>

#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/row.hpp"
#include "gnomon/trace/seen_shadow.hpp"
#include "scene_view.hpp"

namespace gnomon::tool {

/// All rows of one frame under one light: the techniques that can be held against each other.
struct View {
  std::string name, flight;  ///< of the frame; the same for all frames along one path
  std::vector<report::Row> rows;
};
[[nodiscard]] std::vector<View> views_of(const std::vector<report::Row>& rows);
/// Share of the pixels that a row misclassifies, measured.
[[nodiscard]] double wrong_pixels(const report::Row& row) noexcept;

/// A view's scene and shadow.
class Replanned {
 public:
  /// Throws SceneError, and std::runtime_error for a light without a name.
  explicit Replanned(const View& view);

  /// What the planner predicts of a row's technique, with what was measured.
  [[nodiscard]] report::Observation observe(const report::Row& row) const;
  /// The choice among the techniques of the view's rows.
  [[nodiscard]] TechniqueChoice choose(const View& view, const Budget& budget, const CostModel& costs) const;

 private:
  std::string name_;
  SceneView scene_;
  Camera camera_;
  trace::SeenShadow shadow_;
};

}  // namespace gnomon::tool
