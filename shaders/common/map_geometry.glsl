// How a shadow map lies on the world at a point: its derivatives, its texels, which map serves the point, and the bias.
#include "common/frame.glsl"

struct MapPoint {
  vec3 ndc;           // x, y in -1..1, z in 0..1
  float w;
  vec3 d_texel_x;     // gradients in world units: of the texel coordinates ...
  vec3 d_texel_y;
  vec3 d_depth;       // ... and of the depth
};

vec3 matrix_row(mat4 m, int i) { return vec3(m[0][i], m[1][i], m[2][i]); }

MapPoint map_point(int map, vec3 position) {
  mat4 m = frame.maps[map].clip_from_camera_relative;
  vec4 h = m * vec4(position, 1.0);
  MapPoint p;
  p.w = h.w;
  p.ndc = h.xyz / h.w;
  vec2 half_size = 0.5 * frame.maps[map].interval_size.zw;
  vec3 w_row = matrix_row(m, 3);
  p.d_texel_x = (matrix_row(m, 0) - p.ndc.x * w_row) * (half_size.x / h.w);
  p.d_texel_y = (matrix_row(m, 1) - p.ndc.y * w_row) * (half_size.y / h.w);
  p.d_depth = (matrix_row(m, 2) - p.ndc.z * w_row) / h.w;
  return p;
}

bool map_holds(int map, vec3 position) {
  vec4 h = frame.maps[map].clip_from_camera_relative * vec4(position, 1.0);
  return h.w > 0.0 && max(abs(h.x), abs(h.y)) <= h.w;
}

// The map that serves a point at this view depth, -1: none, nothing can shadow it. A gap between the depths of two maps
// is one that the plan left out because no caster reaches it. A point that its own map does not hold goes to the next.
int map_for(vec3 position, float depth) {
  const float kSlack = 1e-5;  // of the interval: view depths are rounded to float on their way here
  int count = int(frame.light.w);
  bool own = true;
  for (int i = 0; i < count; ++i) {
    vec2 interval = frame.maps[i].interval_size.xy;
    float slack = kSlack * max(abs(interval.x), abs(interval.y));
    if (depth > interval.y + slack) continue;
    if (own && depth < interval.x - slack) return -1;
    own = false;
    if (map_holds(i, position)) return i;
  }
  return -1;
}

// One texel's sides across the light, in world units. Zero where the map is singular.
void texel_sides(MapPoint p, vec3 light, out vec3 side_x, out vec3 side_y) {
  vec3 x = cross(p.d_texel_y, light), y = cross(light, p.d_texel_x);
  float det = dot(p.d_texel_x, x);
  side_x = det == 0.0 ? vec3(0.0) : x / det;
  side_y = det == 0.0 ? vec3(0.0) : y / det;
}

struct ShadowReceiver {
  vec2 texel;           // where in the map
  float depth;          // with the bias taken off
  vec2 depth_gradient;  // of the receiver's plane, per texel
};

// Bias in texels of this map at this point. The kernel's reach needs none: filters follow the receiver's plane by its
// gradient. The plane's slope is capped, so that a surface nearly along the light does not lose its shadows.
ShadowReceiver shadow_receiver(int map, vec3 position, vec3 normal) {
  const float kDepthRounding = 4.0 / 16777216.0;  // the rasterizer's depth is good to a few units of 2^-24
  vec3 light = frame.light.xyz;
  float cosine = max(-dot(normal, light), 0.0);
  vec3 across = normal + cosine * light;
  float sine = length(across);
  float tangent = min(sine / max(cosine, 1e-6), frame.bias.w);
  vec3 slope = across * (sine > 0.0 ? tangent / sine : 0.0);

  vec3 side_x, side_y;
  texel_sides(map_point(map, position), light, side_x, side_y);
  float texel_world = max(length(side_x), length(side_y));
  MapPoint p = map_point(map, position + normal * (frame.bias.z * texel_world * sine));
  texel_sides(p, light, side_x, side_y);

  // Distance along the light, towards it, by which the plane rises per texel; a plane that faces the light has none.
  vec2 rise = vec2(dot(slope, side_x), dot(slope, side_y));
  float along_light = dot(p.d_depth, light);  // depth per world unit along the light, exact: its rays are the map's
  float bias_world = frame.bias.x * texel_world + frame.bias.y * (abs(rise.x) + abs(rise.y));

  ShadowReceiver r;
  r.texel = (p.ndc.xy * 0.5 + 0.5) * frame.maps[map].interval_size.zw;
  r.depth = p.ndc.z - along_light * bias_world - kDepthRounding;
  r.depth_gradient = vec2(dot(p.d_depth, side_x), dot(p.d_depth, side_y)) + along_light * rise;
  return r;
}
