// Which casters does each map of a frame draw, and what was left out by which rule?
#include "caster_culling.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "frame_block.hpp"
#include "gnomon/reuse.hpp"

namespace gnomon::render {
namespace {

/// Texels of the map that the box's image covers at most; nothing where a corner is behind the map's centre
/// of projection.
struct TexelExtent {
  double x, y;
  [[nodiscard]] double area() const noexcept { return x * y; }
};
std::optional<TexelExtent> extent_in_map(const ShadowMap& map, const Box& box) noexcept {
  glm::dvec2 low(1e300), high(-1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4((corner & 1) != 0 ? box.max.x : box.min.x,
                                                             (corner & 2) != 0 ? box.max.y : box.min.y,
                                                             (corner & 4) != 0 ? box.max.z : box.min.z, 1.0);
    if (!(clip.w > 0.0)) return std::nullopt;
    low = glm::min(low, glm::dvec2(clip) / clip.w);
    high = glm::max(high, glm::dvec2(clip) / clip.w);
  }
  low = glm::clamp(low, -1.0, 1.0);
  high = glm::clamp(high, -1.0, 1.0);
  return TexelExtent{0.5 * map.width * (high.x - low.x), 0.5 * map.height * (high.y - low.y)};
}

/// What setting up a triangle costs, in texels filled: 0.25 us to 5 ns in software.
constexpr std::uint64_t kTexelsPerTriangle = 50;

std::uint64_t texels_of(const ShadowMap& map) noexcept {
  return static_cast<std::uint64_t>(map.width) * static_cast<std::uint64_t>(map.height);
}

/// Planes round all that the texels show which lookups of the map's receivers read, casters or not: a kernel
/// compares the receiver's plane, which goes on behind the receiver, and takes means of what lies there. So
/// of the planes that the plan culls by only those count that hold the light's rays. Answers how many.
std::size_t planes_of_what_is_read(const CullingJob& job, const ShadowMap& map,
                                   std::array<glm::dvec4, kMaxCullPlanes>& out) noexcept {
  const std::array<glm::dvec4, 5> whole =
      rectangle_planes(map, {0, 0, map.width, map.height}, job.plan.clip_space);
  std::size_t count = 0;
  // The planes of a light with a position are its map's sides; the margin moved all others off its rays. A
  // texel more, so that rounding decides about none.
  if (map.light_world.w != 0.0 || job.reads_everywhere) {
    const double texel = std::max(map.texel_world_max.x, map.texel_world_max.y);
    for (const glm::dvec4& plane : whole) out[count++] = plane + glm::dvec4(0.0, 0.0, 0.0, texel);
    return count;
  }
  // Of rounding; a plane too few only draws more.
  constexpr double kParallel = 1e-9;
  // The slope of a stored texel looks at the next one, and the receiver's place is off by the normal offset.
  constexpr double kNextTexel = 1.5;
  const double beyond = (kNextTexel + job.plan.bias.normal_offset_texels) *
                        std::max(map.texel_world_max.x, map.texel_world_max.y);
  for (const glm::dvec4& plane :
       std::span(map.cull_planes).first(static_cast<std::size_t>(map.cull_plane_count))) {
    if (std::abs(glm::dot(plane, map.light_world)) <= kParallel && count + 1 < out.size())
      out[count++] = plane + glm::dvec4(0.0, 0.0, 0.0, beyond);
  }
  out[count++] = whole.back();
  return count;
}

/// The rule that an omission of the plan stands for.
std::optional<PruneRule> rule_of(OmissionKind kind) noexcept {
  switch (kind) {
    case OmissionKind::cascade_without_receiver:
      return PruneRule::empty_cascades;
    case OmissionKind::cascade_without_caster:
      return PruneRule::casterless_cascades;
    case OmissionKind::face_without_receiver:
      return PruneRule::empty_faces;
    case OmissionKind::face_without_caster:
      return PruneRule::casterless_faces;
    case OmissionKind::resolution_without_gain:
      return PruneRule::metric_resolution;
    default:
      return std::nullopt;
  }
}

}  // namespace

DrawnMaps drawn_maps(const ShadowPlan& plan, const glm::dvec3& camera_world, double step) noexcept {
  DrawnMaps drawn;
  drawn.origin_world = glm::round(camera_world / step) * step;
  const glm::dmat4 drawn_from_plan = drawn_from_plan_clip(plan.clip_space);
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    const ShadowMap& map = plan.map[i];
    glm::dmat4 clip_from_position = map.clip_from_world;
    clip_from_position[3] = map.clip_from_world * glm::dvec4(drawn.origin_world, 1.0);
    drawn.map[i] = {glm::mat4(drawn_from_plan * clip_from_position), map.width, map.height};
  }
  return drawn;
}

