#version 450 core
// The share of each colour that reaches a pixel's surface through the panes before it, from the sums of its samples: the mean
// over those that the light reaches, so that its product with the mask is the light; over all where it reaches none.
#include "pass/lists/lists.glsl"
#include "pass/lists/listed_panes.glsl"
#include "pass/common/surface.glsl"

layout(location = 6) uniform int samples;
layout(location = 0) out vec4 transmittance_out;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  transmittance_out = vec4(1.0);
  if (surface_at(pixel).sky) return;
  uint first = uint(pixel.y * textureSize(position_image, 0).x + pixel.x) * uint(samples);
  vec3 lit = vec3(0.0), all_samples = vec3(0.0);
  int lit_count = 0;
  for (int i = 0; i < samples; ++i) {
    uint at = first + uint(i);
    vec3 passes = exp(-vec3(absorbed[3u * at], absorbed[3u * at + 1u], absorbed[3u * at + 2u]) / kAbsorbanceSteps);
    all_samples += passes;
    if ((listed[at].next & kShadowed) != 0u) continue;
    lit += passes;
    ++lit_count;
  }
  transmittance_out.rgb = lit_count > 0 ? lit / float(lit_count) : all_samples / float(samples);
}
