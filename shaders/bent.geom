#version 450 core
// Casters into a map whose shape bends straight lines: instead of a triangle, the rectangle of texels round its image.
// Fragments find out which of them it covers.
// Based on: Lloyd, Govindaraju, Molnar, Manocha, "Practical Logarithmic Rasterization for Low-Error Shadow Maps", 2007.
#include "library/shape.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 4) out;
layout(location = 0) in vec2 texcoord[];
layout(location = 7) uniform vec4 shape;  // as shaped_point takes it
layout(location = 8) uniform vec2 size;   // of the map, texels
layout(location = 0) flat out vec4 corner[3];
layout(location = 3) flat out vec2 texcoord_out[3];

vec3 polygon[8];  // x, y and w of clip space: a triangle and a corner more for each side of the square
int corners = 3;

// Keeps the part where dot(side, corner) >= 0.
void clip_polygon(vec3 side) {
  vec3 kept[8];
  int count = 0;
  for (int i = 0; i < corners; ++i) {
    vec3 a = polygon[i], b = polygon[i + 1 < corners ? i + 1 : 0];
    float at_a = dot(side, a), at_b = dot(side, b);
    if (at_a >= 0.0 && count < 8) kept[count++] = a;
    if ((at_a >= 0.0) != (at_b >= 0.0) && count < 8) kept[count++] = mix(a, b, at_a / (at_a - at_b));
  }
  for (int i = 0; i < count; ++i) polygon[i] = kept[i];
  corners = count;
}

void main() {
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    polygon[i] = gl_in[i].gl_Position.xyw;
    inside = inside && all(lessThan(abs(polygon[i].xy), vec2(polygon[i].z)));
  }
  if (!inside) {
    // All four together keep no w below 0: what lies behind the centre of projection is gone.
    clip_polygon(vec3(1.0, 0.0, 1.0));
    clip_polygon(vec3(-1.0, 0.0, 1.0));
    clip_polygon(vec3(0.0, 1.0, 1.0));
    clip_polygon(vec3(0.0, -1.0, 1.0));
    if (corners < 3) return;
  }
  vec2 low = vec2(1.0), high = vec2(-1.0);
  for (int i = 0; i < corners; ++i) {
    vec3 p = polygon[i];
    if (p.z > 0.0) {
      low = min(low, p.xy / p.z);
      high = max(high, p.xy / p.z);
    } else {  // the centre of projection itself
      low = vec2(-1.0);
      high = vec2(1.0);
    }
  }
  // Texels: places are rounded, most where the shape draws them apart, and rasterizers snap corners to 1/256.
  const float kSlack = 0.25;
  low = shaped_point(shape, size, max(low, -1.0)).texel - kSlack;
  high = shaped_point(shape, size, min(high, 1.0)).texel + kSlack;
  if (any(lessThan(floor(high - 0.5), ceil(low - 0.5)))) return;  // between the texels' centres
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      corner[k] = gl_in[k].gl_Position;
      texcoord_out[k] = texcoord[k];
    }
    vec2 texel = vec2((i & 1) == 0 ? low.x : high.x, (i & 2) == 0 ? low.y : high.y);
    gl_Position = vec4(texel / size * 2.0 - 1.0, 0.0, 1.0);
    EmitVertex();
  }
  EndPrimitive();
}
