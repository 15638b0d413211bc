// A shadow map as a shader reads it, and its derivatives at a point. Points are in the space that the matrices expect: relative
// to the camera for precision. The includer supplies shadow_map().
#ifndef GNOMON_LIBRARY_SHADOW_MAP_GLSL
#define GNOMON_LIBRARY_SHADOW_MAP_GLSL
#include "library/shape.glsl"

struct ShadowMap {
  mat4 clip_from_point;   // z 0 near the light .. w
  vec4 interval_size;     // depth_begin, depth_end: view depths served; width, height: texels
  vec4 select_planes[4];  // serves points with dot(xyz, point) + w >= 0 for all; (0, 0, 0, 1) where unused
  mat4 shape;             // as shaped_point takes it
  vec4 kernel;            // filter margin in texels; blur that the stored texels went through, as half a box, texels; overlap; depth curve, or minus even_scale
};

ShadowMap shadow_map(int index);

// The map's depths are clip z times this, even along the light; 0: clip z over w.
float even_scale_of(ShadowMap map) { return max(-map.kernel.w, 0.0); }

struct MapPoint {
  vec3 ndc;        // x, y in -1..1, z in 0..1 as the map stores it
  vec2 texel;
  float w;
  vec3 d_texel_x;  // gradients over the position: of the texel coordinates ...
  vec3 d_texel_y;
  vec3 d_depth;    // ... and of the depth
  vec4 ends, longer;  // as in ShapedPoint
};

vec3 matrix_row(mat4 m, int i) { return vec3(m[0][i], m[1][i], m[2][i]); }

MapPoint map_point(ShadowMap map, vec3 position) {
  mat4 m = map.clip_from_point;
  vec4 h = m * vec4(position, 1.0);
  MapPoint p;
  p.w = h.w;
  p.ndc = h.xyz / h.w;
  ShapedPoint at = shaped_point(map.shape, map.interval_size.zw, p.ndc.xy);
  p.texel = at.texel;
  p.ends = at.ends;
  p.longer = at.longer;
  mat2 d = at.texel_from_ndc / h.w;
  vec3 w_row = matrix_row(m, 3);
  vec3 over_x = matrix_row(m, 0) - p.ndc.x * w_row, over_y = matrix_row(m, 1) - p.ndc.y * w_row;
  p.d_texel_x = over_x * d[0].x + over_y * d[1].x;
  p.d_texel_y = over_x * d[0].y + over_y * d[1].y;
  p.d_depth = (matrix_row(m, 2) - p.ndc.z * w_row) / h.w;
  float even = even_scale_of(map);
  if (even > 0.0) {
    p.ndc.z = h.z * even;
    p.d_depth = matrix_row(m, 2) * even;
  }
  return p;
}

// One texel's sides across the light, in world units. Zero where the map is singular. `light`: the way it travels at the
// point.
void texel_sides(MapPoint p, vec3 light, out vec3 side_x, out vec3 side_y) {
  vec3 x = cross(p.d_texel_y, light), y = cross(light, p.d_texel_x);
  float det = dot(p.d_texel_x, x);
  side_x = det == 0.0 ? vec3(0.0) : x / det;
  side_y = det == 0.0 ? vec3(0.0) : y / det;
}

// The way the light travels at a point. `light.w` 0: parallel light along xyz; 1: xyz is where the light is, and a point
// there gets any direction.
vec3 light_at(vec4 light, vec3 position) {
  vec3 away = position - light.xyz;
  float distance_to = length(away);
  return light.w == 0.0 ? light.xyz : distance_to > 0.0 ? away / distance_to : vec3(0.0, -1.0, 0.0);
}
#endif
