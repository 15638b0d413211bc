// Panes before surfaces, which have coloured the light.
layout(binding = 7) uniform sampler2D transmittance_image;

vec3 transmitted(ivec2 pixel) { return texelFetch(transmittance_image, pixel, 0).rgb; }
