#version 450 core
// The picture of many lights: their sum, the sky's light, a little air in the distance.
#include "pass/shade/lit.glsl"

layout(binding = 7) uniform sampler2D light_sum;
layout(location = 0) uniform float sky;   // share of the sky's light
layout(location = 0) out vec4 color_out;  // written through sRGB encoding

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  vec3 ray = view_ray(gl_FragCoord.xy);
  vec3 light = frame.light.xyz;
  if (s.sky) {
    color_out = vec4(display_from_scene(sky * sky_color(ray, light)), 1.0);
    return;
  }
  vec3 color = texelFetch(light_sum, pixel, 0).rgb + s.albedo * sky * sky_ambient(s.shading_normal);
  color_out = vec4(display_from_scene(mix(color, through_air(color, s, ray, light), sky)), 1.0);
}
