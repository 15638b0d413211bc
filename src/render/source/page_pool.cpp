// The pages of a frame on the GPU: where each lies in the pool, and the tables that shaders find them by.
#include "source/page_pool.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "frame/frame_block.hpp"

namespace gnomon::render {
namespace {

// Bindings as shaders/pass/page/tables.glsl states them.
constexpr GLuint kLevelBinding = 2, kRecordBinding = 3, kTableBinding = 4;
// Pages along each side of a layer: drivers take at least 2048 layers, of at least 16384 texels.
constexpr int kPagesAcross = 8, kPerLayer = kPagesAcross * kPagesAcross;

/// From the clip space of a page, -1..1 over its slot, to that of the layer it lies in.
glm::dmat4 layer_from_slot(const TexelRect& place, int side) {
  glm::dmat4 into(1.0);
  for (int axis = 0; axis < 2; ++axis) {
    const double size = axis == 0 ? place.width : place.height, begin = axis == 0 ? place.x : place.y;
    into[axis][axis] = size / side;
    into[3][axis] = (2.0 * begin + size) / side - 1.0;
  }
  return into;
}

}  // namespace

PagePool::Extent PagePool::fit(const PagePlan& plan) noexcept {
  const int pages = static_cast<int>(plan.pages.size());
  const bool enough = slot_texels_ == plan.slot_texels() && pages <= extent_.layers * kPerLayer;
  if (enough) return extent_;
  if (slot_texels_ != plan.slot_texels()) forget();
  slot_texels_ = plan.slot_texels();
  extent_ = {kPagesAcross * slot_texels_, std::max(1, (pages + pages / 4 + kPerLayer - 1) / kPerLayer)};
  slots_.resize(static_cast<std::size_t>(extent_.layers * kPerLayer));
  beneath_.resize(slots_.size());
  scratch_.resize(page_table_size(static_cast<int>(slots_.size())));
  return extent_;
}

void PagePool::forget() noexcept {
  std::fill(slots_.begin(), slots_.end(), PageSlot{});
}

TexelRect PagePool::rectangle(std::uint32_t slot) const noexcept {
  const int at = static_cast<int>(slot) % kPerLayer;
  return {at % kPagesAcross * slot_texels_, at / kPagesAcross * slot_texels_, slot_texels_, slot_texels_};
}

DrawnPage PagePool::place_of(std::size_t page) const noexcept {
  DrawnPage place;
  place.layer = static_cast<int>(kept_[page].slot) / kPerLayer;
  place.place = rectangle(kept_[page].slot);
  place.slot = kept_[page].slot;
  place.composed = kept_[page].compose;
  place.has_beneath = beneath_[place.slot] != 0;
  return place;
}

void PagePool::build(const PagePlan& plan, const PageFrame& frame) {
  // Drawn relative to another origin, or with another matrix, texels differ by rounding; slots with both
  // kinds of casters do not say so without the rule.
  if (frame.apart != apart_ || frame.in_runs != in_runs_ || frame.alpha_test != alpha_test_ ||
      frame.origin_world != origin_world_)
    forget();
  origin_world_ = frame.origin_world;
  alpha_test_ = frame.alpha_test;
  in_runs_ = frame.in_runs;
  apart_ = frame.apart;
  kept_.resize(plan.pages.size());
  // fit() made room.
  (void)keep_pages(plan, frame.static_moved_world, slots_, scratch_, kept_, frame.moved_world);
  for (KeptPage& page : kept_) {
    if (apart_ || !page.compose) continue;
    page.draw = true;
    page.compose = false;
  }
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  pages_.clear();
  records_.clear();
  drew_.assign(plan.pages.size(), false);
  ++builds_;
  drawn_in_.resize(slots_.size());
  for (std::size_t i = 0; i < plan.pages.size(); ++i) {
    const Page& page = plan.pages[i];
    DrawnPage drawn = place_of(i);
    drawn.map = page_map(plan, page);
    const auto counted_from = [&](const glm::dvec3& origin) {
      glm::dmat4 m = drawn.map.clip_from_world;
      m[3] = m * glm::dvec4(origin, 1.0);
      return m;
    };
    records_.push_back({glm::mat4(layer_from_slot(drawn.place, extent_.side) * drawn_from_plan *
                                  counted_from(plan.origin_world)),
                        {page.level, static_cast<std::uint32_t>(page.column),
                         static_cast<std::uint32_t>(page.row), static_cast<std::uint32_t>(drawn.layer)}});
    if (frame.keeps && !kept_[i].draw && !kept_[i].compose) continue;
    if (!kept_[i].compose) beneath_[kept_[i].slot] = 0;
    drew_[i] = true;
    drawn_in_[kept_[i].slot] = builds_;
    drawn.clip_from_position = glm::mat4(drawn_from_plan * counted_from(frame.origin_world));
    pages_.push_back({drawn, block_of(plan, page)});
  }
  runs_.clear();
  drawn_.clear();
  if (frame.in_runs) {
    group_pages(plan, frame.origin_world, pages_, runs_, drawn_);
  } else {
    for (const BlockPage& page : pages_) drawn_.push_back(page.drawn);
  }
  send_tables(plan);
}

void PagePool::send_tables(const PagePlan& plan) {
  levels_.clear();
  for (const ShadowMap& map : plan.levels) {
    // Columns and rows count along the plan's own x and y, whichever way they are drawn.
    Level level{map.clip_from_camera_relative, {}, {}};
    level.select_planes.fill({0.0f, 0.0f, 0.0f, 1.0f});
    for (int i = 0; i < map.select_plane_count; ++i) {
      const glm::dvec4 plane = map.select_planes[static_cast<std::size_t>(i)];
      const double at_origin = plane.w + glm::dot(glm::dvec3(plane), plan.origin_world);
      level.select_planes[static_cast<std::size_t>(i)] =
          glm::vec4(glm::vec3(plane), static_cast<float>(at_origin));
    }
    level.grid = {map.width / plan.page_texels, map.height / plan.page_texels, map.cascade, 0};
    levels_.push_back(level);
  }
  table_ = {static_cast<std::uint32_t>(plan.levels.size()), static_cast<std::uint32_t>(plan.table.size()),
            static_cast<std::uint32_t>(plan.border_texels), 0};
  table_.insert(table_.end(), plan.table.begin(), plan.table.end());
  level_buffer_ = filled_buffer(levels_);
  record_buffer_ = filled_buffer(records_);
  table_buffer_ = filled_buffer(table_);
}

void PagePool::bind() const noexcept {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kLevelBinding, level_buffer_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kRecordBinding, record_buffer_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kTableBinding, table_buffer_.name());
}

}  // namespace gnomon::render
