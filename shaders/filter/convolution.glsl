// Convolution shadow maps (Annen, Mertens, Bekaert, Seidel, Kautz 2007): the comparison as a Fourier series whose terms
// part into one of the map, which is blurred, and one of the receiver. Channels 2 k - 2 and 2 k - 1 hold cos(c_k z) and
// sin(c_k z), c_k = pi (2 k - 1).
#include "filter/option/convolution.glsl"
#include "library/mean.glsl"

const float kPi = 3.14159265;

int fourier_order(ShadowOptions options) { return min(int(options.value[option_order] + 0.5), 2 * GNOMON_SHADOW_VECTORS); }

// Part of the period that depths 0..1 take: the largest difference must not reach the series' next step. A
// longer fall-off takes a smaller part.
float fourier_range(ShadowOptions options) {
  float given_up = min((options.value[option_offset] + 3.5) * 0.5 / options.value[option_order], 0.25);
  return (1.0 - given_up) / (1.0 + options.value[option_widening]);
}

vec2 turned(vec2 a, vec2 by) { return vec2(a.x * by.x - a.y * by.y, a.x * by.y + a.y * by.x); }

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel = shadow_nothing(options);
  float angle = kPi * fourier_range(options) * depth;
  // From term to term the angle grows by twice the first: one sine and cosine for all.
  vec2 basis = vec2(cos(angle), sin(angle));
  vec2 twice = turned(basis, basis);
  // All that fit, in a loop that compilers unroll: the look-up takes as many as the order has.
  for (int k = 0; k < 2 * GNOMON_SHADOW_VECTORS; ++k) {
    vec2 kept = options.unsigned_unit ? 0.5 * basis + 0.5 : basis;
    if ((k & 1) == 0) {
      texel.v[k >> 1].xy = kept;
    } else {
      texel.v[k >> 1].zw = kept;
    }
    basis = turned(basis, twice);
  }
  return texel;
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  int order = fourier_order(options);
  float offset = options.value[option_offset] * 0.5 / options.value[option_order];
  // On a slanted plane half of the kernel lies in front of the point, and its share would be right, and dark.
  const float kSlant = 0.5;
  float depth = min(at.depth - kSlant * dot(abs(at.depth_gradient), at.box), 1.0);
  float angle = kPi * (fourier_range(options) * depth - offset);
  vec2 receiver = vec2(cos(angle), sin(angle));
  vec2 twice = turned(receiver, receiver);
  float sum = 0.5;
  for (int k = 0; k < order; ++k) {
    vec2 basis = (k & 1) == 0 ? texel.v[k >> 1].xy : texel.v[k >> 1].zw;
    if (options.unsigned_unit) basis = 2.0 * basis - 1.0;
    float share = float(k + 1) / options.value[option_order];
    float weight = 2.0 * exp(-options.value[option_attenuation] * share * share) / (kPi * float(2 * k + 1));
    sum += weight * (receiver.x * basis.y - receiver.y * basis.x);
    receiver = turned(receiver, twice);
  }
  float lit = options.value[option_scale] * sum;
  return lit < 1.0 ? max(lit, 0.0) : 1.0;  // not-a-number is lit
}
