// One surface point per pixel: where it is, which way it faces, its colour. Both normals are turned to the viewer.
#ifndef GNOMON_COMMON_GBUFFER_GLSL
#define GNOMON_COMMON_GBUFFER_GLSL
#include "common/frame.glsl"
#include "common/alpha.glsl"
#include "common/octahedral.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;
layout(location = 0) out vec4 position_out;
layout(location = 1) out vec4 normal_out;
layout(location = 2) out vec4 albedo_out;
#ifdef GNOMON_HEIGHTS
layout(location = 3) flat in vec3 plane_normal;
layout(location = 4) flat in vec3 plane_point;
// Height of the position over the plane of its triangle: positions are interpolated, and rounded by up to 1e-4 of their distance
// along triangles that pass the camera closely.
layout(location = 3) out float height_out;
#endif
#ifdef GNOMON_IDENTIFIED
#include "common/identifier.glsl"
layout(location = 3) flat in uint object;
layout(location = 3) out uint identifier_out;
#endif

void main() {
  // Derivatives come before any discard.
  vec3 geometric = cross(dFdx(position), dFdy(position));
  vec4 color = texture(color_image, texcoord) * base_color;
  if (is_cut_out(texcoord)) discard;

  vec3 ray = frame.forward.w > 0.5 ? frame.forward.xyz : position;
  float size = length(geometric);
  geometric = size > 0.0 ? geometric / size : -normalize(ray);
  if (dot(geometric, ray) > 0.0) geometric = -geometric;
  float shading_size = length(normal);
  vec3 shading = shading_size > 0.0 ? normal / shading_size : geometric;
  if (dot(shading, geometric) < 0.0) shading = -shading;

  position_out = vec4(position, dot(position, frame.forward.xyz));
  normal_out = vec4(octahedral_from_unit(geometric), octahedral_from_unit(shading));
  albedo_out = vec4(color.rgb, 1.0);
#ifdef GNOMON_HEIGHTS
  float side = dot(plane_normal, geometric) < 0.0 ? -1.0 : 1.0;
  height_out = side * dot(plane_normal, position - plane_point);
#endif
#ifdef GNOMON_IDENTIFIED
  identifier_out = identifier_of(object);
#endif
}
#endif
