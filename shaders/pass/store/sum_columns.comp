#version 450 core
// Summed-area table, second half: rows of sums, added up along y.
layout(local_size_x = 32) in;
#if GNOMON_CHANNELS > 2
layout(binding = 0, rgba32ui) uniform uimage2DArray sums;
#else
layout(binding = 0, rg32ui) uniform uimage2DArray sums;
#endif
layout(location = 0) uniform int map;

void main() {
  int x = int(gl_GlobalInvocationID.x);
  ivec2 size = imageSize(sums).xy;
  if (x >= size.x) return;
  uvec4 sum = uvec4(0u);
  for (int y = 0; y < size.y; ++y) {
    sum += imageLoad(sums, ivec3(x, y, map));
    imageStore(sums, ivec3(x, y, map), sum);
  }
}
