// Which fragments of an alpha-masked surface are there. The finest image always: smaller ones lose coverage, and camera
// and light must see the same surface.
#ifndef GNOMON_COMMON_ALPHA_GLSL
#define GNOMON_COMMON_ALPHA_GLSL
layout(binding = 3) uniform sampler2D color_image;
layout(location = 1) uniform vec4 base_color;
layout(location = 2) uniform float alpha_cutoff;

bool is_cut_out(vec2 texcoord) { return textureLod(color_image, texcoord, 0.0).a * base_color.a < alpha_cutoff; }
#endif
