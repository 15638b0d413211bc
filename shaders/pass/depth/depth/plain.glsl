// The depth that the rasterizer has.
#include "pass/depth/texcoord.glsl"

void place_fragment() {}
