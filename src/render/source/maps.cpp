// Maps of depths, or of who is nearest to the light: a pixel is lit where its filter finds it so, or where
// map and pixel name the same.
#include "source/maps.hpp"

#include <algorithm>

#include "gnomon/extend/shape.hpp"
#include "gnomon/render/error.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {
namespace {

constexpr FrameOptionSet kOfMaps = FrameOptionSet::all().without({FrameOption::light_clusters});

/// Averages over a pixel's footprint, pyramids of depths, and options found from all of a map's depths know
/// no margin.
bool reads_everywhere(const FilterSettings& settings, const ShadowPlan& plan) noexcept {
  const Filter& filter = *settings.filter;
  return wants_mipmaps(settings, plan) ||
         (filter.hooks.needs_depth_max != nullptr && filter.hooks.needs_depth_max(settings)) ||
         (filter.hooks.adapts != nullptr && filter.hooks.adapts(settings));
}

}  // namespace

const SourceSupport MapSource::kSupport{"maps", "depth maps of a `ShadowPlan`, read by a filter", kOfMaps};
const SourceSupport MapSource::kBentSupport{
    "bent maps", "the same where the shape of a map bends lines",
    kOfMaps.without({FrameOption::depth_layer, FrameOption::map_passes, FrameOption::panes})};
const SourceSupport MapSource::kIdentifierSupport{
    "identifiers", "who is nearest to the light, in maps of a `ShadowPlan`",
    kOfMaps.without({FrameOption::accumulation, FrameOption::depth_layer, FrameOption::linear_depth,
                     FrameOption::map_passes, FrameOption::receiver_plane, FrameOption::small_casters,
                     FrameOption::scrolled_maps, FrameOption::static_casters, FrameOption::unread_tiles,
                     FrameOption::contacts, FrameOption::bent_maps})};

MapSource::MapSource(CasterScene& casters, CasterPass& pass, MapTargets& maps, Screen& screen)
    : casters_(casters), pass_(pass), maps_(maps), screen_(screen), map_pass_(casters, pass, maps) {}

void MapSource::prepare(const FilterSettings& settings) {
  if (settings.filter->info.draws_silhouettes && !silhouettes_) silhouettes_.emplace(casters_.buffers);
}

void MapSource::prepare_identifiers() {
  if (!identifiers_) identifiers_.emplace(casters_.buffers);
}

bool MapSource::numbers(const FrameJob& frame) const noexcept {
  return frame.filter.source.kind == SourceKind::identifiers && identifiers_ && !bends_lines(frame.plan);
}

FrameOptionSet MapSource::supports(const FrameJob& frame) const noexcept {
  if (numbers(frame)) return kIdentifierSupport.supports;
  return (bends_lines(frame.plan) ? kBentSupport : kSupport).supports;
}

SourceSteps MapSource::steps(const FrameJob& frame) const noexcept {
  return {.takes_depths = frame.plan.map_count > 0, .stores_texels = !numbers(frame)};
}

void MapSource::lose() noexcept {
  casters_.lists.forget_maps();
  map_count_ = 0;
}

void MapSource::fit(const ShadowPlan& plan) {
  int width = 1, height = 1;
  bool alike = !plan.sizes_vary;
  map_count_ = plan.map_count;
  if (map_count_ == 0) return;  // what the maps hold stays for the next frame
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    map_size_[i] = glm::ivec2(plan.map[i].width, plan.map[i].height);
    alike = alike && map_size_[i] == map_size_[0] && map_size_[i].x == map_size_[i].y;
    width = std::max(width, plan.map[i].width);
    height = std::max(height, plan.map[i].height);
  }
  // Sizes that follow the view differ by little from frame to frame: new images for all of that would cost
  // more than the texels.
  constexpr int kLayerStep = 256;
  const auto layer = [alike](int side) {
    return alike ? side : (side + kLayerStep - 1) / kLayerStep * kLayerStep;
  };
  if (maps_.fit(layer(width), layer(height), plan.map_count)) casters_.lists.forget_maps();
}

