// How much of the light reaches a pixel's surface, and which map that comes from. Where the maps lie is the part <source>: lit_by(),
// map_at(), shadow_map(), layer_of_map(), options_of_map(). How the filter reads them is the part <read>: visibility().
#ifndef GNOMON_MASK_LOOK_UP_GLSL
#define GNOMON_MASK_LOOK_UP_GLSL
#include "pass/common/frame.glsl"
#include "pass/common/filter.glsl"
#include "pass/common/surface.glsl"
#include "library/receiver.glsl"
#include "library/select_map.glsl"
#include <filter>

layout(binding = 3) uniform sampler2D noise_tile;
layout(binding = 4) uniform sampler2DArrayShadow shadow_compare;
layout(binding = 5) uniform sampler2DArray shadow_depth;
layout(binding = 7) uniform sampler2DArray shadow_depth_max;
layout(location = 0) out vec2 mask;  // 1 lit .. 0 in shadow; map or -1

int map_of_plan(Surface s, vec3 light);

#include <source>
#include <read>

int map_of_plan(Surface s, vec3 light) {
  LightRecord by = lit_by();
  return map_serving(s.position, s.depth, light, by.selection.x, int(by.light.w));
}

// Texels per pixel: the pixel's sides on the surface, in the map.
mat2 texels_per_pixel(ShadowMap map, Surface s) {
  bool orthographic = frame.forward.w > 0.5;
  vec3 ray = orthographic ? frame.forward.xyz : s.position;
  float scale = orthographic ? 1.0 : s.depth;
  vec3 x = frame.right.xyz * (frame.right.w * scale), y = frame.up.xyz * (frame.up.w * scale);
  float facing = dot(s.normal, ray);
  if (facing == 0.0) return mat2(0.0);
  x -= ray * (dot(s.normal, x) / facing);
  y -= ray * (dot(s.normal, y) / facing);
  MapPoint p = map_point(map, s.position);
  return mat2(dot(p.d_texel_x, x), dot(p.d_texel_y, x), dot(p.d_texel_x, y), dot(p.d_texel_y, y));
}

// Evenly spread over 0..1 from pixel to pixel, and from frame to frame where SampleNoise says so.
float frame_noise() {
  const float kBlue = 2.0;
  if (frame.selection.z != kBlue) return pixel_noise(gl_FragCoord.xy + frame.selection.w);
  ivec2 pixel = ivec2(gl_FragCoord.xy) & (textureSize(noise_tile, 0) - 1);
  return fract(texelFetch(noise_tile, pixel, 0).r + frame.selection.w);
}

float visibility_through(int index, Surface s, float noise) {
  LightRecord by = lit_by();
  ShadowMap map = shadow_map(index);
  ShadowLookup at = shadow_lookup(map, layer_of_map(index), by.layer.xy, ShadowSurface(s.position, s.normal, by.light_place), by.bias);
  if (filtering.sums.w > 0.5) at.depth_gradient = vec2(0.0);
  bool covers_pixel = filtering.kernel.z > 1.5;
  ShadowKernel kernel =
      ShadowKernel(filtering.kernel.x, filtering.kernel.y > 0.5, filtering.kernel.z > 0.5 && !covers_pixel);
  mat2 pixel = filtering.kernel.z > 0.5 ? texels_per_pixel(map, s) : mat2(0.0);
  set_kernel(at, map, kernel, pixel);
  if (covers_pixel) at.pixel = pixel_box(pixel);
  at.rotation = 6.2831853 * noise;
  return visibility(at, map, options_of_map(index));
}

// Share of the light that reaches the surface, and the map that it comes from.
vec2 mask_of(Surface s) {
  const float kBlend = 1.0, kDither = 2.0;  // SplitTransition
  LightRecord by = lit_by();
  int count = int(by.light.w);
  bool by_hold = by.selection.x > 0.5;
  vec3 light = light_at(by.light_place, s.position);
  int map = map_at(s, light);
  bool faces_light = dot(s.normal, light) < 0.0;
  vec2 mask = vec2(faces_light || count == 0 ? 1.0 : 0.0, float(map));
  if (map < 0 || !faces_light) return mask;
  float noise = frame_noise();
  float next_share = 0.0;
  if (frame.selection.y > 0.5 && !by_hold && map + 1 < count) {
    next_share = share_of_next_map(shadow_map(map + 1), s.depth);
  }
  if (frame.selection.y == kDither) next_share = next_share > noise ? 1.0 : 0.0;
  // A loop, for software renderers run all branches: a look-up written twice takes twice the time.
  int first = next_share == 1.0 ? map + 1 : map, last = next_share > 0.0 ? map + 1 : map;
  mask.x = 0.0;
  for (int i = first; i <= last; ++i)
    mask.x += (i == map ? 1.0 - next_share : next_share) * visibility_through(i, s, noise);
  if (next_share == 1.0) mask.y = float(map + 1);
  return mask;
}
#endif
