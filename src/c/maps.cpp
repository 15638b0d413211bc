// How does the record of a map become that of C, and back? Maps of the caller's own are checked on the way.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "c/convert.hpp"
#include "geometry/usable.hpp"

namespace gnomon::c {
namespace {

// Images and pools of an engine's own may be larger than any map that a plan makes.
constexpr std::int32_t kMaxForeignSize = 1 << 26;

// Matrices of plans in extreme units have larger entries than any input; products with points must stay
// finite.
constexpr double kLargestEntry = 1e100;

bool fits(double v) noexcept {
  return std::abs(v) <= kLargestEntry;
}
template <std::size_t N>
bool all_usable(const double (&values)[N]) noexcept {
  return std::all_of(std::begin(values), std::end(values), fits);
}
bool all_usable(const double (*planes)[4], std::int32_t count) noexcept {
  return std::all_of(planes, planes + count, [](const double(&plane)[4]) { return all_usable(plane); });
}

/// What would make a call on the map divide by zero, or read beyond an array.
const char* fault_of_map(const gnomon_map& m) noexcept {
  if (!all_usable(m.clip_from_world)) return "map.clip_from_world";
  for (const float v : m.clip_from_camera_relative) {
    if (!fits(static_cast<double>(v))) return "map.clip_from_camera_relative";
  }
  if (m.width < 1 || m.width > kMaxForeignSize) return "map.width";
  if (m.height < 1 || m.height > kMaxForeignSize) return "map.height";
  // Infinite depths are those of a map that serves all.
  if (std::isnan(m.depth_begin) || std::isnan(m.depth_end)) return "map.depth_begin, map.depth_end";
  if (!(m.overlap >= 0.0 && fits(m.overlap))) return "map.overlap";
  if (!all_usable(m.light_world)) return "map.light_world";
  if (m.shape < 0 || static_cast<std::size_t>(m.shape) >= all_shapes().size()) return "map.shape";
  if (m.warp != GNOMON_DEFAULT && (m.warp < 0 || static_cast<std::size_t>(m.warp) >= all_warps().size()))
    return "map.warp";
  if (!all_usable(m.shape_parameters)) return "map.shape_parameters";
  if (m.filter_margin_texels < 0 || m.filter_margin_texels > kMaxForeignSize)
    return "map.filter_margin_texels";
  if (m.cull_plane_count < 0 || m.cull_plane_count > GNOMON_MAX_CULL_PLANES) return "map.cull_plane_count";
  if (!all_usable(m.cull_planes, m.cull_plane_count)) return "map.cull_planes";
  if (m.select_plane_count < 0 || m.select_plane_count > GNOMON_MAX_SELECT_PLANES)
    return "map.select_plane_count";
  if (!all_usable(m.select_planes, m.select_plane_count)) return "map.select_planes";
  if (std::isnan(m.snap_texel[0]) || std::isnan(m.snap_texel[1])) return "map.snap_texel";
  return nullptr;
}

glm::dvec4 to_plane(const double* from) noexcept {
  return {from[0], from[1], from[2], from[3]};
}

void fill(const gnomon_map& m, ShadowMap& to) noexcept {
  to.clip_from_world = to_matrix(m.clip_from_world);
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) to.clip_from_camera_relative[c][r] = m.clip_from_camera_relative[4 * c + r];
  }
  to.depth_begin = m.depth_begin;
  to.depth_end = m.depth_end;
  to.overlap = m.overlap;
  to.light_world = to_plane(m.light_world);
  to.cascade = m.cascade;
  to.width = m.width;
  to.height = m.height;
  to.shape = all_shapes()[static_cast<std::size_t>(m.shape)];
  std::copy(std::begin(m.shape_parameters), std::end(m.shape_parameters), to.shape_parameters.begin());
  to.warp = m.warp != GNOMON_DEFAULT ? all_warps()[static_cast<std::size_t>(m.warp)] : &warps::none;
  to.kappa = m.kappa;
  to.texel_world = {m.texel_world[0], m.texel_world[1]};
  to.texel_world_max = {m.texel_world_max[0], m.texel_world_max[1]};
  to.depth_range_world = m.depth_range_world;
  to.filter_margin_texels = m.filter_margin_texels;
  to.bias_world = {m.bias_constant, m.bias_slope, m.bias_normal_offset};
  to.cull_plane_count = m.cull_plane_count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.cull_plane_count); ++i)
    to.cull_planes[i] = to_plane(m.cull_planes[i]);
  to.select_plane_count = m.select_plane_count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.select_plane_count); ++i)
    to.select_planes[i] = to_plane(m.select_planes[i]);
  to.snap_key = {
      m.snap_x,         m.snap_y, m.snap_depth_near, m.snap_depth_far, {m.snap_texel[0], m.snap_texel[1]},
      m.snap_valid != 0};
  to.m_s_max = m.m_s_max;
  to.m_t_max = m.m_t_max;
  to.m_max = m.m_max;
  to.storage = m.storage;
}

}  // namespace

const char* to_map(const gnomon_map* from, ShadowMap& to) noexcept {
  gnomon_map m;
  if (const char* fault = read(from, m)) return fault;
  if (const char* fault = fault_of_map(m)) return fault;
  fill(m, to);
  return nullptr;
}