void MapSource::fit_beside(FrameJob& frame) {
  const bool numbered = numbers(frame);
  const std::optional<IdentifierOf> of = numbered ? std::optional(frame.filter.source.test.of) : std::nullopt;
  bool lost = of && of != numbered_;
  numbered_ = of;
  if (numbered) {
    screen_.targets.add_identifiers();
    lost = identifiers_->fit(maps_) || lost;
    identifiers_->use(*of);
    has_silhouettes_ = false;
  } else {
    const bool wanted = frame.filter.settings.filter->info.draws_silhouettes && silhouettes_;
    lost = (wanted && silhouettes_->fit(maps_)) || (wanted && !has_silhouettes_) || lost;
    has_silhouettes_ = wanted;
  }
  if (lost) casters_.lists.forget_maps();
}

void MapSource::begin(FrameJob& frame) {
  const ShadowPlan& plan = frame.plan;
  const bool numbered = numbers(frame);
  const DepthKind kind = numbered ? DepthKind{} : depth_kind(frame.options, frame.options.linear_depth);
  // So many boxes cost more than the texels that they would spare.
  constexpr std::size_t kMaxMoved = 4096;
  if (kind != kind_ || casters_.movers.changed_world().size() > kMaxMoved) casters_.lists.forget_maps();
  kind_ = kind;
  fit(plan);
  fit_beside(frame);
  const auto planned = plan.maps();
  frame.shaped = !numbered && std::any_of(planned.begin(), planned.end(),
                                          [](const ShadowMap& map) { return map.shape != &shapes::linear; });
  if (frame.shaped) {
    try {
      make_shaped_programs(frame.filter.settings, frame.programs);
    } catch (const RenderError&) {
      // A lost context compiles nothing; who drew the frame finds out from the context.
    }
  }
  const FilterSettings settings = numbered ? default_settings(filters::hard) : frame.filter.settings;
  const BlurSides blur = numbered ? BlurSides{} : blur_sides(settings, plan);
  const DepthCurves curves = depth_curves(plan, kind.linear);
  frame.filtering = filter_block(settings, blur);
  if (!numbered) {
    set_depth_curves(curves, frame.filtering);
    frame.filtering.sums.w = frame.options.receiver_plane ? 0.0f : 1.0f;
    fit_options(settings, plan, frame.filtering);
  }
  frame.block = frame_block(plan, frame.camera, frame.options, maps_.width, maps_.height, blur, curves);
}

void MapSource::update(FrameJob& frame) {
  const ShadowPlan& plan = frame.plan;
  const FrameOptions& options = frame.options;
  MovingCasters& movers = casters_.movers;
  drawn_ = casters_.place(plan, frame.camera.position);
  CullingJob job{plan, options.prune};
  job.moved_world = movers.changed_world();
  job.static_moved_world = movers.static_changed_world();
  LayeredRule rule;
  if (numbered_) {
    // A receiver that is not drawn leaves its texels to what lies behind it. Parts of large casters come in
    // an order of their own, and triangles are numbered by the scene's.
    job.prune = options.prune.without(PruneRule::small_casters);
    if (numbered_ == IdentifierOf::triangle) job.prune = job.prune.without(PruneRule::caster_clusters);
    job.reads_everywhere = job.redraws_whole = true;
  } else {
    for (std::size_t i = 0; i < plan.maps().size(); ++i)
      drawn_.map[i].even_scale = std::max(-frame.block.maps[i].kernel.w, 0.0f);
    const bool peels = info_of(options.depth_layer).peels;
    job.lost_shadow_share = options.lost_shadow_share;
    job.reads_everywhere = reads_everywhere(frame.filter.settings, plan);
    job.redraws_whole = peels || has_silhouettes_;
    if (composes(options) && !has_silhouettes_ && movers.any()) job.moves = movers.moves();
    job.movers = &movers;
    rule = map_pass_.layered_rule(options);
  }
  casters_.lists.build(job, drawn_, frame.camera, rule);
  if (plan.map_count > 0) movers.finish_frame();
  if (numbered_) {
    draw_identified(frame);
    return;
  }
  map_pass_.draw(plan, drawn_, depth_draw(options));
  if (has_silhouettes_) silhouettes_->draw(casters_.buffers, casters_.lists, maps_, drawn_, map_count_);
}

