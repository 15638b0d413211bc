#version 450 core
// Panes into one shadow map, or into the picture.
#include "pass/common/objects.glsl"

layout(location = 0) in vec3 position_object;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in uint object_index;
layout(location = 3) uniform mat4 clip_from_position;
layout(location = 0) out vec3 position_out;  // from the objects' origin
layout(location = 1) out vec2 texcoord_out;

void main() {
  position_out = relative_from_object(object_index, position_object);
  gl_Position = clip_from_position * vec4(position_out, 1.0);
  texcoord_out = texcoord;
}
