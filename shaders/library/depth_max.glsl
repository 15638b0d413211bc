// The largest depth within a box, from a pyramid whose level 0 has half the depth map's size. Never less than the truth.
#include "library/lookup.glsl"

float depth_max_in(sampler2DArray pyramid, ShadowLookup at, vec2 half_sides) {
  // A texel of level n spans 2^(n + 1) texels of the map: two by two of them span the box wherever it lies.
  float side = 2.0 * max(half_sides.x, half_sides.y);
  int level = clamp(int(ceil(log2(max(side, 1.0)))) - 1, 0, textureQueryLevels(pyramid) - 1);
  ivec2 last = textureSize(pyramid, level).xy - 1;
  float span = exp2(float(level + 1));
  ivec2 low = clamp(ivec2(floor((at.texel - half_sides) / span)), ivec2(0), last);
  ivec2 high = clamp(ivec2(floor((at.texel + half_sides) / span)), ivec2(0), last);
  int layer = int(at.layer);
  float largest =
      max(max(texelFetch(pyramid, ivec3(low, layer), level).r, texelFetch(pyramid, ivec3(high, layer), level).r),
          max(texelFetch(pyramid, ivec3(low.x, high.y, layer), level).r,
              texelFetch(pyramid, ivec3(high.x, low.y, layer), level).r));
  return linear_depth(largest, at.depth_curve);
}
