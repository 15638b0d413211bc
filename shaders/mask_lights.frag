#version 450 core
// The shadow mask of one of many lights, by a filter that reads depths itself: all maps lie in the one layer of a pool. Its
// kernel stays within the map's border.
#define GNOMON_POOL
#include "common/mask.glsl"

float visibility(ShadowLookup at, ShadowMap map, ShadowOptions options) {
  return shadow_visibility(shadow_compare, shadow_depth, at, options);
}
