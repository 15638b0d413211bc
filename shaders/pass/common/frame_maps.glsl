// The frame's maps, as library/select_map.glsl reads them.
#ifndef GNOMON_COMMON_FRAME_MAPS_GLSL
#define GNOMON_COMMON_FRAME_MAPS_GLSL
#include "pass/common/frame.glsl"

ShadowMap shadow_map(int index) { return frame.maps[index]; }
#endif
