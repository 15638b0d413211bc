// A filter that reads depths itself. Its kernel stays within the border of a page or of a map in a pool.

layout(binding = 8) uniform sampler2DArray shadow_points;

// As pass/depth/silhouette.frag stores them.
vec2 shadow_silhouette(ShadowLookup at, vec2 texel) {
  return textureLod(shadow_points, vec3((texel + 0.5) / at.layer_size, at.layer), 0.0).rg * (255.0 / 254.0);
}

float visibility(ShadowLookup at, ShadowMap map, ShadowOptions options) {
  return shadow_visibility(shadow_compare, shadow_depth, at, options);
}
