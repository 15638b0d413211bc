// What each pass of a frame binds and draws.
#include <algorithm>
#include <array>
#include <vector>

#include "frame/blue_noise.hpp"
#include "frame/renderer_impl.hpp"
#include "gl/program.hpp"
#include "gnomon/render/contacts.hpp"

namespace gnomon::render {
namespace {

// Bindings and locations as the shaders state them.
constexpr GLint kBaseColorLocation = 1, kAlphaCutoffLocation = 2, kClipLocation = 3, kMapLocation = 3,
                kWrapLocation = 4, kSamplesLocation = 6, kShapeLocation = 7, kSizeLocation = 8,
                kEvenScaleLocation = 10, kClipOfMapsLocation = 10;
constexpr GLuint kPositionUnit = 0, kNormalUnit = 1, kAlbedoUnit = 2, kColorImageUnit = 3, kMaskUnit = 6,
                 kExtraUnit = 7, kNoiseUnit = kColorImageUnit;
constexpr GLint kSheetLocation = 5;

void bind_material(const Batch& batch) noexcept {
  glBindTextureUnit(kColorImageUnit, batch.texture);
  glBindSampler(kColorImageUnit, batch.sampler);
  glUniform4fv(kBaseColorLocation, 1, &batch.base_color.x);
  glUniform1f(kAlphaCutoffLocation, batch.alpha_cutoff);
}

/// A caster without thickness: see DepthLayer.
bool is_sheet(const Batch& batch) noexcept {
  return batch.double_sided || batch.masked;
}

constexpr auto kNoBatchState = [](const Batch&) {};

}  // namespace

DepthDraw depth_draw(const FrameOptions& options) noexcept {
  const double limit = options.dual_limit_texels;
  return {options.prune.has(PruneRule::alpha_test), options.depth_layer, limit > 0.0 ? limit : 0.0};
}

DepthDraw DepthDraw::of(const DrawnMap& map) const noexcept {
  DepthDraw how = *this;
  how.even_scale = map.even_scale;
  return how;
}

PeeledDepth DepthDraw::peeled(const ShadowPlan& plan, const ShadowMap& map) const noexcept {
  const double texel = std::max(map.texel_world.x, map.texel_world.y), range = map.depth_range_world;
  return {layer, even_scale > 0.0f ? 0.0 : depth_curve(plan, map),
          range > 0.0 ? dual_limit_texels * texel / range : 0.0};
}

CommonPrograms::CommonPrograms()
    : depth(make_caster_program("alpha/opaque", "depth/plain")),
      depth_masked(make_caster_program("alpha/masked", "depth/plain")),
      depth_even(make_caster_program("alpha/opaque", "depth/even")),
      depth_even_masked(make_caster_program("alpha/masked", "depth/even")),
      copy_depth(make_program("pass/depth/copy.vert", "pass/depth/copy.frag")),
      surfaces(make_program("pass/gbuffer/gbuffer.vert", {"pass/gbuffer/gbuffer.frag", {"extra/none"}})),
      shade(make_screen_program({"pass/shade/shade.frag", {"panes/none"}})),
      aliasing(make_screen_program("pass/mask/aliasing.frag")),
      heat(make_screen_program("pass/shade/heat.frag")),
      tint(make_screen_program("pass/shade/tint.frag")) {}

void MapPass::prepare(bool shaped) {
  Program& program = shaped ? shaped_ : linear_;
  if (program) return;
  ShaderChoice choice;
  choice.shapes = shaped;
  program = make_screen_program(shader_, choice);
}

BentPrograms::BentPrograms()
    : opaque(make_program("pass/depth/depth.vert", "pass/depth/bent.geom",
                          {"pass/depth/depth.frag", {"alpha/opaque", "depth/bent"}})),
      masked(make_program("pass/depth/depth.vert", "pass/depth/bent.geom",
                          {"pass/depth/depth.frag", {"alpha/masked", "depth/bent"}})) {}

void Renderer::Impl::draw_map_part(const DrawnPart& part, const DrawnMap& map,
                                   const DepthDraw& how) noexcept {
  const TexelRect& at = part.rectangle;
  // Whole maps with all of their layer, which may be larger.
  if (at.width == map.width && at.height == map.height) {
    glDisable(GL_SCISSOR_TEST);
  } else {
    glEnable(GL_SCISSOR_TEST);
    glScissor(at.x, at.y, at.width, at.height);
  }
  constexpr float kFarthest = 1.0f;
  if (part.clear) glClearNamedFramebufferfv(maps.fbo.name(), GL_DEPTH, 0, &kFarthest);
  if (map.bent)
    draw_bent_casters(part, map, how.alpha_test_where_masked);
  else
    draw_casters(part, map.clip_from_position, how);
}

template <class SetPlace, class SetBatch>
void Renderer::Impl::draw_casters(const DrawnPart& part, const CasterPrograms& by,
                                  bool alpha_test_where_masked, SetPlace&& set_place,
                                  SetBatch&& set_batch) noexcept {
  const std::span<const Batch> batches = scene.batches();
  // Opaque batches come first in the order of batches, and their commands follow each other: one call draws
  // them.
  const std::span<const BatchRange> ranges = lists.ranges(part);
  std::size_t opaque = 0;
  while (alpha_test_where_masked && opaque < ranges.size() && !batches[ranges[opaque].batch].masked) ++opaque;
  if (opaque > 0) {
    glUseProgram(by.opaque.name());
    set_place();
    const auto alike = [&](std::size_t a, std::size_t b) {
      const Batch &one = batches[ranges[a].batch], &other = batches[ranges[b].batch];
      return !by.apart || (is_sheet(one) == is_sheet(other) && one.mirrored == other.mirrored);
    };
    for (std::size_t begin = 0, end = 0; begin < opaque; begin = end) {
      while (end < opaque && alike(begin, end)) ++end;
      set_batch(batches[ranges[begin].batch]);
      lists.draw(ranges[begin].begin, ranges[end - 1].end);
    }
  }
  if (opaque == ranges.size()) return;
  glUseProgram(by.masked.name());
  set_place();
  for (const BatchRange& range : ranges.subspan(opaque)) {
    const Batch& batch = batches[range.batch];
    bind_material(batch);
    set_batch(batch);
    glUniform2i(by.wrap_location, static_cast<GLint>(batch.wrap_u), static_cast<GLint>(batch.wrap_v));
    lists.draw(range.begin, range.end);
  }
}

template <class SetPlace>
void Renderer::Impl::draw_layer(const DrawnPart& part, const CasterPrograms& by, bool mirrored,
                                const DepthDraw& how, SetPlace&& set_place) noexcept {
  // Both sides cast: open and thin things have one side only, and the truth knows no sides.
  if (how.layer != DepthLayer::back) {
    draw_casters(part, by, how.alpha_test_where_masked, set_place, kNoBatchState);
    return;
  }
  glCullFace(GL_FRONT);
  draw_casters(part, CasterPrograms{by.opaque, by.masked, -1, true}, how.alpha_test_where_masked, set_place,
               [mirrored](const Batch& batch) {
                 is_sheet(batch) ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
                 glFrontFace(batch.mirrored != mirrored ? GL_CW : GL_CCW);
               });
  glCullFace(GL_BACK);
  glDisable(GL_CULL_FACE);
}

void Renderer::Impl::draw_casters(const DrawnPart& part, const glm::mat4& clip_from_position,
                                  const DepthDraw& how) noexcept {
  const bool even = how.even_scale > 0.0f;
  const CasterPrograms by{even ? programs.depth_even : programs.depth,
                          even ? programs.depth_even_masked : programs.depth_masked};
  draw_layer(part, by, is_mirrored(clip_from_position), how, [&] {
    glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &clip_from_position[0][0]);
    if (even) glUniform1f(kEvenScaleLocation, how.even_scale);
  });
}

