#version 450 core
// Rectangles of a map whose static casters are copied, each one an instance of a strip of two triangles.
layout(location = 1) uniform int first;
layout(location = 2) uniform vec2 size;  // texels of the viewport
layout(std430, binding = 1) readonly buffer Copies { ivec4 rectangles[]; };

void main() {
  ivec4 at = rectangles[first + gl_InstanceID];
  ivec2 texel = at.xy + ivec2(gl_VertexID & 1, gl_VertexID >> 1) * at.zw;
  gl_Position = vec4(2.0 * vec2(texel) / size - 1.0, 0.0, 1.0);
}
