// What panes absorb on the light's way to each pixel.
// Based on: Muenstermann, Krumpen, Klein, Peters, "Moment-Based Order-Independent Transparency", 2018
// (moments of absorbance along a ray, summed by blending); Peters, Klein, "Moment Shadow Mapping", 2015 (what
// four moments say of the share in front).
#include "frame/pane_pass.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "gl/program.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::render {
namespace {

// Bindings and locations as the shaders state them.
constexpr GLuint kColorImageUnit = 3, kMomentsUnit = 3, kPlacesUnit = 5, kAbsorbanceUnit = 7;
constexpr GLint kBaseColor = 1, kAlphaCutoff = 2, kClip = 3, kLook = 4, kLight = 5, kRange = 6, kDrawn = 7,
                kMap = 3, kSamples = 6;
constexpr GLuint kAbsorbedBinding = 2;

Texture sums(GLenum format, const glm::ivec2& size, int layers) {
  Texture texture = make_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.name(), 1, format, size.x, size.y, layers);
  return texture;
}

/// Corners of a box.
std::array<glm::dvec3, 8> corners_of(const Box& box) noexcept {
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i)
    corners[i] = {(i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                  (i & 4) != 0 ? box.max.z : box.min.z};
  return corners;
}

}  // namespace

std::uint64_t PaneRoom::bytes() const noexcept {
  return static_cast<std::uint64_t>(kPaneTexelBytes) * static_cast<std::uint64_t>(layer.x) *
         static_cast<std::uint64_t>(layer.y) * static_cast<std::uint64_t>(layers);
}

PaneRoom both(const PaneRoom& a, const PaneRoom& b) noexcept {
  return {glm::max(a.layer, b.layer), std::max(a.layers, b.layers)};
}

PaneRoom room_for(const ShadowPlan& plan) noexcept {
  PaneRoom room;
  for (const ShadowMap& map : plan.maps()) room = both(room, {{map.width, map.height}, plan.map_count});
  return room;
}

std::uint64_t PanePass::Rectangle::area() const noexcept {
  return empty() ? 0
                 : static_cast<std::uint64_t>(high.x - low.x) * static_cast<std::uint64_t>(high.y - low.y);
}

PanePass::PanePass(const Scene& panes)
    : panes_(panes),
      map_program_(make_program("pass/panes/pane.vert", "pass/panes/map.frag")),
      transmittance_program_(make_screen_program({"pass/panes/transmittance.frag", {"place/maps"}})),
      add_light_program_(make_screen_program({"pass/shade/add_light.frag", {"panes/in_front"}})),
      shade_program_(make_screen_program({"pass/shade/shade.frag", {"panes/in_front"}})),
      over_program_(make_program("pass/panes/pane.vert", "pass/panes/pane.frag")),
      order_(filled_buffer({std::as_bytes(panes_.order())})),
      map_fbo_(make_framebuffer()),
      over_fbo_(make_framebuffer()),
      shown_(panes_.boxes().size(), 1) {
  panes_.set_object_index_buffer(order_.name());
  constexpr std::array<GLenum, 3> kAll{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
  glNamedFramebufferDrawBuffers(map_fbo_.name(), 3, kAll.data());
}

PanePass::Listed::Listed()
    : sums(make_program("pass/lists/caster.vert", "pass/lists/caster.geom", "pass/lists/panes.frag")),
      transmittance(make_screen_program("pass/panes/listed.frag")) {}

void PanePass::prepare_listed() {
  if (!listed_) listed_.emplace();
}

std::uint64_t PanePass::bytes() const noexcept {
  return room_.bytes() + (listed_ ? listed_->bytes : 0);
}

void PanePass::fit(const PaneRoom& wanted, std::uint64_t most_bytes) {
  // Sizes that follow the view differ from frame to frame: images that are a little too large stay.
  constexpr std::uint64_t kMaxWaste = 4;
  PaneRoom room = both(wanted, room_);
  if (room.bytes() > std::min(kMaxWaste * wanted.bytes(), most_bytes)) room = wanted;
  if (room == room_) return;
  room_ = room;
  held_ = {};
  held_pages_.reset();
  absorbance_ = sums(GL_RGBA16F, room.layer, room.layers);
  moments_ = sums(GL_RGBA32F, room.layer, room.layers);
  places_ = sums(GL_RGBA32F, room.layer, room.layers);
}

void PanePass::resize(int width, int height) {
  if (image_size_ == glm::ivec2(width, height)) return;
  image_size_ = {width, height};
  image_ = pixel_image(GL_RGBA32F, width, height);
  image_fbo_ = make_framebuffer();
  glNamedFramebufferTexture(image_fbo_.name(), GL_COLOR_ATTACHMENT0, image_.name(), 0);
}

void PanePass::clear_image() noexcept {
  constexpr std::array<float, 4> kAll{1.0f, 1.0f, 1.0f, 1.0f};
  glClearTexImage(image_.name(), 0, GL_RGBA, GL_FLOAT, kAll.data());
}

PanePass::Rectangle PanePass::reached(const DrawnMap& map, const glm::dvec3& origin_world,
                                      std::span<const Box> boxes) noexcept {
  const glm::dvec2 size(map.width, map.height);
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const Box& box : boxes) {
    if (box.empty()) continue;
    for (const glm::dvec3& corner : corners_of(box)) {
      const glm::dvec4 clip = glm::dmat4(map.clip_from_position) * glm::dvec4(corner - origin_world, 1.0);
      // Behind a warp's or a local light's centre a box may be anywhere.
      if (!(clip.w > 0.0)) return {{0, 0}, {map.width, map.height}};
      const glm::dvec2 texel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size;
      low = glm::min(low, texel);
      high = glm::max(high, texel);
    }
  }
  // A texel more on each side is empty, so that bilinear reads at an edge find nothing beyond it.
  low = glm::clamp(low - 1.0, glm::dvec2(0.0), size);
  high = glm::clamp(high + 1.0, glm::dvec2(0.0), size);
  return {glm::ivec2(glm::floor(low)), glm::ivec2(glm::ceil(high))};
}

