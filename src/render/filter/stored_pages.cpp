// What filters store besides the depths of pages: images as large as the pool, and the passes that fill a
// page.
#include "filter/stored_pages.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "filter/stored_images.hpp"
#include "gnomon/render/page_filter.hpp"

namespace gnomon::render {
namespace {

constexpr GLuint kLevelBinding = 5;  ///< of shaders/pass/page/tables.glsl
constexpr GLint kLayerLocation = 0, kSlotLocation = 1;

GLintptr offset_of(std::size_t member) noexcept {
  return static_cast<GLintptr>(member);
}

}  // namespace

std::string_view page_filter_refusal(const FilterSettings& settings) noexcept {
  const Filter& filter = *settings.filter;
  if (filter.info.draws_silhouettes) return "reads outlines beside whole maps, which pages do not have";
  if (filter.info.reads == MapRead::summed) return "sums up the texels of whole maps, which no page holds";
  if (settings.mipmap) return "mip-maps, which pages do not have";
  if (covers_pixel(settings)) return "kernels as wide as a pixel, wider than the border of a page";
  if (settings.contacts) return "contacts by a pass over the pixels, which frames of pages do not have";
  if (filter.hooks.needs_depth_max != nullptr && filter.hooks.needs_depth_max(settings))
    return "reads the largest depths of whole maps, which no page holds";
  if (filter.hooks.adapts != nullptr && filter.hooks.adapts(settings))
    return "chooses by the depths of whole maps, which no page holds";
  return {};
}

FilterSettings settings_for_pages(const FilterSettings& settings) noexcept {
  FilterSettings fitted = settings;
  if (settings.filter->hooks.for_pages != nullptr) settings.filter->hooks.for_pages(fitted);
  return fitted;
}

StoredPages::StoredPages()
    : no_vertices_(make_vertex_array()), smooth_sampler_(make_sampler()), nearest_sampler_(make_sampler()) {
  for (const Sampler* sampler : {&smooth_sampler_, &nearest_sampler_}) {
    const GLint filter = sampler == &smooth_sampler_ ? GL_LINEAR : GL_NEAREST;
    glSamplerParameteri(sampler->name(), GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(sampler->name(), GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(sampler->name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler->name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
}

void StoredPages::send_levels(const PagePlan& plan, const FilterSettings& settings) {
  ShadowPlan of_level;
  of_level.clip_space = plan.clip_space;
  levels_.clear();
  FilterBlock block{};
  for (const ShadowMap& level : plan.levels) {
    set_options(settings_for_map(settings, map_depths(settings, level)), 0, block);
    LevelValues values{{}, glm::vec4(static_cast<float>(depth_curve(of_level, level)), 0.0f, 0.0f, 0.0f)};
    std::copy_n(block.options.begin(), kOptionVectors, values.options.begin());
    levels_.push_back(values);
  }
  level_buffer_ = filled_buffer(levels_);
}

void StoredPages::fit(const Shape& wanted) {
  if (wanted == shape_) return;
  shape_ = wanted;
  slots_.clear();
  stored_.clear();
  scratch_.clear();
  bytes_ = scratch_bytes_ = 0;
  for (int i = 0; i < wanted.vectors; ++i) {
    stored_.push_back(array_image(wanted.format, 1, wanted.side, wanted.side, wanted.layers, bytes_));
    if (wanted.scratch)
      scratch_.push_back(array_image(wanted.format, 1, wanted.side, wanted.side, 1, scratch_bytes_));
  }
  stored_fbo_ = make_framebuffer();
  scratch_fbo_ = make_framebuffer();
  draw_into_all(stored_fbo_, std::max<std::size_t>(stored_.size(), 1));
  draw_into_all(scratch_fbo_, std::max<std::size_t>(scratch_.size(), 1));
  attach_images(scratch_fbo_, scratch_, 0, 0);
}

void StoredPages::draw(const FilterPrograms& programs, const PagePool& pool,
                       std::span<const std::size_t> pages, bool blurs) {
  glUseProgram((blurs ? programs.blur_page : programs.store_page).name());
  const bool into_scratch = !blurs && shape_.scratch;
  glBindFramebuffer(GL_FRAMEBUFFER, (into_scratch ? scratch_fbo_ : stored_fbo_).name());
  if (blurs) bind_images(scratch_, nearest_sampler_);
  for (const std::size_t page : pages) {
    const DrawnPage at = pool.place_of(page);
    glViewport(at.place.x, at.place.y, at.place.width, at.place.height);
    glScissor(at.place.x, at.place.y, at.place.width, at.place.height);
    glUniform1i(kLayerLocation, at.layer);
    glUniform4i(kSlotLocation, at.place.x, at.place.y, at.place.width, at.place.height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  ++passes_;
}

/// Pages of one layer and one level.
void StoredPages::fill(const FilterPrograms& programs, const PagePool& pool,
                       std::span<const std::size_t> pages) {
  attach_images(stored_fbo_, stored_, 0, pool.place_of(pages.front()).layer);
  draw(programs, pool, pages, false);
  if (shape_.scratch) draw(programs, pool, pages, true);
}

void StoredPages::forget_other_settings(const FilterSettings& settings, FilterBlock block) noexcept {
  // Slots remember what differs from level to level, and how masks are read makes no other texels.
  block.options = {};
  block.depth_curve = {};
  block.sums.w = 0.0f;
  const bool alike = made_with_.filter == settings.filter && made_with_.format == settings.format &&
                     std::memcmp(&made_block_, &block, sizeof block) == 0;
  if (!alike) slots_.clear();
  made_with_ = settings;
  made_block_ = block;
}

std::vector<std::size_t> StoredPages::take_stale(const PagePool& pool) {
  std::vector<std::size_t> stale;
  for (std::size_t page = 0; page < pool.resident(); ++page) {
    Slot& slot = slots_[pool.slot_of(page)];
    const LevelValues& values = levels_[pool.level_of(page)];
    const std::uint64_t drawn = pool.drawn_in(page);
    if (slot.drawn == drawn && slot.values == values) continue;
    slot = {drawn, values};
    stale.push_back(page);
  }
  return stale;
}

void StoredPages::build(const FilterPrograms& programs, const FilterSettings& settings,
                        const FilterBlock& block, GLuint filter_buffer, const PagePool& pool, GLuint depth) {
  passes_ = 0;
  filtered_texels_ = 0;
  if (!programs.store_page) {
    fit({});
    return;
  }
  fit({pool.extent().side, pool.extent().layers, programs.variant.vectors, stored_format(settings),
       block.reach[0].x > 0});
  smooth_ = programs.variant.reads == MapRead::filtered;
  forget_other_settings(settings, block);
  slots_.resize(pool.slot_count());
  std::vector<std::size_t> stale = take_stale(pool);
  const auto side = static_cast<std::uint64_t>(pool.slot_texels());
  filtered_texels_ = stale.size() * side * side;
  const auto group_of = [&](std::size_t page) {
    return std::pair(pool.place_of(page).layer, pool.level_of(page));
  };
  std::sort(stale.begin(), stale.end(), [&](std::size_t a, std::size_t b) {
    return group_of(a) != group_of(b) ? group_of(a) < group_of(b) : a < b;
  });
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_SCISSOR_TEST);
  glBindVertexArray(no_vertices_.name());
  glBindTextureUnit(kDepthUnit, depth);
  glBindSampler(kDepthUnit, nearest_sampler_.name());
  for (std::size_t begin = 0, end = 0; begin < stale.size(); begin = end) {
    while (end < stale.size() && group_of(stale[end]) == group_of(stale[begin])) ++end;
    const LevelValues& values = levels_[pool.level_of(stale[begin])];
    glNamedBufferSubData(filter_buffer, offset_of(offsetof(FilterBlock, options)), sizeof values.options,
                         values.options.data());
    glNamedBufferSubData(filter_buffer, offset_of(offsetof(FilterBlock, depth_curve)), sizeof values.curve,
                         &values.curve);
    fill(programs, pool, std::span(stale).subspan(begin, end - begin));
  }
  glDisable(GL_SCISSOR_TEST);
}

void StoredPages::bind() const noexcept {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kLevelBinding, level_buffer_.name());
  bind_images(stored_, smooth_ ? smooth_sampler_ : nearest_sampler_);
}

}  // namespace gnomon::render