void Renderer::Impl::draw_layered_maps(const DrawnMaps& drawn, const DepthDraw& how) noexcept {
  const std::span<const int> joined = lists.layered_maps();
  if (joined.empty()) return;
  std::array<glm::mat4, kMaxMaps> clip_of_maps;
  for (std::size_t i = 0; i < clip_of_maps.size(); ++i) clip_of_maps[i] = drawn.map[i].clip_from_position;
  const DrawnMap& first = drawn.map[static_cast<std::size_t>(joined.front())];
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, first.width, first.height);
  constexpr float kFarthest = 1.0f;
  const GLuint fbo = layered->fbo.name();
  glNamedFramebufferTexture(fbo, GL_DEPTH_ATTACHMENT, maps.depth.name(), 0);
  glBindFramebuffer(GL_FRAMEBUFFER, fbo);
  if (joined.size() == static_cast<std::size_t>(maps.layers)) {
    glClearNamedFramebufferfv(fbo, GL_DEPTH, 0, &kFarthest);
  } else {
    // A clear of the framebuffer would take kept maps along.
    for (const int map : joined)
      glClearTexSubImage(maps.depth.name(), 0, 0, 0, map, maps.width, maps.height, 1, GL_DEPTH_COMPONENT,
                         GL_FLOAT, &kFarthest);
  }
  draw_layer(lists.layered_part(), CasterPrograms{layered->opaque, layered->masked},
             is_mirrored(first.clip_from_position), how, [&] {
               glUniformMatrix4fv(kClipOfMapsLocation, static_cast<GLsizei>(clip_of_maps.size()), GL_FALSE,
                                  &clip_of_maps[0][0][0]);
             });
}

