#version 450 core
// Alpha-masked casters: what the mask cuts out lets the light through.
#include "common/alpha.glsl"

layout(location = 0) in vec2 texcoord;

void main() {
  if (is_cut_out(texcoord)) discard;
}
