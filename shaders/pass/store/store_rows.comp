#version 450 core
// From depths to stored texels, and the blur along x where GNOMON_REACH is above 0, of one of their vectors alone. Each
// invocation walks along a part of a row: it fetches every depth once, and keeps the kernel's texels in registers.
#include "pass/store/stored.glsl"
#include "pass/store/walk.glsl"

#if GNOMON_REACH > 0
layout(binding = 0) writeonly uniform image2DArray texel_out;
#else
layout(binding = 0) writeonly uniform image2DArray texel_out[GNOMON_SHADOW_VECTORS];
#endif

// Stores the texel that the walk comes to. `before` and `here`: depths of the texel before it and of itself.
ShadowTexel next_stored(ivec2 texel, inout float before, inout float here, ShadowOptions options) {
#if GNOMON_READS_SLOPE
  float after = depth_at(texel + ivec2(1, 0));
  vec2 slope = vec2(smaller_step(before, here, after), slope_along_y(texel, here));
  ShadowTexel stored = shadow_store(here, slope, options);
  before = here;
  here = after;
  return stored;
#else
  return shadow_store(depth_at(texel), vec2(0.0), options);
#endif
}

void main() {
  ivec2 first = listed_row(walk.w);
  int y = first.y, begin = first.x;
  if (y < 0 || y >= walk.y) return;
  ShadowOptions options = shadow_options(map);
  float before = 1.0, here = 1.0;
#if GNOMON_READS_SLOPE
  before = depth_at(ivec2(begin - kReach - 1, y));
  here = depth_at(ivec2(begin - kReach, y));
#endif
  int end = min(begin + kTileSide, walk.x);
#if GNOMON_REACH > 0
  float weights[kReach + 1] = tap_weights_of(map);
  vec4 window[kSide];
  for (int i = 1; i < kSide; ++i) {
    window[i] = next_stored(ivec2(begin - kReach - 1 + i, y), before, here, options).v[GNOMON_VECTOR];
  }
  for (int x = begin; x < end; ++x) {
    for (int i = 0; i < kSide - 1; ++i) window[i] = window[i + 1];
    window[kSide - 1] = next_stored(ivec2(x + kReach, y), before, here, options).v[GNOMON_VECTOR];
    imageStore(texel_out, ivec3(x, y, walk.z), joined(window, weights, options));
  }
#else
  for (int x = begin; x < end; ++x) {
    ShadowTexel stored = next_stored(ivec2(x, y), before, here, options);
    for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) imageStore(texel_out[i], ivec3(x, y, walk.z), stored.v[i]);
  }
#endif
}
