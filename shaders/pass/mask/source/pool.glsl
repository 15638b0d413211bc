// The maps of the frame's light, one of many, all of whose maps lie in the one layer of a pool.
#include "pass/common/frame_maps.glsl"

LightRecord lit_by() { return light_of_frame(); }
int map_at(Surface s, vec3 light) { return map_of_plan(s, light); }
float layer_of_map(int index) { return 0.0; }
ShadowOptions options_of_map(int index) { return shadow_options(index); }
