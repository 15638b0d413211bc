// One look-up of an engine: gnomon's selection and matrices, one tap of the engine's own comparing sampler, and the bias that
// engine_bias translated.
#version 450
#extension GL_GOOGLE_include_directive : require
#define GNOMON_REVERSED_Z 1
#define GNOMON_SHADOW_VECTORS 1
#define GNOMON_SHAPES 0  // every map of this sample is linear
#include "library/lookup.glsl"
#include "library/select_map.glsl"
#include "library/shadow_block.glsl"

layout(std140, binding = 0) uniform Shadows {
  mat4 draw_clip_from_point[8];
  vec4 depth_bias[8];
  ShadowBlock shadows;
};
layout(binding = 1) uniform sampler2DArrayShadow compare_map;  // linear, GREATER_OR_EQUAL
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 surface_normal;
layout(location = 2) in float view_depth;
layout(location = 0) out vec4 color;
layout(location = 1) out float lit;

ShadowMap shadow_map(int index) { return shadows.maps[index]; }

float lit_share(vec3 light) {
  int index = map_serving(point, view_depth, light, shadows.layer.w, int(shadows.layer.z));
  if (index < 0) return 1.0;  // no map holds the point: nothing can shadow it
  MapPoint at = map_point(shadow_map(index), point);
  float depth = min(at.ndc.z - depth_bias[index].x, 1.0);
  return texture(compare_map, vec4(at.texel / shadows.layer.xy, index, texel_of_depth(depth)));
}

void main() {
  vec3 light = light_at(shadows.light, point);
  float cosine = max(-dot(normalize(surface_normal), light), 0.0);
  lit = cosine > 0.0 ? lit_share(light) : 0.0;
  vec3 linear = vec3(0.8, 0.77, 0.72) * (lit * cosine * vec3(1.0, 0.95, 0.85) + vec3(0.16, 0.19, 0.25) * (1.0 + 0.3 * surface_normal.y));
  color = vec4(pow(linear, vec3(1.0 / 2.2)), 1.0);
}
