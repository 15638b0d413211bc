// The texels that a filter stores for the depth map, before any blur. The part <target> says where: map, place_in(), layer().
#ifndef GNOMON_STORE_STORED_GLSL
#define GNOMON_STORE_STORED_GLSL
#include "pass/common/filter.glsl"
#include <filter>

// A filter's look-up, which may read a second box, is compiled here as well; nothing calls it.
ShadowTexel shadow_mean(ShadowLookup at) {
  ShadowTexel none;
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) none.v[i] = vec4(0.0);
  return none;
}

layout(binding = 5) uniform sampler2DArray depth_map;
#include <target>

// Outside of the layer, or of the page, nothing casts.
float depth_at(ivec2 texel) {
  ivec4 inside_of = place_in(textureSize(depth_map, 0).xy);
  bool inside = all(greaterThanEqual(texel, inside_of.xy)) && all(lessThan(texel, inside_of.xy + inside_of.zw));
  return inside ? linear_depth(texelFetch(depth_map, ivec3(texel, layer()), 0).r, filtering.depth_curve[map].x) : 1.0;
}

float smaller_step(float before, float here, float after) {
  return abs(here - before) < abs(after - here) ? here - before : after - here;
}

// Change of depth per texel along y, or along x and y: of either side the one that changes less, so that no edge counts.
float slope_along_y(ivec2 texel, float here) {
  return smaller_step(depth_at(texel - ivec2(0, 1)), here, depth_at(texel + ivec2(0, 1)));
}
vec2 slope_at(ivec2 texel) {
  float here = depth_at(texel);
  return vec2(smaller_step(depth_at(texel - ivec2(1, 0)), here, depth_at(texel + ivec2(1, 0))),
              slope_along_y(texel, here));
}

ShadowTexel stored_at(ivec2 texel, ShadowOptions options) {
#if GNOMON_READS_SLOPE
  return shadow_store(depth_at(texel), slope_at(texel), options);
#else
  return shadow_store(depth_at(texel), vec2(0.0), options);
#endif
}
#endif
