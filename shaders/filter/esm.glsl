// Exponential shadow maps (Annen, Mertens, Seidel, Flerackers, Kautz 2008): exp(-c d) times the mean of exp(c z). A texel
// stores that mean where floats hold it (GNOMON_MEAN), else ln(mean of exp(c z)) / c, a soft maximum of depths, which never
// overflows.
#include "filter/option/esm.glsl"
#include "library/compare.glsl"
#include "library/depth_max.glsl"

#if GNOMON_MEAN
#include "library/mean.glsl"

// The middle of the depths is 1: the numbers use both signs of the exponent.
ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = vec4(exp(options.value[option_c] * (depth - 0.5)), 0.0, 0.0, 0.0);
  return texel;
}

float soft_maximum(ShadowTexel texel, float c) { return 0.5 + log(texel.v[0].x) / c; }
#else
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
  float c = options.value[option_c];
  // Relative to the larger of both, whose exponential is 1.
  bool behind = texel.v[0].x > sum.v[0].x;
  float other = exp(-c * abs(texel.v[0].x - sum.v[0].x));
  sum.v[0].x = max(sum.v[0].x, texel.v[0].x) + log((behind ? other : 1.0) + weight * (behind ? 1.0 : other)) / c;
}

// The same join as one weighted sum over a kernel, relative to the largest of its texels: one exponential for each texel,
// one logarithm for all.
#define SHADOW_JOINS_BY_SUM 1
vec4 shadow_term(vec4 texel, vec4 largest, ShadowOptions options) {
  return vec4(exp(options.value[option_c] * (texel.x - largest.x)), 0.0, 0.0, 0.0);
}
vec4 shadow_of_sum(vec4 sum, vec4 largest, ShadowOptions options) {
  return vec4(largest.x + log(sum.x) / options.value[option_c], 0.0, 0.0, 0.0);
}

float soft_maximum(ShadowTexel texel, float c) { return texel.v[0].x; }
#endif

// ln(sinh(s) / s) for s >= 0: how far a plane's exponentials' mean lies above its middle's.
float log_mean_over(float s) {
  return s < 0.5 ? s * s * (1.0 / 6.0 - s * s / 180.0) : s + log((1.0 - exp(-2.0 * s)) / (2.0 * s));
}

// Depth along the light of a texel's longest side, as stored.
float depth_of_texel_side(ShadowLookup at) {
  float depth = min(at.depth, 1.0), map_depth = depth_from_linear(depth, at.depth_curve);
  float scale = 1.0 + (1.0 - map_depth) * at.depth_curve;
  return texel_side(at) * abs((at.ray.z - map_depth * at.ray.w) / at.ray.y) * (1.0 + at.depth_curve) / (scale * scale);
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  const float kThreshold = 1.0, kLargestDepth = 2.0;
  float c = options.value[option_c], fallback = options.value[option_fallback];
  float epsilon = options.value[option_epsilon];
  float depth = min(at.depth, 1.0) - options.rounding;
  vec2 rise = abs(at.depth_gradient);
  float log_lit = c * (soft_maximum(texel, c) - depth) - log_mean_over(c * rise.x * at.box.x) - log_mean_over(c * rise.y * at.box.y);
  // The mean holds only where no texel of the kernel lies behind the receiver by more than slope bias and normal offset
  // lift it off its plane, up to half a texel of its rise each, and constant bias, by a share of a texel.
  const float kConstantBias = 0.1;  // texels: twice gnomon::BiasOptions' own
  float allowed = log(1.0 + epsilon) + c * (rise.x + rise.y + kConstantBias * depth_of_texel_side(at));
  bool fails = fallback == kThreshold && log_lit > allowed;
  const float kPyramidReach = 5.0;  // of its texels from the point, in half sides of the kernel
  if (fallback == kLargestDepth) {
    fails = depth + allowed / c + kPyramidReach * dot(rise, at.box) < depth_max_in(depth_max, at, at.box);
  }
  if (options.value[option_failures] > 0.5) return fails ? 0.0 : 1.0;
  float lit = fails ? compare_2x2(depth_map, at, at.texel) : exp(log_lit);  // not-a-number is lit
  return lit < 1.0 ? max(lit, 0.0) : 1.0;
}