void from_map(const ShadowMap& from, gnomon_map& to) noexcept {
  to.cascade = from.cascade;
  from_matrix(from.clip_from_world, to.clip_from_world);
  for (int c = 0; c < 4; ++c)
    from_vector(from.clip_from_camera_relative[c], to.clip_from_camera_relative + 4 * c);
  to.depth_begin = from.depth_begin;
  to.depth_end = from.depth_end;
  to.overlap = from.overlap;
  from_vector(from.light_world, to.light_world);
  to.width = from.width;
  to.height = from.height;
  const auto shape = std::find(all_shapes().begin(), all_shapes().end(), from.shape);
  to.shape = static_cast<std::int32_t>(shape - all_shapes().begin());
  const auto warp = std::find(all_warps().begin(), all_warps().end(), from.warp);
  to.warp =
      warp != all_warps().end() ? static_cast<std::int32_t>(warp - all_warps().begin()) : GNOMON_DEFAULT;
  std::copy(from.shape_parameters.begin(), from.shape_parameters.end(), to.shape_parameters);
  to.kappa = from.kappa;
  from_vector(from.texel_world, to.texel_world);
  from_vector(from.texel_world_max, to.texel_world_max);
  to.depth_range_world = from.depth_range_world;
  to.bias_constant = from.bias_world.constant;
  to.bias_slope = from.bias_world.slope;
  to.bias_normal_offset = from.bias_world.normal_offset;
  to.filter_margin_texels = from.filter_margin_texels;
  to.cull_plane_count = from.cull_plane_count;
  to.select_plane_count = from.select_plane_count;
  // The others are 0: what the core leaves there is no part of a plan.
  double *const cull = &to.cull_planes[0][0], *const select = &to.select_planes[0][0];
  std::fill(cull + 4 * from.cull_plane_count, cull + 4 * GNOMON_MAX_CULL_PLANES, 0.0);
  std::fill(select + 4 * from.select_plane_count, select + 4 * GNOMON_MAX_SELECT_PLANES, 0.0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(from.cull_plane_count); ++i)
    from_vector(from.cull_planes[i], to.cull_planes[i]);
  for (std::size_t i = 0; i < static_cast<std::size_t>(from.select_plane_count); ++i)
    from_vector(from.select_planes[i], to.select_planes[i]);
  to.snap_valid = from.snap_key.valid ? 1 : 0;
  to.snap_x = from.snap_key.x;
  to.snap_y = from.snap_key.y;
  to.snap_depth_near = from.snap_key.depth_near;
  to.snap_depth_far = from.snap_key.depth_far;
  to.snap_texel[0] = from.snap_key.texel.x;
  to.snap_texel[1] = from.snap_key.texel.y;
  to.m_s_max = from.m_s_max;
  to.m_t_max = from.m_t_max;
  to.m_max = from.m_max;
  to.storage = from.storage;
}

const char* to_plan(const gnomon_plan* from, ShadowPlan& to) noexcept {
  gnomon_plan p;
  if (const char* fault = read(from, p)) return fault;
  if (p.status < GNOMON_OK || p.status > GNOMON_INVALID_INPUT) return "plan.status";
  if (p.map_count < 0 || p.map_count > GNOMON_MAX_MAPS || p.map_count > p.map_room) return "plan.map_count";
  if (p.map_count > 0 && p.maps == nullptr) return "plan.maps";
  if (p.map_count > 0 && !known_size<gnomon_map>(p.map_size)) return "plan.map_size";
  if (p.selection < 0 || p.selection > static_cast<std::int32_t>(MapSelection::finest))
    return "plan.selection";
  to.status = static_cast<PlanStatus>(p.status);
  to.origin_world = to_vector(p.origin);
  to.light_direction = to_vector(p.light_direction);
  if (!usable(to.origin_world)) return "plan.origin";
  if (!usable(to.light_direction)) return "plan.light_direction";
  to.clip_space = to_clip_space(p.clip_space);
  to.bias = {p.bias_constant_texels, p.bias_slope_texels, p.bias_normal_offset_texels, p.bias_max_slope};
  to.selection = static_cast<MapSelection>(p.selection);
  to.sizes_vary = p.sizes_vary != 0;
  to.map_count = 0;
  to.omission_count = 0;
  for (std::int32_t i = 0; i < p.map_count; ++i) {
    gnomon_map map;
    set_defaults(map);
    read_bytes(reinterpret_cast<const char*>(p.maps) + std::size_t{p.map_size} * static_cast<std::size_t>(i),
               p.map_size, map);
    if (const char* fault = fault_of_map(map)) return fault;
    ShadowMap& record = to.map[static_cast<std::size_t>(i)];
    record = {};
    fill(map, record);
    to.map_count = i + 1;
  }
  return nullptr;
}

void from_omissions(std::span<const Omission> from, gnomon_omission* to, std::int32_t room) noexcept {
  if (to == nullptr || room <= 0) return;
  for (const Omission& o : from.first(std::min(from.size(), static_cast<std::size_t>(room))))
    *to++ = {static_cast<std::int32_t>(o.kind), o.map, o.a, o.b, o.saves_texels};
}

void from_stats(const AliasingStats& from, gnomon_stats& to) noexcept {
  to.p50 = from.p50;
  to.p95 = from.p95;
  to.max = from.max;
  to.mean = from.mean;
  to.share_undersampled = from.share_undersampled;
  to.storage = from.storage;
  to.samples = static_cast<std::int64_t>(from.samples);
  to.outside = static_cast<std::int64_t>(from.outside);
}

}  // namespace gnomon::c
