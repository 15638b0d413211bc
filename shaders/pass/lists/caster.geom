#version 450 core
// Grows a caster's triangle, so that every texel whose square it touches has its centre inside: a polygon of at most seven
// corners, the intersection of the triangle's rectangle and of the half planes within its edges, all moved out by half a texel.
// Those are the five axes that can separate a triangle from a square, so no texel is drawn in vain but for rounding.
// Based on: Hasselgren, Akenine-Moeller, Ohlsson, "Conservative Rasterization", GPU Gems 2, 2005; Gottschalk et al. 1996.
#include "pass/common/frame.glsl"
#include "pass/common/scale.glsl"
#include "pass/lists/light_frames.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 7) out;
layout(location = 0) in vec3 at_light[];
layout(location = 1) in vec3 magnitude[];
layout(location = 2) in vec2 texcoord[];
layout(location = 3) in float size[];
layout(location = 3) uniform int map;
layout(location = 0) flat out vec3 corner_out[3];
layout(location = 3) flat out vec2 texcoord_out[3];
layout(location = 6) flat out vec4 plane_out;  // unit normal across the light; how far the triangle is rounded along it

const float kRounding = 8.0 / 16777216.0;  // of a sum of four products, and of what is made of it
// Texels. The pixel was listed by a rounded place, and rasterizers snap corners to 1/256.
const float kSlack = 1.0 / 16.0;

vec2 polygon[8];
int corners;

void start_polygon(vec2 low, vec2 high) {
  polygon[0] = low;
  polygon[1] = vec2(high.x, low.y);
  polygon[2] = high;
  polygon[3] = vec2(low.x, high.y);
  corners = 4;
}

// Keeps the part where dot(line, (x, y, 1)) >= 0.
void clip_polygon(vec3 line) {
  vec2 kept[8];
  int count = 0;
  for (int i = 0; i < corners; ++i) {
    vec2 a = polygon[i], b = polygon[i + 1 < corners ? i + 1 : 0];
    float at_a = dot(line, vec3(a, 1.0)), at_b = dot(line, vec3(b, 1.0));
    if (at_a >= 0.0 && count < 8) kept[count++] = a;
    if ((at_a >= 0.0) != (at_b >= 0.0) && count < 8) kept[count++] = mix(a, b, at_a / (at_a - at_b));
  }
  for (int i = 0; i < count; ++i) polygon[i] = kept[i];
  corners = count;
}

vec4 rounded_plane() {
  vec3 side = at_light[1] - at_light[0], other = at_light[2] - at_light[0];
  float scale = scale_to_one(max(abs(side), abs(other)));
  vec3 across = cross(scale * side, scale * other);
  float area = length(across), largest = max(size[0], max(size[1], size[2]));
  return vec4(area > 0.0 ? across / area : vec3(0.0), light_frames.light.z * largest);
}

void emit_polygon() {
  if (corners < 3) return;
  vec4 plane = rounded_plane();
  for (int i = 0; i < min(corners, 7); ++i) {
    // Round about from the first corner: 0, 1, last, 2, last but one, ..
    int at = (i & 1) == 1 ? (i + 1) / 2 : (corners - i / 2) % corners;
    for (int k = 0; k < 3; ++k) {
      corner_out[k] = at_light[k];
      texcoord_out[k] = texcoord[k];
    }
    plane_out = plane;
    gl_Position = vec4(polygon[at], 0.0, 1.0);
    EmitVertex();
  }
  EndPrimitive();
}

// The line through an edge, moved out by the half sides of the grown texel. `rounding`: of its terms.
vec3 moved_out(vec3 line, vec2 half_sides, float rounding) {
  return line + vec3(0.0, 0.0, dot(abs(line.xy), half_sides) + rounding);
}

vec3 line_within(vec2 a, vec2 b, float side) {
  vec2 inward = side * vec2(a.y - b.y, b.x - a.x);
  return vec3(inward, -dot(inward, a));
}
float line_rounding(vec2 a, vec2 b) { return kRounding * dot(abs(vec2(a.y - b.y, b.x - a.x)), abs(a)); }

