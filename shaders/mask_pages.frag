#version 450 core
// The shadow mask from pages, by a filter that reads depths itself. Its kernel stays within the page's border.
#define GNOMON_PAGES
#include "common/pages.glsl"
#include "common/mask.glsl"

float visibility(ShadowLookup at, ShadowMap map, ShadowOptions options) {
  return shadow_visibility(shadow_compare, shadow_depth, at, options);
}
