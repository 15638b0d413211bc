// Three ways to bring a map up to date: draw it whole, add what it lacks, or scroll it and draw the strips.
#include "maps/map_cache.hpp"
#include "gnomon/extend/shape.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "casters/moving_casters.hpp"
#include "frame/frame_block.hpp"

namespace gnomon::render {
namespace {

/// Cost of setting up a triangle, in texels filled: 0.25 us to 5 ns in software.
constexpr std::uint64_t kTexelsPerTriangle = 50;

/// Where nothing static lies beneath, copies of it cost more than they save.
bool any_static(std::span<const std::uint8_t> moves, std::span<const std::uint8_t> casters) noexcept {
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (casters[i] != 0 && moves[i] == 0) return true;
  return false;
}

}  // namespace

ShadowMap drawn_form(const ShadowPlan& plan, std::size_t index) noexcept {
  ShadowMap map = plan.map[index];
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  map.clip_from_world = drawn_from_plan * map.clip_from_world;
  map.shape_parameters = parameters_in(drawn_from_plan, *map.shape, map.shape_parameters);
  return map;
}

MapCache::MapCache(const SceneBuffers& scene, CasterCulling& culling)
    : scene_(scene), culling_(culling), draws_(scene.boxes().size()) {
  for (std::array<Cached, kMaxMaps>* maps : {&cached_, &beneath_})
    for (Cached& cached : *maps) cached.holds.resize(scene.boxes().size());
  for (std::vector<std::uint8_t>& draws : part_draws_) draws.resize(scene.boxes().size());
}

void MapCache::forget(std::size_t first) noexcept {
  for (std::size_t i = first; i < cached_.size(); ++i) cached_[i].valid = beneath_[i].valid = false;
}

bool MapCache::draws_any() const noexcept {
  return std::any_of(draws_.begin(), draws_.end(), [](std::uint8_t d) { return d != 0; });
}

std::uint64_t MapCache::skip_held(const ShadowMap& map, Cached& cached, PruneSaving& saved) {
  double texels = 0.0;
  for (std::uint32_t i = 0; i < draws_.size(); ++i) {
    if (draws_[i] == 0) continue;
    if (cached.holds[i] != 0) {
      draws_[i] = 0;
      ++saved.instances;
      saved.triangles += scene_.triangles_of(i);
      continue;
    }
    cached.holds[i] = 1;
    texels += texels_shown(map, i);
  }
  return std::min(static_cast<std::uint64_t>(std::ceil(texels)), texels_of(map));
}

MapWork MapCache::draw_whole(const ShadowMap& map, Cached& cached) {
  cached.holds = draws_;
  cached.age = -1;
  MapWork work;
  work.add({{0, 0, map.width, map.height}, true, draws_});
  work.texels = texels_of(map);
  return work;
}

MapWork MapCache::hold(const ShadowMap& map, Cached& cached, PruneSavings& saved) {
  MapWork work;
  PruneSaving& saving = saved.of(PruneRule::held_maps);
  work.texels = skip_held(map, cached, saving);
  saving.texels += texels_of(map) - work.texels;
  if (draws_any())
    work.add({{0, 0, map.width, map.height}, false, draws_});
  else
    ++saving.maps;
  return work;
}

void MapCache::fill(const ShadowMap& map, const TexelRect& rectangle, Cached& cached,
                    std::vector<std::uint8_t>& draws, PruneSaving& drawn) {
  std::fill(draws.begin(), draws.end(), std::uint8_t{0});
  for (const std::uint32_t instance :
       culling_.instances_within(rectangle_planes(map, rectangle, kOpenGlZeroToOne))) {
    if (draws_[instance] == 0) {
      cached.holds[instance] = 0;  // in the rest of the map, but not here
    } else if (cached.holds[instance] != 0) {
      draws[instance] = 1;
      ++drawn.instances;
      drawn.triangles += scene_.triangles_of(instance);
    }
  }
}

MapWork MapCache::draw_parts(const ShadowMap& map, const Parts& parts, Cached& cached, PruneSavings& saved) {
  MapWork work;
  work.move = parts.move;
  PruneSaving drawn;
  for (std::size_t i = 0; i < parts.rectangles.size(); ++i) {
    const TexelRect& rectangle = parts.rectangles[i];
    fill(map, rectangle, cached, part_draws_[i], drawn);
    work.add({rectangle, true, part_draws_[i]});
    work.texels += static_cast<std::uint64_t>(rectangle.width) * static_cast<std::uint64_t>(rectangle.height);
  }
  // Large casters are drawn into every rectangle: not worth it where that takes more than the texels give.
  const std::uint64_t spared = texels_of(map) - std::min(work.texels, texels_of(map));
  if (drawn.triangles > parts.whole_triangles + spared / kTexelsPerTriangle) return draw_whole(map, cached);
  PruneSaving& saving = saved.of(parts.rule);
  work.texels = std::min(work.texels + skip_held(map, cached, saving), texels_of(map));
  if (draws_any()) work.add({{0, 0, map.width, map.height}, false, draws_});
  saving.texels += texels_of(map) - work.texels;
  saved.spent_by(parts.rule).instances += drawn.instances;
  saved.spent_by(parts.rule).triangles += drawn.triangles;
  return work;
}

MapWork MapCache::redraw(const ShadowMap& map, const DirtyTexels& dirty, Cached& cached,
                         PruneSavings& saved) {
  std::uint64_t all_triangles = 0;
  for (std::uint32_t i = 0; i < draws_.size(); ++i)
    all_triangles += draws_[i] != 0 ? scene_.triangles_of(i) : 0;
  return draw_parts(map, {dirty.rectangles(), {}, PruneRule::held_maps, all_triangles}, cached, saved);
}

MapWork MapCache::scroll(const CullingJob& job, const ShadowMap& map, const MapReuse& moved, Cached& cached,
                         PruneSavings& saved) {
  std::uint64_t held_triangles = 0;
  for (std::uint32_t i = 0; i < draws_.size(); ++i) {
    if (job.reads_everywhere && draws_[i] == 0) cached.holds[i] = 0;
    if (draws_[i] != 0 && cached.holds[i] != 0) held_triangles += scene_.triangles_of(i);
  }
  const std::span<const TexelRect> strips{moved.strip.data(), static_cast<std::size_t>(moved.strip_count)};
  return draw_parts(
      map, {strips, {moved.shift_x, moved.shift_y, moved.kept}, PruneRule::scrolled_maps, held_triangles},
      cached, saved);
}

MapWork MapCache::bring_up(const CachedDraw& draw, std::span<const Box> moved_world, Cached& cached,
                           PruneSavings& saved) {
  const CullingJob& job = draw.job;
  const DrawnMap& drawn = draw.drawn.map[draw.index];
  const ShadowMap map = drawn_form(job.plan, draw.index);
  const bool usable = cached.valid && cached.origin_world == draw.drawn.origin_world;
  const bool same = usable && job.prune.has(PruneRule::held_maps) && cached.drawn == drawn &&
                    (!(job.reads_everywhere || job.redraws_whole) || cached.holds == draws_);
  const DirtyTexels dirty = usable ? dirty_bounds(map, moved_world) : DirtyTexels{};
  const bool holds = same && !dirty.whole && !(job.redraws_whole && dirty.any());
  const bool scrolls = usable && !same && !job.redraws_whole && job.prune.has(PruneRule::scrolled_maps) &&
                       !dirty.any() && !dirty_bounds(cached.map, moved_world).any();
  const MapReuse moved = scrolls ? reuse(cached.map, map, kOpenGlZeroToOne) : MapReuse{};
  MapWork work = holds && dirty.any()                ? redraw(map, dirty, cached, saved)
                 : holds                             ? hold(map, cached, saved)
                 : moved.kind == ReuseKind::scrolled ? scroll(job, map, moved, cached, saved)
                                                     : draw_whole(map, cached);
  cached.valid = true;
  cached.origin_world = draw.drawn.origin_world;
  cached.drawn = drawn;
  cached.map = map;
  work.age = ++cached.age;
  return work;
}

std::span<const Box> MapCache::adoption_bounds(const CullingJob& job) {
  adopted_.assign(job.moved_world.begin(), job.moved_world.end());
  for (std::size_t i = 0; i < job.moves.size(); ++i)
    if (job.moves[i] != 0) adopted_.push_back(scene_.boxes()[i]);
  return adopted_;
}

double MapCache::texels_shown(const ShadowMap& map, std::uint32_t instance) const noexcept {
  const std::optional<TexelExtent> extent = extent_in_map(map, scene_.boxes()[instance]);
  return extent ? extent->area() : static_cast<double>(texels_of(map));
}

double MapCache::draw_over(const CachedDraw& draw, const ShadowMap& map, Cached& cached,
                           PruneSavings& saved) {
  double texels = 0.0;
  for (const TexelRect& copied : copied_) texels += 1.0 * copied.width * copied.height;
  for (std::uint32_t i = 0; i < over_.size(); ++i) {
    if (draw.job.moves[i] == 0) continue;
    // In the rest of the map, but not where it is copied.
    const bool erased = may_touch(map, scene_.boxes()[i], copied_);
    if (erased) cached.holds[i] = 0;
    if (draw.casters[i] == 0) continue;
    if (cached.holds[i] != 0) {
      ++saved.of(PruneRule::held_maps).instances;
      saved.of(PruneRule::held_maps).triangles += scene_.triangles_of(i);
      continue;
    }
    over_[i] = cached.holds[i] = 1;
    if (!erased) texels += texels_shown(map, i);
  }
  count_static(draw, map, saved);
  return texels;
}

void MapCache::count_static(const CachedDraw& draw, const ShadowMap& map, PruneSavings& saved) {
  const DirtyTexels redrawn = dirty_bounds(map, draw.job.moved_world);
  for (const TexelRect& rectangle : redrawn.rectangles()) {
    for (const std::uint32_t i :
         culling_.instances_within(rectangle_planes(map, rectangle, kOpenGlZeroToOne))) {
      if (draw.job.moves[i] != 0 || draw.casters[i] == 0 || over_[i] != 0) continue;
      for (PruneSaving* of : {&saved.of(PruneRule::static_casters), &saved.spent_by(PruneRule::held_maps)}) {
        ++of->instances;
        of->triangles += scene_.triangles_of(i);
      }
    }
  }
}

LayeredWork MapCache::compose(const CachedDraw& draw, PruneSavings& saved) {
  const CullingJob& job = draw.job;
  Cached &cached = cached_[draw.index], &beneath = beneath_[draw.index];
  const ShadowMap map = drawn_form(job.plan, draw.index);
  LayeredWork work;
  work.has_beneath = true;
  work.adopts = !beneath.valid && cached.valid;
  if (work.adopts) beneath = cached;
  draws_.assign(draw.casters.begin(), draw.casters.end());
  for (std::size_t i = 0; i < draws_.size(); ++i) {
    if (job.moves[i] != 0) draws_[i] = beneath.holds[i] = 0;
  }
  work.beneath = bring_up(draw, work.adopts ? adoption_bounds(job) : job.static_moved_world, beneath, saved);
  const bool drawn_whole = work.beneath.age == 0;
  work.adopts = work.adopts && !drawn_whole;
  const bool same =
      cached.valid && cached.origin_world == beneath.origin_world && cached.drawn == beneath.drawn &&
      !drawn_whole && !work.beneath.move.any() &&
      (!job.reads_everywhere || std::equal(cached.holds.begin(), cached.holds.end(), draw.casters.begin()));
  DirtyShapes& dirty = dirty_[draw.index];
  if (!same) dirty.forget();
  const bool whole = !same || !dirty.find(map, job.movers->named_world(), job.movers->moved());
  // Static casters that came into reach are drawn into both maps.
  over_.assign(draws_.size(), 0);
  const std::span<const MapPart> parts = work.beneath.parts();
  if (!whole && !parts.empty() && !parts.back().clear)
    std::copy(parts.back().draws.begin(), parts.back().draws.end(), over_.begin());
  for (std::size_t i = 0; i < over_.size(); ++i) {
    if (whole || job.moves[i] == 0) cached.holds[i] = beneath.holds[i];
  }
  double texels = 0.0;
  if (!whole) {
    copied_.assign(dirty.rectangles().begin(), dirty.rectangles().end());
    texels = draw_over(draw, map, cached, saved);
  } else {
    copied_.assign(1, {0, 0, map.width, map.height});
    for (std::uint32_t i = 0; i < over_.size(); ++i) {
      if (job.moves[i] == 0 || draw.casters[i] == 0) continue;
      over_[i] = cached.holds[i] = 1;
      texels += texels_shown(map, i);
    }
  }
  cached.valid = true;
  cached.origin_world = beneath.origin_world;
  cached.drawn = beneath.drawn;
  cached.map = beneath.map;
  cached.age = beneath.age;
  finish(work, texels, map, saved);
  return work;
}

void MapCache::finish(LayeredWork& work, double texels, const ShadowMap& map, PruneSavings& saved) {
  const bool draws = std::any_of(over_.begin(), over_.end(), [](std::uint8_t d) { return d != 0; });
  work.map.copies = copied_;
  if (draws) work.map.add({{0, 0, map.width, map.height}, false, over_});
  work.map.age = work.beneath.age;
  texels += static_cast<double>(work.beneath.texels);
  work.map.texels = std::min(static_cast<std::uint64_t>(std::ceil(texels)), texels_of(map));
  PruneSaving& saving = saved.of(work.beneath.move.any() ? PruneRule::scrolled_maps : PruneRule::held_maps);
  saving.texels -= std::min(saving.texels, work.map.texels - std::min(work.map.texels, work.beneath.texels));
  const bool was_counted = work.beneath.part_count == 0 && !work.beneath.move.any();
  if (was_counted && work.map.any()) saving.maps -= std::min<std::uint64_t>(saving.maps, 1);
}

LayeredWork MapCache::update(const CachedDraw& draw, PruneSavings& saved) {
  const CullingJob& job = draw.job;
  if (any_static(job.moves, draw.casters)) return compose(draw, saved);
  beneath_[draw.index].valid = false;
  dirty_[draw.index].forget();
  draws_.assign(draw.casters.begin(), draw.casters.end());
  LayeredWork work;
  work.map = bring_up(draw, job.moved_world, cached_[draw.index], saved);
  return work;
}

}  // namespace gnomon::render
