// Casters per map: all that reach the receivers swept along the light, less those far below a texel.
#include "casters/caster_culling.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "gnomon/extend/shape.hpp"
#include "gnomon/motion.hpp"

namespace gnomon::render {
namespace {

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
    case OmissionKind::cascade_on_planes:
      return PruneRule::empty_cascades;
    case OmissionKind::cascade_without_gain:
      return PruneRule::equal_cascades;
    case OmissionKind::cascade_without_caster:
    case OmissionKind::plane_without_caster:
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
  const TexelGrid texels = map.texels();
  const ShapeRectangle covered = map.shape->texel_bounds(texels.parameters, texels.size(), {low, high});
  return TexelExtent{covered.high.x - covered.low.x, covered.high.y - covered.low.y};
}

std::array<PruneSaving, kPruneRuleCount> PruneSavings::net() const noexcept {
  std::array<PruneSaving, kPruneRuleCount> all = saved;
  for (std::size_t rule = 0; rule < all.size(); ++rule) {
    all[rule].instances -= std::min(all[rule].instances, spent[rule].instances);
    all[rule].triangles -= std::min(all[rule].triangles, spent[rule].triangles);
  }
  return all;
}

CasterCulling::CasterCulling(const SceneBuffers& scene)
    : scene_(scene),
      blocks_(CasterSet::block_count(scene.boxes().size())),
      indices_(CasterSet::index_count(scene.boxes().size())),
      listed_(scene.boxes().size()),
      draws_(scene.boxes().size()),
      diagonal_(scene.boxes().size()) {
  for (std::uint32_t i = 0; i < scene.boxes().size(); ++i) {
    if (!scene.casts(i)) continue;
    triangles_ += scene.triangles_of(i);
    ++count_;
  }
  rebuild();
}

void CasterCulling::rebuild() {
  boxes_.assign(scene_.boxes().begin(), scene_.boxes().end());
  for (std::uint32_t i = 0; i < boxes_.size(); ++i)
    if (!scene_.casts(i)) boxes_[i] = {};
  set_ = CasterSet(boxes_, blocks_, indices_);
  for (std::size_t i = 0; i < diagonal_.size(); ++i)
    diagonal_[i] = glm::length(scene_.boxes()[i].max - scene_.boxes()[i].min);
}

void CasterCulling::count_omissions(const ShadowPlan& plan, PruneSavings& saved) const noexcept {
  for (const Omission& omission : plan.omitted()) {
    const std::optional<PruneRule> rule = rule_of(omission.kind);
    if (!rule) continue;
    saved.of(*rule).texels += static_cast<std::uint64_t>(omission.saves_texels);
    if (*rule == PruneRule::metric_resolution) continue;
    ++saved.of(*rule).maps;
    saved.of(*rule).triangles += triangles_;
    saved.of(*rule).instances += count_;
  }
}

std::span<const std::uint32_t> CasterCulling::instances_within(std::span<const glm::dvec4> planes) {
  return std::span(listed_).first(std::min(set_.cull(planes, listed_), listed_.size()));
}

void CasterCulling::mark_swept(const CullingJob& job, const ShadowMap& map, PruneSavings& saved) {
  if (!job.prune.has(PruneRule::swept_casters)) {
    for (std::uint32_t i = 0; i < draws_.size(); ++i) draws_[i] = scene_.casts(i) ? 1 : 0;
    return;
  }
  std::fill(draws_.begin(), draws_.end(), std::uint8_t{0});
  std::array<glm::dvec4, kMaxCullPlanes> planes;
  const std::size_t plane_count = planes_of_what_is_read(job, map, planes);
  const std::span<const std::uint32_t> swept = instances_within(std::span(planes).first(plane_count));
  PruneSaving& saving = saved.of(PruneRule::swept_casters);
  saving.instances += count_ - swept.size();
  saving.triangles += triangles_;
  for (const std::uint32_t instance : swept) {
    draws_[instance] = 1;
    saving.triangles -= scene_.triangles_of(instance);
  }
}

void CasterCulling::drop_small(const CullingJob& job, const ShadowMap& map, PruneSavings& saved) {
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
    draws_[i] = 0;
    ++saved.of(PruneRule::small_casters).instances;
    saved.of(PruneRule::small_casters).triangles += scene_.triangles_of(i);
  }
}

std::span<const std::uint8_t> CasterCulling::casters_of(const CullingJob& job, const ShadowMap& map,
                                                        PruneSavings& saved) {
  mark_swept(job, map, saved);
  drop_small(job, map, saved);
  return draws_;
}

}  // namespace gnomon::render
