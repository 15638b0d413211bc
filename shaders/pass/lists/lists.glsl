// Lists of the pixels that look into each texel of a map.
#ifndef GNOMON_LISTS_LISTS_GLSL
#define GNOMON_LISTS_LISTS_GLSL
#include "pass/lists/light_frames.glsl"

// One pixel's point. Parallel light: two coordinates across the light, and the way along it. Local light: two slopes seen from
// the light, and the distance from it. Along the map's axis, rays far off it would lose more than they are lifted by.
struct ListedPixel {
  vec3 at;
  uint next;  // the list's next pixel plus 1, 0 at its end; kShadowed is added once something shadows the pixel
};
const uint kShadowed = 0x80000000u;

layout(std430, binding = 1) buffer ListedPixels { ListedPixel listed[]; };
#endif
