// The caster that one texel holds between a point and a light with a size, and the width of a kernel of such texels.
#ifndef GNOMON_LIBRARY_CASTER_GLSL
#define GNOMON_LIBRARY_CASTER_GLSL
#include "library/compare.glsl"

// The longer axis of an ellipse.
float widest_axis(mat2 disc) { return sqrt(max(dot(disc[0], disc[0]), dot(disc[1], disc[1]))); }

// Distance to what the texel under `offset` stores, world units; below 0 where that is not in front of the receiver's plane.
float caster_at(sampler2DArray depth_map, ShadowLookup at, vec2 offset) {
  vec2 texel = floor(at.texel + offset) + 0.5;
  float stored = depth_of_texel(textureLod(depth_map, vec3(texel / at.layer_size, at.layer), 0.0).r);
  return plane_depth(at, texel - at.texel) <= stored ? -1.0 : max(distance_to_depth(at, stored), 0.0);
}
#endif
