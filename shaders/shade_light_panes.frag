#version 450 core
// The light of one of many lights that panes have coloured.
#include "common/add_light.glsl"

layout(binding = 7) uniform sampler2D transmittance_image;

vec3 transmitted(ivec2 pixel) { return texelFetch(transmittance_image, pixel, 0).rgb; }
