#version 450 core
// The light of one of many lights, added to that of the others. The part <panes> says which share of each colour panes let
// through: transmitted().
#include "pass/shade/lit.glsl"
#include <panes>

layout(location = 0) uniform vec4 brightness;
layout(location = 0) out vec4 light_out;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  vec3 color = s.albedo * kSunColor * brightness.rgb * transmitted(pixel);
  light_out = s.sky ? vec4(0.0) : vec4(color * light_on(light_of_frame(), s, pixel), 0.0);
}
