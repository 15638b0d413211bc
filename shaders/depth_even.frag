#version 450 core
// Opaque casters into a map of even depths.
#include "common/even_depth.glsl"

void main() { gl_FragDepth = fragment_depth(); }
