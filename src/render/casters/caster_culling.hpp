// Which casters does each map of a frame draw, whatever it showed before?
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "casters/scene_buffers.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/options.hpp"
#include "gnomon/plan.hpp"

namespace gnomon::render {

class MovingCasters;

struct CullingJob {
  const ShadowPlan& plan;
  PruneRules prune;
  double lost_shadow_share = 0.0;
  /// A lookup may read beyond the map's filter margin, or depends on the whole map: casters that no receiver
  /// needs count, too.
  bool reads_everywhere = false;
  /// A map that changes in part is drawn whole: what it stores beside its depths is made from all of it.
  bool redraws_whole = false;
  /// Bounds of casters that moved since the last frame, before and after.
  std::span<const Box> moved_world = {};
  /// The same of places where static casters came or went; they have maps of their own where `moves` is not
  /// empty.
  std::span<const Box> static_moved_world = {};
  /// By instance: 1 where it moves. Empty: casters are not told apart.
  std::span<const std::uint8_t> moves = {};
  /// Has the shapes of those that moved; needed where `moves` is not empty.
  MovingCasters* movers = nullptr;
};

/// What each rule saved in one frame, and what it drew more to save that.
struct PruneSavings {
  std::array<PruneSaving, kPruneRuleCount> saved{}, spent{};

  [[nodiscard]] PruneSaving& of(PruneRule rule) noexcept { return saved[static_cast<std::size_t>(rule)]; }
  [[nodiscard]] PruneSaving& spent_by(PruneRule rule) noexcept {
    return spent[static_cast<std::size_t>(rule)];
  }
  /// Saved less spent; 0 where a rule drew more triangles to draw fewer texels.
  [[nodiscard]] std::array<PruneSaving, kPruneRuleCount> net() const noexcept;
};

/// Texels of a map that the image of a box covers at most.
struct TexelExtent {
  double x, y;
  [[nodiscard]] double area() const noexcept { return x * y; }
};
/// Nothing where a corner is behind the map's centre of projection.
[[nodiscard]] std::optional<TexelExtent> extent_in_map(const ShadowMap& map, const Box& box) noexcept;
[[nodiscard]] inline std::uint64_t texels_of(const ShadowMap& map) noexcept {
  return static_cast<std::uint64_t>(map.width) * static_cast<std::uint64_t>(map.height);
}

class CasterCulling {
 public:
  explicit CasterCulling(const SceneBuffers& scene);

  /// Takes the scene's boxes as they are now.
  void rebuild();
  /// Counts what the plan pruned itself.
  void count_omissions(const ShadowPlan& plan, PruneSavings& saved) const noexcept;
  /// Casters of one map by instance: 1 or 0. Valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> casters_of(const CullingJob& job, const ShadowMap& map,
                                                         PruneSavings& saved);
  /// Instances whose boxes reach inside all planes. Valid until the next call of any member.
  [[nodiscard]] std::span<const std::uint32_t> instances_within(std::span<const glm::dvec4> planes);

 private:
  void mark_swept(const CullingJob& job, const ShadowMap& map, PruneSavings& saved);
  void drop_small(const CullingJob& job, const ShadowMap& map, PruneSavings& saved);

  const SceneBuffers& scene_;
  std::vector<CasterBlock> blocks_;
  std::vector<std::uint32_t> indices_, listed_;
  std::vector<std::uint8_t> draws_;
  std::vector<double> diagonal_;  ///< of each instance's box
  CasterSet set_;
  std::vector<Box> boxes_;       ///< of casters, by instance; empty where one does not cast
  std::uint64_t triangles_ = 0;  ///< of all casters
  std::size_t count_ = 0;        ///< of casters
};

}  // namespace gnomon::render
