// Reads back what the camera sees: one surface point per pixel.
#ifndef GNOMON_COMMON_SURFACE_GLSL
#define GNOMON_COMMON_SURFACE_GLSL
#include "pass/common/octahedral.glsl"

layout(binding = 0) uniform sampler2D position_image;  // camera-relative, view depth
layout(binding = 1) uniform sampler2D normal_image;    // octahedral: geometric, shading
layout(binding = 2) uniform sampler2D albedo_image;    // linear; alpha 0: sky, 1/2: no shadow falls on it

struct Surface {
  bool sky;
  bool receives;  // shadows; the sky does not
  vec3 position;  // camera-relative
  float depth;    // along the view
  vec3 normal;    // of the triangle, towards the viewer
  vec3 shading_normal;
  vec3 albedo;
};

Surface surface_at(ivec2 pixel) {
  vec4 position = texelFetch(position_image, pixel, 0);
  vec4 normals = texelFetch(normal_image, pixel, 0);
  vec4 albedo = texelFetch(albedo_image, pixel, 0);
  return Surface(albedo.a == 0.0, albedo.a > 0.75, position.xyz, position.w, unit_from_octahedral(normals.xy),
                 unit_from_octahedral(normals.zw), albedo.rgb);
}
#endif
