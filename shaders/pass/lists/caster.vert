#version 450 core
// Casters in the map's clip space and in the frame across its light.
#include "pass/common/frame.glsl"
#include "pass/lists/light_frames.glsl"
#include "pass/common/objects.glsl"

layout(location = 0) in vec3 position_object;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in uint object_index;
layout(location = 3) uniform int map;
layout(location = 0) out vec3 at_light;
layout(location = 1) out vec3 magnitude;  // sums of the terms that make up clip x, y, w: what their rounding is measured by
layout(location = 2) out vec2 texcoord_out;
layout(location = 3) out float size;  // of its coordinates

void main() {
  vec3 position = relative_from_object(object_index, position_object);
  mat4 m = frame.maps[map].clip_from_point;
  gl_Position = m * vec4(position, 1.0);
  vec4 sum = abs(m[0]) * abs(position.x) + abs(m[1]) * abs(position.y) + abs(m[2]) * abs(position.z) + abs(m[3]);
  magnitude = sum.xyw;
  at_light = light_from_point(map, position);
  texcoord_out = texcoord;
  size = size_of_coordinates(position, size_of_terms(object_index, position_object)) + (local_light() ? length(at_light) : 0.0);
}
