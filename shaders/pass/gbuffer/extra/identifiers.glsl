// The numbers that maps know the surfaces by.
#include "pass/common/identifier.glsl"

layout(location = 3) flat in uint object;
layout(location = 3) out uint identifier_out;

void store_extra(vec3 geometric) { identifier_out = identifier_of(object); }
