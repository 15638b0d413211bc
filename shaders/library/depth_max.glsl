// The largest depth within a box, from a pyramid whose level 0 has half the depth map's size. Never less than the truth.
#ifndef GNOMON_LIBRARY_DEPTH_MAX_GLSL
#define GNOMON_LIBRARY_DEPTH_MAX_GLSL
#include "library/lookup.glsl"

float depth_max_in(sampler2DArray pyramid, ShadowLookup at, vec2 half_sides) {
  // A texel of level n spans 2^(n + 1) texels of the map: two by two of them span the box wherever it lies.
  float side = 2.0 * max(half_sides.x, half_sides.y);
  int level = clamp(int(ceil(log2(max(side, 1.0)))) - 1, 0, textureQueryLevels(pyramid) - 1);
  // By place, as fetch_joined.glsl does.
  vec2 size = vec2(textureSize(pyramid, level).xy);
  float span = exp2(float(level + 1));
  vec2 low = (clamp(floor((at.texel - half_sides) / span), vec2(0.0), size - 1.0) + 0.5) / size;
  vec2 high = (clamp(floor((at.texel + half_sides) / span), vec2(0.0), size - 1.0) + 0.5) / size;
  float lod = float(level);
  float largest = max(max(textureLod(pyramid, vec3(low, at.layer), lod).r, textureLod(pyramid, vec3(high, at.layer), lod).r),
             max(textureLod(pyramid, vec3(low.x, high.y, at.layer), lod).r,
                 textureLod(pyramid, vec3(high.x, low.y, at.layer), lod).r));
  return linear_depth(largest, at.depth_curve);  // the pyramid holds depths as maps are read, never reversed
}
#endif
