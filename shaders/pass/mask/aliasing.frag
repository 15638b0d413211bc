#version 450 core
// Screen pixels per shadow-map texel at every pixel's surface. Mirrors gnomon::measure_point: J = B T E, texels per
// pixel, by way of a plane of constant depth (E), slid along the eye's ray onto the surface (T), into the map (B).
#include "pass/common/frame.glsl"
#include "pass/common/grazing.glsl"
#include "pass/common/surface.glsl"

layout(binding = 6) uniform sampler2D mask_image;
// m_max, m_s, m_t, map. Map -1: sky, or no map serves the point. All m 0: the surface is turned from the light, or
// light only grazes it, and rounding would decide m.
layout(location = 0) out vec4 aliasing;

vec3 on_surface(vec3 step_view, vec3 ray, vec3 normal) {
  return step_view - ray * (dot(normal, step_view) / dot(normal, ray));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  int map = int(texelFetch(mask_image, pixel, 0).g);
  aliasing = vec4(0.0, 0.0, 0.0, float(map));
  if (s.sky || map < 0 || dot(s.normal, light_at(frame.light_place, s.position)) > -kGrazing) return;

  bool orthographic = frame.forward.w > 0.5;
  vec3 ray = orthographic ? frame.forward.xyz : s.position;
  float scale = orthographic ? 1.0 : s.depth;
  vec3 step_x = on_surface(frame.right.xyz * (frame.right.w * scale), ray, s.normal);
  vec3 step_y = on_surface(frame.up.xyz * (frame.up.w * scale), ray, s.normal);
  MapPoint p = map_point(frame.maps[map], s.position);
  vec2 column_x = vec2(dot(p.d_texel_x, step_x), dot(p.d_texel_y, step_x));
  vec2 column_y = vec2(dot(p.d_texel_x, step_y), dot(p.d_texel_y, step_y));

  float det = column_x.x * column_y.y - column_x.y * column_y.x;
  float size = 0.5 * (dot(column_x, column_x) + dot(column_y, column_y));
  float spread = sqrt(max(0.0, (size - abs(det)) * (size + abs(det))));
  // 1 / smallest singular value, without the difference size - spread that loses all digits.
  float m_max = sqrt(size + spread) / abs(det);
  float m_s = length(vec2(column_y.y, column_x.y)) / abs(det);
  float m_t = length(vec2(column_y.x, column_x.x)) / abs(det);
  aliasing = vec4(m_max, m_s, m_t, float(map));
}
