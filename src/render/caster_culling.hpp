// Which casters does each map of a frame draw, and what was left out by which rule?
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "gnomon/caster_set.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/prune.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/reuse.hpp"
#include "scene_buffers.hpp"

namespace gnomon::render {

/// How casters are drawn into one map: from positions relative to DrawnMaps::origin_world.
struct DrawnMap {
  glm::mat4 clip_from_position{1.0f};
  int width = 0, height = 0;
  bool operator==(const DrawnMap&) const = default;
};
struct DrawnMaps {
  glm::dvec3 origin_world{0.0};
  std::array<DrawnMap, kMaxMaps> map;
};
/// `step`: the origin is the camera's position to the nearest multiple of it, so that it stays where it is
/// while the camera moves a little, and with it every bit of a map that does.
[[nodiscard]] DrawnMaps drawn_maps(const ShadowPlan& plan, const glm::dvec3& camera_world,
                                   double step) noexcept;

struct CullingJob {
  const ShadowPlan& plan;
  const DrawnMaps& drawn;
  PruneRules prune;
  double lost_shadow_share = 0.0;
  /// A lookup may read beyond the map's filter margin, or follows from the whole map: what no receiver needs
  /// counts, too.
  bool reads_everywhere = false;
};

/// Casters to be drawn into a rectangle of a map, by instance: 1 or 0.
struct MapPart {
  TexelRect rectangle;
  bool clear = true;  ///< false: what the rectangle holds stays right
  std::span<const std::uint8_t> draws;
};
/// What of a map is somewhere else in it now: `kept`, where it is to go.
struct MapMove {
  int shift_x = 0, shift_y = 0;  ///< texels
  TexelRect kept;
  [[nodiscard]] bool any() const noexcept { return shift_x != 0 || shift_y != 0; }
};
/// What is to be done with a map: first what it holds is moved, then the parts are drawn. Neither: the map is
/// as it was.
struct MapWork {
  static constexpr std::size_t kMaxParts = 3;  ///< two strips, and what came into reach anywhere
  MapMove move;
  std::array<MapPart, kMaxParts> part;
  std::size_t part_count = 0;
  std::uint64_t texels = 0;  ///< that drawing touches, at most
  int age = 0;               ///< frames since all of it was drawn

  [[nodiscard]] std::span<const MapPart> parts() const noexcept { return {part.data(), part_count}; }
  void add(const MapPart& of) noexcept { part[part_count++] = of; }
};

class CasterCulling {
 public:
  explicit CasterCulling(const SceneBuffers& scene);

  /// The maps hold nothing any more.
  void forget() noexcept;
  /// Counts what the plan left out; to be called before the maps of a frame.
  void begin(const CullingJob& job);
  /// Also takes down what the map holds once it is drawn so. The answer is good until the next call.
  MapWork choose(const CullingJob& job, std::size_t index);

  /// Since begin(), per rule; 0 where a rule drew more triangles to draw fewer texels.
  [[nodiscard]] std::array<PruneSaving, kPruneRuleCount> saved() const noexcept;

 private:
  struct Kept {
    bool valid = false;
    int age = 0;  ///< frames since it was drawn whole
    glm::dvec3 origin_world{0.0};
    DrawnMap drawn;
    ShadowMap map;                    ///< in the clip space that it was drawn in
    std::vector<std::uint8_t> holds;  ///< by instance
  };
  void mark_swept(const CullingJob& job, const ShadowMap& map);
  void drop_small(const CullingJob& job, const ShadowMap& map);
  // `map`: in the clip space that it is drawn in.
  MapWork draw_whole(const ShadowMap& map, Kept& kept);
  /// What is not in it yet, where the map stands still.
  MapWork hold(const ShadowMap& map, Kept& kept);
  /// The strips that came into the map, and what is not in the rest of it yet.
  MapWork scroll(const CullingJob& job, const ShadowMap& map, const MapReuse& moved, Kept& kept);
  /// Leaves those that `kept` has out of draws_. Answers how many texels the others touch, at most.
  std::uint64_t draw_what_is_missing(PruneRule rule, const ShadowMap& map, Kept& kept);
  [[nodiscard]] bool draws_any() const noexcept;
  [[nodiscard]] std::uint64_t triangles_of(std::uint32_t instance) const noexcept {
    return scene_.primitive_of(instance).index_count / 3;
  }
  [[nodiscard]] PruneSaving& saving(PruneRule rule) noexcept {
    return saved_[static_cast<std::size_t>(rule)];
  }
  void leave_out(PruneRule rule, std::uint32_t instance) noexcept;

  const SceneBuffers& scene_;
  std::vector<CasterBlock> blocks_;
  std::vector<std::uint32_t> indices_, listed_;
  std::vector<std::uint8_t> draws_;
  std::array<std::vector<std::uint8_t>, 2> strip_draws_;
  std::vector<double> diagonal_;  ///< of each instance's box
  CasterSet set_;
  std::uint64_t triangles_ = 0;  ///< of all instances
  std::array<Kept, kMaxMaps> kept_;
  std::array<PruneSaving, kPruneRuleCount> saved_{};
  PruneSaving drawn_in_strips_;  ///< by scrolled_maps, of what it left out before
};

}  // namespace gnomon::render
