// Which instances each view of a frame draws, as indirect draw commands.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "casters/caster_culling.hpp"
#include "casters/scene_buffers.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/renderer.hpp"
#include "maps/drawn_maps.hpp"
#include "maps/layered_maps.hpp"
#include "maps/map_cache.hpp"
#include "source/page_pool.hpp"

namespace gnomon::render {

/// Commands [begin, end) of DrawLists' buffer, drawn with the state of one batch.
struct BatchRange {
  std::uint32_t batch = 0, begin = 0, end = 0;
};

/// A rectangle of a map, and what is drawn there.
struct DrawnPart {
  TexelRect rectangle;
  bool clear = true;               ///< before drawing
  std::size_t begin = 0, end = 0;  ///< of DrawLists' ranges
};

/// The draw lists of all maps and of the camera, built on the CPU and sent in one go before the first pass: a
/// buffer that changes between passes makes the driver wait for the pass before.
class DrawLists {
 public:
  explicit DrawLists(SceneBuffers& scene);

  /// Rebuilds and uploads everything for this frame.
  void build(const CullingJob& job, const DrawnMaps& drawn, const Camera& camera,
             const LayeredRule& rule = {});
  /// The same without the cache: one part for each map, with all of its casters. The maps' depths stay as
  /// they are.
  void build_uncached(const CullingJob& job, const Camera& camera);
  /// The same with pages or runs of them in place of maps: one part for each, see page_part. `moves`: by
  /// instance, 1 where it is drawn apart, see moving_part; empty: none is.
  void build_pages(std::span<const DrawnPage> pages, const Camera& camera, PruneRules prune,
                   std::span<const std::uint8_t> moves = {});
  /// What is drawn into one page, by index: its static casters, none where it is composed.
  [[nodiscard]] const DrawnPart& page_part(std::size_t page) const noexcept { return page_parts_[page]; }
  /// Its moving casters.
  [[nodiscard]] const DrawnPart& moving_part(std::size_t page) const noexcept { return moving_parts_[page]; }
  [[nodiscard]] static bool draws(const DrawnPart& part) noexcept { return part.end > part.begin; }
  /// Casters are culled by the scene's boxes as they are now.
  void rebuild_casters() { culling_.rebuild(); }
  /// The maps hold nothing any more: the next build() draws them whole.
  void forget_maps() noexcept { cache_.forget(); }

  /// What a map holds that is to be moved, before anything of it is drawn.
  [[nodiscard]] const MapMove& move(int index) const noexcept {
    return move_[static_cast<std::size_t>(index)];
  }
  /// Rectangles of static depths, by their places in a buffer that is bound for shaders/pass/depth/copy.vert.
  struct Copies {
    std::size_t first = 0, count = 0;
  };
  /// What is done with the map of static casters beneath a map; everything else comes after that.
  struct Beneath {
    bool used = false;    ///< false: there is none, and nothing to do
    bool adopts = false;  ///< first it becomes a copy of the map
    MapMove move;
    std::array<DrawnPart, MapWork::kMaxParts> part{};
    std::size_t part_count = 0;
    bool copies_whole = false;  ///< all of it goes to the map
    Copies copies;              ///< that go to the map
    [[nodiscard]] std::span<const DrawnPart> parts() const noexcept { return {part.data(), part_count}; }
  };
  [[nodiscard]] const Beneath& beneath(int index) const noexcept {
    return beneath_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] std::span<const DrawnPart> parts(int index) const noexcept {
    const auto map = static_cast<std::size_t>(index);
    return {parts_[map].data(), part_count_[map]};
  }
  [[nodiscard]] std::span<const BatchRange> ranges(const DrawnPart& part) const noexcept {
    return {ranges_.data() + part.begin, part.end - part.begin};
  }
  /// Maps that one pass draws, by their indices; none, or two and more.
  [[nodiscard]] std::span<const int> layered_maps() const noexcept {
    return {layered_.data(), layered_count_};
  }
  [[nodiscard]] bool is_layered(int index) const noexcept;
  /// What that pass draws.
  [[nodiscard]] const DrawnPart& layered_part() const noexcept { return layered_part_; }
  [[nodiscard]] std::uint32_t layered_draws() const noexcept { return layered_draws_; }
  [[nodiscard]] std::span<const BatchRange> camera() const noexcept {
    return std::span(ranges_).subspan(camera_begin_);
  }
  [[nodiscard]] const MapStats& map_stats(int index) const noexcept {
    return stats_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] const std::array<PruneSaving, kPruneRuleCount>& saved() const noexcept { return saved_; }
  [[nodiscard]] const MapStats& camera_stats() const noexcept { return stats_.back(); }

