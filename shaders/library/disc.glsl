// Points spread over the unit disc, turned by an angle: for kernels of few samples whose error should look like noise.
#ifndef GNOMON_LIBRARY_DISC_GLSL
#define GNOMON_LIBRARY_DISC_GLSL
// A spiral of golden angles (Vogel 1979): even for every number of points. Point i lies along the direction that has been
// turned i times, at vogel_radius(i, count): a sine and a cosine for all points, not for each.
vec2 vogel_first(float angle) { return vec2(cos(angle), sin(angle)); }
vec2 vogel_turned(vec2 direction) {
  const vec2 kTurn = vec2(-0.73736886, 0.67549032);  // cosine and sine of the golden angle
  return vec2(direction.x * kTurn.x - direction.y * kTurn.y, direction.x * kTurn.y + direction.y * kTurn.x);
}
float vogel_radius(int i, int count) { return sqrt((float(i) + 0.5) / float(count)); }

// Blue noise whose first points are spread out, however many. Repeats after 64.
const vec2 kPoissonPoints[64] = vec2[](
#include "library/poisson_64.glsl"
);

// `direction`: cosine and sine of the angle.
vec2 poisson_point(int i, vec2 direction) {
  vec2 p = kPoissonPoints[i & 63];
  return vec2(direction.x * p.x - direction.y * p.y, direction.y * p.x + direction.x * p.y);
}
#endif