void Renderer::Impl::draw_casters_behind(const DrawnPart& part, const glm::mat4& clip_from_position,
                                         const DepthDraw& how) noexcept {
  draw_casters(
      part, CasterPrograms{depth_peel.opaque(), depth_peel.masked(), -1, true}, how.alpha_test_where_masked,
      [&] {
        glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &clip_from_position[0][0]);
        glUniform1f(kEvenScaleLocation, how.even_scale);
      },
      [](const Batch& batch) { glUniform1i(kSheetLocation, is_sheet(batch) ? 1 : 0); });
}

void Renderer::Impl::peel(const DrawnPart& part, const TexelRect& at, int layer,
                          const glm::mat4& clip_from_position, const DepthDraw& how,
                          const PeeledDepth& depth) noexcept {
  depth_peel.begin(maps, layer, at);
  draw_casters_behind(part, clip_from_position, how);
  depth_peel.finish(maps, layer, at, depth, no_vertices.name());
  glBindVertexArray(scene.vertex_array());
}

void Renderer::Impl::draw_bent_casters(const DrawnPart& part, const DrawnMap& map,
                                       bool alpha_test_where_masked) noexcept {
  if (!bent) return;
  const auto set_place = [&] {
    glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &map.clip_from_position[0][0]);
    glUniformMatrix4fv(kShapeLocation, 1, GL_FALSE, &map.shape[0][0]);
    glUniform2f(kSizeLocation, static_cast<float>(map.width), static_cast<float>(map.height));
    glUniform1f(kEvenScaleLocation, map.even_scale);
  };
  draw_casters(part, CasterPrograms{bent->opaque, bent->masked}, alpha_test_where_masked, set_place,
               kNoBatchState);
}

void Renderer::Impl::draw_identified_casters(const DrawnPart& part, const glm::mat4& clip_from_position,
                                             bool alpha_test_where_masked) noexcept {
  draw_casters(
      part, CasterPrograms{identifiers->opaque(), identifiers->masked()}, alpha_test_where_masked,
      [&] { glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &clip_from_position[0][0]); }, kNoBatchState);
}

void Renderer::Impl::draw_casters_on_lists(const ShadowPlan& plan, bool alpha_test_where_masked) noexcept {
  pixel_lists->bind(targets.mask.name());
  glBindVertexArray(scene.vertex_array());
  // From the camera, as the surfaces: casters then have the very corners of the triangles that are seen.
  scene.use(SceneBuffers::Placed::for_camera);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  for (int i = 0; i < plan.map_count; ++i) {
    const ShadowMap& map = plan.map[static_cast<std::size_t>(i)];
    glViewport(0, 0, map.width, map.height);
    for (const DrawnPart& part : lists.parts(i)) {
      draw_casters(
          part, CasterPrograms{pixel_lists->opaque(), pixel_lists->masked(), kWrapLocation},
          alpha_test_where_masked,
          [i, this] {
            glUniform1i(kMapLocation, i);
            glUniform1i(kSamplesLocation, pixel_lists->samples());
          },
          kNoBatchState);
    }
  }
  pixel_lists->average(targets.mask.name());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT |
                  GL_BUFFER_UPDATE_BARRIER_BIT);
}

