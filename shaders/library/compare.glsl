// Depths compared with the receiver's plane, for filters that read the depth map and for those that fall back to it.
#ifndef GNOMON_LIBRARY_COMPARE_GLSL
#define GNOMON_LIBRARY_COMPARE_GLSL
#include "library/lookup.glsl"

// A way of `offset` texels from the point may leave the point's piece of the map: what it is longer by than that many of the
// point's own texels, in those. 0 in maps whose texels change smoothly.
vec2 beyond_piece(ShadowLookup at, vec2 offset) {
  return at.longer.xy * min(offset - at.ends.xy, 0.0) + at.longer.zw * max(offset - at.ends.zw, 0.0);
}

// The plane of the receiver, `offset` texels from the point. It may go on behind the map's far plane, where nothing is
// drawn: lit.
float plane_depth(ShadowLookup at, vec2 offset) {
  return min(at.depth + dot(at.depth_gradient, offset + beyond_piece(at, offset)), 1.0);
}

// The same at four texels that share a corner, in textureGather's order: (left, top), (right, top), (right, bottom),
// (left, bottom); top is the higher row.
vec4 plane_depths(ShadowLookup at, vec2 to_corner) {
  vec2 g = at.depth_gradient, half_step = 0.5 * g;
  vec2 low = g * beyond_piece(at, to_corner - 0.5), high = g * beyond_piece(at, to_corner + 0.5);
  vec4 depth = at.depth + dot(g, to_corner) +
               vec4(-half_step.x + half_step.y, half_step.x + half_step.y, half_step.x - half_step.y, -half_step.x - half_step.y);
  return min(depth + vec4(low.x, high.x, high.x, low.x) + vec4(high.yy, low.yy), 1.0);
}

// The four comparisons round a point, each with the plane at its texel, weighted bilinearly.
float compare_2x2(sampler2DArray depth_map, ShadowLookup at, vec2 texel) {
  vec2 corner = floor(texel - 0.5) + 1.0;  // shared by the four texels
  vec2 right_top = texel - corner + 0.5;
  vec4 stored = depth_of_texel(textureGather(depth_map, vec3(corner / at.layer_size, at.layer)));
  if (at.depth_curve != 0.0) {
    for (int i = 0; i < 4; ++i) stored[i] = linear_depth(stored[i], at.depth_curve);
  }
  vec2 to_corner = corner - at.texel;
  // textureGather's order: (left, top), (right, top), (right, bottom), (left, bottom); top is the higher row.
  vec4 depth = vec4(plane_depth(at, to_corner + vec2(-0.5, 0.5)), plane_depth(at, to_corner + vec2(0.5, 0.5)),
                    plane_depth(at, to_corner + vec2(0.5, -0.5)), plane_depth(at, to_corner + vec2(-0.5, -0.5)));
  vec2 x = vec2(1.0 - right_top.x, right_top.x), y = vec2(1.0 - right_top.y, right_top.y);
  return dot(x.xyyx * y.yyxx, vec4(lessThanEqual(depth, stored)));
}
#endif