CasterCulling::CasterCulling(const SceneBuffers& scene)
    : scene_(scene),
      blocks_(CasterSet::block_count(scene.boxes().size())),
      indices_(CasterSet::index_count(scene.boxes().size())),
      listed_(scene.boxes().size()),
      draws_(scene.boxes().size()),
      set_(scene.boxes(), blocks_, indices_) {
  diagonal_.reserve(scene.boxes().size());
  for (std::uint32_t i = 0; i < scene.boxes().size(); ++i) {
    diagonal_.push_back(glm::length(scene.boxes()[i].max - scene.boxes()[i].min));
    triangles_ += triangles_of(i);
  }
  for (Kept& kept : kept_) kept.holds.resize(scene.boxes().size());
  for (std::vector<std::uint8_t>& draws : strip_draws_) draws.resize(scene.boxes().size());
}

void CasterCulling::forget() noexcept {
  for (Kept& kept : kept_) kept.valid = false;
}

void CasterCulling::begin(const CullingJob& job) {
  saved_ = {};
  drawn_in_strips_ = {};
  for (const Omission& omission : job.plan.omitted()) {
    const std::optional<PruneRule> rule = rule_of(omission.kind);
    if (!rule) continue;
    saving(*rule).texels += static_cast<std::uint64_t>(omission.saves_texels);
    if (*rule == PruneRule::metric_resolution) continue;
    ++saving(*rule).maps;
    saving(*rule).triangles += triangles_;
    saving(*rule).instances += draws_.size();
  }
}

std::array<PruneSaving, kPruneRuleCount> CasterCulling::saved() const noexcept {
  std::array<PruneSaving, kPruneRuleCount> all = saved_;
  PruneSaving& scrolled = all[static_cast<std::size_t>(PruneRule::scrolled_maps)];
  scrolled.instances -= std::min(scrolled.instances, drawn_in_strips_.instances);
  scrolled.triangles -= std::min(scrolled.triangles, drawn_in_strips_.triangles);
  return all;
}

void CasterCulling::leave_out(PruneRule rule, std::uint32_t instance) noexcept {
  draws_[instance] = 0;
  ++saving(rule).instances;
  saving(rule).triangles += triangles_of(instance);
}

void CasterCulling::mark_swept(const CullingJob& job, const ShadowMap& map) {
  if (!job.prune.has(PruneRule::swept_casters)) {
    std::fill(draws_.begin(), draws_.end(), std::uint8_t{1});
    return;
  }
  std::fill(draws_.begin(), draws_.end(), std::uint8_t{0});
  std::array<glm::dvec4, kMaxCullPlanes> planes;
  const std::size_t plane_count = planes_of_what_is_read(job, map, planes);
  const std::size_t count =
      std::min(set_.cull(std::span(planes).first(plane_count), listed_), listed_.size());
  PruneSaving& saved = saving(PruneRule::swept_casters);
  saved.instances += draws_.size() - count;
  saved.triangles += triangles_;
  for (const std::uint32_t instance : std::span(listed_).first(count)) {
    draws_[instance] = 1;
    saved.triangles -= triangles_of(instance);
  }
}

void CasterCulling::drop_small(const CullingJob& job, const ShadowMap& map) {
  if (!job.prune.has(PruneRule::small_casters)) return;
  // Half a texel along either side: it covers the middle of one texel at most, and mostly of none.
  constexpr double kSide = 0.5;
  const double widest = kSide * std::max(map.texel_world_max.x, map.texel_world_max.y);
  double left = job.lost_shadow_share * static_cast<double>(texels_of(map));
  for (std::uint32_t i = 0; i < draws_.size() && left >= 1.0; ++i) {
    // The diagonal rules nearly all of them out before anything is projected.
    if (draws_[i] == 0 || diagonal_[i] > 2.0 * widest) continue;
    const std::optional<TexelExtent> extent = extent_in_map(map, scene_.boxes()[i]);
    if (!extent || extent->x > kSide || extent->y > kSide) continue;
    left -= 1.0;
    leave_out(PruneRule::small_casters, i);
  }
}

std::uint64_t CasterCulling::draw_what_is_missing(PruneRule rule, const ShadowMap& map, Kept& kept) {
  double texels = 0.0;
  for (std::uint32_t i = 0; i < draws_.size(); ++i) {
    if (draws_[i] == 0) continue;
    if (kept.holds[i] != 0) {
      leave_out(rule, i);
      continue;
    }
    kept.holds[i] = 1;
    const std::optional<TexelExtent> extent = extent_in_map(map, scene_.boxes()[i]);
    texels += extent ? extent->area() : static_cast<double>(texels_of(map));
  }
  return std::min(static_cast<std::uint64_t>(std::ceil(texels)), texels_of(map));
}

