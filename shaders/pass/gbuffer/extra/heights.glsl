// How far off its triangle each point was rounded: positions are interpolated, and rounded by up to 1e-4 of their distance along
// triangles that pass the camera closely.
layout(location = 3) flat in vec3 plane_normal;
layout(location = 4) flat in vec3 plane_point;
layout(location = 5) flat in float plane_rounding;
layout(location = 3) out float height_out;  // the least that the position may have over the plane of its triangle

void store_extra(vec3 geometric) {
  float side = dot(plane_normal, geometric) < 0.0 ? -1.0 : 1.0;
  height_out = side * dot(plane_normal, position - plane_point) - plane_rounding;
}
