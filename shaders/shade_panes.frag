#version 450 core
// The picture with light that panes have coloured.
#include "common/shade.glsl"

layout(binding = 7) uniform sampler2D transmittance_image;

vec3 transmitted(ivec2 pixel) { return texelFetch(transmittance_image, pixel, 0).rgb; }