void MapSource::draw_identified(const FrameJob& frame) noexcept {
  constexpr GLint kClipLocation = 3;  // as shaders/pass/depth/depth.vert states it
  pass_.begin();
  for (int i = 0; i < map_count_; ++i) {
    const DrawLists& lists = casters_.lists;
    if (lists.parts(i).empty()) continue;
    const DrawnMap& map = drawn_.map[static_cast<std::size_t>(i)];
    identifiers_->attach(maps_, i);
    glViewport(0, 0, map.width, map.height);
    // A map that changes is drawn whole, in one part.
    for (const DrawnPart& part : lists.parts(i)) {
      glDisable(GL_SCISSOR_TEST);
      if (part.clear) identifiers_->clear();
      pass_.draw_by(part, CasterPrograms{identifiers_->opaque(), identifiers_->masked()},
                    frame.options.prune.has(PruneRule::alpha_test),
                    [&] { glUniformMatrix4fv(kClipLocation, 1, GL_FALSE, &map.clip_from_position[0][0]); });
    }
  }
}

SurfacePass MapSource::surfaces() const noexcept {
  if (!numbered_) return screen_.surfaces();
  return {screen_.targets.identified_fbo.name(), &identifiers_->surfaces(), static_cast<int>(*numbered_)};
}

void MapSource::adapt(FrameJob& frame) {
  const FilterSettings& settings = frame.filter.settings;
  adapted_.maps_read_back = 0;
  for (int i = 0; i < map_count_; ++i)
    if (!casters_.lists.map_stats(i).held) adapted_.map[static_cast<std::size_t>(i)].valid = false;
  if (settings.filter->hooks.adapts == nullptr || !settings.filter->hooks.adapts(settings)) return;
  std::vector<float> depths;
  for (int i = 0; i < map_count_; ++i) {
    const auto at = static_cast<std::size_t>(i);
    Adapted::Map& chosen = adapted_.map[at];
    if (!chosen.valid || chosen.told.filter != settings.filter || chosen.told.option != settings.option) {
      depths.resize(static_cast<std::size_t>(map_size_[at].x) * static_cast<std::size_t>(map_size_[at].y));
      read_depths(i, depths);
      ++adapted_.maps_read_back;
      // As the layers will store them.
      const double curve = frame.filtering.depth_curve[at].x;
      if (curve > 0.0)
        for (float& depth : depths) depth = static_cast<float>(linear_depth(depth, curve));
      chosen = {true, settings, settings};
      settings.filter->hooks.adapt(chosen.own, depths);
    }
    set_options(chosen.own, at, frame.filtering);
  }
  screen_.upload(frame.filtering);
}

bool MapSource::pays_to_mark(const FrameJob& frame) const noexcept {
  if (!frame.options.prune.has(PruneRule::unread_tiles) || !frame.programs.mark) return false;
  std::uint64_t texels = 0, pixels = static_cast<std::uint64_t>(screen_.targets.width) *
                                     static_cast<std::uint64_t>(screen_.targets.height);
  for (int i = 0; i < map_count_; ++i) {
    if (casters_.lists.map_stats(i).held) continue;
    const glm::ivec2 size = map_size_[static_cast<std::size_t>(i)];
    texels += static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y);
  }
  // A marked pixel costs about as much as two filtered vectors of four channels.
  constexpr std::uint64_t kVectorsPerPixel = 2;
  return texels * static_cast<std::uint64_t>(frame.programs.variant.vectors) >= kVectorsPerPixel * pixels;
}

