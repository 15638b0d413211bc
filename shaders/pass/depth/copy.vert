#version 450 core
// Rectangles of a map whose static casters are copied, two triangles each. No instances: drivers in software take as long
// for each as for a draw.
layout(location = 1) uniform int first;
layout(location = 2) uniform vec2 size;  // texels of the viewport
layout(std430, binding = 1) readonly buffer Copies { ivec4 rectangles[]; };

void main() {
  ivec4 at = rectangles[first + gl_VertexID / 6];
  int corner = gl_VertexID % 6;
  ivec2 texel = at.xy + ivec2(corner == 1 || corner > 3, corner == 2 || corner == 3 || corner == 5) * at.zw;
  gl_Position = vec4(2.0 * vec2(texel) / size - 1.0, 0.0, 1.0);
}
