// By what to multiply lengths of any unit before they are multiplied with each other.
#ifndef GNOMON_COMMON_SCALE_GLSL
#define GNOMON_COMMON_SCALE_GLSL
// A power of two, which changes no digit: the largest component is then in 0.5..1, as far as there is such a power.
float scale_to_one(vec3 v) {
  v = abs(v);
  int exponent;
  frexp(max(max(v.x, v.y), v.z), exponent);
  return ldexp(1.0, clamp(-exponent, -126, 126));
}
#endif
