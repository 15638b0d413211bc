// A blur whose radius the shader was compiled for. One invocation walks along a part of a row or column; loops over its
// window have bounds that every compiler unrolls, so that the window stays in registers.
#include "pass/store/listed_tiles.glsl"

layout(local_size_x = 32) in;  // four strips of a tile, or the columns of one
const int kReach = GNOMON_REACH;      // taps to either side of the middle one
const int kSide = 2 * GNOMON_REACH + 1;

layout(location = 1) uniform ivec4 walk;  // texels along x and y to be filled, layer written, tiles of a layer

// Puts one vector of the kernel's texels together, where the window holds nothing else.
vec4 joined(vec4 window[kSide], float weights[GNOMON_REACH + 1], ShadowOptions options) {
#if GNOMON_MEAN
  vec4 sum = vec4(0.0);
  for (int i = 0; i < kSide; ++i) sum += weights[abs(i - kReach)] * window[i];
  return sum;
#elif defined(SHADOW_JOINS_BY_SUM)
  vec4 largest = window[0], sum = vec4(0.0);
  for (int i = 1; i < kSide; ++i) largest = max(largest, window[i]);
  for (int i = 0; i < kSide; ++i) sum += weights[abs(i - kReach)] * shadow_term(window[i], largest, options);
  return shadow_of_sum(sum, largest, options);
#else
  // Any of a texel's vectors: those that only the filter may join are all joined alike.
  ShadowTexel sum = shadow_nothing(options);
  ShadowTexel next = sum;
  for (int i = 0; i < kSide; ++i) {
    next.v[0] = window[i];
    shadow_join(sum, next, weights[abs(i - kReach)], options);
  }
#ifdef SHADOW_PACKS
  sum = shadow_pack(sum, options);
#endif
  return sum.v[0];
#endif
}

float[GNOMON_REACH + 1] tap_weights_of(int map) {
  float weights[GNOMON_REACH + 1];
  for (int i = 0; i <= GNOMON_REACH; ++i) weights[i] = tap_weight(map, i);
  return weights;
}
