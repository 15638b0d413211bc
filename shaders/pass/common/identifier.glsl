// The number of the caster, or of the triangle, that a fragment belongs to: 1 and up, 0 is none.
#ifndef GNOMON_COMMON_IDENTIFIER_GLSL
#define GNOMON_COMMON_IDENTIFIER_GLSL
layout(std430, binding = 5) readonly buffer FirstTriangles { uint first_triangle[]; };  // by object
layout(location = 9) uniform bool by_triangle;

uint identifier_of(uint object) { return 1u + (by_triangle ? first_triangle[object] + uint(gl_PrimitiveID) : object); }
#endif
