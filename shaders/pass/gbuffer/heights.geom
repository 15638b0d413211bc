#version 450 core
// Passes each pixel the plane of its triangle, and how far that is rounded.
#include "pass/common/scale.glsl"
#include "pass/lists/light_frames.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
layout(location = 0) in vec3 position[];
layout(location = 1) in vec3 normal[];
layout(location = 2) in vec2 texcoord[];
layout(location = 4) in float terms[];
layout(location = 0) out vec3 position_out;
layout(location = 1) out vec3 normal_out;
layout(location = 2) out vec2 texcoord_out;
layout(location = 3) flat out vec3 plane_normal;
layout(location = 4) flat out vec3 plane_point;
layout(location = 5) flat out float plane_rounding;

void main() {
  vec3 side = position[1] - position[0], other = position[2] - position[0];
  float scale = scale_to_one(max(abs(side), abs(other)));
  vec3 across = cross(scale * side, scale * other);
  float size = length(across), largest = 0.0;
  for (int i = 0; i < 3; ++i) largest = max(largest, size_of_coordinates(position[i], terms[i]));
  for (int i = 0; i < 3; ++i) {
    gl_Position = gl_in[i].gl_Position;
    position_out = position[i];
    normal_out = normal[i];
    texcoord_out = texcoord[i];
    plane_normal = size > 0.0 ? across / size : vec3(0.0);
    plane_point = position[0];
    plane_rounding = light_frames.light.z * largest;
    EmitVertex();
  }
  EndPrimitive();
}
