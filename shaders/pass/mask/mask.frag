#version 450 core
// The shadow mask: how much of the light reaches each pixel's surface, and which map that comes from.
#include "pass/mask/look_up.glsl"

void main() {
  Surface s = surface_at(ivec2(gl_FragCoord.xy));
  mask = s.receives ? mask_of(s) : vec2(1.0, -1.0);
}
