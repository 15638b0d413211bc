#version 450 core
// Which share of a pixel's samples does the light reach?
#include "pass/lists/lists.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1, rg32f) uniform image2D mask_image;
layout(location = 0) uniform int samples;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(mask_image);
  if (any(greaterThanEqual(pixel, size))) return;
  uint first = uint(pixel.y * size.x + pixel.x) * uint(samples);
  int lit = 0;
  for (int i = 0; i < samples; ++i) lit += (listed[first + uint(i)].next & kShadowed) == 0u ? 1 : 0;
  float map = imageLoad(mask_image, pixel).y;
  imageStore(mask_image, pixel, vec4(float(lit) / float(samples), map, 0.0, 0.0));
}
