#version 450 core
// Alpha-masked casters: the depth, and the number of who is nearest.
#include "common/alpha.glsl"
#include "common/identifier.glsl"

layout(location = 0) in vec2 texcoord;
layout(location = 1) flat in uint object;
layout(location = 0) out uint identifier;

void main() {
  if (is_cut_out(texcoord)) discard;
  identifier = identifier_of(object);
}
