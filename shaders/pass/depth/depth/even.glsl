// Into a map of even depths.
#include "pass/depth/even_depth.glsl"
#include "pass/depth/texcoord.glsl"

void place_fragment() { gl_FragDepth = fragment_depth(); }
