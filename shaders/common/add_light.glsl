// The light of one of many lights, added to that of the others. The includer supplies transmitted(), the share of each colour
// that panes let through.
#ifndef GNOMON_COMMON_ADD_LIGHT_GLSL
#define GNOMON_COMMON_ADD_LIGHT_GLSL
#include "common/lit.glsl"

layout(location = 0) uniform vec4 brightness;
layout(location = 0) out vec4 light_out;

vec3 transmitted(ivec2 pixel);

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  vec3 color = s.albedo * kSunColor * brightness.rgb * transmitted(pixel);
  light_out = s.sky ? vec4(0.0) : vec4(color * light_on(s, pixel), 0.0);
}
#endif
