// Where the objects stand: affine matrices in rows, relative to the camera or to the origin that maps are drawn from.
#ifndef GNOMON_COMMON_OBJECTS_GLSL
#define GNOMON_COMMON_OBJECTS_GLSL
#include "pass/common/scale.glsl"

struct Object {
  vec4 row[3];
};
layout(std430, binding = 0) readonly buffer Objects { Object objects[]; };

vec3 relative_from_object(uint index, vec3 position) {
  vec4 p = vec4(position, 1.0);
  return vec3(dot(objects[index].row[0], p), dot(objects[index].row[1], p), dot(objects[index].row[2], p));
}

// How large the terms are that add up to it: what its rounding is measured by.
float size_of_terms(uint index, vec3 position) {
  Object o = objects[index];
  vec4 p = vec4(abs(position), 1.0);
  return length(vec3(dot(abs(o.row[0]), p), dot(abs(o.row[1]), p), dot(abs(o.row[2]), p)));
}

// By the cofactor matrix: right for every affine transform, also where it has no inverse. The sign of the determinant
// turns mirrored normals the right way. The length may be any but zero.
vec3 world_normal_from_object(uint index, vec3 normal) {
  vec3 a = objects[index].row[0].xyz, b = objects[index].row[1].xyz, c = objects[index].row[2].xyz;
  float scale = scale_to_one(max(max(abs(a), abs(b)), abs(c)));
  a *= scale;
  b *= scale;
  c *= scale;
  vec3 bc = cross(b, c);
  vec3 n = vec3(dot(bc, normal), dot(cross(c, a), normal), dot(cross(a, b), normal));
  return dot(a, bc) < 0.0 ? -n : n;
}
#endif
