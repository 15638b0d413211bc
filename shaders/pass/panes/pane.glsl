// How much light passes a pane: gnomon::transmittance of its material.
#ifndef GNOMON_PANES_PANE_GLSL
#define GNOMON_PANES_PANE_GLSL
layout(binding = 3) uniform sampler2D color_image;
layout(location = 1) uniform vec4 base_color;
layout(location = 2) uniform float alpha_cutoff;
layout(location = 4) uniform vec2 look;  // transmission; AlphaMode

vec3 pane_transmittance(vec2 texcoord) {
  const float kMask = 1.0, kBlend = 2.0;
  vec4 color = textureLod(color_image, texcoord, 0.0) * base_color;
  float covered = look.y == kBlend ? color.a : 1.0;
  if (look.y == kMask && color.a < alpha_cutoff) covered = 0.0;
  return vec3(1.0 - covered) + color.rgb * (covered * look.x);
}
#endif
