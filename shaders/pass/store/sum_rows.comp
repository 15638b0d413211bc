#version 450 core
// Summed-area table, first half: stored texels as integers, added up along x. One invocation walks one row: exact, no
// barriers.
#include "pass/store/stored.glsl"

layout(local_size_x = 32) in;
#if GNOMON_CHANNELS > 2
layout(binding = 0, rgba32ui) writeonly uniform uimage2DArray sums;
#else
layout(binding = 0, rg32ui) writeonly uniform uimage2DArray sums;
#endif

void main() {
  int y = int(gl_GlobalInvocationID.x);
  ivec2 size = imageSize(sums).xy;
  if (y >= size.y) return;
  ShadowOptions options = shadow_options(map);
  uvec4 sum = uvec4(0u);
  for (int x = 0; x < size.x; ++x) {
    vec4 value = stored_at(ivec2(x, y), options).v[0];
    sum += uvec4(clamp(value, 0.0, 1.0) * filtering.sums.x + 0.5);
    imageStore(sums, ivec3(x, y, map), sum);
  }
}
