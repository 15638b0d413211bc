#version 450 core
// The shadow mask by a filter that reads the depth map itself.
#include "common/mask.glsl"

float visibility(ShadowLookup at, ShadowMap map, ShadowOptions options) {
  return shadow_visibility(shadow_compare, shadow_depth, at, options);
}
