#version 450 core
// The blur along y of texels that are blurred along x. Each invocation walks along a part of a column: it fetches every
// texel once, and keeps the kernel's texels in registers.
#include "pass/common/filter.glsl"
#include <filter>
#include "pass/store/walk.glsl"

layout(binding = 8) uniform sampler2DArray rows;  // one vector of the texels, in layer 0
layout(binding = 0) writeonly uniform image2DArray texel_out;
layout(location = 0) uniform int map;
layout(location = 2) uniform int vector;  // which of a texel's vectors

vec4 texel_at(int x, int y, vec4 outside) {
  return y >= 0 && y < walk.y ? texelFetch(rows, ivec3(x, y, 0), 0) : outside;
}

void main() {
  ivec2 first = listed_column();
  int x = first.x, begin = first.y;
  if (x < 0 || x >= walk.x) return;
  ShadowOptions options = shadow_options(map);
  float weights[kReach + 1] = tap_weights_of(map);
  ShadowTexel beyond = shadow_store(1.0, vec2(0.0), options);
  vec4 outside = beyond.v[vector];
  vec4 window[kSide];
  for (int i = 1; i < kSide; ++i) window[i] = texel_at(x, begin - kReach - 1 + i, outside);
  int end = min(begin + kTileSide, walk.y);
  for (int y = begin; y < end; ++y) {
    for (int i = 0; i < kSide - 1; ++i) window[i] = window[i + 1];
    window[kSide - 1] = texel_at(x, y + kReach, outside);
    imageStore(texel_out, ivec3(x, y, walk.z), joined(window, weights, options));
  }
}
