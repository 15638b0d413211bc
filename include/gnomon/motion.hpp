// What do frames carry over under motion? Plans that follow a moving camera, the part of a map that can be
// reused, and sub-texel jitter for temporal accumulation (render::Accumulation). Jitter based on: Scherzer,
// Jeschke, Wimmer, "Pixel-Correct Shadow Maps with Temporal Reprojection and Shadow Test Confidence", 2007.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "gnomon/clip_space.hpp"
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

/// State that make_plan carries from frame to frame. Start with an empty one; keep one per camera and light;
/// clear it at a cut. Plain data: copy it to try a frame twice.
///
/// Fit::tight and Fit::rotated: warp, rectangle and splits move towards the best ones in steps. Texels per
/// area then change by less than kDensityStep at every lit surface point that stays in its map. Faster camera
/// motion weakens the warp, which limits shimmering. Small gains are ignored. Unavoidable jumps (a receiver
/// came into view, the camera was moved far) are listed in events(). Fit::warped_stable: the map is unchanged
/// until the view leaves it. Fit::stable: texels and light depths change more rarely. Maps of a local light
/// that moved begin afresh, and so do all maps under another WarpOptions::warp.
struct PlanHistory {
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
  /// A map of CadenceOptions as it was planned, and the camera it was planned for.
  struct KeptMap {
    std::int64_t frame = -1;        ///< in which it was planned; -1: never
    bool drawn = false;             ///< false: no caster could reach its receivers
    ShadowMap map;                  ///< as make_plan gave it
    glm::dmat4 gl_from_world{1.0};  ///< OpenGL clip space
    Camera camera;                  ///< of the frame in which the map was planned
  };
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

enum class ReuseKind : std::uint8_t {
  none,  ///< another grid, depth range, light or size, or nothing of the old map is in the new one: draw it
         ///< whole
  identical,  ///< every texel holds
  scrolled,   ///< `kept` holds once moved; `strip` is new
};

/// How to make the current map from the previous one. Copy texel (x, y) of the old map to (x + shift_x, y +
/// shift_y) of the new one wherever that lies in `kept`. Or address the texture modulo its size and copy
/// nothing. Then draw the strips. `kept` and the strips cover the map without overlap, whatever the kind.
struct MapReuse {
  ReuseKind kind = ReuseKind::none;  ///< how much of the old map holds
  int shift_x = 0, shift_y = 0;      ///< texels
  TexelRect kept;                    ///< in the current map; empty for none
  std::array<TexelRect, 2> strip;    ///< to be drawn; the first strip_count are used
  int strip_count = 0;               ///< none: 1, the whole map; identical: 0; scrolled: 1 or 2
};

/// Compares two maps planned with the same clip space, `clip_space`. Maps of Fit::stable scroll; any others,
/// those of local lights among them, are reusable only while their matrix is equal bit by bit. That is
/// while nothing moves, or while Fit::warped_stable keeps it.
///
/// Guarantees the texel-to-world mapping only; unchanged casters are the caller's responsibility. Casters
/// must not have moved, and both frames must have drawn all casters over the map's rectangle
/// (rectangle_planes) with depth clamp. cull_planes is not enough: it omits casters that the old view did not
/// need, and the new one may.
[[nodiscard]] MapReuse reuse(const ShadowMap& previous, const ShadowMap& current,
                             const ClipSpace& clip_space = {}) noexcept;

/// The map with clip_from_camera_relative for an eye at `new_origin`, world space; everything else unchanged.
/// For a map kept from an earlier frame: its matrix then takes points relative to the new eye. Computed from
/// clip_from_world, so that any number of moves lose nothing: within 1e-3 texel of it a thousand kilometres
/// from the origin.
[[nodiscard]] ShadowMap rebased(const ShadowMap& map, const glm::dvec3& new_origin) noexcept;

/// Planes round everything that can throw a shadow into a rectangle of the map. These are its four sides and
/// the map's far plane, open towards the light (draw with depth clamp). To be given to CasterSet::cull. As
/// ShadowMap::cull_planes: dot(xyz, p_world) + w >= 0 inside, unit normals. `clip_space` is the plan's.
[[nodiscard]] std::array<glm::dvec4, 5> rectangle_planes(const ShadowMap& map, const TexelRect& rectangle,
                                                         const ClipSpace& clip_space = {}) noexcept;

/// A jittered map reads so much farther than its plan, texels: add it to FilterExtent::texels
/// (`filter.texels`) before planning, so that no kernel leaves its map.
inline constexpr double kJitterReachTexels = 0.5;

/// Frames after which the offsets repeat: as many as Accumulation::memory counts.
inline constexpr std::uint32_t kJitterFrames = 64;

/// Offset of the grid in a frame, texels, each in (-0.5, 0.5). The offsets are a lattice of 64 points, in an
/// order in which the first 8, 16 and 32 are lattices as well. Any kJitterFrames frames in a row hold all of
/// it, so that what has converged stays as it is.
[[nodiscard]] glm::dvec2 jitter_texels(std::uint32_t frame_index) noexcept;

/// The plan with the texel grid of every map moved by `offset_texels` across the light, at most
/// kJitterReachTexels along each axis. Larger offsets and not-a-number are clamped. The maps serve the same
/// points and casters as before. Moved maps cannot be reused by the next frame: their snap keys are
/// invalid.
[[nodiscard]] ShadowPlan jittered(const ShadowPlan& plan, const glm::dvec2& offset_texels) noexcept;

}  // namespace gnomon
