#version 450 core
// The aliasing error as a colour: warm where one texel covers several pixels (undersampled), cold where several texels
// share a pixel, white where they match. Mirrored by heat_color in picture.cpp, which draws the legend.
#include "pass/common/frame.glsl"
#include "pass/common/surface.glsl"

layout(binding = 6) uniform sampler2D mask_image;
layout(binding = 7) uniform sampler2D aliasing_image;
layout(location = 0) out vec4 color_out;

// sRGB stops at log2 m = -4, -3 .. 4.
const vec3 kStops[9] = vec3[](vec3(0.110, 0.078, 0.353), vec3(0.141, 0.220, 0.573), vec3(0.161, 0.443, 0.710),
                              vec3(0.478, 0.710, 0.843), vec3(0.961, 0.961, 0.949), vec3(0.992, 0.804, 0.439),
                              vec3(0.957, 0.514, 0.220), vec3(0.808, 0.196, 0.149), vec3(0.463, 0.039, 0.118));

vec3 heat_color(float m) {
  float at = clamp(log2(m), -4.0, 4.0) + 4.0;
  int i = min(int(at), 7);
  return mix(kStops[i], kStops[i + 1], at - float(i));
}

vec3 linear_from_srgb(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c)); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  vec4 aliasing = texelFetch(aliasing_image, pixel, 0);
  vec3 color = vec3(0.62);  // sky
  if (!s.sky) {
    bool judged = aliasing.w >= 0.0 && aliasing.x > 0.0;
    // A little light and shadow, so that one sees what is where.
    float cosine = max(-dot(s.shading_normal, light_at(frame.light_place, s.position)), 0.0);
    float shape = 0.90 + 0.10 * texelFetch(mask_image, pixel, 0).r * cosine;
    float facing = abs(dot(s.shading_normal, normalize(s.position)));
    color = judged ? heat_color(aliasing.x) * shape : vec3(0.36 + 0.10 * facing);
  }
  color_out = vec4(linear_from_srgb(color), 1.0);
}
