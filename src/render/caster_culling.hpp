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

/// What is to be done with a map.
struct MapWork {
  bool clear = true;  ///< false: what it holds stays right
  /// Casters to draw, by instance: 1 or 0. None and no clearing: the map is as it was.
  std::span<const std::uint8_t> draws;
  std::uint64_t texels = 0;  ///< that drawing touches, at most
};

class CasterCulling {
 public:
  explicit CasterCulling(const SceneBuffers& scene);

  /// The maps hold nothing any more.
  void forget() noexcept;
  /// Counts what the plan left out; to be called before the maps of a frame.
  void begin(const CullingJob& job);
  /// Also takes down what the map holds once it is drawn so. The answer is good until the next call.
  MapWork choose(const CullingJob& job, std::size_t map);

  [[nodiscard]] const std::array<PruneSaving, kPruneRuleCount>& saved() const noexcept { return saved_; }

 private:
  struct Kept {
    bool valid = false;
    glm::dvec3 origin_world{0.0};
    DrawnMap drawn;
    std::vector<std::uint8_t> holds;  ///< by instance
  };
  void mark_swept(const CullingJob& job, const ShadowMap& map);
  void drop_small(const CullingJob& job, const ShadowMap& map);
  MapWork hold(const CullingJob& job, std::size_t map);
  [[nodiscard]] PruneSaving& saving(PruneRule rule) noexcept {
    return saved_[static_cast<std::size_t>(rule)];
  }
  void leave_out(PruneRule rule, std::uint32_t instance) noexcept;

  const SceneBuffers& scene_;
  std::vector<CasterBlock> blocks_;
  std::vector<std::uint32_t> indices_, listed_;
  std::vector<std::uint8_t> draws_;
  std::vector<double> diagonal_;  ///< of each instance's box
  CasterSet set_;
  std::uint64_t triangles_ = 0;  ///< of all instances
  std::array<Kept, kMaxMaps> kept_;
  std::array<PruneSaving, kPruneRuleCount> saved_{};
};

}  // namespace gnomon::render
