// Power-law shadow maps (Gumbau, Szirmay-Kalos, Sbert, Chover 2011): least, mean and largest depth of the kernel make a
// distribution of its depths, which is read at the receiver. Channels: least, mean, largest of u = 2 depth - 1, or of the
// depth where only 0..1 can be stored.
#include "library/lookup.glsl"

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  texel.v[0] = vec4(vec3(options.unsigned_unit ? depth : 2.0 * depth - 1.0), 0.0);
  return texel;
}

ShadowTexel shadow_nothing(ShadowOptions options) {
  ShadowTexel sum;
  sum.v[0] = vec4(2.0, 0.0, -2.0, 0.0);  // any texel is nearer to 0
  return sum;
}

void shadow_join(inout ShadowTexel sum, ShadowTexel texel, float weight, ShadowOptions options) {
  const float kLeastWeight = 1e-4;  // what counts less is in the kernel by the rounding of its place alone
  sum.v[0].y += weight * texel.v[0].y;
  if (weight < kLeastWeight) return;
  sum.v[0].x = min(sum.v[0].x, texel.v[0].x);
  sum.v[0].z = max(sum.v[0].z, texel.v[0].z);
}

// 1 - (1 - below)^exponent, without the digits that are lost where the power is close to 1.
float one_less_power(float below, float exponent) {
  // log(1 - y) = -2 atanh(y / (2 - y)), whose series is good to 1e-8 up to here.
  float ratio = below / (2.0 - below), r2 = ratio * ratio;
  float series = -2.0 * ratio * (1.0 + r2 * (1.0 / 3.0 + r2 * (0.2 + r2 * (1.0 / 7.0 + r2 / 9.0))));
  float x = exponent * (below < 0.25 ? series : log(1.0 - below));
  if (x < -0.5) return 1.0 - exp(x);
  return -x * (1.0 + x / 2.0 * (1.0 + x / 3.0 * (1.0 + x / 4.0 * (1.0 + x / 5.0 * (1.0 + x / 6.0 * (1.0 + x / 7.0))))));
}

float power_lit(float least, float mean, float largest, float depth) {
  mean = min(max(mean, least), largest);
  if (!(depth > mean)) return 1.0;
  if (depth >= largest || mean == least) return 0.0;
  float range = largest - least;
  float exponent = (mean - least) / (largest - mean);
  return one_less_power((largest - depth) / range, exponent) / one_less_power((largest - mean) / range, exponent);
}

// Options: offset, two of the fall-off, longest offset (0: no limit).
float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  const float kRoundings = 4.0;  // of the mean, stored after each half of the blur, read and compared
  float depth = min(at.depth, 1.0);
  float value = options.unsigned_unit ? depth : 2.0 * depth - 1.0;
  float longest = options.value[3] > 0.0 ? (options.unsigned_unit ? 1.0 : 2.0) * options.value[3] : 2.0;
  float offset = min(options.value[0] * (texel.v[0].z - texel.v[0].x), longest) + kRoundings * options.rounding;
  float lit = power_lit(texel.v[0].x, texel.v[0].y, texel.v[0].z, value - offset);
  return lit < 1.0 ? max(lit, 0.0) : 1.0;  // not-a-number is lit
}