// All corners lie in front of the map's centre of projection.
void grow_projected(vec2 texel) {
  vec2 v[3], least = vec2(1e30), most = vec2(-1e30), off = vec2(0.0);
  for (int i = 0; i < 3; ++i) {
    float w = gl_in[i].gl_Position.w;
    v[i] = gl_in[i].gl_Position.xy / w;
    off = max(off, kRounding * (magnitude[i].xy + abs(v[i]) * magnitude[i].z) / w);
    least = min(least, v[i]);
    most = max(most, v[i]);
  }
  vec2 slack = off + kSlack * texel, half_sides = 0.5 * texel + slack;
  vec2 low = max(least - half_sides, vec2(-1.0)), high = min(most + half_sides, vec2(1.0));
  if (any(greaterThanEqual(low, high))) return;
  start_polygon(low, high);
  const float kSmall = 2.5;  // texels: cutting corners off costs more than it saves
  if (any(greaterThan(high - low, kSmall * texel))) {
    float area = (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x);
    int longest = 0;
    float length_of_longest = 0.0;
    for (int i = 0; i < 3; ++i) {
      float edge = distance(v[i], v[(i + 1) % 3]);
      if (edge > length_of_longest) {
        longest = i;
        length_of_longest = edge;
      }
    }
    if (abs(area) > 4.0 * length(slack) * length_of_longest) {
      float side = area > 0.0 ? 1.0 : -1.0;
      for (int i = 0; i < 3; ++i) {
        vec2 a = v[i], b = v[(i + 1) % 3];
        clip_polygon(moved_out(line_within(a, b, side), half_sides, line_rounding(a, b)));
      }
    } else {  // seen from the edge: which side is which is lost in rounding, and it hardly matters
      vec2 a = v[longest], b = v[(longest + 1) % 3];
      for (int i = 0; i < 2; ++i) {
        float rounding = line_rounding(a, b) + abs(area);
        clip_polygon(moved_out(line_within(a, b, i == 0 ? 1.0 : -1.0), half_sides, rounding));
      }
    }
  }
  emit_polygon();
}

// Some corner lies behind or close to the centre of projection: edges in homogeneous coordinates (Olano, Greer 1997).
void grow_homogeneous(vec2 texel) {
  vec2 half_sides = (0.5 + kSlack) * texel;
  vec3 p[3], cofactor[3];
  for (int i = 0; i < 3; ++i) p[i] = gl_in[i].gl_Position.xyw;
  for (int i = 0; i < 3; ++i) cofactor[i] = cross(p[i], p[(i + 1) % 3]);
  float volume = dot(p[0], cofactor[1]);
  vec3 m1 = magnitude[1], m2 = magnitude[2];
  float volume_rounding = 4.0 * kRounding * dot(magnitude[0], m1.yzx * m2.zxy + m1.zxy * m2.yzx);
  start_polygon(vec2(-1.0), vec2(1.0));
  if (abs(volume) > volume_rounding) {
    for (int i = 0; i < 3; ++i) {
      vec3 a = magnitude[i], b = magnitude[(i + 1) % 3], terms = a.yzx * b.zxy + a.zxy * b.yzx;
      clip_polygon(moved_out(sign(volume) * cofactor[i], half_sides, 2.0 * kRounding * (terms.x + terms.y + terms.z)));
    }
  }
  emit_polygon();
}

// True where all corners lie beyond the same side of the map's square, grown by a texel.
bool beyond_a_side(vec2 texel) {
  bvec2 beyond = bvec2(true), before = bvec2(true);
  for (int i = 0; i < 3; ++i) {
    vec4 p = gl_in[i].gl_Position;
    // Multiplied out with w of either sign: a part of the triangle in front of the centre of projection stays beyond.
    vec2 side = (vec2(1.0) + texel) * p.w, rounding = kRounding * (magnitude[i].xy + 2.0 * magnitude[i].z);
    beyond = bvec2(ivec2(beyond) & ivec2(greaterThan(p.xy - side, rounding)));
    before = bvec2(ivec2(before) & ivec2(lessThan(p.xy + side, -rounding)));
  }
  return any(beyond) || any(before);
}

void main() {
  vec2 texel = 2.0 / frame.maps[map].interval_size.zw;
  vec3 w = vec3(gl_in[0].gl_Position.w, gl_in[1].gl_Position.w, gl_in[2].gl_Position.w);
  float least = min(w.x, min(w.y, w.z)), most = max(w.x, max(w.y, w.z));
  if (most <= 0.0 || beyond_a_side(texel)) return;
  const float kClose = 1e-3;  // of the farthest corner: places on the map lose their digits
  if (least > kClose * most) {
    grow_projected(texel);
  } else {
    grow_homogeneous(texel);
  }
}
