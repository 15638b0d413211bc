// Which page serves a point, and how is a page drawn and culled?
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "gnomon/motion.hpp"
#include "pages/fill.hpp"
#include "plan/select.hpp"

namespace gnomon {
namespace {

/// Column or row of a clip coordinate; -1 beside the map. An edge of the map belongs to it.
std::int32_t cell(double clip, double w, int texels, int page) noexcept {
  constexpr double kRounding = 1e-9;
  const double at = (0.5 * clip / w + 0.5) * (texels / page);
  if (!(at >= -kRounding && at <= texels / page + kRounding)) return -1;
  return static_cast<std::int32_t>(clamp_to(std::floor(at), 0.0, texels / page - 1));
}

/// Of the last level of a part that has one.
int page_of_part(const PagePlan& plan, const glm::dvec3& point, int part) noexcept {
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

}  // namespace

int page_at(const PagePlan& plan, std::uint32_t level, std::int32_t column, std::int32_t row) noexcept {
  return find_page(plan.table, plan.pages, level, column, row);
}

int page_serving(const PagePlan& plan, const glm::dvec3& point) noexcept {
  // A cube's faces share a little at their edges, where the map of one may end at what it serves: the first
  // with a page there.
  for (int tried = -1;;) {
    int part = -1;
    for (const ShadowMap& level : plan.levels) {
      if (level.cascade > tried && (part < 0 || level.cascade < part) &&
          inside_select_planes(level, point, plan.origin_world))
        part = level.cascade;
    }
    if (part < 0) return -1;
    const int page = page_of_part(plan, point, part);
    if (page >= 0) return page;
    tried = part;
  }
}

ShadowMap page_map(const PagePlan& plan, const Page& page) noexcept {
  const ShadowMap& level = plan.levels[page.level];
  ShadowMap map = level;
  const double texels = plan.page_texels;
  const int slot = plan.slot_texels();
  map.width = map.height = slot;
  map.filter_margin_texels = plan.border_texels;
  glm::dmat4& m = map.clip_from_world;
  if (level.snap_key.valid) {
    // From the place alone, not from the level's extent, which follows the view.
    const PagePlaces& at = plan.places[static_cast<std::size_t>(level.cascade)];
    const glm::dvec2 side = level.snap_key.texel * texels;
    const double scale = 2.0 * texels / slot;
    const auto middle = [&](std::int64_t first, std::int32_t cell) {
      return static_cast<double>(first / plan.page_texels + cell) + 0.5;
    };
    const double column = middle(level.snap_key.x, page.column), row = middle(level.snap_key.y, page.row);
    for (int i = 0; i < 4; ++i) {
      m[i][0] = (at.x[i] / side.x - at.w[i] * column) * scale;
      m[i][1] = (at.y[i] / side.y - at.w[i] * row) * scale;
    }
  } else {
    const glm::dvec2 size(level.width, level.height);
    const glm::dvec2 middle = (glm::dvec2(page.column, page.row) + 0.5) * texels / size * 2.0 - 1.0;
    const glm::dvec2 scale = size / static_cast<double>(slot);
    for (int i = 0; i < 4; ++i) {
      m[i][0] = (m[i][0] - middle.x * m[i][3]) * scale.x;
      m[i][1] = (m[i][1] - middle.y * m[i][3]) * scale.y;
    }
  }
  map.clip_from_camera_relative = glm::mat4(counted_from(m, plan.origin_world));
  map.cull_planes.fill(glm::dvec4(0.0));
  map.cull_plane_count = 0;
  for (const glm::dvec4& plane : rectangle_planes(map, {0, 0, slot, slot}, plan.clip_space))
    map.cull_planes[static_cast<std::size_t>(map.cull_plane_count++)] = plane;
  if (map.light_world.w != 0.0) {
    const glm::dvec4 ahead = row_of(m, 3);
    map.cull_planes[static_cast<std::size_t>(map.cull_plane_count++)] =
        ahead / glm::length(glm::dvec3(ahead));
  }
  return map;
}

}  // namespace gnomon
