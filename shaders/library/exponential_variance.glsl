// Depths warped by exponentials and the variance bound over them: shared by evsm2 and evsm4.
#ifndef GNOMON_LIBRARY_EXPONENTIAL_VARIANCE_GLSL
#define GNOMON_LIBRARY_EXPONENTIAL_VARIANCE_GLSL
#include "library/variance.glsl"

// exp(c u) of u = 2 depth - 1.
vec2 warped_moments(float depth, float c) {
  float w = exp(c * (2.0 * depth - 1.0));
  return vec2(w, w * w);
}

// The bound in one warp; `sign` -1 for the warp -exp(-c u), of which the moments of exp(-c u) are stored. `least`: a
// standard deviation, of the depth range.
float warped_bound(vec2 moments, float depth, float c, float sign, float least, float rounding) {
  const float kRoundings = 4.0;
  float u = 2.0 * depth - 1.0;
  float w = exp(sign * c * u);
  float mean = sign * moments.x, at = sign * w;
  if (!(at > mean)) return 1.0;
  // The warp's derivative takes the least deviation along.
  float floor_at = 2.0 * least * c * w;
  float variance = max(moments.y - mean * mean, max(floor_at * floor_at, kRoundings * rounding * moments.y));
  return chebyshev(mean, variance, at);
}
#endif
