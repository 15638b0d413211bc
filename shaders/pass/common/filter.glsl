// The filter's settings, and the blur that stored texels go through.
#ifndef GNOMON_COMMON_FILTER_GLSL
#define GNOMON_COMMON_FILTER_GLSL
#include "library/lookup.glsl"

const int kTapVectors = 9;  // weights of the taps 0..35 to either side

const int kOptionVectors = 4;

layout(std140, binding = 1) uniform Filter {
  vec4 kernel;      // radius; 1: in world units; 1: averages over the pixel, 2: kernels cover it; rounding of the format
  vec4 sums;        // steps of a summed-area table per 1; 1: the format stores only 0..1; reads along a long footprint; 1: no receiver plane
  ivec4 reach[GNOMON_MAX_MAPS];                     // per map: taps to either side of the middle one
  vec4 options[GNOMON_MAX_MAPS * kOptionVectors];  // per map: FilterSettings::option
  vec4 weights[GNOMON_MAX_MAPS * kTapVectors];  // per map: of the taps, from the middle on
  vec4 depth_curve[GNOMON_MAX_MAPS];            // per map: see linear_depth
} filtering;

ShadowOptions shadow_options(int map) {
  ShadowOptions options;
  for (int i = 0; i < 4 * kOptionVectors; ++i) options.value[i] = filtering.options[map * kOptionVectors + i / 4][i & 3];
  options.rounding = filtering.kernel.w;
  options.unsigned_unit = filtering.sums.y > 0.5;
  return options;
}

float tap_weight(int map, int distance_to_middle) {
  return filtering.weights[map * kTapVectors + distance_to_middle / 4][distance_to_middle & 3];
}
#endif
