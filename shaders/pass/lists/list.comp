#version 450 core
// Lists the samples of pixels by the texel of the map that they look into. What no map serves gets its mask here.
#include "pass/common/frame_maps.glsl"
#include "pass/common/surface.glsl"
#include "pass/lists/lists.glsl"
#include "pass/lists/facet.glsl"
#include "library/select_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 4) uniform sampler2D height_image;      // of each position over the plane of its triangle, rounding taken off
layout(binding = 0, r32ui) uniform uimage2DArray heads;  // first pixel of each texel's list plus 1
layout(binding = 1, rg32f) writeonly uniform image2D mask_image;
layout(location = 0) uniform int samples;  // of each pixel: 1 at its centre, more over its facet

// The point as casters are tested against it: lifted off its plane, since coordinates are rounded.
vec3 lifted(ivec2 pixel, Surface s, vec3 light, int map) {
  vec3 at = light_from_point(map, s.position);
  float away = local_light() ? length(s.position - frame.light_place.xyz) : 0.0;
  // Coordinates are relative to the camera, those of a local light's frame to it.
  float least = light_frames.light.z * (length(s.position) + away);
  float height = least - texelFetch(height_image, pixel, 0).r;
  float lift = height / max(-dot(s.normal, light), kGrazing);
  if (!local_light()) return vec3(at.xy, at.z - lift);
  return vec3(at.xy / at.z, away - lift);
}

void list(ivec2 pixel, uint index, Surface s, vec3 light, int map) {
  vec4 h = shadow_map(map).clip_from_point * vec4(s.position, 1.0);
  vec2 size = shadow_map(map).interval_size.zw;
  // By an even grid over the map's square, whatever the map's shape: casters are drawn into the same.
  ivec2 texel = ivec2(clamp(floor((h.xy / h.w * 0.5 + 0.5) * size), vec2(0.0), size - 1.0));
  uint next = imageAtomicExchange(heads, ivec3(texel, map), index + 1u);
  listed[index] = ListedPixel(lifted(pixel, s, light, map), next);
}

// Lists a sample, and returns what it is without casters and its map.
vec2 mask_of(ivec2 pixel, uint index, Surface s) {
  int count = int(frame.light.w);
  vec3 light = light_at(frame.light_place, s.position);
  int map = map_serving(s.position, s.depth, light, frame.selection.x, count);
  bool faces_light = dot(s.normal, light) < 0.0;
  if (map >= 0 && faces_light) list(pixel, index, s, light, map);
  return vec2(faces_light || count == 0 ? 1.0 : 0.0, float(map));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = textureSize(position_image, 0);
  if (any(greaterThanEqual(pixel, size))) return;
  Surface s = surface_at(pixel);
  uint first = uint(pixel.y * size.x + pixel.x) * uint(samples);
  vec2 mask = vec2(1.0, -1.0);
  for (int i = 0; i < samples; ++i) {
    uint index = first + uint(i);
    listed[index].next = 0u;
    if (!s.receives) continue;
    Surface at = s;
    if (samples > 1) {
      at.position = facet_point(s, i, samples);
      at.depth = dot(at.position, frame.forward.xyz);
    }
    vec2 sampled = mask_of(pixel, index, at);
    if (i == 0) mask = sampled;
    if (sampled.x == 0.0) listed[index].next = kShadowed;
  }
  imageStore(mask_image, pixel, vec4(mask, 0.0, 0.0));
}
