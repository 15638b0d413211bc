#version 450 core
// Casters into one shadow map. The same positions in the same order of operations for opaque and masked ones.
#include "pass/common/objects.glsl"

layout(location = 0) in vec3 position_object;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in uint object_index;
layout(location = 3) uniform mat4 clip_from_position;  // of this map, from the same origin as the objects
layout(location = 0) out vec2 texcoord_out;
layout(location = 1) flat out uint object_out;
layout(location = 2) out float clip_z_out;

void main() {
  gl_Position = clip_from_position * vec4(relative_from_object(object_index, position_object), 1.0);
  texcoord_out = texcoord;
  object_out = object_index;
  clip_z_out = gl_Position.z;
}
