// Draws one state of the viewer to a picture: the same with a window and without.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "all_lights.hpp"
#include "canvas.hpp"
#include "frame_pages.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/render/light_pool.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/trace/tracer.hpp"
#include "loaded.hpp"
#include "pictures.hpp"
#include "posed_scene.hpp"
#include "state.hpp"
#include "truth.hpp"

namespace gnomon::tool::view {

/// One side of a comparison, as it was drawn last.
struct Side {
  ShadowPlan plan;     ///< as it was made; without maps where there are pages
  ShadowPlan drawn;    ///< as it was drawn: where the plan's camera is frozen, for another eye
  Camera plan_camera;  ///< that it was made for
  render::FrameStats stats;
  double plan_ms = 0.0;
  AliasingStats m;                           ///< over what the plan's camera sees of the boxes
  std::optional<report::MaskErrors> errors;  ///< where the exact shadow is known
  /// Share of pixels that hard comparison in the plan's maps or pages is to misclassify, without drawing
  /// them; known where `errors` are.
  std::optional<double> expected_wrong;
  /// Share of pixels that the step from the plan before to this one flips, 0..1; see Stage::count_flips().
  std::optional<double> flips;
  PlanHistory history;
  std::shared_ptr<FramePages> pages;  ///< in place of maps; nullptr: off
  /// All lights of the file, in place of the maps of one; nullptr: off.
  std::shared_ptr<render::LightPool> lights;
  LightsDrawn lights_drawn;

  /// The texels that an index of the mask names; nullptr: none.
  [[nodiscard]] const ShadowMap* map_of(int index) const noexcept;
  /// Maps or levels: those that View::map may show.
  [[nodiscard]] int picture_count() const noexcept;
  [[nodiscard]] const PagePlan* page_plan() const noexcept { return pages ? &pages->plan() : nullptr; }
  [[nodiscard]] std::span<const Omission> omitted() const noexcept {
    return pages ? pages->plan().omitted() : plan.omitted();
  }
};

class Stage {
 public:
  /// Uploads the scene and compiles what every frame needs. Begins to sort the triangles for rays in the
  /// background. Throws RenderError.
  explicit Stage(std::shared_ptr<const Loaded> loaded);

  [[nodiscard]] const Loaded& loaded() const noexcept { return *loaded_; }

  /// Draws the state. `settled`: it will not change at once, so that exact shadows are worth beginning.
  /// Returns what is wrong with the state, in which case the last picture stays, or an empty text.
  std::string draw(const State& state, int width, int height, bool settled);
  /// Waits for the exact shadows of the last picture, if it shows any; draw() then shows all of them.
  void finish_truth(const std::function<void(int rows, int of)>& seen = {});
  /// From the next draw on, misclassified pixels are counted in every view, as far as exact shadows are
  /// there.
  void count_errors(bool wanted) noexcept { counts_errors_ = wanted; }
  /// From the next draw on, the shimmering of side A's maps is counted: each frame is drawn with the plan
  /// before as well, for the same camera. Not counted where the light or the scene moved, with pages, and
  /// where the plan's camera is frozen.
  void count_flips(bool wanted) noexcept { counts_flips_ = wanted; }
  /// What time_frame() draws: side A, or what its times are compared with, hard shadows from one unwarped
  /// map.
  enum class Timed : std::uint8_t { side_a, baseline };
  /// Draws the last state once more, with nothing kept from earlier frames, and leaves the picture alone.
  /// Milliseconds of planning, maps, prefilter and look-up.
  [[nodiscard]] double time_frame(const State& state, Timed what);

  [[nodiscard]] const Canvas& canvas() const noexcept { return canvas_; }
  [[nodiscard]] const Side& side(int which) const noexcept { return sides_[static_cast<std::size_t>(which)]; }
  [[nodiscard]] const Camera& camera() const noexcept { return camera_; }
  [[nodiscard]] const Light& light() const noexcept { return light_; }
  /// Rows of exact shadows that are done, of how many; none where none are wanted.
  [[nodiscard]] std::optional<std::array<int, 2>> truth_progress() const;
  /// Takes what the background has finished.
  void poll() { posed_.take_tracer(false); }
  /// Begins to sort the triangles where they stand now: worth it once they rest.
  void want_tracer() { posed_.begin_tracer(); }
  /// The box of each instance, as posed.
  [[nodiscard]] const std::vector<Box>& boxes() const noexcept { return posed_.boxes(); }
  /// nullptr until the triangles are sorted, as they stand now.
  [[nodiscard]] const trace::Tracer* tracer() const noexcept { return posed_.tracer().get(); }
  /// Compiles one more of the filters that no state has used yet, for maps or for pages; false where all are
  /// compiled.
  bool compile_ahead(bool by_pages);
  /// True where the filter's programs are compiled already, for pages where the settings have them, or for
  /// all lights of the file.
  [[nodiscard]] bool is_compiled(const Settings& settings, bool all_lights = false) const;
  /// True where a page policy that reads the picture would refine the last one, once it is settled.
  [[nodiscard]] bool unfinished() const noexcept { return unfinished_; }
  /// Forgets what plans carry from frame to frame: after a cut.
  void cut() noexcept;

 private:
  [[nodiscard]] std::string make_plans(const State& state, int width, int height);
  void draw_side(const State& state, const Settings& settings, Side& side, Canvas& canvas, bool settled);
  /// The sun as the state holds it, for this camera; draws `surfaces` where it needs them.
  [[nodiscard]] Light held_light(const State& state, const Camera& camera,
                                 std::shared_ptr<const VisibleSurfaces>& surfaces);
  [[nodiscard]] std::string plan_side(const Settings& settings, const Camera& planned, const Light& light,
                                      std::shared_ptr<const VisibleSurfaces>& surfaces, Side& side);
  [[nodiscard]] std::optional<FloatImage> mask_of_plan_before(const State& state, const Side& before);
  /// Plans all lights of the file for one side.
  [[nodiscard]] std::string plan_lights_of(const State& state, const Settings& settings, const Camera& camera,
                                           Side& side);
  void draw_lights(const State& state, const Settings& settings, Side& side);
  void draw_pages(const State& state, const Settings& settings, Side& side, bool settled);
  [[nodiscard]] render::PreparedFilter prepare(const Settings& settings, bool all_lights = false);
  [[nodiscard]] Image side_legend(const State& state, const Side& side) const;
  void draw_map_view(const State& state, Side& side, Canvas& canvas);
  void want_truth(bool settled);
  void draw_view(const State& state, Side& side, Canvas& canvas);
  void compose(const State& state);

  std::shared_ptr<const Loaded> loaded_;
  render::Renderer renderer_;
  PosedScene posed_;
  std::vector<std::string> compiled_;  ///< filters as text, for pages with a word before
  std::array<Side, 2> sides_;
  Canvas canvas_, canvas_a_, canvas_b_;
  Camera camera_;
  Light light_;
  glm::dvec3 held_sun_{0.0};  ///< of the last frame; no length: none is held
  double exposure_ = 0.0;     ///< of all lights of the file; 0: no picture had light yet
  Truth truth_;
  bool wants_truth_ = false, unfinished_ = false, counts_errors_ = false, counts_flips_ = false;
};

}  // namespace gnomon::tool::view
