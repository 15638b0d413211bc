// What of the last frame's stable map still holds, and what little is left to draw.
// Based on: Acton, "CSM Scrolling: An acceleration technique for the rendering of cascaded shadow maps",
// SIGGRAPH Advances in Real-Time Rendering, 2012.
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include "geometry/light_axes.hpp"
#include "geometry/matrix.hpp"

namespace gnomon {
namespace {

bool same_texels(const ShadowMap& a, const ShadowMap& b) noexcept {
  return a.width == b.width && a.height == b.height && a.shape == b.shape &&
         a.shape_parameters == b.shape_parameters;
}

bool same_grid(const ShadowMap& a, const ShadowMap& b) noexcept {
  const SnapKey &p = a.snap_key, &c = b.snap_key;
  if (!p.valid || !c.valid || !(p.texel.x > 0.0 && p.texel.y > 0.0) || p.texel != c.texel) return false;
  // Beyond 2^53 keys are clamped: they no longer tell where the map is.
  constexpr std::int64_t kTrusted = std::int64_t{1} << 52;
  for (const std::int64_t key : {p.x, p.y, c.x, c.y}) {
    if (key <= -kTrusted || key >= kTrusted) return false;
  }
  if (p.depth_near != c.depth_near || p.depth_far != c.depth_far) return false;
  if (!same_texels(a, b) || !a.shape->affine || a.filter_margin_texels != b.filter_margin_texels)
    return false;
  if (a.light_world != b.light_world || a.light_world.w != 0.0 || a.kappa != 0.0 || b.kappa != 0.0)
    return false;
  // The same clip space: its axes point the same way. They differ by rounding at most, or by a whole turn.
  for (int row = 0; row < 3; ++row) {
    if (!(glm::dot(glm::dvec3(row_of(a.clip_from_world, row)), glm::dvec3(row_of(b.clip_from_world, row))) >
          0.0))
      return false;
  }
  return true;
}

/// Of one axis: what of `size` texels remains after a shift, and what is new.
struct Span {
  int begin, length;
};
Span kept_span(int shift, int size) noexcept {
  return {std::max(shift, 0), size - std::abs(shift)};
}
Span new_span(int shift, int size) noexcept {
  return {shift > 0 ? 0 : size - std::abs(shift), std::abs(shift)};
}

/// To the last bit: what was drawn is what would be drawn.
bool same_map(const ShadowMap& a, const ShadowMap& b) noexcept {
  return a.clip_from_world == b.clip_from_world && same_texels(a, b) && a.light_world == b.light_world &&
         (a.snap_key == b.snap_key || (!a.snap_key.valid && !b.snap_key.valid));
}

MapReuse whole(const ShadowMap& map) noexcept {
  MapReuse result;
  result.strip[0] = {0, 0, map.width, map.height};
  result.strip_count = 1;
  return result;
}

}  // namespace

MapReuse reuse(const ShadowMap& previous, const ShadowMap& current, const ClipSpace& clip_space) noexcept {
  if (same_map(previous, current)) {
    MapReuse result;
    result.kind = ReuseKind::identical;
    result.kept = {0, 0, current.width, current.height};
    return result;
  }
  if (!same_grid(previous, current)) return whole(current);
  // Keys count along the light's own axes; the map's may point against them.
  const LightFrame frame = grid_frame(-glm::dvec3(current.light_world));
  const bool x_against = glm::dot(glm::dvec3(row_of(current.clip_from_world, 0)), frame.x) < 0.0;
  bool y_against = glm::dot(glm::dvec3(row_of(current.clip_from_world, 1)), frame.y) < 0.0;
  if (clip_space.first_row == FirstRow::y_plus_one) y_against = !y_against;
  // The map moves one way, what it shows the other.
  const std::int64_t x = previous.snap_key.x - current.snap_key.x,
                     y = previous.snap_key.y - current.snap_key.y;
  const int width = current.width, height = current.height;
  if (x <= -width || x >= width || y <= -height || y >= height) return whole(current);

  MapReuse result;
  result.shift_x = static_cast<int>(x_against ? -x : x);
  result.shift_y = static_cast<int>(y_against ? -y : y);
  const Span kept_x = kept_span(result.shift_x, width), kept_y = kept_span(result.shift_y, height);
  const Span new_x = new_span(result.shift_x, width), new_y = new_span(result.shift_y, height);
  result.kept = {kept_x.begin, kept_y.begin, kept_x.length, kept_y.length};
  for (const TexelRect& strip : {TexelRect{new_x.begin, 0, new_x.length, height},
                                 TexelRect{kept_x.begin, new_y.begin, kept_x.length, new_y.length}}) {
    if (!strip.empty()) result.strip[static_cast<std::size_t>(result.strip_count++)] = strip;
  }
  result.kind = result.strip_count == 0 ? ReuseKind::identical : ReuseKind::scrolled;
  return result;
}

std::array<glm::dvec4, 5> rectangle_planes(const ShadowMap& map, const TexelRect& rectangle,
                                           const ClipSpace& clip_space) noexcept {
  const glm::dmat4& m = map.clip_from_world;
  const glm::dvec4 x = row_of(m, 0), y = row_of(m, 1), w = row_of(m, 3);
  const glm::dvec4 z = row_of(texture_from_clip(clip_space) * m, 2);
  // Texels are counted from ndc (-1, -1), rows of memory from where the clip space says.
  const bool downwards = clip_space.first_row == FirstRow::y_plus_one;
  const int row = downwards ? map.height - rectangle.y - rectangle.height : rectangle.y;
  const TexelGrid texels = map.texels();
  const ShapeRectangle ndc =
      map.shape->ndc_bounds(texels.parameters, texels.size(),
                            {{rectangle.x, row}, {rectangle.x + rectangle.width, row + rectangle.height}});
  std::array<glm::dvec4, 5> planes = {x - w * ndc.low.x, w * ndc.high.x - x, y - w * ndc.low.y,
                                      w * ndc.high.y - y, clip_space.reversed_z ? z : w - z};
  for (glm::dvec4& plane : planes) plane /= glm::length(glm::dvec3(plane));
  return planes;
}

ShadowMap rebased(const ShadowMap& map, const glm::dvec3& new_origin) noexcept {
  ShadowMap moved = map;
  moved.clip_from_camera_relative = glm::mat4(counted_from(map.clip_from_world, new_origin));
  return moved;
}

}  // namespace gnomon