  /// What the commands of BatchRange are, and the instances that they draw from `base_instance` on.
  [[nodiscard]] std::span<const DrawCommand> commands() const noexcept { return commands_; }
  [[nodiscard]] std::span<const std::uint32_t> objects() const noexcept { return objects_; }
  /// Makes them those that draws take; build() does, too.
  void bind_commands() const noexcept;

  /// Draws commands [begin, end) with the state that is bound.
  void draw(std::uint32_t begin, std::uint32_t end) const noexcept;

 private:
  /// Lists one part of a map, whose casters its planes cull.
  DrawnPart listed(const CullingJob& job, const ShadowMap& as_drawn, const MapPart& part, MapStats& stats,
                   PruneSavings& saved);
  void add_map(const CullingJob& job, const DrawnMaps& drawn, std::size_t map, PruneSavings& saved);
  /// `planes`: large casters are drawn within them, and what that saves is counted; none: drawn whole.
  void add_view(std::span<const std::uint8_t> draws, MapStats& stats, std::span<const glm::dvec4> planes,
                PruneSaving& saved);
  /// The parts of a caster within planes, where that is less than all of it; false: it is to be drawn whole.
  bool add_parts(std::uint32_t instance, MapStats& stats, std::span<const glm::dvec4> planes,
                 PruneSaving& saved);
  /// In one part, cleared before; no map whose shape bends lines, or whose depths are linear.
  [[nodiscard]] bool is_drawn_whole(std::size_t map, const DrawnMap& as) const noexcept;
  /// Finds the maps that one pass may draw, and makes its list where the rule wants it.
  void join_maps(const CullingJob& job, const DrawnMaps& drawn, const LayeredRule& rule);
  /// One list of the maps' own: runs of one primitive become one command over instances and maps. Returns how
  /// many commands.
  std::uint32_t add_joined();
  void mark_visible(const Camera& camera);
  /// Empties all lists, those of pages too.
  void clear();
  /// The camera's own list, and all lists to the GPU.
  void finish(const Camera& camera);

  SceneBuffers& scene_;  ///< whose clusters have scratch of their own
  CasterCulling culling_;
  MapCache cache_;
  std::array<PruneSaving, kPruneRuleCount> saved_{};
  std::array<MapMove, kMaxMaps> move_{};
  std::array<std::array<DrawnPart, MapWork::kMaxParts>, kMaxMaps> parts_{};
  std::array<std::size_t, kMaxMaps> part_count_{};
  std::array<Beneath, kMaxMaps> beneath_{};
  std::vector<DrawnPart> page_parts_, moving_parts_;
  std::vector<glm::ivec4> copies_;  ///< x, y, width, height
  std::array<int, kMaxMaps> layered_{};
  std::size_t layered_count_ = 0;
  DrawnPart layered_part_;
  std::uint32_t layered_draws_ = 0;
  struct MapCommand {
    DrawCommand command;
    std::uint32_t map;
  };
  std::vector<MapCommand> joining_;     ///< scratch: of one batch
  std::vector<std::uint8_t> visible_;   ///< scratch: by instance
  std::vector<std::uint32_t> objects_;  ///< object of each drawn instance, all views one after the other
  std::vector<DrawCommand> commands_;
  std::vector<BatchRange> ranges_;
  std::size_t camera_begin_ = 0;                ///< of ranges_, whose last are the camera's
  std::array<MapStats, kMaxMaps + 1> stats_{};  ///< the camera's last
  Buffer object_buffer_, command_buffer_, copy_buffer_;
  std::size_t object_capacity_ = 0, command_capacity_ = 0, copy_capacity_ = 0;
};

}  // namespace gnomon::render