void MapSource::store(FrameJob& frame) {
  adapt(frame);
  const FilterSettings& settings = frame.filter.settings;
  StoreJob job;
  job.depth = maps_.depth.name();
  job.layer_width = maps_.width;
  job.layer_height = maps_.height;
  job.map_size = {map_size_.data(), static_cast<std::size_t>(map_count_)};
  job.mipmaps = wants_mipmaps(settings, frame.plan);
  job.shaped = frame.shaped;
  for (int i = 0; i < map_count_; ++i)
    job.held[static_cast<std::size_t>(i)] = casters_.lists.map_stats(i).held;
  if (pays_to_mark(frame)) {
    job.mark_read = [this, &frame] {
      screen_.fullscreen(screen_.targets.mask_fbo.name(), frame.programs.mark_for(frame.shaped));
    };
  }
  stored_.build(frame.programs, settings, frame.filtering, job);
}

void MapSource::mask(FrameJob& frame, GLuint fbo) {
  maps_.bind();
  if (numbered_) {
    identifiers_->bind(screen_.targets.identifier.name(), frame.filter.source.test.neighbours);
    screen_.fullscreen(fbo, identifiers_->mask());
    return;
  }
  stored_.bind();
  if (has_silhouettes_) silhouettes_->bind();
  draw_mask(screen_, frame.programs.mask_for(frame.shaped), fbo);
}

void MapSource::tint(FrameJob& frame) {
  const Camera& camera = frame.camera;
  tint_from_maps(screen_, *frame.panes, frame.plan, drawn_, camera, {0, 0, camera.width, camera.height},
                 {.keep = frame.options.prune.has(PruneRule::held_maps)});
  frame.stats.pane_texels = frame.panes->texels();
}

void MapSource::count(FrameJob& frame) {
  FrameStats& stats = frame.stats;
  const DrawLists& lists = casters_.lists;
  stats.map_count = map_count_;
  for (int i = 0; i < map_count_; ++i) {
    stats.map[static_cast<std::size_t>(i)] = work_of_map(lists, i, kind_.layer);
    stats.texels += lists.map_stats(i).texels;
  }
  count_lists(lists, stats);
  stats.layered_maps = static_cast<int>(lists.layered_maps().size());
  stats.layered_draws = lists.layered_draws();
  stats.map_bytes = maps_.bytes() + (frame.panes != nullptr ? frame.panes->bytes() : 0);
  stats.identified = numbered_.has_value();
  if (numbered_) {
    stats.map_bytes += identifiers_->bytes();
    return;
  }
  if (frame.options.time_passes) {
    stats.filtered_texels = stored_.take_filtered_texels();
    const std::uint64_t whole = stored_.whole_texels();
    stats.saved[static_cast<std::size_t>(PruneRule::unread_tiles)].filtered =
        whole - std::min(stats.filtered_texels, whole);
  }
  stats.prefilter_passes = stored_.passes();
  stats.maps_read_back = adapted_.maps_read_back;
  stats.map_bytes += stored_.bytes();
  stats.scratch_bytes = stored_.scratch_bytes() + pass_.scratch_bytes();
  if (!has_silhouettes_) return;
  stats.map_bytes += silhouettes_->bytes();
  stats.scratch_bytes += silhouettes_->scratch_bytes();
}

void MapSource::read_depths(int map, std::span<float> depths) const noexcept {
  const glm::ivec2 size = map_size_[static_cast<std::size_t>(map)];
  glGetTextureSubImage(maps_.depth.name(), 0, 0, 0, map, size.x, size.y, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                       static_cast<GLsizei>(depths.size_bytes()), depths.data());
}

}  // namespace gnomon::render
