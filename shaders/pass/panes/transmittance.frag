#version 450 core
// The share of each colour that reaches a pixel's surface through the panes before it. Moments of where the panes absorb
// say how much of that lies in front of the surface, and the mean place of each colour how it differs. Two panes are exact.
// The part <place> says where a point lies in the images of panes, of the map that the mask names: pane_place().
#include "pass/common/frame.glsl"
#include "pass/panes/pane_light.glsl"
#include "pass/common/surface.glsl"
#include "library/moments.glsl"

layout(binding = 3) uniform sampler2DArray pane_moments;
layout(binding = 6) uniform sampler2D mask_image;
layout(binding = 7) uniform sampler2DArray pane_absorbance;
layout(binding = 5) uniform sampler2DArray pane_places;
layout(location = 0) out vec4 transmittance_out;

// Where a point lies in the images of panes.
struct PanePlace {
  vec2 texel;
  float layer;
  vec4 drawn;  // texels that hold the panes of its map: least and largest
};

#include <place>

float share_before(vec4 moments, float at) {
  if (at >= 1.0) return 1.0;
  if (at <= 0.0) return 0.0;
  const float kBias = 1e-5;  // rounded moments may be no moments at all
  vec4 b = mix(moments, vec4(0.0, 0.375, 0.0, 0.375), kBias);
  float u = 2.0 * at - 1.0;
  vec2 z;
  float least = share_in_front(b, u, z);
  // At most that, and what may lie at the surface itself: half of it.
  float own = (z.x * z.y - b.x * (z.x + z.y) + b.y) / ((u - z.x) * (u - z.y));
  float share = least + 0.5 * own;
  return share > 0.0 ? min(share, 1.0) : 0.0;
}

// The same by colour: absorbance is parted between the two places that the first three moments stand for, as each
// colour's mean place says.
vec3 shares_before(vec4 moments, vec3 mean_places, float share) {
  float variance = moments.y - moments.x * moments.x;
  const float kOnePlace = 1e-5;
  if (variance < kOnePlace) return vec3(share);
  float sum = (moments.z - moments.x * moments.y) / variance, product = sum * moments.x - moments.y;
  float root = sqrt(max(0.25 * sum * sum - product, 0.0));
  float near = 0.5 * sum - root, far = 0.5 * sum + root;
  float first = (far - moments.x) / (far - near);
  vec3 first_of = clamp((far - mean_places) / (far - near), 0.0, 1.0);
  if (share <= first) return first_of * (share / first);
  return 1.0 - (1.0 - first_of) * ((1.0 - share) / max(1.0 - first, 1e-9));
}

// Bilinear by hand: the images may be larger than this frame needs, and what hardware makes of a place in them changes by
// roundings with their size. `last`: the largest texel.
vec4 between_texels(sampler2DArray images, vec2 texel, ivec2 last, int layer) {
  vec2 first = floor(texel - 0.5), part = texel - 0.5 - first;
  ivec2 a = ivec2(first), b = min(a + 1, last);
  vec4 low = mix(texelFetch(images, ivec3(a, layer), 0), texelFetch(images, ivec3(b.x, a.y, layer), 0), part.x);
  vec4 high = mix(texelFetch(images, ivec3(a.x, b.y, layer), 0), texelFetch(images, ivec3(b, layer), 0), part.x);
  return mix(low, high, part.y);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  int index = int(texelFetch(mask_image, pixel, 0).g);
  transmittance_out = vec4(1.0);
  if (s.sky || index < 0) return;
  PanePlace place = pane_place(index, s.position);
  if (any(lessThan(place.texel, place.drawn.xy)) || any(greaterThan(place.texel, place.drawn.zw))) return;
  // At the edge of a map nothing beyond it is read; other edges are empty.
  vec2 texel = clamp(place.texel, place.drawn.xy + 0.5, place.drawn.zw - 0.5);
  ivec2 last = ivec2(place.drawn.zw) - 1;
  int layer = int(place.layer);
  vec3 absorbed = between_texels(pane_absorbance, texel, last, layer).rgb;
  vec4 places = between_texels(pane_places, texel, last, layer);
  const float kNothing = 1e-6;
  if (places.a < kNothing) return;
  vec4 moments = between_texels(pane_moments, texel, last, layer) / places.a;
  float share = share_before(moments, share_of_range(s.position));
  transmittance_out.rgb = exp(-absorbed * shares_before(moments, places.rgb / max(absorbed, vec3(1e-9)), share));
}
