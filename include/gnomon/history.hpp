// What a plan remembers of the frame before it, so that texels do not jump under a moving camera.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "gnomon/plan.hpp"

namespace gnomon {

/// What the texels did that no care could avoid.
enum class PlanEventKind : std::uint8_t {
  map_appeared,  ///< nothing was remembered of this cascade
  map_refitted,  ///< Fit::warped_stable: the view left the map
  density_jump,  ///< some surface point's texels per area changed by more than kDensityStep
};
struct PlanEvent {
  PlanEventKind kind{};
  int map = 0;                 ///< ShadowMap::cascade
  double density_ratio = 1.0;  ///< density_jump: of now over before, where it is farthest from 1
};

/// Largest change of texels per world area, from frame to frame at any surface point, that passes for smooth.
inline constexpr double kDensityStep = 0.05;

/// A map of CadenceOptions as it was planned, and the camera it was planned for.
struct KeptMap {
  std::int64_t frame = -1;  ///< in which it was planned; -1: never
  bool drawn = false;       ///< false: no caster could reach its receivers
  ShadowMap map;
  glm::dmat4 gl_from_world{1.0};  ///< OpenGL clip space
  Camera camera;
};

/// State that make_plan carries from frame to frame. Start with an empty one; keep one per camera and light;
/// clear it at a cut. Plain data: copy it to try a frame twice.
struct PlanHistory {
  struct Map {
    std::int64_t frame = -1;        ///< in which it was laid; -1: never
    glm::dmat4 gl_from_world{1.0};  ///< OpenGL clip space
    int width = 0, height = 0, filter_margin_texels = 0;
  };
  std::array<Map, kMaxMaps> map;            ///< by cascade
  std::int64_t frame = 0;                   ///< of the next plan
  glm::dvec3 eye_world{0.0}, forward{0.0};  ///< of the last frame
  /// The light of the last frame: its position with w = 1, or the direction towards it with w = 0.
  glm::dvec4 light_world{0.0};
  std::array<double, kMaxMaps + 1> edge{};  ///< view depths between the cascades
  int edge_count = 0;
  std::array<KeptMap, kMaxMaps> kept;  ///< by cascade

  /// Of the last frame planned.
  std::array<PlanEvent, kMaxMaps> event;
  int event_count = 0;
  [[nodiscard]] std::span<const PlanEvent> events() const noexcept {
    return {event.data(), static_cast<std::size_t>(event_count)};
  }
  void clear() noexcept { *this = {}; }
};

/// As make_plan, for the next frame of a moving camera. Directional lights with Fit::tight: warp and splits
/// go towards the best ones in steps that keep the change of texels per area, at every surface point that
/// stays in its map, below kDensityStep; the warp is the weaker the faster the camera moves; small gains are
/// not followed at all. Where that cannot be (a receiver came into view, the camera was moved by a lot),
/// events() says so. Fit::warped_stable: the map stands still until the view leaves it. Other fits, and
/// lights with a position, are planned as without history.
[[nodiscard]] ShadowPlan make_plan(const Camera& camera, const Light& light, const SceneBounds& bounds,
                                   const PlanOptions& options, PlanHistory& history,
                                   const VisibleDepths* visible = nullptr,
                                   std::span<const glm::dvec3> visible_points_world = {}) noexcept;

}  // namespace gnomon
