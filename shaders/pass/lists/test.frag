#version 450 core
// Marks the pixels of a texel's list that a caster's triangle shadows. The part <alpha> says where the triangle is cut out:
// is_there().
#include "pass/lists/triangle.glsl"
#include <alpha>

layout(binding = 1, rg32f) writeonly uniform image2D mask_image;
layout(location = 6) uniform int samples;  // of each pixel; more than 1 are counted when all casters are drawn

void main() {
  int width = imageSize(mask_image).x;
  uint next = texelFetch(heads, ivec3(gl_FragCoord.xy, map), 0).r;
  while (next != 0u) {
    uint index = next - 1u;
    ListedPixel pixel = listed[index];
    next = pixel.next & ~kShadowed;
    if ((pixel.next & kShadowed) != 0u || !shadows(pixel.at)) continue;
    uint before = atomicOr(listed[index].next, kShadowed);
    if (samples == 1 && (before & kShadowed) == 0u)
      imageStore(mask_image, ivec2(int(index) % width, int(index) / width), vec4(0.0, float(map), 0.0, 0.0));
  }
}
