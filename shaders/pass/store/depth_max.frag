#version 450 core
// The next smaller level of a pyramid of largest depths; level 0 has half the depth map's size.
// Its base level is the one to read.
layout(binding = 5) uniform sampler2DArray from;
layout(location = 0) uniform int map;
layout(location = 0) out float largest;

void main() {
  ivec2 last = textureSize(from, 0).xy - 1;
  ivec2 first = 2 * ivec2(gl_FragCoord.xy);
  // A side that is no multiple of two leaves a third row or column to the last texel.
  ivec2 odd = ivec2(equal(first + 2, last));
  largest = 0.0;
  for (int y = 0; y < 2 + odd.y; ++y) {
    for (int x = 0; x < 2 + odd.x; ++x) {
      largest = max(largest, texelFetch(from, ivec3(min(first + ivec2(x, y), last), map), 0).r);
    }
  }
}
