#version 450 core
// The surfaces that the camera sees, one point per pixel: where it is, which way it faces, its colour. Both normals are turned to the viewer.
// The part <extra> stores more of it: store_extra().
#include "pass/common/frame.glsl"
#include "pass/common/alpha.glsl"
#include "pass/common/octahedral.glsl"
#include "pass/common/scale.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texcoord;
layout(location = 11) uniform float surface_alpha;  // of the albedo: pass/common/surface.glsl
layout(location = 0) out vec4 position_out;
layout(location = 1) out vec4 normal_out;
layout(location = 2) out vec4 albedo_out;

#include <extra>

void main() {
  // Derivatives come before any discard.
  vec3 right = dFdx(position), up = dFdy(position);
  float scale = scale_to_one(max(abs(right), abs(up)));
  vec3 geometric = cross(scale * right, scale * up);
  vec4 color = texture(color_image, texcoord) * base_color;
  if (is_cut_out(texcoord)) discard;
  // A triangle without area in the picture may have pixels, whose position is no number.
  const float kLargest = 3.4e38;
  if (!all(lessThanEqual(abs(position), vec3(kLargest)))) discard;

  vec3 ray = frame.forward.w > 0.5 ? frame.forward.xyz : position;
  float size = length(geometric);
  geometric = size > 0.0 ? geometric / size : -normalize(ray);
  if (dot(geometric, ray) > 0.0) geometric = -geometric;
  float shading_size = length(normal);
  vec3 shading = shading_size > 0.0 ? normal / shading_size : geometric;
  if (dot(shading, geometric) < 0.0) shading = -shading;

  position_out = vec4(position, dot(position, frame.forward.xyz));
  normal_out = vec4(octahedral_from_unit(geometric), octahedral_from_unit(shading));
  albedo_out = vec4(color.rgb, surface_alpha);
  store_extra(geometric);
}
