// The depth that the rasterizer has, and the number of who is nearest.
#include "pass/common/identifier.glsl"
#include "pass/depth/texcoord.glsl"

layout(location = 1) flat in uint object;
layout(location = 0) out uint identifier;

void place_fragment() { identifier = identifier_of(object); }
