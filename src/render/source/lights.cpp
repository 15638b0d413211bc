// A frame of many lights: their maps in one pool, a mask for each, and the sum of their light.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "frame/renderer_impl.hpp"
#include "gl/pass_timer.hpp"
#include "gl/program.hpp"
#include "source/light_pass.hpp"

namespace gnomon::render {
namespace {

constexpr GLint kBrightnessLocation = 0, kSkyLocation = 0;
constexpr GLuint kMaskUnit = 6, kSumUnit = 7, kTransmittanceUnit = 7;

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

/// Of a local light; 0 for a sun.
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
  } else {
    const auto* spot = std::get_if<SpotLight>(&light.light);
    const auto* point = std::get_if<PointLight>(&light.light);
    const glm::dvec3 position = spot != nullptr ? spot->position : point->position;
    block.light_place = glm::vec4(glm::vec3(position - camera.position), 1.0f);
  }
  for (std::size_t k = 0; k < plan.maps().size(); ++k)
    move_to_place(plan.map[k], maps.place[k], plan.select_by_map, glm::vec2(pool), block.maps[k]);
  return block;
}

}  // namespace

LightPass::LightPass()
    : add(make_screen_program({"pass/shade/add_light.frag", {"panes/none"}})),
      finish(make_screen_program("pass/shade/lights.frag")) {}

void LightPass::resize(int new_width, int new_height) {
  if (width == new_width && height == new_height) return;
  width = new_width;
  height = new_height;
  sum = pixel_image(GL_RGBA32F, width, height);
  sum_fbo = make_framebuffer();
  glNamedFramebufferTexture(sum_fbo.name(), GL_COLOR_ATTACHMENT0, sum.name(), 0);
  mask_and_sum_fbo = make_framebuffer();
  glNamedFramebufferTexture(mask_and_sum_fbo.name(), GL_COLOR_ATTACHMENT1, sum.name(), 0);
  constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glNamedFramebufferDrawBuffers(mask_and_sum_fbo.name(), 2, kBoth.data());
}

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

PreparedFilter Renderer::prepare_lights(const FilterSettings& settings) {
  const PreparedFilter prepared = prepare(settings);
  Program& program = impl_->filter_programs[prepared.program].mask_lights;
  if (!program) program = make_lights_program(settings);
  Program& clustered = impl_->filter_programs[prepared.program].shade_clusters;
  if (!clustered && LightLists::are_supported()) clustered = make_clusters_program(settings);
  if (!impl_->light_pass) impl_->light_pass.emplace();
  return prepared;
}

void Renderer::Impl::list_pool_maps(const LightPlan& plan, std::span<const DrawnLight> lights,
                                    const glm::dvec3& camera_world, FrameStats& stats) {
  LightPass& pass = *light_pass;
  pass.maps.clear();
  pass.light_of.clear();
  for (std::size_t i = 0; i < std::min(lights.size(), plan.lights.size()); ++i) {
    const LightMaps& places = plan.lights[i];
    if (pass.holds && !places.due) continue;
    const ShadowPlan& own = plan_of(lights[i], places);
    stats.lights_drawn += own.map_count > 0 ? 1 : 0;
    const DrawnMaps drawn = drawn_maps(own, camera_world, scene.origin_step());
    for (std::size_t k = 0; k < own.maps().size(); ++k) {
      const ShadowMap& map = own.map[k];
      pass.maps.push_back({map,
                           drawn.map[k].clip_from_position,
                           0,
                           {places.place[k].x, places.place[k].y, map.width, map.height}});
      pass.light_of.push_back(i);
    }
  }
}

void Renderer::Impl::draw_pool_maps(std::span<const DrawnLight> lights, const DepthDraw& how) noexcept {
  const LightPass& pass = *light_pass;
  glBindVertexArray(scene.vertex_array());
  scene.use(SceneBuffers::Placed::for_maps);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  glNamedFramebufferTextureLayer(maps.fbo.name(), GL_DEPTH_ATTACHMENT, maps.depth.name(), 0, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, maps.fbo.name());
  glEnable(GL_SCISSOR_TEST);
  constexpr float kFarthest = 1.0f;
  for (std::size_t i = 0; i < pass.maps.size(); ++i) {
    const DrawnPage& map = pass.maps[i];
    const TexelRect& at = map.place;
    glScissor(at.x, at.y, at.width, at.height);
    glViewport(at.x, at.y, at.width, at.height);
    glClearNamedFramebufferfv(maps.fbo.name(), GL_DEPTH, 0, &kFarthest);
    draw_casters(lists.page_part(i), map.clip_from_position, how);
    if (!info_of(how.layer).peels) continue;
    peel(lists.page_part(i), at, 0, map.clip_from_position, how,
         how.peeled(*lights[pass.light_of[i]].plan, map.map));
    glBindFramebuffer(GL_FRAMEBUFFER, maps.fbo.name());
  }
  glDisable(GL_SCISSOR_TEST);
}

