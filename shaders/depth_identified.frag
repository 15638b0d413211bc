#version 450 core
// Opaque casters: the depth, and the number of who is nearest.
#include "common/identifier.glsl"

layout(location = 1) flat in uint object;
layout(location = 0) out uint identifier;

void main() { identifier = identifier_of(object); }
