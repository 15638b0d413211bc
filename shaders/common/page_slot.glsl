// The page whose texels are stored: in its level's numbers it is the first map.
#ifndef GNOMON_COMMON_PAGE_SLOT_GLSL
#define GNOMON_COMMON_PAGE_SLOT_GLSL
const int map = 0;
layout(location = 0) uniform int slot_layer;
layout(location = 1) uniform ivec4 slot;  // lower left corner, width, height
#endif