void PanePass::move(std::size_t instance, const Instance& to) {
  // More than that, and the maps are drawn anew.
  constexpr std::size_t kMaxChanged = 4096;
  if (changed_world_.size() < kMaxChanged) {
    changed_world_.push_back(panes_.boxes()[instance]);
    changed_world_.push_back(to.bounds_world);
  } else {
    held_ = {};
  }
  const std::vector<std::uint32_t> order(panes_.order().begin(), panes_.order().end());
  panes_.move(instance, to);
  if (std::equal(order.begin(), order.end(), panes_.order().begin(), panes_.order().end())) return;
  // A pane became its own mirror image. Sums are rounded in the order of drawing.
  order_ = filled_buffer({std::as_bytes(panes_.order())});
  panes_.set_object_index_buffer(order_.name());
  held_ = {};
}

void PanePass::show_within(const glm::dvec4& light_world, double range) {
  const bool bounded = light_world.w != 0.0 && range > 0.0;
  const glm::dvec3 at(light_world);
  const std::span<const Box> boxes = panes_.boxes();
  shown_world_.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i];
    shown_[i] = panes_.casts(static_cast<std::uint32_t>(i)) &&
                (!bounded || (!box.empty() && glm::distance(glm::clamp(at, box.min, box.max), at) < range));
    if (shown_[i] != 0) shown_world_.push_back(box);
  }
}

bool PanePass::tint(const ShadowPlan& plan, const DrawnMaps& drawn, double range) {
  if (plan.map_count == 0) return false;
  show_within(plan.map[0].light_world, range);
  for (int i = 0; i < plan.map_count; ++i) {
    const DrawnMap& map = drawn.map[static_cast<std::size_t>(i)];
    if (!reached(map, drawn.origin_world, shown_world_).empty()) return true;
  }
  return false;
}

glm::dvec2 PanePass::range_along(const glm::dvec4& light_world) const noexcept {
  const bool local = light_world.w != 0.0;
  const glm::dvec3 light = local ? glm::dvec3(light_world) : -glm::normalize(glm::dvec3(light_world));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Box& box : panes_.boxes()) {
    if (box.empty()) continue;
    for (const glm::dvec3& corner : corners_of(box)) {
      const double away = local ? glm::distance(corner, light) : glm::dot(corner, light);
      low = std::min(low, away);
      high = std::max(high, away);
    }
    // A box round the light, or beside it, is nearer than its corners.
    if (local) low = std::min(low, glm::distance(glm::clamp(light, box.min, box.max), light));
  }
  if (!(low <= high)) return {0.0, 1.0};
  // A single pane may lie across the light; the range is divided by.
  constexpr double kRounding = 1e-6, kLeast = 1e-30;
  const double extent = std::max(high - low, kRounding * (std::abs(low) + std::abs(high)) + kLeast);
  constexpr double kSteps = 16.0;
  const double step = std::exp2(std::ceil(std::log2(extent))) / kSteps;
  return {(std::floor(low / step) - 1.0) * step, (std::ceil(high / step) + 1.0) * step};
}

