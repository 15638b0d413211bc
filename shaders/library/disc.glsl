// Points spread over the unit disc, turned by an angle: for kernels of few samples whose error should look like noise.
#ifndef GNOMON_LIBRARY_DISC_GLSL
#define GNOMON_LIBRARY_DISC_GLSL
// A spiral of golden angles (Vogel 1979): even for every number of points.
vec2 vogel_point(int i, int count, float angle) {
  const float kGoldenAngle = 2.3999632;
  float a = float(i) * kGoldenAngle + angle;
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(a), sin(a));
}

// Blue noise whose first points are spread out, however many. Repeats after 64.
const vec2 kPoissonPoints[64] = vec2[](
#include "library/poisson_64.glsl"
);

vec2 poisson_point(int i, int count, float angle) {
  vec2 p = kPoissonPoints[i & 63];
  float c = cos(angle), s = sin(angle);
  return vec2(c * p.x - s * p.y, s * p.x + c * p.y);
}
#endif
