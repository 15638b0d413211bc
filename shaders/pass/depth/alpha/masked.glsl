// Alpha-masked casters: what the mask cuts out lets the light through.
#include "pass/common/alpha.glsl"
