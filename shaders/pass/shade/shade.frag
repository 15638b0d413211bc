#version 450 core
// The picture: sun where the mask lets it through, sky everywhere, a little air in the distance. The part <panes> says which share
// of each colour panes let through: transmitted().
#include "pass/shade/lit.glsl"
#include <panes>

layout(location = 0) out vec4 color_out;  // written through sRGB encoding

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  vec3 ray = view_ray(gl_FragCoord.xy);
  vec3 light = frame.light.xyz;
  if (s.sky) {
    color_out = vec4(display_from_scene(sky_color(ray, light)), 1.0);
    return;
  }
  const float kDusk = 0.3;  // share of the sky's light that is left under a local light
  float sky = is_local_light(light_of_frame()) ? kDusk : 1.0;
  vec3 sun = kSunColor * light_on(light_of_frame(), s, pixel) * transmitted(pixel);
  vec3 color = s.albedo * (sun + sky * sky_ambient(s.shading_normal));
  color_out = vec4(display_from_scene(through_air(color, s, ray, light)), 1.0);
}
