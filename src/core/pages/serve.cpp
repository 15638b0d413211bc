// Which page serves a point, and how is a page drawn and culled?
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "pages/fill.hpp"

namespace gnomon {
namespace {

/// Inside the planes that part the maps of a cube.
bool in_part(const ShadowMap& map, const glm::dvec3& point) noexcept {
  for (int i = 0; i < map.select_plane_count; ++i) {
    const glm::dvec4& plane = map.select_planes[static_cast<std::size_t>(i)];
    if (!(glm::dot(glm::dvec3(plane), point) + plane.w >= 0.0)) return false;
  }
  return true;
}

/// Column or row of a clip coordinate; -1 beside the map. An edge of the map belongs to it.
std::int32_t cell(double clip, double w, int texels, int page) noexcept {
  constexpr double kRounding = 1e-9;
  const double at = (0.5 * clip / w + 0.5) * (texels / page);
  if (!(at >= -kRounding && at <= texels / page + kRounding)) return -1;
  return static_cast<std::int32_t>(clamp_to(std::floor(at), 0.0, texels / page - 1));
}

glm::dvec4 plane_of(const glm::dvec4& row) noexcept {
  const double length = glm::length(glm::dvec3(row));
  return length > 0.0 ? row / length : glm::dvec4(0.0);
}

}  // namespace

int page_at(const PagePlan& plan, std::uint32_t level, std::int32_t column, std::int32_t row) noexcept {
  return find_page(plan.table, plan.pages, level, column, row);
}

int page_serving(const PagePlan& plan, const glm::dvec3& point) noexcept {
  // Of a cube's faces, which share a little at their edges, the first that holds the point.
  int part = -1;
  for (const ShadowMap& level : plan.levels) {
    if ((part < 0 || level.cascade < part) && in_part(level, point)) part = level.cascade;
  }
  for (std::size_t i = plan.levels.size(); i-- > 0;) {
    const ShadowMap& level = plan.levels[i];
    if (level.cascade != part) continue;
    const glm::dvec4 clip = level.clip_from_world * glm::dvec4(point, 1.0);
    if (!(clip.w > 0.0)) continue;
    const std::int32_t column = cell(clip.x, clip.w, level.width, plan.page_texels);
    const std::int32_t row = cell(clip.y, clip.w, level.height, plan.page_texels);
    if (column < 0 || row < 0) continue;
    const int page = page_at(plan, static_cast<std::uint32_t>(i), column, row);
    if (page >= 0) return page;
  }
  return -1;
}

ShadowMap page_map(const PagePlan& plan, const Page& page) noexcept {
  const ShadowMap& level = plan.levels[page.level];
  ShadowMap map = level;
  const double texels = plan.page_texels, slot = plan.slot_texels();
  map.width = map.height = plan.slot_texels();
  map.filter_margin_texels = plan.border_texels;
  const glm::dvec2 size(level.width, level.height);
  const glm::dvec2 middle = (glm::dvec2(page.column, page.row) + 0.5) * texels / size * 2.0 - 1.0;
  const glm::dvec2 scale = size / slot;
  glm::dmat4& m = map.clip_from_world;
  for (int i = 0; i < 4; ++i) {
    m[i][0] = (m[i][0] - middle.x * m[i][3]) * scale.x;
    m[i][1] = (m[i][1] - middle.y * m[i][3]) * scale.y;
  }
  glm::dmat4 relative = m;
  relative[3] = m * glm::dvec4(plan.origin_world, 1.0);
  map.clip_from_camera_relative = glm::mat4(relative);
  const auto row = [&m](int r) { return glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]); };
  const glm::dvec4 x = row(0), y = row(1), z = row(2), w = row(3);
  const double lowest = plan.clip_space.ndc_depth == NdcDepth::zero_to_one ? 0.0 : -1.0;
  const glm::dvec4 far_plane = plan.clip_space.reversed_z ? z - w * lowest : w - z;
  map.cull_planes.fill(glm::dvec4(0.0));
  map.cull_plane_count = 0;
  for (const glm::dvec4& side : {w + x, w - x, w + y, w - y, far_plane})
    map.cull_planes[static_cast<std::size_t>(map.cull_plane_count++)] = plane_of(side);
  if (map.light_world.w != 0.0)
    map.cull_planes[static_cast<std::size_t>(map.cull_plane_count++)] = plane_of(w);
  return map;
}

}  // namespace gnomon
