// How much of a distribution with four given moments must lie in front of a depth (Peters, Klein 2015). Depths are
// u = 2 depth - 1: odd and even moments then part, and numbers stay small.
#ifndef GNOMON_LIBRARY_MOMENTS_GLSL
#define GNOMON_LIBRARY_MOMENTS_GLSL
#include "library/lookup.glsl"

// In formats of 0..1 the moments go through a change of basis that makes use of all steps (Peters 2017): of the odd ones
// and of the even ones, whose ranges over -1..1 it maps to 0..1.
ShadowTexel store_four_moments(float depth, ShadowOptions options) {
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

// The widest distribution whose moments are these.
const vec4 kSpreadOut = vec4(0.0, 0.375, 0.0, 0.375);

// Four moments as four numbers of 0..1 that may be rounded apart and still are moments: the two depths of the only
// distribution of two depths with the first three, the share of the farther one, and the root of where the fourth lies
// between the least and the largest that depths of -1..1 allow. After Peters 2017, "Non-linearly quantized moment shadow maps".
vec2 range_of_fourth(vec2 z, float share) {
  vec2 z2 = z * z;
  float mean = mix(z.x, z.y, share), second = mix(z2.x, z2.y, share), third = mix(z.x * z2.x, z.y * z2.y, share);
  float most = second - (mean - third) * (mean - third) / max(1.0 - second, 1e-7);
  float least = mix(z2.x * z2.x, z2.y * z2.y, share);
  return vec2(least, max(most, least));
}

vec4 packed_moments(vec4 b) {
  const float kFlat = 8.0 / 16777216.0;  // a variance that is all rounding: one depth
  float mean = clamp(b.x, -1.0, 1.0), variance = b.y - mean * mean;
  if (!(variance > kFlat)) return vec4(vec2(0.5 * mean + 0.5), 0.5, 0.0);
  float half_skew = 0.5 * (b.z - mean * (3.0 * b.y - 2.0 * mean * mean)) / variance;
  float root = sqrt(half_skew * half_skew + variance);
  float away = half_skew + (half_skew > 0.0 ? root : -root), near = -variance / away;
  vec2 z = clamp(mean + vec2(min(away, near), max(away, near)), -1.0, 1.0);
  float share = clamp((mean - z.x) / max(z.y - z.x, 1e-7), 0.0, 1.0);
  vec2 range = range_of_fourth(z, share);
  float spread = clamp((b.w - range.x) / max(range.y - range.x, 1e-7), 0.0, 1.0);
  return vec4(0.5 * z + 0.5, share, sqrt(spread));
}

vec4 unpacked_moments(vec4 stored) {
  vec2 z = 2.0 * stored.xy - 1.0, z2 = z * z, range = range_of_fourth(z, stored.z);
  return vec4(mix(z.x, z.y, stored.z), mix(z2.x, z2.y, stored.z), mix(z.x * z2.x, z.y * z2.y, stored.z),
              mix(range.x, range.y, stored.w * stored.w));
}

// The moments of a stored texel, moved by a share towards those of depths spread out: what is stored has been rounded, and
// may be no moments at all.
vec4 moments_of(ShadowTexel texel, ShadowOptions options, float bias, float roundings) {
  vec4 b = texel.v[0];
  if (options.unsigned_unit) {
    vec2 odd = b.xz - 0.5;
    b = vec4(-0.33333333 * odd.x + 1.7320508 * odd.y, 0.125 * b.y + b.w, -0.75 * odd.x + 1.2990381 * odd.y,
             b.w - 0.125 * b.y);
  }
  return mix(b, kSpreadOut, max(bias, roundings * options.rounding));
}

// On a slanted plane half of the kernel lies in front of the point: the bound would be right, and dark.
float receiver_of_moments(ShadowLookup at, vec2 box) {
  const float kSlant = 0.5;
  return 2.0 * min(at.depth - kSlant * dot(abs(at.depth_gradient), box), 1.0) - 1.0;
}

// Least share in front of u, for any support: Hamburger's problem. Also returns the other two depths, z, of the
// extreme distribution, for the bound below.
float share_in_front(vec4 b, float u, out vec2 z) {
  // Cholesky factors of the Hankel matrix (1 b1 b2; b1 b2 b3; b2 b3 b4).
  float d22 = b.y - b.x * b.x;
  float l32_d22 = b.z - b.x * b.y;
  float d33_d22 = (b.w - b.y * b.y) * d22 - l32_d22 * l32_d22;
  float l32 = l32_d22 / d22;
  // c = Hankel^-1 (1, u, u^2): its polynomial has the other two depths as roots.
  float c1 = u - b.x;
  float c2 = u * u - b.y - l32 * c1;
  c1 /= d22;
  c2 *= d22 / d33_d22;
  c1 -= l32 * c2;
  float c0 = 1.0 - b.x * c1 - b.y * c2;
  float p = c1 / c2, q = c0 / c2;
  float root = sqrt(max(0.25 * p * p - q, 0.0));
  // The root that is nearer to 0 as a quotient: as a difference it would be rounding where p is large.
  float away = -0.5 * p + (p > 0.0 ? -root : root);
  float near = root > 0.0 ? q / away : away;
  z = vec2(min(near, away), max(near, away));
  if (u <= z.x) return 0.0;
  // Weight of z.x, or all but that of u, where u lies between or behind both: by Lagrange's polynomial.
  if (u <= z.y) return (z.y * u - b.x * (z.y + u) + b.y) / ((z.x - u) * (z.x - z.y));
  return 1.0 - (z.x * z.y - b.x * (z.x + z.y) + b.y) / ((u - z.x) * (u - z.y));
}

// The same when all depths are known to lie in -1..1: Hausdorff's problem. Where Hamburger's extreme distribution leaves
// that range, the extreme one has depths -1, u, 1 and a free one.
float share_in_front_bounded(vec4 b, float u) {
  vec2 z;
  float unbounded = share_in_front(b, u, z);
  if (z.x >= -1.0 && z.y <= 1.0) return unbounded;
  float free_at = (b.y - b.w - u * (b.x - b.z)) / (b.x - b.z - u * (1.0 - b.y));
  // Weights of -1 and of the free depth, by Lagrange's polynomials over the four.
  float first = (b.z - b.y * (u + free_at + 1.0) + b.x * (u * free_at + u + free_at) - u * free_at) /
                ((-1.0 - u) * (-1.0 - free_at) * -2.0);
  float free_weight = (b.z - b.y * u - b.x + u) / ((free_at + 1.0) * (free_at - u) * (free_at - 1.0));
  return free_at < u ? first + free_weight : first;
}
#endif