bool Renderer::Impl::add_clustered_lights(const LightPlan& plan, std::span<const DrawnLight> lights,
                                          const Camera& camera, const PreparedFilter& filter,
                                          const FrameOptions& options) {
  const Program& program = filter_programs[filter.program].shade_clusters;
  if (!program || options.light_clusters.tile_pixels == 0) return false;
  LightPass& pass = *light_pass;
  pass.lists.clear();
  for (std::size_t i = 0; i < std::min(lights.size(), plan.lights.size()); ++i) {
    if (is_dark(plan.lights[i], lights[i]) || pass.tinted[i] != 0) continue;
    pass.lists.add(lights[i].light,
                   block_of(lights[i], plan.lights[i], camera, options, {maps.width, maps.height}),
                   lights[i].color);
  }
  if (!pass.lists.send(camera, options.light_clusters)) return false;
  FilterBlock filtering = filter_block(filter.settings, BlurSides{});
  filtering.sums.w = options.receiver_plane ? 0.0f : 1.0f;
  upload(frame_block({}, camera, options, maps.width, maps.height, BlurSides{}, DepthCurves{}), filtering);
  glNamedFramebufferTexture(pass.mask_and_sum_fbo.name(), GL_COLOR_ATTACHMENT0, targets.mask.name(), 0);
  draw_mask(program, pass.mask_and_sum_fbo.name());
  return true;
}

void Renderer::Impl::mark_tinted(const LightPlan& plan, std::span<const DrawnLight> lights,
                                 const Camera& camera) {
  std::vector<std::uint8_t>& tinted = light_pass->tinted;
  tinted.assign(lights.size(), 0);
  light_pass->pane_room = {};
  light_pass->pane_texels = 0;
  if (!panes) return;
  panes->resize(camera.width, camera.height);
  panes->clear_image();
  for (std::size_t i = 0; i < std::min(lights.size(), plan.lights.size()); ++i) {
    if (is_dark(plan.lights[i], lights[i])) continue;
    const ShadowPlan& own = plan_of(lights[i], plan.lights[i]);
    tinted[i] =
        panes->tint(own, drawn_maps(own, camera.position, scene.origin_step()), range_of(lights[i].light));
    if (tinted[i] != 0) light_pass->pane_room = both(light_pass->pane_room, room_for(own));
  }
}

