// A map whose texel grid does not move with the camera.
// Based on: Valient, "Stable Rendering of Cascaded Shadow Maps", ShaderX6, 2008; sides from the longest chord
// within the bounds of all receivers instead of the enclosing sphere, and centres as whole numbers of texels
// in double, are this project's.
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/matrix.hpp"
#include "geometry/vector.hpp"
#include "geometry/visible.hpp"
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

/// The grid: a rectangle whose sides depend on the slice and the bounds of all receivers alone, its centre at
/// a whole texel.
struct Grid {
  glm::dvec2 texel, half;
  double side;        // the longer one, borders apart
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

/// The longest distance between two corners of the one view's slice: from its image's edges, so that it is
/// the same bits every frame.
double longest_chord_of(const PlanContext& c, double begin, double end) noexcept {
  return longest_chord(c.camera.left, c.camera.right, c.camera.bottom, c.camera.top, c.camera.orthographic,
                       begin, end);
}
/// Between two corners of any slices.
double longest_distance(const Slices& slices) noexcept {
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

/// The farthest that two points in a box of these sides lie from each other along `axis`, where they are at
/// most `chord` apart.
double farthest_along(const glm::dvec3& axis, const glm::dvec3& size, double chord) noexcept {
  // Along the axis itself, until sides of the box end: the rest of the chord then lies along the others.
  glm::dvec3 offset(0.0);
  std::array<bool, 3> ended{};
  for (int round = 0; round < 3; ++round) {
    double left = chord * chord, across = 0.0;
    for (int i = 0; i < 3; ++i) {
      if (ended[static_cast<std::size_t>(i)])
        left -= size[i] * size[i];
      else
        across += axis[i] * axis[i];
    }
    const double along = left > 0.0 && across > 0.0 ? std::sqrt(left / across) : 0.0;
    for (int i = 0; i < 3; ++i) {
      if (ended[static_cast<std::size_t>(i)]) continue;
      offset[i] = along * std::abs(axis[i]);
      if (offset[i] < size[i]) continue;
      offset[i] = size[i];
      ended[static_cast<std::size_t>(i)] = true;
    }
  }
  return glm::dot(offset, glm::abs(axis));
}

/// Sides of a box that holds all receivers, in steps: receivers that move at the ends of their bounds, as one
/// that walks and jumps on flat ground, change the texels of a grid rarely. `chord`: of the slice.
glm::dvec3 sizes_in_steps(const Box& receivers, double chord) noexcept {
  const glm::dvec3 size = receivers.max - receivers.min;
  // Of a thin side, steps that hardly make the others' texels larger; and off round numbers, which sizes are
  // by design, so that their rounding is no step.
  constexpr double kSteps = 8.0, kThin = 1.0 / 16.0, kOff = 1.0 / 3.0;
  const double thin = kThin * min_of(chord, max_of(size.x, max_of(size.y, size.z)));
  glm::dvec3 stepped = size;
  for (int i = 0; i < 3; ++i) {
    const double step = elementary::power_of_two_below(max_of(size[i], thin)) / kSteps;
    if (step > 0.0) stepped[i] = (std::ceil(size[i] / step - kOff) + kOff) * step;
  }
  return stepped;
}

/// Where receivers of the slice lie, relative to the camera, and how long sides hold them wherever the camera
/// looks.
struct Extent {
  glm::dvec2 middle, side;
  double chord;  // longest distance within the slices
};

/// Along one axis.
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};
Span span_along(const glm::dvec3& axis, const Polytope& body) noexcept {
  Span span;
  for (const Polytope::Vertex& v : body.vertices()) {
    const double at = glm::dot(axis, v.position);
    span = {min_of(span.low, at), max_of(span.high, at)};
  }
  return span;
}

/// For one camera: the slice within the bounds of all receivers. Not its body, which follows receivers that
/// move inside of them.
Extent extent_of_slice(const PlanContext& c, const MapRequest& request) noexcept {
  const Box& receivers = c.receivers;
  Extent extent{};
  extent.chord = longest_chord_of(c, request.begin, request.end);
  const Polytope slice = frustum_slice(c.camera, c.axes, request.begin, request.end);
  const glm::dvec3 size = sizes_in_steps(receivers, extent.chord);
  Polytope held = slice;
  clip(held, relative_to(receivers, c.camera.position));
  for (int i = 0; i < 2; ++i) {
    const glm::dvec3& axis = i == 0 ? request.space.frame.x : request.space.frame.y;
    const Span span = span_along(axis, held.empty() ? slice : held);
    extent.middle[i] = 0.5 * (span.low + span.high);
    extent.side[i] = farthest_along(axis, size, extent.chord);
  }
  return extent;
}

/// For several cameras, or with room round what one sees. Out of line: other maps need not make room for the
/// slices.
[[gnu::noinline]] Extent extent_of_slices(const PlanContext& c, const MapRequest& request) noexcept {
  const Box& receivers = c.receivers;
  const Slices slices = slices_of(c, request);
  Extent extent{};
  extent.chord = c.views.empty() ? longest_chord_of(c, request.begin, request.end) : longest_distance(slices);
  const glm::dvec3 centre = 0.5 * (receivers.min + receivers.max) - c.camera.position;
  const glm::dvec3 size = sizes_in_steps(receivers, extent.chord);
  for (int i = 0; i < 2; ++i) {
    const glm::dvec3& axis = i == 0 ? request.space.frame.x : request.space.frame.y;
    Span all;
    for (const Polytope& slice : slices.all()) {
      const Span span = span_along(axis, slice);
      all = {min_of(all.low, span.low - request.room), max_of(all.high, span.high + request.room)};
    }
    // Either side holds them all: that of the slices, and that of the receivers' bounds.
    const double across = 0.5 * glm::dot(glm::abs(axis), size);
    extent.side[i] = min_of(extent.chord + 2.0 * request.room, 2.0 * across);
    const double middle = glm::dot(axis, centre);
    const double from = max_of(all.low, middle - across), to = min_of(all.high, middle + across);
    extent.middle[i] = 0.5 * (from < to ? from + to : all.low + all.high);
  }
  return extent;
}

/// Sides as they are drawn.
glm::dvec2 rounded_sides(const PlanContext& c, double end, const glm::dvec2& sides, double chord) noexcept {
  // Flat receivers that the light grazes, and such as are a point, leave a side of next to nothing; floats
  // relative to the camera tell no texels apart that are finer than this share of a slice's distance.
  constexpr double kThinnest = 1.0 / 64.0, kLeast = 0x1p-13;
  const double least = max_of(kThinnest * max_of(sides.x, sides.y), kLeast * max_of(chord, std::abs(end)));
  glm::dvec2 rounded;
  for (int i = 0; i < 2; ++i) {
    // Up, so that their own rounding can never change the grid.
    const double side = max_of(sides[i], least);
    const double unit = elementary::power_of_two_below(side) / c.options.resolution.stable_size_steps;
    rounded[i] = std::ceil(side / unit) * unit;
  }
  return rounded;
}

/// The last frame's sides where they are long enough, and not much longer: receivers that go up and down at
/// the end of their bounds must not change the texels each time.
glm::dvec2 kept_sides(const PlanContext& c, const MapRequest& request, const glm::dvec2& sides) noexcept {
  const PlanHistory::Map* const last = request.last;
  if (last == nullptr || last->width != request.slot.width) return sides;
  constexpr double kLonger = 1.25;
  glm::dvec2 kept = sides;
  for (int i = 0; i < 2; ++i) {
    const double texel = 2.0 / (last->width * glm::length(glm::dvec3(row_of(last->gl_from_world, i))));
    const double side = texel * (last->width - 1 - 2 * last->filter_margin_texels);
    if (!(side > sides[i] * (1.0 - 1e-9) && side < sides[i] * kLonger)) continue;
    // In the steps that it was rounded to, so that it is the same bits.
    const double unit = elementary::power_of_two_below(side) / c.options.resolution.stable_size_steps;
    kept[i] = max_of(sides[i], std::floor(side / unit + 0.5) * unit);
  }
  return kept;
}

/// Out of line: the map need not make room for the slice.
[[gnu::noinline]] Grid grid_of(const PlanContext& c, const MapRequest& request, ShadowMap& map) noexcept {
  Grid grid{};
  const Extent extent =
      c.views.empty() && request.room == 0.0 ? extent_of_slice(c, request) : extent_of_slices(c, request);
  const glm::dvec2 sides = kept_sides(c, request, rounded_sides(c, request.end, extent.side, extent.chord));
  // One texel is the room that snapping moves within.
  map.filter_margin_texels = border_texels(c.options, map.width - 1, 1.0 / min_of(sides.x, sides.y));
  const double inside = map.width - 1 - 2 * map.filter_margin_texels;
  grid.texel = sides / inside;
  grid.eye = request.space.frame.turned(c.camera.position);
  // Texels finer than doubles are this far out have no place of their own.
  constexpr double kMaxTexels = 0x1p50;
  for (int i = 0; i < 2; ++i) {
    while (std::abs(grid.eye[i]) > kMaxTexels * grid.texel[i]) grid.texel[i] *= 2.0;
  }
  grid.side = max_of(grid.texel.x, grid.texel.y) * inside;
  grid.half = 0.5 * grid.texel * static_cast<double>(map.width);
  // The middle, in absolute light coordinates, to the nearest texel.
  map.snap_key.texel = grid.texel;
  map.snap_key.x = snap_index(grid.eye.x + extent.middle.x, grid.texel.x);
  map.snap_key.y = snap_index(grid.eye.y + extent.middle.y, grid.texel.y);
  grid.centre = glm::dvec2(map.snap_key.x, map.snap_key.y) * grid.texel;
  return grid;
}

/// The last frame's depths where they hold these, and not much more: what was drawn then stays as it is. An
/// end that moves out gets room, as the next casters in view often move it farther.
void keep_depths(const MapRequest& request, double step, SnapKey& key) noexcept {
  const PlanHistory::Map* const last = request.last;
  if (last == nullptr || last->width != request.slot.width) return;
  constexpr double kLonger = 2.0, kRoom = 0.25, kRounding = 1e-6;
  const glm::dvec4 row = row_of(last->gl_from_world, 2);
  const double height = 2.0 / glm::length(glm::dvec3(row)), bottom = 0.5 * (row.w - 1.0) * height;
  const double low = std::floor(bottom / step + 0.5), high = std::floor((bottom + height) / step + 0.5);
  // Of another grid, whose steps are others.
  if (!(std::abs(bottom / step - low) < kRounding && std::abs((bottom + height) / step - high) < kRounding))
    return;
  const auto far_end = static_cast<double>(key.depth_far), near_end = static_cast<double>(key.depth_near);
  const double length = near_end - far_end;
  if (low <= far_end && high >= near_end && high - low <= kLonger * length) {
    key.depth_far = static_cast<std::int64_t>(low);
    key.depth_near = static_cast<std::int64_t>(high);
    return;
  }
  const auto room = static_cast<std::int64_t>(std::ceil(kRoom * length));
  if (far_end < low) key.depth_far -= room;
  if (near_end > high) key.depth_near += room;
}

/// Depths in whole steps of a sixteenth of the longer side, so that stored depths do not change either. Steps
/// double until whole numbers hold both ends.
LightDepths snapped_depths(const MapRequest& request, const Grid& grid, const HeightRange& heights,
                           SnapKey& key) noexcept {
  const LightDepths wanted = padded(heights.bottom, heights.height, grid.side);
  const double low = grid.eye.z + wanted.bottom, high = low + wanted.height;
  constexpr double kMaxSteps = 0x1p52;
  double step = grid.side / 16.0;
  const double farthest = max_of(std::abs(low), std::abs(high));
  while (farthest / step > kMaxSteps) step *= 2.0;
  key.depth_far = snap_index(std::floor(low / step), 1.0);
  key.depth_near = snap_index(std::ceil(high / step), 1.0);
  if (key.depth_near <= key.depth_far) key.depth_near = key.depth_far + 1;
  keep_depths(request, step, key);
  key.valid = true;
  return {static_cast<double>(key.depth_far) * step,
          static_cast<double>(key.depth_near - key.depth_far) * step};
}

/// OpenGL clip space of a rectangle round `centre`. Sizes are given, not differences of edges: far from the
/// origin those would be rounding.
glm::dmat4 clip_from_grid(const glm::dvec2& centre, const glm::dvec2& half,
                          const LightDepths& depths) noexcept {
  glm::dmat4 m(1.0);
  m[0][0] = 1.0 / half.x;
  m[1][1] = 1.0 / half.y;
  m[2][2] = -2.0 / depths.height;
  m[3] = {-centre.x / half.x, -centre.y / half.y, 1.0 + 2.0 * depths.bottom / depths.height, 1.0};
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

bool stable_map_serves_both(const PlanContext& c, const LightFrame& frame, double begin, double middle,
                            double end) noexcept {
  const double first = longest_chord_of(c, begin, middle);
  const glm::dvec3 least = sizes_in_steps(c.receivers, first);
  // Sides grow with the chord until they hold all receivers.
  const glm::dvec2 all(glm::dot(glm::abs(frame.x), least), glm::dot(glm::abs(frame.y), least));
  constexpr double kRounding = 1.0 - 1e-12;
  if (first < kRounding * max_of(all.x, all.y)) return false;
  const auto sides = [&](double to, double chord) {
    const glm::dvec3 size = sizes_in_steps(c.receivers, chord);
    return rounded_sides(c, to, {farthest_along(frame.x, size, chord), farthest_along(frame.y, size, chord)},
                         chord);
  };
  const glm::dvec2 both = sides(end, longest_chord_of(c, begin, end));
  return both == sides(middle, first) && both == sides(end, longest_chord_of(c, middle, end));
}

void stable_map(const PlanContext& c, const MapRequest& request, MapResult& result) noexcept {
  ShadowMap& map = result.map;
  begin_record(c, request, map);
  const Grid grid = grid_of(c, request, map);
  const LightBody body = in_light_space(c, request);
  const glm::dvec2 centre = grid.centre - glm::dvec2(grid.eye);  // relative to the camera
  PlaneMap plane = body.under({});
  plane.a_min = centre.x - grid.half.x;
  plane.a_max = centre.x + grid.half.x;
  plane.b_min = centre.y - plane.u_min - grid.half.y;
  plane.b_max = centre.y - plane.u_min + grid.half.y;

  const double border = static_cast<double>(map.filter_margin_texels) / map.width;
  const glm::dvec4 light(request.space.frame.z, 0.0);
  const ServedBody served(c, request, body, plane);
  SweptBody swept;
  sweep(served.request().body, light, max_of(grid.texel.x, grid.texel.y) * map.filter_margin_texels,
        c.camera.position, swept);
  const HeightRange heights = height_range(c, served.request(), {served.points(), plane, swept, {border}});
  if (!heights.has_casters && !request.without_casters) return;
  result.drawn = true;
  const LightDepths still_depths = snapped_depths(request, grid, heights, map.snap_key);
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