void Renderer::Impl::draw_shadow_maps(const ShadowPlan& plan, const DrawnMaps& drawn,
                                      const DepthDraw& how) noexcept {
  // All moves before the first draw: a copy waits for what is being drawn into its image.
  for (int i = 0; i < map_count; ++i) {
    const MapMove& move = lists.move(i);
    if (move.any()) maps.move(MapTargets::Of::all, i, move.kept, move.shift_x, move.shift_y);
  }
  draw_static_maps(drawn, how);
  glBindVertexArray(scene.vertex_array());
  scene.use(SceneBuffers::Placed::for_maps);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  draw_layered_maps(drawn, how);
  for (int i = 0; i < map_count; ++i) {
    const DrawLists::Copies& copies = lists.beneath(i).copies;
    if ((lists.parts(i).empty() && copies.count == 0) || lists.is_layered(i)) continue;
    const DrawnMap& map = drawn.map[static_cast<std::size_t>(i)];
    const DepthDraw of_map = how.of(map);
    glNamedFramebufferTextureLayer(maps.fbo.name(), GL_DEPTH_ATTACHMENT, maps.depth.name(), 0, i);
    glBindFramebuffer(GL_FRAMEBUFFER, maps.fbo.name());
    glViewport(0, 0, map.width, map.height);
    copy_static(copies, i, {map.width, map.height});
    for (const DrawnPart& part : lists.parts(i)) {
      draw_map_part(part, map, of_map);
      if (info_of(how.layer).peels && !map.bent)
        peel(part, part.rectangle, i, map.clip_from_position, of_map,
             of_map.peeled(plan, plan.map[static_cast<std::size_t>(i)]));
    }
  }
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::Impl::adapt_filter(const FilterSettings& settings, FilterBlock& block) noexcept {
  maps_read_back = 0;
  for (int i = 0; i < map_count; ++i)
    if (!lists.map_stats(i).held) adapted[static_cast<std::size_t>(i)].valid = false;
  if (settings.filter->hooks.adapts == nullptr || !settings.filter->hooks.adapts(settings)) return;
  std::vector<float> depths;
  for (int i = 0; i < map_count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    Adapted& chosen = adapted[at];
    if (!chosen.valid || chosen.told.filter != settings.filter || chosen.told.option != settings.option) {
      depths.resize(static_cast<std::size_t>(map_size[at].x) * static_cast<std::size_t>(map_size[at].y));
      read_depths(i, depths);
      ++maps_read_back;
      // As the layers will store them.
      const double curve = block.depth_curve[at].x;
      if (curve > 0.0)
        for (float& depth : depths) depth = static_cast<float>(linear_depth(depth, curve));
      chosen = {true, settings, settings};
      settings.filter->hooks.adapt(chosen.own, depths);
    }
    set_options(chosen.own, at, block);
  }
  glNamedBufferSubData(filter_buffer.name(), 0, sizeof block, &block);
}

bool Renderer::Impl::pays_to_mark(const FilterPrograms& filter, bool unread_tiles) const noexcept {
  if (!unread_tiles || !filter.mark) return false;
  std::uint64_t texels = 0, pixels = static_cast<std::uint64_t>(targets.width) *
                                     static_cast<std::uint64_t>(targets.height);
  for (int i = 0; i < map_count; ++i) {
    if (lists.map_stats(i).held) continue;
    const glm::ivec2 size = map_size[static_cast<std::size_t>(i)];
    texels += static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
  }
  // A marked pixel costs about as much as two filtered vectors of four channels.
  constexpr std::uint64_t kVectorsPerPixel = 2;
  return texels * static_cast<std::uint64_t>(filter.variant.vectors) >= kVectorsPerPixel * pixels;
}

void Renderer::Impl::prefilter(const ShadowPlan& plan, const PreparedFilter& filter, FilterBlock& block,
                               bool unread_tiles) noexcept {
  adapt_filter(filter.settings, block);
  const FilterPrograms& programs_of_filter = filter_programs[filter.program];
  StoreJob job;
  job.depth = maps.depth.name();
  job.layer_width = maps.width;
  job.layer_height = maps.height;
  job.map_size = {map_size.data(), static_cast<std::size_t>(plan.map_count)};
  job.mipmaps = wants_mipmaps(filter.settings, plan);
  job.shaped = shaped;
  for (int i = 0; i < plan.map_count; ++i) job.held[static_cast<std::size_t>(i)] = lists.map_stats(i).held;
  if (pays_to_mark(programs_of_filter, unread_tiles))
    job.mark_read = [&] { fullscreen(targets.mask_fbo.name(), programs_of_filter.mark_for(shaped)); };
  stored.build(programs_of_filter, filter.settings, block, job);
}

void Renderer::Impl::draw_surfaces(GLuint fbo, const Program& program) noexcept {
  glBindFramebuffer(GL_FRAMEBUFFER, fbo);
  glViewport(0, 0, targets.width, targets.height);
  constexpr std::array<float, 4> kNothing{};
  for (GLint i = 0; i < 3; ++i) glClearNamedFramebufferfv(fbo, GL_COLOR, i, kNothing.data());
  constexpr float kFarthestReversed = 0.0f;
  glClearNamedFramebufferfv(fbo, GL_DEPTH, 0, &kFarthestReversed);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glBindVertexArray(scene.vertex_array());
  scene.use(SceneBuffers::Placed::for_camera);
  glUseProgram(program.name());
  const std::span<const Batch> batches = scene.batches();
  for (const BatchRange& range : lists.camera()) {
    const Batch& batch = batches[range.batch];
    batch.double_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
    glFrontFace(batch.mirrored ? GL_CW : GL_CCW);
    bind_material(batch);
    lists.draw(range.begin, range.end);
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

void Renderer::Impl::bind_surfaces() const noexcept {
  glBindTextureUnit(kPositionUnit, targets.position.name());
  glBindTextureUnit(kNormalUnit, targets.normal.name());
  glBindTextureUnit(kAlbedoUnit, targets.albedo.name());
}

void Renderer::Impl::fullscreen(GLuint fbo, const Program& program) const noexcept {
  glBindFramebuffer(GL_FRAMEBUFFER, fbo);
  glViewport(0, 0, targets.width, targets.height);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(no_vertices.name());
  bind_surfaces();
  glUseProgram(program.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::Impl::bind_noise(SampleNoise noise) noexcept {
  if (noise != SampleNoise::blue) return;
  if (!noise_tile) {
    const std::vector<float> values = blue_noise();
    noise_tile = pixel_image(GL_R32F, kBlueNoiseSide, kBlueNoiseSide);
    glTextureSubImage2D(noise_tile.name(), 0, 0, 0, kBlueNoiseSide, kBlueNoiseSide, GL_RED, GL_FLOAT,
                        values.data());
  }
  glBindTextureUnit(kNoiseUnit, noise_tile.name());
  glBindSampler(kNoiseUnit, 0);
}

void Renderer::Impl::draw_mask(const Program& program, GLuint fbo, bool from_pages) noexcept {
  glBindTextureUnit(kCompareUnit, maps.depth.name());
  glBindSampler(kCompareUnit, maps.compare_sampler.name());
  glBindTextureUnit(kDepthUnit, maps.depth.name());
  glBindSampler(kDepthUnit, maps.plain_sampler.name());
  from_pages ? stored_pages.bind() : stored.bind();
  if (drew_silhouettes) silhouettes->bind();
  fullscreen(fbo, program);
  glBindSampler(kExtraUnit, 0);  // shared with the depth pyramid
}

void Renderer::Impl::draw_contacts(const ShadowPlan& plan, const FilterSettings& settings,
                                   GLuint fbo) noexcept {
  constexpr GLint kFallOffLocation = 0;
  std::array<float, kMaxMaps> fall_off{};
  for (std::size_t i = 0; i < plan.maps().size(); ++i)
    fall_off[i] = static_cast<float>(contact_reach_world(settings, map_depths(settings, plan.map[i])));
  const Program& program = contacts.program(shaped);
  glProgramUniform1fv(program.name(), kFallOffLocation, static_cast<GLsizei>(kMaxMaps), fall_off.data());
  glEnable(GL_BLEND);
  glBlendEquation(GL_MIN);
  fullscreen(fbo, program);
  glBlendEquation(GL_FUNC_ADD);
  glDisable(GL_BLEND);
}

void Renderer::Impl::draw_accumulated(const Camera& camera, const FrameOptions& options,
                                      const FrameBlock& block) noexcept {
  history.bind(camera, options.accumulation);
  fullscreen(history.fbo_with(targets.mask), accumulate.program(shaped));
  history.keep(camera, block);
}

void Renderer::Impl::draw_shade(const FrameBlock& block, const glm::dvec3& camera_world) {
  glBindTextureUnit(kMaskUnit, targets.mask.name());
  if (panes) glBindTextureUnit(kExtraUnit, panes->image().name());
  glEnable(GL_FRAMEBUFFER_SRGB);
  fullscreen(targets.color_fbo.name(), panes ? panes->shade_program() : programs.shade);
  glDisable(GL_FRAMEBUFFER_SRGB);
  if (panes) panes->draw_over(targets, block.clip_from_camera_relative, camera_world);
}

void Renderer::Impl::draw_transmittance(const ShadowPlan& plan, const DrawnMaps& drawn, const Camera& camera,
                                        const FrameOptions& options, FrameStats& stats) {
  draw_transmittance(plan, drawn, camera, {0, 0, camera.width, camera.height},
                     {options.prune.has(PruneRule::held_maps)});
  stats.pane_texels = panes->texels();
}

void Renderer::Impl::draw_transmittance(const ShadowPlan& plan, const DrawnMaps& drawn, const Camera& camera,
                                        const TexelRect& part, const PanePass::MapDraw& how) {
  panes->resize(camera.width, camera.height);
  panes->draw_maps(plan, drawn, how);
  panes->bind_maps(camera.position);
  glBindTextureUnit(kMaskUnit, targets.mask.name());
  glEnable(GL_SCISSOR_TEST);
  glScissor(part.x, part.y, part.width, part.height);
  fullscreen(panes->fbo(), panes->transmittance_program());
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::Impl::draw_transmittance(const PagePlan& plan, const glm::dvec3& origin_world,
                                        const Camera& camera) {
  panes->resize(camera.width, camera.height);
  panes->draw_pages(plan, pages, origin_world);
  pages.bind();
  panes->bind_pages(camera.position);
  glBindTextureUnit(kMaskUnit, targets.mask.name());
  fullscreen(panes->fbo(), panes->pages_program());
}

void Renderer::Impl::draw_listed_transmittance(const ShadowPlan& plan, const Camera& camera) {
  panes->resize(camera.width, camera.height);
  pixel_lists->bind(targets.mask.name());
  panes->draw_listed(plan, camera.position, *pixel_lists);
  fullscreen(panes->fbo(), panes->listed_program());
}

void Renderer::Impl::draw_aliasing() noexcept {
  glBindTextureUnit(kMaskUnit, targets.mask.name());
  fullscreen(targets.aliasing_fbo.name(), programs.aliasing);
}

void Renderer::Impl::draw_heat_map() noexcept {
  glBindTextureUnit(kMaskUnit, targets.mask.name());
  glBindTextureUnit(kExtraUnit, targets.aliasing.name());
  glEnable(GL_FRAMEBUFFER_SRGB);
  fullscreen(targets.heat_fbo.name(), programs.heat);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

void Renderer::Impl::draw_cascade_tint() noexcept {
  glBindTextureUnit(kMaskUnit, targets.mask.name());
  glBindTextureUnit(kExtraUnit, targets.color.name());
  glEnable(GL_FRAMEBUFFER_SRGB);
  fullscreen(targets.tint_fbo.name(), programs.tint);
  glDisable(GL_FRAMEBUFFER_SRGB);
}

}  // namespace gnomon::render
