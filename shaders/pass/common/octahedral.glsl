// Unit vectors in two numbers (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
// Vectors").
#ifndef GNOMON_COMMON_OCTAHEDRAL_GLSL
#define GNOMON_COMMON_OCTAHEDRAL_GLSL
vec2 octahedral_from_unit(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return n.z >= 0.0 ? p : folded;
}

vec3 unit_from_octahedral(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  vec2 folded = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
  return normalize(n.z >= 0.0 ? n : vec3(folded, n.z));
}
#endif
