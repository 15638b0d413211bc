// A view of a sweep as the planner sees it: what it predicts of each technique, and which it picks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/sweep.hpp"
#include "gnomon/report/cost_model.hpp"
#include "gnomon/report/row.hpp"
#include "gnomon/trace/seen_shadow.hpp"
#include "scene_view.hpp"
#include "visible_surfaces.hpp"

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
  /// The choice among the techniques of the view's rows: as rows name it, with the filter of that name.
  struct Choice {
    PlanStatus status = PlanStatus::invalid_input;  ///< of TechniqueChoice; ok: the rest is known
    report::Technique technique = {};               ///< its fit and split as those of the rows
    double error = 0.0;                             ///< Technique::error
    std::int64_t texels = 0;                        ///< Technique::texels
  };
  [[nodiscard]] Choice choose(const View& view, const Budget& budget,
                              const report::StoredCostModel& model) const;

 private:
  /// With the pool, and with feedback on what the camera sees where the policy reads it.
  [[nodiscard]] PageOptions pages_of(const SweepEntry& entry) const noexcept;

  std::string name_;
  SceneView scene_;
  Camera camera_;
  trace::Tracer tracer_;
  trace::SeenShadow shadow_;
  VisibleSurfaces surfaces_;            ///< that pages are planned from
  std::vector<std::uint8_t> feedback_;  ///< on them
};

}  // namespace gnomon::tool
