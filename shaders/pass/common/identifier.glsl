// The number of the caster, or of the triangle, that a fragment belongs to: 1 and up, 0 of what casts no shadow.
#ifndef GNOMON_COMMON_IDENTIFIER_GLSL
#define GNOMON_COMMON_IDENTIFIER_GLSL
layout(std430, binding = 5) readonly buffer FirstTriangles { uint first_triangle[]; };  // by object; kNoCaster
layout(location = 9) uniform bool by_triangle;

const uint kNoCaster = 0xffffffffu;

uint identifier_of(uint object) {
  uint first = first_triangle[object];
  if (first == kNoCaster) return 0u;
  return 1u + (by_triangle ? first + uint(gl_PrimitiveID) : object);
}
#endif
