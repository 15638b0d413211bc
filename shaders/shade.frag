#version 450 core
// The picture without panes.
#include "common/shade.glsl"

vec3 transmitted(ivec2 pixel) { return vec3(1.0); }
