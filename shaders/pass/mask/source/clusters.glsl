// The maps of `own_light`, one of the many lights of a cluster, all of whose maps lie in the one layer of a pool.
#include "pass/common/frame.glsl"

struct OwnLight {
  LightRecord record;
  vec4 brightness;  // by channel; index of its first map
};
layout(std430, binding = 2) readonly buffer OwnLights { OwnLight own_lights[]; };
layout(std430, binding = 3) readonly buffer PoolMaps { ShadowMap pool_maps[]; };

OwnLight own_light;  // the one that is being read

LightRecord lit_by() { return own_light.record; }
int map_at(Surface s, vec3 light) { return map_of_plan(s, light); }
ShadowMap shadow_map(int index) { return pool_maps[int(own_light.brightness.w) + index]; }
float layer_of_map(int index) { return 0.0; }
ShadowOptions options_of_map(int index) { return shadow_options(0); }
