// Moment shadow maps (Peters, Klein 2015): four moments of the kernel's depths bound the share that is lit.
#include "library/mean.glsl"
#include "library/moments.glsl"
#include "library/variance.glsl"

// Options: bounded, bleed, bias.
// In formats of 0..1 the moments go through a change of basis that makes use of all steps (Peters 2017): of the odd ones
// and of the even ones, whose ranges over -1..1 it maps to 0..1.
ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  float u = 2.0 * depth - 1.0, u2 = u * u;
  vec4 b = vec4(u, u2, u2 * u, u2 * u2);
  if (options.unsigned_unit) {
    b = vec4(0.5 + 1.5 * b.x - 2.0 * b.z, 4.0 * (b.y - b.w), 0.5 + 0.8660254 * b.x - 0.3849002 * b.z,
             0.5 * (b.y + b.w));
  }
  ShadowTexel texel;
  texel.v[0] = b;
  return texel;
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  vec4 b = texel.v[0];
  if (options.unsigned_unit) {
    vec2 odd = b.xz - 0.5;
    b = vec4(-0.33333333 * odd.x + 1.7320508 * odd.y, 0.125 * b.y + b.w, -0.75 * odd.x + 1.2990381 * odd.y,
             b.w - 0.125 * b.y);
  }
  // Towards the moments of depths spread out: what is stored has been rounded, and may be no moments at all.
  float bias = max(options.value[2], (options.unsigned_unit ? 8.0 : 64.0) * options.rounding);
  b = mix(b, vec4(0.0, 0.375, 0.0, 0.375), bias);
  // On a slanted plane half of the kernel lies in front of the point: the bound would be right, and dark.
  const float kSlant = 0.5;
  float u = 2.0 * min(at.depth - kSlant * dot(abs(at.depth_gradient), at.box), 1.0) - 1.0;
  vec2 z;
  float dark = options.value[0] > 0.5 ? share_in_front_bounded(b, u) : share_in_front(b, u, z);
  float lit = 1.0 - dark;
  return without_bleeding(lit < 1.0 ? max(lit, 0.0) : 1.0, options.value[1]);
}
