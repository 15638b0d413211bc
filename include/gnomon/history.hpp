// Which state do plans carry from frame to frame, so that texels do not jump under a moving camera?
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "gnomon/plan.hpp"

namespace gnomon {

/// Unavoidable discontinuities in texel density.
enum class PlanEventKind : std::uint8_t {
  map_appeared,  ///< nothing was remembered of this cascade
  map_refitted,  ///< Fit::warped_stable: the view left the map
  density_jump,  ///< some surface point's texels per area changed by more than kDensityStep
};
/// A discontinuity of one map, from the last frame to this one.
struct PlanEvent {
  PlanEventKind kind{};        ///< the kind of discontinuity
  int map = 0;                 ///< ShadowMap::cascade
  double density_ratio = 1.0;  ///< density_jump: of now over before, where it is farthest from 1
};

/// Largest change of texels per world area, from frame to frame at any surface point, that passes for smooth.
inline constexpr double kDensityStep = 0.05;

/// A map of CadenceOptions as it was planned, and the camera it was planned for.
struct KeptMap {
  std::int64_t frame = -1;        ///< in which it was planned; -1: never
  bool drawn = false;             ///< false: no caster could reach its receivers
  ShadowMap map;                  ///< as make_plan gave it
  glm::dmat4 gl_from_world{1.0};  ///< OpenGL clip space
  Camera camera;                  ///< of the frame in which the map was planned
};

/// The best warp of one cascade, where the next frame's search begins.
struct SearchedWarp {
  std::int64_t until = -1;         ///< the frame whose search begins from nothing again; -1: at once
  glm::dmat4 xyw_from_world{1.0};  ///< x, y and w of OpenGL clip space; z is of no use
  double gain_ratio = 1.0;         ///< objective over that of no warp
  double last_ratio = 0.0;         ///< as WarpChoice::last_ratio
};

/// The best edges between cascades, which those of later frames move towards.
struct SearchedEdges {
  std::int64_t until = -1;                   ///< the frame whose edges are searched again; -1: at once
  std::array<double, kMaxMaps + 1> depth{};  ///< view depths
  int count = 0;                             ///< entries of `depth` that are used
};

/// State that make_plan carries from frame to frame. Start with an empty one; keep one per camera and light;
/// clear it at a cut. Plain data: copy it to try a frame twice.
struct PlanHistory {
  /// The last map of one cascade.
  struct Map {
    std::int64_t frame = -1;                              ///< in which it was fitted; -1: never
    glm::dmat4 gl_from_world{1.0};                        ///< OpenGL clip space
    int width = 0, height = 0, filter_margin_texels = 0;  ///< texels
    SearchedWarp searched;                                ///< that the map moves towards
  };
  std::array<Map, kMaxMaps> map;            ///< by cascade
  std::int64_t frame = 0;                   ///< of the next plan
  glm::dvec3 eye_world{0.0}, forward{0.0};  ///< of the last frame
  /// The light of the last frame: its position with w = 1, or the direction towards it with w = 0.
  glm::dvec4 light_world{0.0};
  std::array<double, kMaxMaps + 1> edge{};  ///< view depths between the cascades
  int edge_count = 0;                       ///< entries of `edge` that are used; 0 before the first plan
  SearchedEdges searched_edges;             ///< SplitScheme::optimal
  std::array<KeptMap, kMaxMaps> kept;       ///< by cascade
  /// Options of the last frame. Under any others kept maps are planned again, and searches restart.
  PlanOptions options;

  /// Events of the last plan; event_count of them are used.
  std::array<PlanEvent, kMaxMaps> event;
  int event_count = 0;  ///< entries of `event` that are used
  /// Events of the last plan.
  [[nodiscard]] std::span<const PlanEvent> events() const noexcept {
    return {event.data(), static_cast<std::size_t>(event_count)};
  }
  /// Forgets all frames: call it at a cut.
  void clear() noexcept { *this = {}; }
};

/// As make_plan, for the next frame of a moving camera. Fit::tight and Fit::rotated: warp, rectangle and
/// splits move towards the best ones in steps. Texels per area then change by less than kDensityStep at every
/// lit surface point that stays in its map. Faster camera motion weakens the warp, which limits shimmering.
/// Small gains are ignored. Unavoidable jumps (a receiver came into view, the camera was moved far) are
/// listed in events(). Fit::warped_stable: the map is unchanged until the view leaves it. Fit::stable needs
/// no history. Maps of a local light that moved begin afresh.
[[nodiscard]] ShadowPlan make_plan(const Camera& camera, const Light& light, const SceneBounds& bounds,
                                   const PlanOptions& options, PlanHistory& history,
                                   const VisibleDepths* visible = nullptr,
                                   std::span<const glm::dvec3> visible_points_world = {}) noexcept;

}  // namespace gnomon
