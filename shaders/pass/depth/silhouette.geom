#version 450 core
// Outlines of casters into a map of points: an edge whose triangles all lie on one side of it, as the light sees them, becomes
// a band that covers every texel it touches.
// Based on: Sen, Cammarano, Hanrahan, "Shadow Silhouette Maps", 2003.
layout(lines_adjacency) in;
layout(triangle_strip, max_vertices = 4) out;
layout(location = 4) uniform vec2 size;  // of the map, texels
layout(location = 0) flat out vec4 segment;  // both ends, texels of the map of points
layout(location = 1) flat out vec4 depths;   // of both ends, and 1 over their w

// Positive and negative on either side of the plane through the light and the edge.
float side_of(vec3 a, vec3 b, vec3 point) { return dot(a, cross(b - a, point - a)); }

void main() {
  vec4 a = gl_in[1].gl_Position, b = gl_in[2].gl_Position;
  float one = side_of(a.xyw, b.xyw, gl_in[0].gl_Position.xyw), other = side_of(a.xyw, b.xyw, gl_in[3].gl_Position.xyw);
  // Each measured along the same edge: the second triangle runs it the other way round, but its corner is what counts.
  if (one * other < 0.0) return;
  // What lies in front of the near plane is in no map; beyond the sides by more than any neighbour reads it may go. Ends that
  // are not clipped keep their bits, for all edges that share them.
  const float kBeyond = 4.0;  // texels
  vec2 wide = 1.0 + 2.0 * kBeyond / size;
  float from = 0.0, to = 1.0;
  float at_a[5] = float[5](a.z, wide.x * a.w - a.x, wide.x * a.w + a.x, wide.y * a.w - a.y, wide.y * a.w + a.y);
  float at_b[5] = float[5](b.z, wide.x * b.w - b.x, wide.x * b.w + b.x, wide.y * b.w - b.y, wide.y * b.w + b.y);
  for (int i = 0; i < 5; ++i) {
    if (at_a[i] < 0.0 && at_b[i] < 0.0) return;
    if (at_a[i] < 0.0) from = max(from, at_a[i] / (at_a[i] - at_b[i]));
    if (at_b[i] < 0.0) to = min(to, at_a[i] / (at_a[i] - at_b[i]));
  }
  if (from > to) return;
  vec4 begin = from > 0.0 ? mix(a, b, from) : a, end = to < 1.0 ? mix(a, b, to) : b;
  if (!(begin.w > 0.0 && end.w > 0.0)) return;
  vec2 p = (begin.xy / begin.w * 0.5 + 0.5) * size - 0.5, q = (end.xy / end.w * 0.5 + 0.5) * size - 0.5;
  // The centre of a square that a line touches is at most half a diagonal away from it.
  const float kHalfDiagonal = 0.7072;
  float run = length(q - p);
  vec2 along = run > 0.0 ? (q - p) * (kHalfDiagonal / run) : vec2(kHalfDiagonal, 0.0), across = vec2(-along.y, along.x);
  for (int i = 0; i < 4; ++i) {
    segment = vec4(p, q);
    depths = vec4(begin.z / begin.w, end.z / end.w, 1.0 / begin.w, 1.0 / end.w);
    vec2 texel = ((i & 1) == 0 ? p - along : q + along) + ((i & 2) == 0 ? across : -across);
    gl_Position = vec4(texel / size * 2.0 - 1.0, 0.0, 1.0);
    EmitVertex();
  }
  EndPrimitive();
}
