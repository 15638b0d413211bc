#version 450 core
// Opaque casters against the pixels of a texel's list.
#include "common/irregular_test.glsl"

bool is_there(vec3 weights) { return true; }

void main() { test_list(); }
