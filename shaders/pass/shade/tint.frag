#version 450 core
// The picture, tinted by the map that serves each pixel.
#include "pass/common/surface.glsl"

layout(binding = 6) uniform sampler2D mask_image;
layout(binding = 7) uniform sampler2D color_image_lit;
layout(location = 0) out vec4 color_out;

const vec3 kTints[8] = vec3[](vec3(1.0, 0.28, 0.22), vec3(0.30, 0.85, 0.28), vec3(0.25, 0.48, 1.0),
                              vec3(1.0, 0.80, 0.15), vec3(0.85, 0.35, 0.95), vec3(0.20, 0.85, 0.85),
                              vec3(1.0, 0.55, 0.20), vec3(0.65, 0.65, 0.65));

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 lit = texelFetch(color_image_lit, pixel, 0).rgb;
  Surface s = surface_at(pixel);
  int map = int(texelFetch(mask_image, pixel, 0).g);
  float luma = dot(lit, vec3(0.2126, 0.7152, 0.0722));
  vec3 tint = map < 0 ? vec3(1.0) : kTints[map % 8];
  color_out = vec4(s.sky ? lit : mix(lit, vec3(luma) * (0.35 + 1.1 * tint), 0.72), 1.0);
}
