// Depths compared with the receiver's plane, for filters that read the depth map and for those that fall back to it.
#ifndef GNOMON_LIBRARY_COMPARE_GLSL
#define GNOMON_LIBRARY_COMPARE_GLSL
#include "library/lookup.glsl"

// The plane of the receiver, `offset` texels from the point. It may go on behind the map's far plane, where nothing is
// drawn: lit.
float plane_depth(ShadowLookup at, vec2 offset) { return min(at.depth + dot(at.depth_gradient, offset), 1.0); }

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
