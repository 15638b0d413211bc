// Exponential shadow maps (Annen, Mertens, Seidel, Flerackers, Kautz 2008): exp(-c d) times the mean of exp(c z). What is
// stored is ln(mean of exp(c z)) / c, a soft maximum of depths, which never overflows.
#include "library/compare.glsl"
#include "library/depth_max.glsl"

// Options: c, fallback, epsilon.
ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = vec4(depth, 0.0, 0.0, 0.0);
  return texel;
}

ShadowTexel shadow_nothing(ShadowOptions options) {
  ShadowTexel sum;
  sum.v[0] = vec4(-1e30, 0.0, 0.0, 0.0);  // exp(c z) = 0
  return sum;
}

void shadow_join(inout ShadowTexel sum, ShadowTexel texel, float weight, ShadowOptions options) {
  float c = options.value[0];
  float largest = max(sum.v[0].x, texel.v[0].x);
  sum.v[0].x =
      largest + log(exp(c * (sum.v[0].x - largest)) + weight * exp(c * (texel.v[0].x - largest))) / c;
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  const float kThreshold = 1.0, kLargestDepth = 2.0;
  float c = options.value[0], fallback = options.value[1], epsilon = options.value[2];
  float depth = min(at.depth, 1.0) - options.rounding;
  float lit = exp(c * (texel.v[0].x - depth));
  // The mean holds only where no texel of the kernel lies behind the receiver.
  bool fails = fallback == kThreshold && lit > 1.0 + epsilon;
  if (fallback == kLargestDepth) fails = depth + log(1.0 + epsilon) / c < depth_max_in(depth_max, at, at.box);
  if (fails) return compare_2x2(depth_map, at, at.texel);
  return lit < 1.0 ? max(lit, 0.0) : 1.0;
}
