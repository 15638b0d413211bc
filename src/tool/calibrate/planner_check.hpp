// What the planner predicts and picks, beside what a sweep measured.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/row.hpp"
#include "gnomon/trace/seen_shadow.hpp"
#include "scene_view.hpp"

namespace gnomon::tool {

/// All rows of one frame under one light: the techniques that can be held against each other.
struct View {
  std::string name;
  std::vector<report::Row> rows;
};
[[nodiscard]] std::vector<View> views_of(const std::vector<report::Row>& rows);

/// A view as the planner sees it.
class Replanned {
 public:
  /// Throws SceneError.
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

/// Asks for picks within budgets and at errors from end to end of what each view measured, and prints for
/// each how far it is from the measured front. Returns 0.
int check_planner(const report::StoredCostModel& model, const std::vector<report::Row>& rows, bool json);

}  // namespace gnomon::tool
