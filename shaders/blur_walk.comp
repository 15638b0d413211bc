#version 450 core
// The blur of stored texels along x or y. Each invocation walks along a part of a row or column: it fetches every texel
// once, and keeps the kernel's texels in registers.
#include "common/filter.glsl"
#include <filter>
#include "common/walk.glsl"

layout(binding = 8) uniform sampler2DArray stored;
layout(binding = 0) writeonly uniform image2DArray texel_out;
layout(location = 0) uniform int map;
layout(location = 2) uniform ivec3 blur;  // 1: along x; layer that is read; which of a texel's vectors

ivec2 place(int across, int along) { return blur.x == 1 ? ivec2(along, across) : ivec2(across, along); }

vec4 texel_at(int across, int along, int end, vec4 outside) {
  return along >= 0 && along < end ? texelFetch(stored, ivec3(place(across, along), blur.y), 0) : outside;
}

void main() {
  ivec2 first = blur.x == 1 ? listed_row(kRows, walk.w).yx : listed_column();
  int across = first.x, begin = first.y;
  ivec2 size = blur.x == 1 ? walk.yx : walk.xy;
  if (across < 0 || across >= size.x) return;
  ShadowOptions options = shadow_options(map);
  float weights[kReach + 1] = tap_weights_of(map);
  ShadowTexel beyond = shadow_store(1.0, vec2(0.0), options);
  vec4 outside = beyond.v[blur.z];
  vec4 window[kSide];
  for (int i = 1; i < kSide; ++i) window[i] = texel_at(across, begin - kReach - 1 + i, size.y, outside);
  int end = min(begin + kTileSide, size.y);
  for (int at = begin; at < end; ++at) {
    for (int i = 0; i < kSide - 1; ++i) window[i] = window[i + 1];
    window[kSide - 1] = texel_at(across, at + kReach, size.y, outside);
    imageStore(texel_out, ivec3(place(across, at), walk.z), joined(window, weights, options));
  }
}
