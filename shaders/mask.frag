#version 450 core
// How much of the light reaches each pixel's surface, and through which map that was found out.
#include "common/map_geometry.glsl"
#include "common/surface.glsl"
#include <filter>

layout(binding = 4) uniform sampler2DArrayShadow shadow_compare;
layout(binding = 5) uniform sampler2DArray shadow_map;
layout(location = 0) out vec2 mask;  // 1 lit .. 0 in shadow; map or -1

void main() {
  Surface s = surface_at(ivec2(gl_FragCoord.xy));
  mask = vec2(1.0, -1.0);
  if (s.sky) return;
  int map = map_for(s.position, s.depth);
  bool faces_light = dot(s.normal, frame.light.xyz) < 0.0;
  mask = vec2(faces_light || frame.light.w == 0.0 ? 1.0 : 0.0, float(map));
  if (map < 0 || !faces_light) return;
  ShadowReceiver r = shadow_receiver(map, s.position, s.normal);
  ShadowLookup at = ShadowLookup(r.texel, float(map), r.depth, r.depth_gradient, frame.layer.xy);
  mask.x = shadow_visibility(shadow_compare, shadow_map, at, ShadowParameters(frame.layer.z));
}