void Renderer::Impl::add_light(const LightMaps& maps_of_light, const DrawnLight& light, bool tinted,
                               const Camera& camera, const PreparedFilter& filter,
                               const FrameOptions& options) {
  LightPass& pass = *light_pass;
  const TexelRect part = lit_pixels(light.light, camera);
  if (part.empty()) return;
  const ShadowPlan& of_light = plan_of(light, maps_of_light);
  FilterBlock filtering = filter_block(filter.settings, BlurSides{});
  set_depth_curves(depth_curves(of_light), filtering);
  filtering.sums.w = options.receiver_plane ? 0.0f : 1.0f;
  fit_options(filter.settings, of_light, filtering);
  const FrameBlock block = block_of(light, maps_of_light, camera, options, {maps.width, maps.height});
  upload(block, filtering);
  glEnable(GL_SCISSOR_TEST);
  glScissor(part.x, part.y, part.width, part.height);
  draw_mask(filter_programs[filter.program].mask_lights, targets.mask_fbo.name());
  if (tinted) {
    // Panes are drawn into maps of their own, whose matrices are not those of the pool.
    FrameOptions own = options;
    own.light = &light.light;
    upload(frame_block(of_light, camera, own, 1, 1, BlurSides{}, depth_curves(of_light)), filtering);
    draw_transmittance(of_light, drawn_maps(of_light, camera.position, scene.origin_step()), camera, part,
                       {.range = range_of(light.light), .room = pass.pane_room});
    pass.pane_texels += panes->texels();
    upload(block, filtering);
    glEnable(GL_SCISSOR_TEST);
    glScissor(part.x, part.y, part.width, part.height);
    glBindTextureUnit(kTransmittanceUnit, panes->image().name());
  }
  glBindTextureUnit(kMaskUnit, targets.mask.name());
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  const Program& add = tinted ? panes->add_light_program() : pass.add;
  glProgramUniform4f(add.name(), kBrightnessLocation, light.color.x, light.color.y, light.color.z, 0.0f);
  fullscreen(pass.sum_fbo.name(), add);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::Impl::add_lights(const LightPlan& plan, std::span<const DrawnLight> lights,
                                const Camera& camera, const PreparedFilter& filter,
                                const FrameOptions& options) noexcept {
  bind_noise(options.noise);
  mark_tinted(plan, lights, camera);
  const bool clustered = add_clustered_lights(plan, lights, camera, filter, options);
  if (!clustered) {
    constexpr std::array<float, 4> kDark{}, kLit{1.0f, -1.0f};
    // Not through the framebuffer: under Mesa such a clear was seen to be lost where no draw follows it.
    glClearTexImage(light_pass->sum.name(), 0, GL_RGBA, GL_FLOAT, kDark.data());
    glClearTexImage(targets.mask.name(), 0, GL_RG, GL_FLOAT, kLit.data());
  }
  for (std::size_t i = 0; i < std::min(lights.size(), plan.lights.size()); ++i) {
    const bool tinted = light_pass->tinted[i] != 0;
    if (is_dark(plan.lights[i], lights[i]) || (clustered && !tinted)) continue;
    add_light(plan.lights[i], lights[i], tinted, camera, filter, options);
  }
}

void Renderer::Impl::draw_sum_of_lights(const Camera& camera, std::span<const DrawnLight> lights,
                                        const FrameOptions& options) {
  // The sky is that of the first sun; under local lights alone it is dusk.
  ShadowPlan sky;
  float share = 0.3f;
  for (const DrawnLight& light : lights) {
    const auto* sun = std::get_if<DirectionalLight>(&light.light);
    if (sun == nullptr || share == 1.0f) continue;
    sky.light_direction = glm::normalize(sun->direction);
    share = std::clamp(std::max({light.color.x, light.color.y, light.color.z}), 0.02f, 1.0f);
  }
  const FrameBlock block = frame_block(sky, camera, options, 1, 1, BlurSides{}, DepthCurves{});
  upload(block, FilterBlock{});
  glBindTextureUnit(kMaskUnit, targets.mask.name());
  glBindTextureUnit(kSumUnit, light_pass->sum.name());
  glProgramUniform1f(light_pass->finish.name(), kSkyLocation, share);
  glEnable(GL_FRAMEBUFFER_SRGB);
  fullscreen(targets.color_fbo.name(), light_pass->finish);
  glDisable(GL_FRAMEBUFFER_SRGB);
  if (panes) panes->draw_over(targets, block.clip_from_camera_relative, camera.position);
}

FrameStats Renderer::draw(const LightPlan& plan, std::span<const DrawnLight> lights, const Camera& camera,
                          const PreparedFilter& filter, const FrameOptions& options) noexcept {
  Impl& impl = *impl_;
  if (!impl.light_pass || !impl.filter_programs[filter.program].mask_lights)
    return draw(ShadowPlan{}, camera, filter, options);
  LightPass& pass = *impl.light_pass;
  impl.take_moved(options.moved_world);
  impl.movers.forget_changes();
  impl.lists.forget_maps();
  impl.pages.forget();
  impl.history.forget();  // each mask is of one light
  impl.take_layer(options.depth_layer, options.dual_limit_texels);
  FrameStats stats;
  const PassTimer timed{stats, options.time_passes};
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  impl.targets.resize(camera.width, camera.height);
  pass.resize(camera.width, camera.height);
  impl.map_count = 0;
  const bool lost = impl.maps.fit(std::max(plan.pool_width, 1), std::max(plan.pool_height, 1), 1);
  if (lost || options.depth_layer != pass.layer || options.dual_limit_texels != pass.limit_texels)
    pass.holds = false;
  timed(Pass::shadow_maps, [&] {
    // The camera's part of the block is the same for all lights.
    impl.upload(frame_block({}, camera, options, 1, 1, BlurSides{}, DepthCurves{}), FilterBlock{});
    static_cast<void>(impl.place_scene({}, camera.position));
    impl.list_pool_maps(plan, lights, camera.position, stats);
    impl.lists.build_pages(pass.maps, camera, options.prune);
    impl.draw_pool_maps(lights, depth_draw(options));
  });
  pass.holds = true;
  pass.layer = options.depth_layer;
  pass.limit_texels = options.dual_limit_texels;
  timed(Pass::surfaces,
        [&] { impl.draw_surfaces(impl.targets.surfaces_fbo.name(), impl.programs.surfaces); });
  timed(Pass::mask, [&] { impl.add_lights(plan, lights, camera, filter, options); });
  timed(Pass::shade, [&] { impl.draw_sum_of_lights(camera, lights, options); });
  stats.map_count = 1;
  stats.map[0] = impl.work_of_map(0);
  stats.texels = stats.map[0].texels;
  stats.saved = impl.lists.saved();
  stats.camera = impl.lists.camera_stats();
  stats.lights_tinted = static_cast<int>(std::count(pass.tinted.begin(), pass.tinted.end(), 1));
  stats.pane_texels = pass.pane_texels;
  stats.map_bytes = impl.maps.bytes();
  stats.scratch_bytes = impl.panes ? impl.panes->bytes() : 0;
  return stats;
}

}  // namespace gnomon::render
