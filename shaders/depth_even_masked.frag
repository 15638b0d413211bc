#version 450 core
// Alpha-masked casters into a map of even depths.
#include "common/alpha.glsl"
#include "common/even_depth.glsl"

layout(location = 0) in vec2 texcoord;

void main() {
  if (is_cut_out(texcoord)) discard;
  gl_FragDepth = fragment_depth();
}
