// What panes absorb before the surfaces that pages serve: a place for each page that panes reach.
#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "frame/frame_block.hpp"
#include "frame/pane_pass.hpp"
#include "gl/program.hpp"

namespace gnomon::render {
namespace {

// As the shaders state them.
constexpr GLint kClip = 3;
constexpr GLuint kRecordBinding = 6;

}  // namespace

PaneRoom PanePass::PagesLook::room() const noexcept {
  const int count = static_cast<int>(pages.size()), per_layer = across * across;
  return {glm::ivec2(across * side), (count + per_layer - 1) / per_layer};
}

void PanePass::prepare_pages() {
  if (!pages_program_)
    pages_program_ = make_screen_program({"pass/panes/transmittance.frag", {"place/pages"}});
}

PanePass::PagesLook PanePass::place_pages(const PagePlan& plan, const PagePool& pool,
                                          const glm::dvec3& origin_world,
                                          std::vector<PageRecord>& records) const {
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  const int slot = plan.slot_texels();
  std::vector<DrawnMap> maps(plan.pages.size());
  std::vector<std::size_t> reached_pages;
  for (std::size_t i = 0; i < plan.pages.size(); ++i) {
    const ShadowMap map = page_map(plan, plan.pages[i]);
    glm::dmat4 clip = map.clip_from_world;
    clip[3] = clip * glm::dvec4(origin_world, 1.0);
    maps[i].clip_from_position = glm::mat4(drawn_from_plan * clip);
    maps[i].width = maps[i].height = slot;
    if (!reached(maps[i], origin_world, panes_.boxes()).empty()) reached_pages.push_back(i);
  }
  PagesLook look;
  look.side = slot;
  look.pages.resize(reached_pages.size());
  // A layer no larger than all pages need, and more of them only where they need many.
  constexpr int kMaxAcross = 8, kLeastSide = 4;
  while (look.across < kMaxAcross && look.room().layers > 1) ++look.across;
  while (look.room().bytes() > kMaxPageBytes && look.side > kLeastSide) look.side = (look.side + 1) / 2;
  const int per_layer = look.across * look.across;
  const float scale = static_cast<float>(look.side) / static_cast<float>(slot);
  for (std::size_t n = 0; n < reached_pages.size(); ++n) {
    const std::size_t i = reached_pages[n];
    const int cell = static_cast<int>(n) % per_layer;
    PageLook& page = look.pages[n];
    page.clip_from_position = maps[i].clip_from_position;
    page.layer = static_cast<int>(n) / per_layer;
    page.place = look.side * glm::ivec2(cell % look.across, cell / look.across);
    maps[i].width = maps[i].height = look.side;
    const Rectangle at = reached(maps[i], origin_world, panes_.boxes());
    page.at = {page.place + at.low, page.place + at.high};
    const TexelRect in_pool = pool.place_of(i).place;
    records[i] = {{glm::vec2(scale), glm::vec2(page.place) - scale * glm::vec2(in_pool.x, in_pool.y)},
                  {page.at.low, page.at.high},
                  {page.layer, 0.0f, 0.0f, 0.0f}};
  }
  return look;
}

void PanePass::draw_pages(const PagePlan& plan, const PagePool& pool, const glm::dvec3& origin_world) {
  texels_ = 0;
  light_world_ = page_map(plan, plan.pages[0]).light_world;
  range_world_ = range_along(light_world_);
  std::vector<PageRecord> records(plan.pages.size());
  PagesLook look = place_pages(plan, pool, origin_world, records);
  look.origin_world = origin_world;
  look.light_world = light_world_;
  look.range_world = range_world_;
  page_records_ = filled_buffer(records);
  const bool kept = held_pages_ && changed_world_.empty() && *held_pages_ == look;
  changed_world_.clear();
  if (kept) return;
  held_ = {};
  if (look.pages.empty()) {
    held_pages_ = std::move(look);
    return;
  }
  fit(look.room(), kMaxPageBytes);
  begin_sums(origin_world);
  int layer = -1;
  for (const PageLook& page : look.pages) {
    if (page.layer != layer) attach(layer = page.layer);
    glViewport(page.place.x, page.place.y, look.side, look.side);
    DrawnMap map;
    map.clip_from_position = page.clip_from_position;
    map.width = map.height = look.side;
    const std::span<const Box> boxes = panes_.boxes();
    for (std::size_t i = 0; i < boxes.size(); ++i)
      shown_[i] = panes_.casts(static_cast<std::uint32_t>(i)) &&
                  !reached(map, origin_world, boxes.subspan(i, 1)).empty();
    clear(page.at);
    glUniformMatrix4fv(kClip, 1, GL_FALSE, &page.clip_from_position[0][0]);
    draw_all();
  }
  end_sums();
  held_pages_ = std::move(look);
}

void PanePass::bind_pages(const glm::dvec3& camera_world) noexcept {
  bind_images();
  glUseProgram(pages_program_->name());
  set_light(camera_world);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kRecordBinding, page_records_.name());
}

}  // namespace gnomon::render
