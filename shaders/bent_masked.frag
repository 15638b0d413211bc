#version 450 core
// Alpha-masked casters into a map whose shape bends lines.
#include "common/alpha.glsl"
#include "common/bent.glsl"

layout(location = 3) flat in vec2 texcoord[3];

void main() {
  vec3 weights = covered();
  if (is_cut_out(weights.x * texcoord[0] + weights.y * texcoord[1] + weights.z * texcoord[2])) discard;
}
