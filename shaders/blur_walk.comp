#version 450 core
// The blur of stored texels along x or y. Each invocation walks along a part of a row or column: it fetches every texel
// once, and keeps the kernel's texels in registers.
#include "common/filter.glsl"
#include "common/walk.glsl"
#include <filter>

layout(local_size_x = 32) in;
layout(binding = 8) uniform sampler2DArray stored;
layout(binding = 0) writeonly uniform image2DArray texel_out;
layout(location = 0) uniform int map;
layout(location = 2) uniform ivec3 blur;  // 1: along x; layer that is read; which of a texel's vectors

ivec2 place(int across, int along) { return blur.x == 1 ? ivec2(along, across) : ivec2(across, along); }

vec4 texel_at(int across, int along, int end, vec4 outside) {
  return along >= 0 && along < end ? texelFetch(stored, ivec3(place(across, along), blur.y), 0) : outside;
}

void main() {
  int across = int(gl_GlobalInvocationID.x), begin = int(gl_GlobalInvocationID.y) * walk.w;
  ivec2 size = blur.x == 1 ? walk.yx : walk.xy;
  if (across >= size.x) return;
  ShadowOptions options = shadow_options(map);
  float weights[kReach + 1] = tap_weights_of(map);
  ShadowTexel beyond = shadow_store(1.0, vec2(0.0), options);
  vec4 outside = beyond.v[blur.z];
  vec4 window[kSide];
  for (int i = 1; i < kSide; ++i) window[i] = texel_at(across, begin - kReach - 1 + i, size.y, outside);
  int end = min(begin + walk.w, size.y);
  for (int at = begin; at < end; ++at) {
    for (int i = 0; i < kSide - 1; ++i) window[i] = window[i + 1];
    window[kSide - 1] = texel_at(across, at + kReach, size.y, outside);
#if GNOMON_MEAN
    vec4 sum = vec4(0.0);
    for (int i = 0; i < kSide; ++i) sum += weights[abs(i - kReach)] * window[i];
#else
    // Texels that only the filter may join have one vector.
    ShadowTexel joined = shadow_nothing(options);
    for (int i = 0; i < kSide; ++i) {
      ShadowTexel next;
      next.v[0] = window[i];
      shadow_join(joined, next, weights[abs(i - kReach)], options);
    }
    vec4 sum = joined.v[0];
#endif
    imageStore(texel_out, ivec3(place(across, at), walk.z), sum);
  }
}
