// Behind the first surface of its texel: the second surface is what is left in front.
#include "pass/depth/even_depth.glsl"
#include "pass/depth/texcoord.glsl"

layout(binding = 5) uniform sampler2DArray first_surface;
// Casters without thickness: each of their surfaces is its own second one.
layout(location = 5) uniform bool sheet;

bool is_peeled_off() {
  // Surfaces that rounding alone parts are one: the rasterizer's depth is good to a few units of 2^-24.
  const float kRounding = 4.0 / 16777216.0;
  float first = texelFetch(first_surface, ivec3(gl_FragCoord.xy, 0), 0).r;
  float own = fragment_depth();
  return sheet ? own < first - kRounding : own <= first + kRounding;
}

void place_fragment() {
  if (is_peeled_off()) discard;
  gl_FragDepth = fragment_depth();
}
