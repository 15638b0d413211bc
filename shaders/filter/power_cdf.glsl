// Power-law shadow maps (Gumbau, Szirmay-Kalos, Sbert, Chover 2011): least, mean and largest depth of the kernel make a
// distribution of its depths, which is read at the receiver. Channels of a layer: least, mean, largest of u = 2 depth - 1
// in it, or of the depth where only 0..1 can be stored.
#include "filter/option/power_cdf.glsl"
#include "library/lookup.glsl"

// Least and largest depths cannot be interpolated between texels; what they say of a receiver can.
#define SHADOW_INTERPOLATES 1

// Layers of depth have a vector each, and reach over half of their neighbours.
vec2 layer_ends(int layer) {
  float count = float(GNOMON_SHADOW_VECTORS);
  return vec2(max(float(layer) - 0.5, 0.0), min(float(layer) + 1.5, count)) / count;
}

// Beyond a layer's ends: its ends.
float value_in(vec2 ends, float depth, ShadowOptions options) {
  float within = clamp((depth - ends.x) / (ends.y - ends.x), 0.0, 1.0);
  return options.unsigned_unit ? within : 2.0 * within - 1.0;
}

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel;
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) {
    texel.v[i] = vec4(vec3(value_in(layer_ends(i), depth, options)), 0.0);
  }
  return texel;
}

ShadowTexel shadow_nothing(ShadowOptions options) {
  ShadowTexel sum;
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) sum.v[i] = vec4(2.0, 0.0, -2.0, 0.0);  // any texel is nearer to 0
  return sum;
}

vec4 joined_layer(vec4 sum, vec4 texel, float weight) {
  const float kLeastWeight = 1e-4;  // what counts less is in the kernel by the rounding of its place alone
  float mean = sum.y + weight * texel.y;
  if (weight < kLeastWeight) return vec4(sum.x, mean, sum.z, 0.0);
  return vec4(min(sum.x, texel.x), mean, max(sum.z, texel.z), 0.0);
}

void shadow_join(inout ShadowTexel sum, ShadowTexel texel, float weight, ShadowOptions options) {
  // A vector at a time: Mesa 22 was seen to lose what such a loop writes to parts of it, within a loop of taps.
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) sum.v[i] = joined_layer(sum.v[i], texel.v[i], weight);
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

float lit_in(int layer, vec4 texel, float depth, ShadowOptions options) {
  const float kRoundings = 4.0;  // of the mean, stored after each half of the blur, read and compared
  vec2 ends = layer_ends(layer);
  float scale = (options.unsigned_unit ? 1.0 : 2.0) / (ends.y - ends.x);
  float longest = options.value[option_longest] > 0.0 ? scale * options.value[option_longest] : 2.0;
  float offset = min(options.value[option_offset] * (texel.z - texel.x), longest) + kRoundings * options.rounding;
  float lit = power_lit(texel.x, texel.y, texel.z, value_in(ends, depth, options) - offset);
  return lit < 1.0 ? max(lit, 0.0) : 1.0;  // not-a-number is lit
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  float depth = min(at.depth, 1.0);
  // Whole in the middle of a layer, nothing in the middle of the next.
  float place = clamp(depth * float(GNOMON_SHADOW_VECTORS) - 0.5, 0.0, float(GNOMON_SHADOW_VECTORS - 1));
  float lit = 0.0;
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) {
    float share = max(1.0 - abs(place - float(i)), 0.0);
    if (share > 0.0) lit += share * lit_in(i, texel.v[i], depth, options);
  }
  return lit < 1.0 ? max(lit, 0.0) : 1.0;
}
