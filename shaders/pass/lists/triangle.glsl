// Does a caster's triangle lie between the light and a listed point? The includer supplies is_there().
#ifndef GNOMON_LISTS_TRIANGLE_GLSL
#define GNOMON_LISTS_TRIANGLE_GLSL
#include "pass/lists/lists.glsl"
#include "pass/common/turn.glsl"

layout(binding = 4) uniform usampler2DArray heads;
layout(location = 3) uniform int map;
layout(location = 0) flat in vec3 corner[3];  // across the light, as ListedPixel::at
layout(location = 6) flat in vec4 plane;      // unit normal; how far the triangle is rounded along it

bool is_there(vec3 weights);

bool shadows(vec3 at) {
  bool local = local_light();
  precise vec2 p[3];
  for (int i = 0; i < 3; ++i) p[i] = corner[i].xy - at.xy * (local ? corner[i].z : 1.0);
  vec3 weights = vec3(turn(p[1], p[2]), turn(p[2], p[0]), turn(p[0], p[1]));
  if (any(lessThan(weights, vec3(0.0))) && any(greaterThan(weights, vec3(0.0)))) return false;
  float sum = weights.x + weights.y + weights.z;
  if (sum == 0.0) return false;
  weights /= sum;
  vec3 way = local ? normalize(vec3(at.xy, 1.0)) : vec3(0.0, 0.0, 1.0);
  vec3 depth = vec3(dot(corner[0], way), dot(corner[1], way), dot(corner[2], way));
  float rounding = plane.w / max(abs(dot(plane.xyz, way)), kGrazing);
  if (!(dot(weights, depth - at.z) < -rounding)) return false;  // not between the light and the point
  if (local && !(dot(weights, depth) > 0.0)) return false;      // behind the light
  return is_there(weights);
}
#endif
