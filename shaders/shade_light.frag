#version 450 core
// The light of one of many lights without panes.
#include "common/add_light.glsl"

vec3 transmitted(ivec2 pixel) { return vec3(1.0); }
