// Many lights: the depths of their maps in one pool, a mask for each, and the sum of their light.
#include "source/pool.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/study/bias.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "gl/program.hpp"

namespace gnomon::render {
namespace {

constexpr GLint kBrightnessLocation = 0, kSkyLocation = 0;
constexpr GLuint kSumUnit = 7, kTransmittanceUnit = 7;

/// The plan by which a light's maps are drawn and read; one without maps where it has none that can be.
const ShadowPlan& plan_of(const DrawnLight& light, const LightMaps& maps) noexcept {
  static const ShadowPlan none{};
  if (light.plan == nullptr || light.plan->map_count > maps.map_count) return none;
  for (const ShadowMap& map : light.plan->maps()) {
    if (!map.shape->affine || map.width > maps.size || map.height > maps.size) return none;
  }
  return *light.plan;
}

/// Row of a matrix that points are multiplied with.
glm::vec4 row(const glm::mat4& m, int i) noexcept {
  return {m[0][i], m[1][i], m[2][i], m[3][i]};
}

/// Reads the map in its place: the pool becomes the map's square, and planes part it from its neighbours.
void move_to_place(const ShadowMap& map, const TexelRect& place, bool by_hold, const glm::vec2& pool,
                   MapBlock& block) noexcept {
  glm::mat4& m = block.clip_from_camera_relative;
  if (map.select_plane_count == 0) {
    // As map_spans of shaders/library/select_map.glsl takes the map's own border.
    const float border = by_hold ? static_cast<float>(map.filter_margin_texels) - 0.25f : 0.0f;
    const glm::vec2 inside = 1.0f - 2.0f * border / glm::vec2(map.width, map.height);
    const glm::vec4 x = row(m, 0), y = row(m, 1), w = row(m, 3);
    block.select_planes = {w * inside.x + x, w * inside.x - x, w * inside.y + y, w * inside.y - y};
  }
  const glm::vec2 scale = glm::vec2(map.width, map.height) / pool;
  const glm::vec2 offset =
      (2.0f * glm::vec2(place.x, place.y) + glm::vec2(map.width, map.height)) / pool - 1.0f;
  for (int column = 0; column < 4; ++column) {
    m[column][0] = m[column][0] * scale.x + m[column][3] * offset.x;
    m[column][1] = m[column][1] * scale.y + m[column][3] * offset.y;
  }
  block.interval_size.z = pool.x;
  block.interval_size.w = pool.y;
}

/// The range of a local light, world units; 0 for a sun.
double range_of(const Light& light) noexcept {
  const auto* spot = std::get_if<SpotLight>(&light);
  const auto* point = std::get_if<PointLight>(&light);
  return spot != nullptr ? spot->range : point != nullptr ? point->range : 0.0;
}

/// It adds nothing to the picture.
bool is_dark(const LightMaps& maps, const DrawnLight& light) noexcept {
  const bool reaches = std::holds_alternative<DirectionalLight>(light.light) || range_of(light.light) > 0.0;
  return maps.outcome == LightOutcome::without_receiver || light.color == glm::vec3(0.0f) || !reaches;
}

/// The block that all passes read for one light.
FrameBlock block_of(const DrawnLight& light, const LightMaps& maps, const Camera& camera,
                    const FrameOptions& options, const glm::ivec2& pool) noexcept {
  const ShadowPlan& plan = plan_of(light, maps);
  FrameOptions own = options;
  own.light = &light.light;
  FrameBlock block = frame_block(plan, camera, own, pool.x, pool.y, BlurSides{}, depth_curves(plan));
  if (const auto* sun = std::get_if<DirectionalLight>(&light.light)) {
    block.light_place = glm::vec4(glm::vec3(glm::normalize(sun->direction)), 0.0f);
  } else if (light.inverse_square) {
    block.light_place.w = 2.0f;
  }
  for (std::size_t k = 0; k < plan.maps().size(); ++k)
    move_to_place(plan.map[k], maps.place[k], plan.selection != MapSelection::view_depth, glm::vec2(pool),
                  block.maps[k]);
  return block;
}

/// The pixels that a light can light, from the lower left corner; all of them for a sun.
TexelRect lit_pixels(const Light& light, const Camera& camera) noexcept {
  const TexelRect all{0, 0, camera.width, camera.height};
  const auto* spot = std::get_if<SpotLight>(&light);
  const auto* point = std::get_if<PointLight>(&light);
  if (spot == nullptr && point == nullptr) return all;
  const glm::dvec3 centre = (spot != nullptr ? spot->position : point->position) - camera.position;
  const double range = spot != nullptr ? spot->range : point->range;
  const CameraAxes axes = camera_axes(camera);
  glm::dvec2 low(1e300), high(-1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at =
        centre + range * glm::dvec3((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    const double depth = camera.orthographic ? 1.0 : glm::dot(axes.forward, at);
    // Behind the eye corners bound nothing.
    if (!(depth > 1e-3 * camera.near_depth)) return all;
    const glm::dvec2 image{(glm::dot(axes.right, at) / depth - camera.left) / (camera.right - camera.left),
                           (glm::dot(axes.up, at) / depth - camera.bottom) / (camera.top - camera.bottom)};
    low = glm::min(low, image);
    high = glm::max(high, image);
  }
  const auto pixel = [](double share, int size) {
    return static_cast<int>(std::clamp(share * size, -1.0, size + 1.0));
  };
  TexelRect part;
  part.x = std::max(0, pixel(low.x, camera.width) - 1);
  part.y = std::max(0, pixel(low.y, camera.height) - 1);
  part.width = std::min(camera.width, pixel(high.x, camera.width) + 2) - part.x;
  part.height = std::min(camera.height, pixel(high.y, camera.height) + 2) - part.y;
  return part;
}

}  // namespace

const SourceSupport PoolSource::kSupport{
    "lights", "maps of a `LightPlan`, in one pool",
    FrameOptionSet::all().without(
        {FrameOption::accumulation, FrameOption::linear_depth, FrameOption::map_passes, FrameOption::light,
         FrameOption::aliasing, FrameOption::heat_map, FrameOption::cascade_tint, FrameOption::moved_world,
         FrameOption::small_casters, FrameOption::held_maps, FrameOption::scrolled_maps,
         FrameOption::static_casters, FrameOption::unread_tiles, FrameOption::contacts,
         FrameOption::bent_maps})};

LightSum::LightSum()
    : add(make_screen_program({"pass/shade/add_light.frag", {"panes/none"}})),
      finish(make_screen_program("pass/shade/lights.frag")) {}

void LightSum::resize(int new_width, int new_height) {
  if (width == new_width && height == new_height) return;
  width = new_width;
  height = new_height;
  image = pixel_image(GL_RGBA32F, width, height);
  fbo = make_framebuffer();
  glNamedFramebufferTexture(fbo.name(), GL_COLOR_ATTACHMENT0, image.name(), 0);
  mask_and_sum_fbo = make_framebuffer();
  glNamedFramebufferTexture(mask_and_sum_fbo.name(), GL_COLOR_ATTACHMENT1, image.name(), 0);
  constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferDrawBuffers(mask_and_sum_fbo.name(), 2, kBoth.data());
}

PoolSource::PoolSource(CasterScene& casters, CasterPass& pass, MapTargets& maps, Screen& screen)
    : casters_(casters), pass_(pass), maps_(maps), screen_(screen) {}

FrameOptionSet PoolSource::supports(const FrameJob&) const noexcept {
  return kSupport.supports;
}

SourceSteps PoolSource::steps(const FrameJob&) const noexcept {
  return {.adds_light = true};
}

void PoolSource::lose() noexcept {
  holds_ = false;
}

void PoolSource::begin(FrameJob& frame) {
  const LightPlan& plan = *frame.shadows.light_plan();
  casters_.movers.forget_changes();  // the plan says which maps are due
  sum_.resize(frame.camera.width, frame.camera.height);
  const DepthKind kind = depth_kind(frame.options, false);
  const bool lost = maps_.fit(std::max(plan.pool_width, 1), std::max(plan.pool_height, 1), 1);
  if (lost || kind != kind_) holds_ = false;
  kind_ = kind;
  // The camera's part of the block is the same for all lights.
  frame.block = frame_block(frame.plan, frame.camera, frame.options, 1, 1, BlurSides{}, DepthCurves{});
  frame.filtering = {};
}

void PoolSource::list_maps(FrameJob& frame) {
  const LightPlan& plan = *frame.shadows.light_plan();
  const std::span<const DrawnLight> lights = frame.shadows.lights();
  due_.clear();
  light_of_.clear();
  for (std::size_t i = 0; i < std::min(lights.size(), plan.lights.size()); ++i) {
    const LightMaps& places = plan.lights[i];
    if (holds_ && !places.due) continue;
    const ShadowPlan& own = plan_of(lights[i], places);
    frame.stats.lights_drawn += own.map_count > 0 ? 1 : 0;
    const DrawnMaps drawn = drawn_maps(own, frame.camera.position, casters_.buffers.origin_step());
    for (std::size_t k = 0; k < own.maps().size(); ++k) {
      const ShadowMap& map = own.map[k];
      due_.push_back({map,
                      drawn.map[k].clip_from_position,
                      0,
                      {places.place[k].x, places.place[k].y, map.width, map.height}});
      light_of_.push_back(i);
    }
  }
}

void PoolSource::update(FrameJob& frame) {
  static_cast<void>(casters_.place({}, frame.camera.position));
  list_maps(frame);
  casters_.lists.build_pages(due_, frame.camera, frame.options.prune);
  const DepthDraw how = depth_draw(frame.options);
  pass_.begin();
  maps_.attach(MapTargets::Of::all, 0);
  glEnable(GL_SCISSOR_TEST);
  constexpr float kFarthest = 1.0f;
  for (std::size_t i = 0; i < due_.size(); ++i) {
    const DrawnPage& map = due_[i];
    const DrawnPart& part = casters_.lists.page_part(i);
    const TexelRect& at = map.place;
    glScissor(at.x, at.y, at.width, at.height);
    glViewport(at.x, at.y, at.width, at.height);
    glClearNamedFramebufferfv(maps_.fbo.name(), GL_DEPTH, 0, &kFarthest);
    pass_.draw(part, map.clip_from_position, how);
    if (!info_of(how.layer).peels) continue;
    pass_.peel(maps_, 0, at, part, map.clip_from_position, how,
               how.peeled(*frame.shadows.lights()[light_of_[i]].plan, map.map));
    glBindFramebuffer(GL_FRAMEBUFFER, maps_.fbo.name());
  }
  glDisable(GL_SCISSOR_TEST);
  holds_ = true;
}

SurfacePass PoolSource::surfaces() const noexcept {
  return screen_.surfaces();
}

bool PoolSource::add_clustered(FrameJob& frame, GLuint mask) {
  const FrameOptions& options = frame.options;
  const Program& program = frame.programs.shade_clusters;
  if (!program || options.light_clusters.tile_pixels == 0) return false;
  const LightPlan& plan = *frame.shadows.light_plan();
  const std::span<const DrawnLight> lights = frame.shadows.lights();
  lists_.clear();
  for (std::size_t i = 0; i < std::min(lights.size(), plan.lights.size()); ++i) {
    if (is_dark(plan.lights[i], lights[i]) || tinted_[i] != 0) continue;
    lists_.add(lights[i].light,
               block_of(lights[i], plan.lights[i], frame.camera, options, {maps_.width, maps_.height}),
               lights[i].color);
  }
  if (!lists_.send(frame.camera, options.light_clusters)) return false;
  FilterBlock filtering = filter_block(frame.filter.settings, BlurSides{});
  filtering.sums.w = options.receiver_plane ? 0.0f : 1.0f;
  screen_.upload(
      frame_block(frame.plan, frame.camera, options, maps_.width, maps_.height, BlurSides{}, DepthCurves{}),
      filtering);
  glNamedFramebufferTexture(sum_.mask_and_sum_fbo.name(), GL_COLOR_ATTACHMENT0, mask, 0);
  maps_.bind();
  draw_mask(screen_, program, sum_.mask_and_sum_fbo.name());
  return true;
}

void PoolSource::mark_tinted(const FrameJob& frame) {
  const LightPlan& plan = *frame.shadows.light_plan();
  const std::span<const DrawnLight> lights = frame.shadows.lights();
  tinted_.assign(lights.size(), 0);
  pane_room_ = {};
  if (frame.panes == nullptr) return;
  frame.panes->resize(frame.camera.width, frame.camera.height);
  frame.panes->clear_image();
  for (std::size_t i = 0; i < std::min(lights.size(), plan.lights.size()); ++i) {
    if (is_dark(plan.lights[i], lights[i])) continue;
    const ShadowPlan& own = plan_of(lights[i], plan.lights[i]);
    const DrawnMaps drawn = drawn_maps(own, frame.camera.position, casters_.buffers.origin_step());
    tinted_[i] = frame.panes->tint(own, drawn, range_of(lights[i].light));
    if (tinted_[i] != 0) pane_room_ = both(pane_room_, room_for(own));
  }
}

void PoolSource::add_light(FrameJob& frame, std::size_t index, GLuint fbo) {
  const DrawnLight& light = frame.shadows.lights()[index];
  const LightMaps& places = frame.shadows.light_plan()->lights[index];
  const Camera& camera = frame.camera;
  const FrameOptions& options = frame.options;
  const bool tinted = tinted_[index] != 0;
  const TexelRect part = lit_pixels(light.light, camera);
  if (part.empty()) return;
  const ShadowPlan& plan = plan_of(light, places);
  FilterBlock filtering = filter_block(frame.filter.settings, BlurSides{});
  set_depth_curves(depth_curves(plan), filtering);
  filtering.sums.w = options.receiver_plane ? 0.0f : 1.0f;
  fit_options(frame.filter.settings, plan, filtering);
  const FrameBlock block = block_of(light, places, camera, options, {maps_.width, maps_.height});
  const auto begin_part = [&] {
    screen_.upload(block, filtering);
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.x, part.y, part.width, part.height);
  };
  begin_part();
  maps_.bind();
  draw_mask(screen_, frame.programs.mask_lights, fbo);
  if (tinted) {
    PanePass& panes = *frame.panes;
    // Panes are drawn into maps of their own, whose matrices are not those of the pool.
    FrameOptions own = options;
    own.light = &light.light;
    screen_.upload(frame_block(plan, camera, own, 1, 1, BlurSides{}, depth_curves(plan)), filtering);
    tint_from_maps(screen_, panes, plan, drawn_maps(plan, camera.position, casters_.buffers.origin_step()),
                   camera, part, {.range = range_of(light.light), .room = pane_room_});
    frame.stats.pane_texels += panes.texels();
    begin_part();
    glBindTextureUnit(kTransmittanceUnit, panes.image().name());
  }
  screen_.bind_mask();
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  const Program& add = tinted ? frame.panes->add_light_program() : sum_.add;
  glProgramUniform4f(add.name(), kBrightnessLocation, light.color.x, light.color.y, light.color.z, 0.0f);
  screen_.fullscreen(sum_.fbo.name(), add);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
}

void PoolSource::mask(FrameJob& frame, GLuint fbo) {
  const LightPlan& plan = *frame.shadows.light_plan();
  const std::span<const DrawnLight> lights = frame.shadows.lights();
  const GLuint image = screen_.targets.mask.name();
  mark_tinted(frame);
  const bool clustered = add_clustered(frame, image);
  if (!clustered) {
    constexpr std::array<float, 4> kDark{}, kLit{1.0f, -1.0f};
    // Not through the framebuffer: under Mesa such a clear was seen to be lost where no draw follows it.
    glClearTexImage(sum_.image.name(), 0, GL_RGBA, GL_FLOAT, kDark.data());
    glClearTexImage(image, 0, GL_RG, GL_FLOAT, kLit.data());
  }
  for (std::size_t i = 0; i < std::min(lights.size(), plan.lights.size()); ++i) {
    if (is_dark(plan.lights[i], lights[i]) || (clustered && tinted_[i] == 0)) continue;
    add_light(frame, i, fbo);
  }
}

void PoolSource::shade(FrameJob& frame) {
  // The sky is that of the first sun; under local lights alone it is dusk.
  ShadowPlan sky;
  float share = 0.3f;
  for (const DrawnLight& light : frame.shadows.lights()) {
    const auto* sun = std::get_if<DirectionalLight>(&light.light);
    if (sun == nullptr || share == 1.0f) continue;
    sky.light_direction = glm::normalize(sun->direction);
    share = std::clamp(std::max({light.color.x, light.color.y, light.color.z}), 0.02f, 1.0f);
  }
  FrameBlock block = frame_block(sky, frame.camera, frame.options, 1, 1, BlurSides{}, DepthCurves{});
  block.layer.w = frame.block.layer.w;
  const FrameTargets& targets = screen_.targets;
  screen_.upload(block, FilterBlock{});
  screen_.bind_mask();
  glBindTextureUnit(kSumUnit, sum_.image.name());
  glProgramUniform1f(sum_.finish.name(), kSkyLocation, share);
  glEnable(GL_FRAMEBUFFER_SRGB);
  screen_.fullscreen(targets.color_fbo.name(), sum_.finish);
  glDisable(GL_FRAMEBUFFER_SRGB);
  if (frame.panes != nullptr)
    frame.panes->draw_over(targets, block.clip_from_camera_relative, frame.camera.position);
}

void PoolSource::count(FrameJob& frame) {
  FrameStats& stats = frame.stats;
  stats.map_count = 1;
  stats.map[0] = work_of_map(casters_.lists, 0, kind_.layer);
  stats.texels = stats.map[0].texels;
  count_lists(casters_.lists, stats);
  stats.lights_tinted = static_cast<int>(std::count(tinted_.begin(), tinted_.end(), 1));
  stats.map_bytes = maps_.bytes();
  stats.scratch_bytes = frame.panes != nullptr ? frame.panes->bytes() : 0;
}

}  // namespace gnomon::render
