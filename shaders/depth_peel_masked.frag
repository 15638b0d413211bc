#version 450 core
// Alpha-masked casters behind the first surface.
#include "common/alpha.glsl"
#include "common/peel.glsl"

layout(location = 0) in vec2 texcoord;

void main() {
  if (is_peeled_off() || is_cut_out(texcoord)) discard;
  gl_FragDepth = fragment_depth();
}
