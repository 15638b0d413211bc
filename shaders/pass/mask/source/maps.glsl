// The maps of the frame's plan, a layer each.
#include "pass/common/frame_maps.glsl"

LightRecord lit_by() { return light_of_frame(); }
int map_at(Surface s, vec3 light) { return map_of_plan(s, light); }
float layer_of_map(int index) { return float(index); }
ShadowOptions options_of_map(int index) { return shadow_options(index); }
