#version 450 core
// The light of one of many lights, added to that of the others.
#include "common/lit.glsl"

layout(location = 0) uniform vec4 brightness;
layout(location = 0) out vec4 light_out;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  light_out = s.sky ? vec4(0.0) : vec4(s.albedo * kSunColor * brightness.rgb * light_on(s, pixel), 0.0);
}
