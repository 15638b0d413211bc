// Which options hold for this light, history and number of cameras, and which are ignored? Decided once,
// before any stage: those below read what holds, and ask no more.
#pragma once

#include <array>
#include <span>

#include "gnomon/extend/shape.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/pages.hpp"
#include "gnomon/plan.hpp"

namespace gnomon {

/// What a plan is for, besides its options.
struct PlanCase {
  const Light& light;
  bool orthographic = false;  // the camera
  std::size_t views = 0;      // cameras of plan_views; 0: the one of make_plan
  bool has_history = false;
  bool has_depths = false;  // visible ones
  bool has_points = false;  // visible ones
};

/// True for a shape that undoes what warps do along the view.
[[nodiscard]] inline bool undoes_warps(const Shape& shape) noexcept {
  return !shape.affine && shape.serving == nullptr && shape.round == nullptr;
}

/// How maps are made.
struct Conduct {
  const Warp* warp = &warps::none;       // the one to use, or the default; none with a stable grid
  const Shape* shape = &shapes::linear;  // linear where the requested one does not hold
  double error_bound = 0.0;              // maps shrink to this bound of m; 0: they keep their size
  bool stable = false;                   // Fit::stable: grids do not follow the camera
  bool rotated = false;                  // Fit::rotated: rectangles turn to the least area
  bool caches_maps = false;              // Fit::warped_stable: a map serves until the view leaves it
  bool caches_cascades = false;          // CadenceOptions: those behind the first serve for some frames
  bool divides_reach = false;            // depths that no turn of the camera changes are divided
  bool has_history = false;              // a PlanHistory holds
  bool steady = false;                   // maps go in small steps from those of the last frame

  /// From now on as without a history: for trials, and for maps that have no steady way to go.
  void forget() noexcept { caches_cascades = has_history = steady = false; }
};

/// Entries of ShadowPlan::omitted about options that do not hold.
class Ignored {
 public:
  void add(IgnoredOption option) noexcept {
    add({OmissionKind::option_ignored, -1, static_cast<double>(option), 0.0, 0});
  }
  void add(OmissionKind kind) noexcept { add({kind, -1, 0.0, 0.0, 0}); }
  [[nodiscard]] std::span<const Omission> entries() const noexcept { return {entry_.data(), count_}; }

 private:
  void add(const Omission& entry) noexcept { entry_[count_++] = entry; }

  // A local light ignores the most: all but the texel budget, the history and the cadence.
  std::array<Omission, 10> entry_;
  std::size_t count_ = 0;
};

/// What holds of the options.
struct Resolved {
  PlanOptions options;  // those that are ignored have their defaults
  Conduct conduct;
  bool parts = false;           // parallel light: receivers are divided other than by view depth
  bool tetrahedron = false;     // a point light has the faces of a tetrahedron
  bool planes = false;          // WarpOptions::planes have maps
  bool follows_depths = false;  // cascades cover visible depths alone
  bool follows_points = false;  // maps cover the bounds of visible points
  bool counts_seen = false;     // warps are judged at points that the camera sees
  bool square = false;          // sides of maps that share a budget are equal
  Ignored of_maps;              // listed with the maps, where anything is visible
  Ignored of_plan;              // listed in any case, last
};
/// The options are valid.
[[nodiscard]] Resolved resolve(const PlanOptions& options, const PlanCase& plan) noexcept;

/// The same for plan_lights, whose maps have one size each and lie where a cube's faces do.
[[nodiscard]] PlanOptions resolve_lights(const PlanOptions& options, int side) noexcept;

/// What holds of the options of plan_pages.
struct ResolvedPages {
  PageOptions options;  // share and reach_texels have their defaults where they are ignored
  PlanOptions base;     // of the maps that the pages lie on
  Ignored ignored;
};
/// The same for plan_pages. The options are valid and name a policy.
[[nodiscard]] ResolvedPages resolve_pages(const PageOptions& options) noexcept;

}  // namespace gnomon
