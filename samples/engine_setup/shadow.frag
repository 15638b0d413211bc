// A complete look-up of an engine: the lit share of one pixel, by percentage-closer filtering. Bindings, names and inputs are
// the engine's own. Points are relative to the camera position (ShadowPlan::origin_world).
//   glslangValidator -V -I/usr/share/gnomon/shaders shadow.frag
#version 450
#extension GL_GOOGLE_include_directive : require
#define GNOMON_SHADOW_VECTORS 1  // filters that compare depths store nothing
#include "filter/pcf.glsl"
#include "library/receiver.glsl"
#include "library/select_map.glsl"
#include "library/shadow_block.glsl"

layout(std140, binding = 0) uniform Shadows { ShadowBlock shadows; };  // filled by gnomon::shader_block
layout(binding = 1) uniform sampler2DArray depth_map;                  // nearest texel, clamped to the edge
layout(binding = 2) uniform sampler2DArrayShadow compare_map;          // linear, LESS_OR_EQUAL
layout(location = 0) in vec3 point;
layout(location = 1) in vec3 normal;  // of the triangle, towards the viewer
layout(location = 2) in float view_depth;
layout(location = 0) out vec4 color;

ShadowMap shadow_map(int index) { return shadows.maps[index]; }

float lit_share() {
  vec3 n = normalize(normal);
  vec3 light = light_at(shadows.light, point);
  if (dot(n, light) >= 0.0) return 0.0;  // turned away from the light
  int index = map_serving(point, view_depth, light, shadows.layer.w, int(shadows.layer.z));
  if (index < 0) return 1.0;  // no map holds the point: nothing can shadow it
  ShadowMap map = shadow_map(index);
  ShadowLookup at = shadow_lookup(map, float(index), shadows.layer.xy, ShadowSurface(point, n, shadows.light), shadows.bias);
  set_kernel(at, map, ShadowKernel(1.0, false, false), mat2(0.0));  // a kernel of 3 x 3 texels
  ShadowOptions options;
  for (int i = 0; i < 16; ++i) options.value[i] = 0.0;  // pcf: a box
  options.rounding = 0.0;
  options.unsigned_unit = false;
  return shadow_visibility(compare_map, depth_map, at, options);
}

void main() { color = vec4(vec3(lit_share()), 1.0); }