MapWork CasterCulling::draw_whole(const ShadowMap& map, Kept& kept) {
  kept.holds = draws_;
  kept.age = -1;
  MapWork work;
  work.add({{0, 0, map.width, map.height}, true, draws_});
  work.texels = texels_of(map);
  return work;
}

MapWork CasterCulling::hold(const ShadowMap& map, Kept& kept) {
  MapWork work;
  work.texels = draw_what_is_missing(PruneRule::held_maps, map, kept);
  PruneSaving& saved = saving(PruneRule::held_maps);
  saved.texels += texels_of(map) - work.texels;
  if (draws_any())
    work.add({{0, 0, map.width, map.height}, false, draws_});
  else
    ++saved.maps;
  return work;
}

MapWork CasterCulling::scroll(const CullingJob& job, const ShadowMap& map, const MapReuse& moved,
                              Kept& kept) {
  MapWork work;
  work.move = {moved.shift_x, moved.shift_y, moved.kept};
  PruneSaving drawn;
  std::uint64_t held_triangles = 0;
  for (std::uint32_t i = 0; i < draws_.size(); ++i) {
    if (job.reads_everywhere && draws_[i] == 0) kept.holds[i] = 0;
    if (draws_[i] != 0 && kept.holds[i] != 0) held_triangles += triangles_of(i);
  }
  for (std::size_t s = 0; s < static_cast<std::size_t>(moved.strip_count); ++s) {
    const TexelRect& strip = moved.strip[s];
    std::vector<std::uint8_t>& draws = strip_draws_[s];
    std::fill(draws.begin(), draws.end(), std::uint8_t{0});
    const std::size_t count =
        std::min(set_.cull(rectangle_planes(map, strip, kOpenGlZeroToOne), listed_), listed_.size());
    for (const std::uint32_t instance : std::span(listed_).first(count)) {
      if (draws_[instance] == 0) {
        kept.holds[instance] = 0;  // in the rest of the map, but not here
      } else if (kept.holds[instance] != 0) {
        draws[instance] = 1;
        ++drawn.instances;
        drawn.triangles += triangles_of(instance);
      }
    }
    work.add({strip, true, draws});
    work.texels += static_cast<std::uint64_t>(strip.width) * static_cast<std::uint64_t>(strip.height);
  }
  // Large casters are drawn into either strip: not worth it where that takes more than the texels give.
  const std::uint64_t spared = texels_of(map) - std::min(work.texels, texels_of(map));
  if (drawn.triangles > held_triangles + spared / kTexelsPerTriangle) return draw_whole(map, kept);
  work.texels =
      std::min(work.texels + draw_what_is_missing(PruneRule::scrolled_maps, map, kept), texels_of(map));
  if (draws_any()) work.add({{0, 0, map.width, map.height}, false, draws_});
  saving(PruneRule::scrolled_maps).texels += texels_of(map) - work.texels;
  drawn_in_strips_.instances += drawn.instances;
  drawn_in_strips_.triangles += drawn.triangles;
  return work;
}

bool CasterCulling::draws_any() const noexcept {
  return std::any_of(draws_.begin(), draws_.end(), [](std::uint8_t d) { return d != 0; });
}

MapWork CasterCulling::choose(const CullingJob& job, std::size_t index) {
  mark_swept(job, job.plan.map[index]);
  drop_small(job, job.plan.map[index]);
  Kept& kept = kept_[index];
  const DrawnMap& drawn = job.drawn.map[index];
  ShadowMap map = job.plan.map[index];
  map.clip_from_world = drawn_from_plan_clip(job.plan.clip_space) * map.clip_from_world;
  const bool usable = kept.valid && kept.origin_world == job.drawn.origin_world;
  const bool holds = usable && job.prune.has(PruneRule::held_maps) && kept.drawn == drawn &&
                     (!job.reads_everywhere || kept.holds == draws_);
  const MapReuse moved = usable && !holds && job.prune.has(PruneRule::scrolled_maps)
                             ? reuse(kept.map, map, kOpenGlZeroToOne)
                             : MapReuse{};
  MapWork work = holds                               ? hold(map, kept)
                 : moved.kind == ReuseKind::scrolled ? scroll(job, map, moved, kept)
                                                     : draw_whole(map, kept);
  kept.valid = true;
  kept.origin_world = job.drawn.origin_world;
  kept.drawn = drawn;
  kept.map = map;
  work.age = ++kept.age;
  return work;
}

}  // namespace gnomon::render