void PanePass::set_light(const glm::dvec3& origin_world) const noexcept {
  const bool local = light_world_.w != 0.0;
  const glm::dvec3 light =
      local ? glm::dvec3(light_world_) - origin_world : -glm::normalize(glm::dvec3(light_world_));
  const glm::dvec2 range = range_world_ - (local ? 0.0 : glm::dot(origin_world, light));
  glUniform4f(kLight, static_cast<float>(light.x), static_cast<float>(light.y), static_cast<float>(light.z),
              local ? 1.0f : 0.0f);
  glUniform2f(kRange, static_cast<float>(range.x), static_cast<float>(range.y));
}

void PanePass::draw_all() const noexcept {
  const std::span<const std::uint32_t> order = panes_.order();
  for (const Batch& batch : panes_.batches()) {
    glBindTextureUnit(kColorImageUnit, batch.texture);
    glBindSampler(kColorImageUnit, batch.sampler);
    glUniform4fv(kBaseColor, 1, &batch.base_color.x);
    glUniform1f(kAlphaCutoff, batch.alpha_cutoff);
    glUniform2f(kLook, batch.transmission, static_cast<float>(batch.alpha_mode));
    for (std::uint32_t i = batch.begin; i < batch.end; ++i) {
      if (shown_[order[i]] == 0) continue;
      const Primitive& primitive = panes_.primitive_of(order[i]);
      const auto offset = static_cast<std::uintptr_t>(primitive.first_index) * sizeof(std::uint32_t);
      glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(primitive.index_count),
                                          GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset), 1, i);
    }
  }
  glBindSampler(kColorImageUnit, 0);
}

void PanePass::attach(int layer) noexcept {
  glNamedFramebufferTextureLayer(map_fbo_.name(), GL_COLOR_ATTACHMENT0, absorbance_.name(), 0, layer);
  glNamedFramebufferTextureLayer(map_fbo_.name(), GL_COLOR_ATTACHMENT1, moments_.name(), 0, layer);
  glNamedFramebufferTextureLayer(map_fbo_.name(), GL_COLOR_ATTACHMENT2, places_.name(), 0, layer);
  glBindFramebuffer(GL_FRAMEBUFFER, map_fbo_.name());
}

void PanePass::begin_sums(const glm::dvec3& origin_world) noexcept {
  panes_.place(SceneBuffers::Placed::for_maps, origin_world);
  panes_.use(SceneBuffers::Placed::for_maps);
  glBindVertexArray(panes_.vertex_array());
  glUseProgram(map_program_.name());
  set_light(origin_world);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  // Panes before the nearest caster absorb as well.
  glEnable(GL_DEPTH_CLAMP);
}

void PanePass::end_sums() noexcept {
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
}

void PanePass::clear(const Rectangle& at) noexcept {
  if (at.empty()) return;
  constexpr std::array<float, 4> kNothing{};
  glScissor(at.low.x, at.low.y, at.high.x - at.low.x, at.high.y - at.low.y);
  for (const GLint target : {0, 1, 2})
    glClearNamedFramebufferfv(map_fbo_.name(), GL_COLOR, target, kNothing.data());
  texels_ += at.area();
}

void PanePass::clear_beyond(const Rectangle& before, const Rectangle& now) noexcept {
  if (before.empty()) return clear(now);
  clear({now.low, {before.low.x, now.high.y}});
  clear({{before.high.x, now.low.y}, now.high});
  clear({{before.low.x, now.low.y}, {before.high.x, before.low.y}});
  clear({{before.low.x, before.high.y}, {before.high.x, now.high.y}});
}

void PanePass::draw_map(int layer, const Look& look, bool keep) noexcept {
  const auto at = static_cast<std::size_t>(layer);
  const DrawnMap& map = look.map;
  Held& held = held_[at];
  const Rectangle all = reached(map, look.origin_world, shown_world_);
  const bool kept = keep && held.valid && held.look == look;
  Rectangle dirty = all, now = all;
  attach(layer);
  glViewport(0, 0, map.width, map.height);
  if (kept) {
    dirty = reached(map, look.origin_world, changed_world_);
    if (held.at.empty()) {
      now = all.empty() ? held.at : all;
    } else if (all.empty()) {
      now = held.at;
    } else {
      now = {glm::min(all.low, held.at.low), glm::max(all.high, held.at.high)};
    }
    clear_beyond(held.at, now);
  }
  if (!dirty.empty()) {
    clear(dirty);
    draw_all();
  }
  held = {keep, look, now};
  if (!now.empty()) drawn_[at] = {now.low, now.high};
}

