// A map whose texel grid does not move with the camera.
// Based on: Valient, "Stable Rendering of Cascaded Shadow Maps", ShaderX6, 2008; the size from the longest
// chord instead of the enclosing sphere, and centres as whole numbers of texels in double, are this
// project's.
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/vector.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/extend/light_space.hpp"
#include "gnomon/shadow_map.hpp"
#include "gnomon/study/formulas.hpp"
#include "lanes/elementary.hpp"
#include "map/depths.hpp"
#include "map/light_body.hpp"
#include "map/record.hpp"
#include "map/shared_views.hpp"
#include "map/size.hpp"

namespace gnomon {
namespace {

/// The grid: a square whose size depends on the slice alone, its centre at a whole texel.
struct Grid {
  double side, texel, half;
  glm::dvec3 eye;     // of the light frame
  glm::dvec2 centre;  // absolute
};

/// The slice of every camera that the map serves, relative to the plan's origin.
struct Slices {
  std::array<Polytope, kMaxViews> slice;
  std::size_t count = 0;
  [[nodiscard]] std::span<const Polytope> all() const noexcept { return {slice.data(), count}; }
};
Slices slices_of(const PlanContext& c, const MapRequest& request) noexcept {
  Slices slices;
  if (c.views.empty())
    slices.slice[slices.count++] = frustum_slice(c.camera, c.axes, request.begin, request.end);
  for (const SharedView& view : c.views)
    slices.slice[slices.count++] = view_slice(view, request.begin, request.end);
  return slices;
}

/// The longest distance between two corners of any slices. For one view from its image's edges, so that it is
/// the same bits every frame.
double longest_distance(const PlanContext& c, const MapRequest& request, const Slices& slices) noexcept {
  if (c.views.empty()) {
    return longest_chord(c.camera.left, c.camera.right, c.camera.bottom, c.camera.top, c.camera.orthographic,
                         request.begin, request.end);
  }
  double longest = 0.0;
  for (const Polytope& a : slices.all()) {
    for (const Polytope& b : slices.all()) {
      for (const Polytope::Vertex& v : a.vertices()) {
        for (const Polytope::Vertex& w : b.vertices())
          longest = max_of(longest, glm::length(v.position - w.position));
      }
    }
  }
  return longest;
}

/// Out of line: the map need not make room for the slices.
[[gnu::noinline]] Grid grid_of(const PlanContext& c, const MapRequest& request, ShadowMap& map) noexcept {
  const LightFrame& frame = request.space.frame;
  Grid grid{};
  // Rounded up so that its own rounding can never change the grid; one texel is the room that snapping moves
  // within.
  const Slices slices = slices_of(c, request);
  const double chord = longest_distance(c, request, slices) + 2.0 * request.room;
  const double unit = elementary::power_of_two_below(chord) / c.options.resolution.stable_size_steps;
  grid.side = std::ceil(chord / unit) * unit;
  map.filter_margin_texels = border_texels(c.options, map.width - 1, 1.0 / grid.side);
  const int inside = map.width - 1 - 2 * map.filter_margin_texels;
  grid.texel = grid.side / inside;
  grid.eye = frame.turned(c.camera.position);
  // Texels finer than doubles are this far out have no place of their own.
  constexpr double kMaxTexels = 0x1p50;
  while (max_of(std::abs(grid.eye.x), std::abs(grid.eye.y)) > kMaxTexels * grid.texel) grid.texel *= 2.0;
  grid.side = grid.texel * inside;
  grid.half = 0.5 * grid.texel * map.width;
  // Centre of the whole slice, in absolute light coordinates, to the nearest texel.
  Box box;
  for (const Polytope& slice : slices.all()) {
    for (const Polytope::Vertex& v : slice.vertices()) box.extend(frame.turned(v.position));
  }
  map.snap_key.texel = grid.texel;
  map.snap_key.x = snap_index(grid.eye.x + 0.5 * (box.min.x + box.max.x), grid.texel);
  map.snap_key.y = snap_index(grid.eye.y + 0.5 * (box.min.y + box.max.y), grid.texel);
  grid.centre = glm::dvec2(map.snap_key.x, map.snap_key.y) * grid.texel;
  return grid;
}

/// Depths in whole steps of a sixteenth of the side, so that stored depths do not change either. Steps double
/// until whole numbers hold both ends.
LightDepths snapped_depths(const Grid& grid, const HeightRange& heights, SnapKey& key) noexcept {
  const LightDepths wanted = padded(heights.bottom, heights.height, grid.side);
  const double low = grid.eye.z + wanted.bottom, high = low + wanted.height;
  constexpr double kMaxSteps = 0x1p52;
  double step = grid.side / 16.0;
  const double farthest = max_of(std::abs(low), std::abs(high));
  while (farthest / step > kMaxSteps) step *= 2.0;
  key.depth_far = snap_index(std::floor(low / step), 1.0);
  key.depth_near = snap_index(std::ceil(high / step), 1.0);
  if (key.depth_near <= key.depth_far) key.depth_near = key.depth_far + 1;
  key.valid = true;
  return {static_cast<double>(key.depth_far) * step,
          static_cast<double>(key.depth_near - key.depth_far) * step};
}

/// OpenGL clip space of a square round `centre`. Sizes are given, not differences of edges: far from the
/// origin those would be rounding.
glm::dmat4 clip_from_grid(const glm::dvec2& centre, double half, const LightDepths& depths) noexcept {
  glm::dmat4 m(1.0);
  m[0][0] = m[1][1] = 1.0 / half;
  m[2][2] = -2.0 / depths.height;
  m[3] = {-centre.x / half, -centre.y / half, 1.0 + 2.0 * depths.bottom / depths.height, 1.0};
  return m;
}

}  // namespace

std::int64_t snap_index(double value, double step) noexcept {
  constexpr double kLargest = 9007199254740992.0;  // 2^53
  const double index = std::floor(value / step + 0.5);
  if (!(index > -kLargest)) return -static_cast<std::int64_t>(kLargest);
  if (index > kLargest) return static_cast<std::int64_t>(kLargest);
  return static_cast<std::int64_t>(index);
}

void stable_map(const PlanContext& c, const MapRequest& request, MapResult& result) noexcept {
  ShadowMap& map = result.map;
  begin_record(c, request, map);
  const Grid grid = grid_of(c, request, map);
  const LightBody body = in_light_space(c, request);
  const glm::dvec2 centre = grid.centre - glm::dvec2(grid.eye);  // relative to the camera
  PlaneMap plane = body.under({});
  plane.a_min = centre.x - grid.half;
  plane.a_max = centre.x + grid.half;
  plane.b_min = centre.y - plane.u_min - grid.half;
  plane.b_max = centre.y - plane.u_min + grid.half;

  const double border = static_cast<double>(map.filter_margin_texels) / map.width;
  const glm::dvec4 light(request.space.frame.z, 0.0);
  const ServedBody served(c, request, body, plane);
  SweptBody swept;
  sweep(served.request().body, light, grid.texel * map.filter_margin_texels, c.camera.position, swept);
  const HeightRange heights = height_range(c, served.request(), {served.points(), plane, swept, {border}});
  if (!heights.has_casters && !request.without_casters) return;
  result.drawn = true;
  const LightDepths still_depths = snapped_depths(grid, heights, map.snap_key);
  const LightDepths depths{still_depths.bottom - grid.eye.z, still_depths.height};
  map.depth_range_world = depths.height;
  TexelsNeeded needed;
  texels_needed(body.points(), plane, pixels_per_slope(c.camera), needed);
  const glm::dmat4 turn = request.space.light_from_relative();
  const glm::dmat4 gl_from_relative = clip_from_grid(centre, grid.half, depths) * turn;
  complete_record(c, request,
                  {body, plane, swept, needed, {}, pixel_obliquity(c, request.body), gl_from_relative}, map);
  // Of the key alone: the same key, the same bits, and what was drawn stays as it is.
  result.gl_from_world = clip_from_grid(grid.centre, grid.half, still_depths) * turn;
  map.clip_from_world = clip_from_gl_clip(c.options.clip_space) * result.gl_from_world;
}

}  // namespace gnomon
