#version 450 core
// Casters into a map whose shape bends straight lines: instead of a triangle, rectangles of texels round its image, which is
// cut across into some slabs so that long thin ones do not cover much that they miss. Fragments find out which texels they hit.
// Based on: Lloyd, Govindaraju, Molnar, Manocha, "Practical Logarithmic Rasterization for Low-Error Shadow Maps", 2007.
#include "library/shape.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 32) out;
layout(location = 0) in vec2 texcoord[];
layout(location = 7) uniform mat4 shape;  // as shaped_point takes it
layout(location = 8) uniform vec2 size;   // of the map, texels
layout(location = 0) flat out vec4 corner[3];
layout(location = 3) flat out vec2 texcoord_out[3];

const int kMost = 9;
vec3 polygon[kMost];  // x, y and w of clip space: a triangle and a corner more for each side of the square and of a slab
int corners = 3;

// Keeps the part where dot(side, corner) >= 0.
void clip_polygon(vec3 side) {
  vec3 kept[kMost];
  int count = 0;
  for (int i = 0; i < corners; ++i) {
    vec3 a = polygon[i], b = polygon[i + 1 < corners ? i + 1 : 0];
    float at_a = dot(side, a), at_b = dot(side, b);
    if (at_a >= 0.0 && count < kMost) kept[count++] = a;
    if ((at_a >= 0.0) != (at_b >= 0.0) && count < kMost) kept[count++] = mix(a, b, at_a / (at_a - at_b));
  }
  for (int i = 0; i < count; ++i) polygon[i] = kept[i];
  corners = count;
}

// Where the polygon lies in ndc. Its w is 0 or above.
void bound_polygon(out vec2 low, out vec2 high) {
  low = vec2(1.0);
  high = vec2(-1.0);
  for (int i = 0; i < corners; ++i) {
    vec3 p = polygon[i];
    bool known = p.z > 0.0;  // else the centre of projection itself: anywhere
    low = min(low, known ? p.xy / p.z : vec2(-1.0));
    high = max(high, known ? p.xy / p.z : vec2(1.0));
  }
}

// Texels: places are rounded, most where the shape draws them apart, and rasterizers snap corners to 1/256.
const float kSlack = 0.25;

void emit_rectangle(vec2 low, vec2 high) {
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
  vec2 low, high;
  bound_polygon(low, high);
  vec4 bounds = texel_bounds(shape, size, max(low, -1.0), min(high, 1.0));
  low = bounds.xy - kSlack;
  high = bounds.zw + kSlack;
  const float kThin = 3.0, kRows = 4.0;  // texels across that cost no more than a slab; texels along of a slab
  const int kMaxSlabs = 8;
  float first = floor(low.y), rows = ceil(high.y) - first;
  int slabs = high.x - low.x > kThin && rows_stay_rows(shape) ? clamp(int(rows / kRows), 1, kMaxSlabs) : 1;
  if (slabs == 1) {
    emit_rectangle(low, high);
    return;
  }
  vec3 whole[kMost];
  int whole_corners = corners;
  for (int i = 0; i < whole_corners; ++i) whole[i] = polygon[i];
  for (int slab = 0; slab < slabs; ++slab) {
    float begin = first + floor(rows * float(slab) / float(slabs)), end = first + floor(rows * float(slab + 1) / float(slabs));
    for (int i = 0; i < whole_corners; ++i) polygon[i] = whole[i];
    corners = whole_corners;
    // Slabs meet between texels' centres, but what they show is looked for a little beyond.
    float from = ndc_of_texel(shape, size, vec2(0.0, begin - kSlack)).y, to = ndc_of_texel(shape, size, vec2(0.0, end + kSlack)).y;
    clip_polygon(vec3(0.0, 1.0, -from));
    clip_polygon(vec3(0.0, -1.0, to));
    if (corners < 3) continue;
    vec2 left, right;
    bound_polygon(left, right);
    emit_rectangle(vec2(shaped_point(shape, size, vec2(max(left.x, -1.0), from)).texel.x - kSlack, begin),
                   vec2(shaped_point(shape, size, vec2(min(right.x, 1.0), from)).texel.x + kSlack, end));
  }
}
