#version 450 core
// The states of one map's tiles, before a frame marks those that it reads.
#include "pass/store/tiles.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, r8ui) uniform uimage2DArray states;
layout(location = 0) uniform int layer;
layout(location = 1) uniform ivec2 keep;  // 1: filled tiles stay valid; 1: all others are wanted

void main() {
  ivec2 size = imageSize(states).xy;
  int index = int(gl_GlobalInvocationID.x);
  if (index >= size.x * size.y) return;
  ivec3 tile = ivec3(index % size.x, index / size.x, layer);
  bool holds = keep.x == 1 && imageLoad(states, tile).x != kStale;
  imageStore(states, tile, uvec4(holds ? kHolds : keep.y == 1 ? kWanted : kStale, 0u, 0u, 0u));
}