void PanePass::draw_maps(const ShadowPlan& plan, const DrawnMaps& drawn, const MapDraw& how) {
  drawn_.fill(glm::vec4(0.0f));
  texels_ = 0;
  if (plan.map_count == 0) return;
  fit(both(room_for(plan), how.room), std::numeric_limits<std::uint64_t>::max());
  light_world_ = plan.map[0].light_world;
  range_world_ = range_along(light_world_);
  show_within(light_world_, how.range);
  begin_sums(drawn.origin_world);
  for (int i = 0; i < kMaxMaps; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (i >= plan.map_count || drawn.map[at].bent) {
      held_[at].valid = false;
      continue;
    }
    const DrawnMap& map = drawn.map[at];
    glUniformMatrix4fv(kClip, 1, GL_FALSE, &map.clip_from_position[0][0]);
    draw_map(i, {map, drawn.origin_world, light_world_, range_world_}, how.keep);
  }
  changed_world_.clear();
  held_pages_.reset();
  end_sums();
}

void PanePass::draw_listed(const ShadowPlan& plan, const glm::dvec3& camera_world, const PixelLists& lists) {
  const std::uint64_t bytes = 3 * sizeof(std::uint32_t) * lists.entries();
  if (bytes != listed_->bytes) {
    listed_->absorbed = make_buffer();
    glNamedBufferStorage(listed_->absorbed.name(), static_cast<GLsizeiptr>(bytes), nullptr, 0);
    listed_->bytes = bytes;
  }
  constexpr GLuint kNothing = 0;
  glClearNamedBufferData(listed_->absorbed.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &kNothing);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kAbsorbedBinding, listed_->absorbed.name());
  for (std::uint32_t i = 0; i < shown_.size(); ++i) shown_[i] = panes_.casts(i);
  panes_.place(SceneBuffers::Placed::for_camera, camera_world);
  panes_.use(SceneBuffers::Placed::for_camera);
  glBindVertexArray(panes_.vertex_array());
  glUseProgram(listed_->sums.name());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  const DrawnMaps seen = drawn_maps(plan, camera_world, panes_.origin_step());
  for (int i = 0; i < plan.map_count; ++i) {
    const DrawnMap& map = seen.map[static_cast<std::size_t>(i)];
    if (!map.bent && reached(map, seen.origin_world, panes_.boxes()).empty()) continue;
    glViewport(0, 0, map.width, map.height);
    glUniform1i(kMap, i);
    draw_all();
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  glUseProgram(listed_->transmittance.name());
  glUniform1i(kSamples, lists.samples());
}

void PanePass::bind_images() noexcept {
  const std::pair<GLuint, GLuint> images[] = {
      {kMomentsUnit, moments_.name()}, {kPlacesUnit, places_.name()}, {kAbsorbanceUnit, absorbance_.name()}};
  for (const auto& [unit, texture] : images) {
    glBindTextureUnit(unit, texture);
    glBindSampler(unit, 0);
  }
}

void PanePass::bind_maps(const glm::dvec3& camera_world) noexcept {
  bind_images();
  glUseProgram(transmittance_program_.name());
  if (light_world_ != glm::dvec4(0.0)) set_light(camera_world);
  glUniform4fv(kDrawn, kMaxMaps, &drawn_[0].x);
}

void PanePass::draw_over(const FrameTargets& targets, const glm::mat4& clip_from_camera_relative,
                         const glm::dvec3& camera_world) {
  glNamedFramebufferTexture(over_fbo_.name(), GL_COLOR_ATTACHMENT0, targets.color.name(), 0);
  glNamedFramebufferTexture(over_fbo_.name(), GL_DEPTH_ATTACHMENT, targets.depth.name(), 0);
  glBindFramebuffer(GL_FRAMEBUFFER, over_fbo_.name());
  glViewport(0, 0, targets.width, targets.height);
  std::fill(shown_.begin(), shown_.end(), std::uint8_t{1});
  panes_.place(SceneBuffers::Placed::for_camera, camera_world);
  panes_.use(SceneBuffers::Placed::for_camera);
  glBindVertexArray(panes_.vertex_array());
  glUseProgram(over_program_.name());
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glDisable(GL_CULL_FACE);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  glUniformMatrix4fv(kClip, 1, GL_FALSE, &clip_from_camera_relative[0][0]);
  draw_all();
  glDisable(GL_BLEND);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace gnomon::render
