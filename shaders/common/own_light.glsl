// One of many lights, all of whose maps lie in one pool: what frames of a single light have in their block.
#ifndef GNOMON_COMMON_OWN_LIGHT_GLSL
#define GNOMON_COMMON_OWN_LIGHT_GLSL
#include "library/shadow_map.glsl"

struct OwnLight {
  vec4 light;        // as the frame's members of these names
  vec4 light_place;
  vec4 light_cone;
  vec4 bias;
  vec4 layer;
  vec4 selection;
  vec4 brightness;   // by channel; index of its first map
};
layout(std430, binding = 2) readonly buffer OwnLights { OwnLight own_lights[]; };
layout(std430, binding = 3) readonly buffer PoolMaps { ShadowMap pool_maps[]; };

OwnLight own_light;  // the one that is being read
ShadowMap shadow_map(int index) { return pool_maps[int(own_light.brightness.w) + index]; }
float layer_of_map(int index) { return 0.0; }
#endif
