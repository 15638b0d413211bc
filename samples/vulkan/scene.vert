// The camera's pass.
#version 450
layout(push_constant) uniform Push {
  mat4 clip_from_point;
  vec4 eye;
  vec4 forward;  // of the camera, unit
};
layout(location = 0) in vec3 position;  // world
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 point;  // relative to the eye
layout(location = 1) out vec3 surface_normal;
layout(location = 2) out float view_depth;

void main() {
  point = position - eye.xyz;
  surface_normal = normal;
  view_depth = dot(point, forward.xyz);
  gl_Position = clip_from_point * vec4(point, 1.0);
}
