// Into a map whose shape bends lines: whether the caster's triangle covers the centre of this texel, and how deep it lies there.
#include "library/shape.glsl"
#include "pass/common/turn.glsl"

layout(location = 7) uniform mat4 shape;  // as shaped_point takes it
layout(location = 8) uniform vec2 size;   // of the map, texels
layout(location = 10) uniform float even_scale;  // as even_depth.glsl has it
layout(location = 0) flat in vec4 corner[3];  // clip space
layout(location = 3) flat in vec2 texcoord[3];

// Weights of the corners where the ray through the texel's centre meets the triangle, as they are before the map's projection.
// Writes the depth there. Discards where it does not meet, behind the centre of projection, and beyond the map's depths.
vec3 covered() {
  vec2 at = ndc_of_texel(shape, size, gl_FragCoord.xy);
  // From the texel's centre, so that coordinates are small where the triangle is.
  precise vec2 p[3];
  for (int i = 0; i < 3; ++i) p[i] = corner[i].xy - at * corner[i].w;
  vec3 weights = vec3(turn(p[1], p[2]), turn(p[2], p[0]), turn(p[0], p[1]));
  if (any(lessThan(weights, vec3(0.0))) && any(greaterThan(weights, vec3(0.0)))) discard;
  float sum = weights.x + weights.y + weights.z;
  if (sum == 0.0) discard;
  weights /= sum;
  float w = dot(weights, vec3(corner[0].w, corner[1].w, corner[2].w));
  float z = dot(weights, vec3(corner[0].z, corner[1].z, corner[2].z)), depth = z / w;
  if (!(w > 0.0 && depth >= 0.0 && depth <= 1.0)) discard;
  gl_FragDepth = even_scale > 0.0 ? clamp(z * even_scale, 0.0, 1.0) : depth;
  return weights;
}

vec3 weights_here;  // as covered() returns them

void place_fragment() { weights_here = covered(); }

vec2 texcoord_here() { return weights_here.x * texcoord[0] + weights_here.y * texcoord[1] + weights_here.z * texcoord[2]; }
