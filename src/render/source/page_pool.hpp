// The pages of a frame on the GPU: where each lies in the pool, and the tables that shaders find them by.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gl/gl_object.hpp"
#include "gnomon/motion.hpp"
#include "gnomon/pages.hpp"
#include "source/page_runs.hpp"

namespace gnomon::render {

/// What decides about pages besides their plan.
struct PageFrame {
  glm::dvec3 origin_world{0.0};  ///< what casters are drawn relative to
  bool alpha_test = false;       ///< where materials are masked alone
  bool keeps = false;            ///< draws what the pool does not hold; else every page
  bool apart = false;            ///< moving casters are drawn over static ones; else a page is drawn whole
  bool in_runs = true;           ///< neighbouring pages are drawn together; else each into its slot
  /// Bounds of casters that changed, before and after: where static ones came or went, and of moving ones.
  std::span<const Box> static_moved_world = {}, moved_world = {};
};

/// Pages side by side in the layers of one depth array, kept from frame to frame.
class PagePool {
 public:
  /// Sides of a layer, and layers.
  struct Extent {
    int side = 1, layers = 1;
  };
  /// Grows to hold the pages of the plan, and a quarter more where it grows: pages that leave the view stay.
  Extent fit(const PagePlan& plan) noexcept;
  /// The layers hold nothing any more.
  void forget() noexcept;

  /// Places the pages and sends the tables.
  void build(const PagePlan& plan, const PageFrame& frame);
  /// Those to draw: run by run, without PageFrame::in_runs in the plan's order.
  [[nodiscard]] std::span<const BlockPage> pages() const noexcept { return pages_; }
  [[nodiscard]] std::span<const BlockPage> pages_of(const PageRun& run) const noexcept {
    return pages().subspan(run.begin, run.end - run.begin);
  }
  /// PageFrame::in_runs of the last build().
  [[nodiscard]] bool in_runs() const noexcept { return in_runs_; }
  /// None without PageFrame::in_runs.
  [[nodiscard]] std::span<const PageRun> runs() const noexcept { return runs_; }
  /// What each run draws into the image of its block; without PageFrame::in_runs what each page draws into
  /// the pool.
  [[nodiscard]] std::span<const DrawnPage> drawn() const noexcept { return drawn_; }
  /// Where a page of the last plan lies; its index must be below resident().
  [[nodiscard]] DrawnPage place_of(std::size_t page) const noexcept;
  [[nodiscard]] std::size_t resident() const noexcept { return records_.size(); }
  /// False where a page of the last plan was kept from an earlier one, and beyond resident().
  [[nodiscard]] bool drew(std::size_t page) const noexcept { return page < drew_.size() && drew_[page]; }
  /// From now on static casters have depths of their own in a slot, until its page is drawn again.
  void add_beneath(std::uint32_t slot) noexcept { beneath_[slot] = 1; }
  [[nodiscard]] const Extent& extent() const noexcept { return extent_; }
  [[nodiscard]] int slot_texels() const noexcept { return slot_texels_; }
  [[nodiscard]] std::size_t slot_count() const noexcept { return slots_.size(); }
  /// Of a page of the last plan; its index must be below resident().
  [[nodiscard]] std::size_t slot_of(std::size_t page) const noexcept { return kept_[page].slot; }
  [[nodiscard]] std::size_t level_of(std::size_t page) const noexcept { return records_[page].key.x; }
  /// Which build(), counted from 1, drew what its slot holds.
  [[nodiscard]] std::uint64_t drawn_in(std::size_t page) const noexcept { return drawn_in_[slot_of(page)]; }
  /// Binds the tables where shaders/pass/page/tables.glsl reads them.
  void bind() const noexcept;

 private:
  /// Mirrors PageLevel and PageRecord of the shaders.
  struct Level {
    glm::mat4 clip_from_point;
    std::array<glm::vec4, kMaxSelectPlanes> select_planes;
    glm::ivec4 grid;
  };
  struct Record {
    glm::mat4 clip_from_point;
    glm::uvec4 key;
  };
  [[nodiscard]] TexelRect rectangle(std::uint32_t slot) const noexcept;
  void send_tables(const PagePlan& plan);

  Extent extent_;
  int slot_texels_ = 0;
  glm::dvec3 origin_world_{0.0};
  bool alpha_test_ = false, apart_ = false, in_runs_ = true;
  std::vector<PageSlot> slots_;
  std::vector<std::uint32_t> scratch_;
  std::vector<KeptPage> kept_;
  std::vector<std::uint8_t> beneath_;  ///< by slot: 1 where static casters have depths of their own
  std::uint64_t builds_ = 0;
  std::vector<std::uint64_t> drawn_in_;  ///< by slot
  std::vector<bool> drew_;               ///< by page of the last plan
  std::vector<BlockPage> pages_;
  std::vector<PageRun> runs_;
  std::vector<DrawnPage> drawn_;  ///< by run, or by page
  std::vector<Level> levels_;
  std::vector<Record> records_;
  std::vector<std::uint32_t> table_;
  Buffer level_buffer_, record_buffer_, table_buffer_;
};

}  // namespace gnomon::render
