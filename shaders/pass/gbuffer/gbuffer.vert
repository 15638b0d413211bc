#version 450 core
// The surfaces that the camera sees.
#include "pass/common/frame.glsl"
#include "pass/common/objects.glsl"

layout(location = 0) in vec3 position_object;
layout(location = 1) in vec3 normal_object;
layout(location = 2) in vec2 texcoord;
layout(location = 3) in uint object_index;
layout(location = 0) out vec3 position_out;
layout(location = 1) out vec3 normal_out;
layout(location = 2) out vec2 texcoord_out;
layout(location = 3) flat out uint object_out;
layout(location = 4) out float terms_out;

void main() {
  vec3 position = relative_from_object(object_index, position_object);
  gl_Position = frame.clip_from_camera_relative * vec4(position, 1.0);
  position_out = position;
  normal_out = world_normal_from_object(object_index, normal_object);
  texcoord_out = texcoord;
  object_out = object_index;
  terms_out = size_of_terms(object_index, position_object);
}
