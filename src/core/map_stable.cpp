// A map whose texel grid stands still while the camera moves.
// Based on: Valient, "Stable Rendering of Cascaded Shadow Maps", ShaderX6, 2008; the size from the longest
// chord instead of the enclosing sphere, and centres as whole numbers of texels in double, are this
// project's.
#include <cmath>
#include <glm/geometric.hpp>

#include "elementary.hpp"
#include "map_parts.hpp"
#include "vector.hpp"

namespace gnomon {

bool lay_stable_map(const PlanContext& c, const Polytope& body, double begin, double end,
                    ShadowMap& map) noexcept {
  const LightFrame& frame = c.frame;
  map.warp = &warps::none;
  // Rounded up so that its own rounding can never change the grid; one texel is the room that snapping moves
  // within.
  const double chord = longest_chord(c.camera.left, c.camera.right, c.camera.bottom, c.camera.top,
                                     c.camera.orthographic, begin, end);
  const double unit = elementary::power_of_two_below(chord) / c.options.stable_size_steps;
  const double side = std::ceil(chord / unit) * unit;
  map.filter_margin_texels = margin_texels(c.options, map.width - 1, 1.0 / side);
  const double texel = side / (map.width - 1 - 2 * map.filter_margin_texels);
  const double half = 0.5 * texel * map.width;
  // Centre of the whole slice, in absolute light coordinates, to the nearest texel.
  const Polytope slice = frustum_slice(c.camera, c.axes, begin, end);
  Box box;
  for (const Polytope::Vertex& v : slice.vertices()) {
    box.extend({glm::dot(frame.x, v.position), glm::dot(frame.y, v.position), glm::dot(frame.z, v.position)});
  }
  const glm::dvec3 eye{glm::dot(frame.x, c.camera.position), glm::dot(frame.y, c.camera.position),
                       glm::dot(frame.z, c.camera.position)};
  map.snap_key.texel = texel;
  map.snap_key.x = snap_index(eye.x + 0.5 * (box.min.x + box.max.x), texel);
  map.snap_key.y = snap_index(eye.y + 0.5 * (box.min.y + box.max.y), texel);

  const SweptBody swept = sweep(c, body, texel * map.filter_margin_texels);
  if (!swept.reach.any) return false;
  const LightBody points = in_light_frame(c, frame, body);
  const DepthExtent extent = depth_extent(c, points, swept);
  const double bottom = extent.bottom;
  PlaneMap plane = plane_map(points.points(), {});
  const double x = static_cast<double>(map.snap_key.x) * texel,
               y = static_cast<double>(map.snap_key.y) * texel;
  plane.a_min = x - half - eye.x;
  plane.a_max = x + half - eye.x;
  plane.b_min = y - half - eye.y - plane.u_min;
  plane.b_max = y + half - eye.y - plane.u_min;
  const double height = caster_height(extent.reach, frame, points, plane, bottom,
                                      static_cast<double>(map.filter_margin_texels) / map.width);
  // Depths in whole steps of a sixteenth of the side: the stored depths hold still, too.
  const double step = side / 16.0;
  const LightDepths wanted = padded(bottom, height, side);
  map.snap_key.depth_far = static_cast<std::int64_t>(std::floor((eye.z + wanted.bottom) / step));
  map.snap_key.depth_near =
      static_cast<std::int64_t>(std::ceil((eye.z + wanted.bottom + wanted.height) / step));
  map.snap_key.valid = true;

  const LightDepths depths{static_cast<double>(map.snap_key.depth_far) * step - eye.z,
                           static_cast<double>(map.snap_key.depth_near - map.snap_key.depth_far) * step};
  map.depth_range_world = depths.height;
  finish_map(c, points, plane, swept, clip_from_light(plane, depths, 0.0) * light_from_relative(frame), map);
  // Of the key alone: the same key, the same bits, and what was drawn stays as it is.
  PlaneMap still = plane;
  still.u_min = 0.0;
  still.a_min = x - half;
  still.a_max = x + half;
  still.b_min = y - half;
  still.b_max = y + half;
  const LightDepths still_depths{static_cast<double>(map.snap_key.depth_far) * step, depths.height};
  map.clip_from_world = clip_from_gl_clip(c.options.clip_space) * clip_from_light(still, still_depths, 0.0) *
                        light_from_relative(frame);
  return true;
}

}  // namespace gnomon
