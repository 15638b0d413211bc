#version 450 core
// Casters into one shadow map. The same positions in the same order of operations for opaque and masked ones.
#include "common/frame.glsl"
#include "common/objects.glsl"

layout(location = 0) in vec3 position_object;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in uint object_index;
layout(location = 0) uniform int map;
layout(location = 0) out vec2 texcoord_out;

void main() {
  vec3 position = camera_relative_from_object(object_index, position_object);
  gl_Position = frame.maps[map].clip_from_point * vec4(position, 1.0);
  texcoord_out = texcoord;
}
