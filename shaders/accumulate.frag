#version 450 core
// The mask over several frames: this frame's result joins what re-projection finds of the frames before, weighted by how
// close the look-up came to its texel's centre (Scherzer, Jeschke, Wimmer 2007).
#include "common/frame.glsl"
#include "common/surface.glsl"
#include "library/receiver.glsl"

layout(binding = 6) uniform sampler2D mask_image;     // of this frame alone
layout(binding = 7) uniform sampler2D history_image;  // mean, weight, view depth; weight 0: nothing
layout(std140, binding = 2) uniform History {
  mat4 clip_before;    // of the camera one frame before, from points relative to this frame's
  vec4 depth_before;   // view depth there: dot(xyz, point) + w
  vec4 settings;       // confidence's power, most weight, share that depths may be off, 1: there is a history
} history;
layout(location = 0) out vec2 mask;  // 1 lit .. 0 in shadow; map or -1
layout(location = 1) out vec4 kept;

// 1 at a texel's centre .. 0 at its border, to the power, in units of a frame's mean over evenly spread places.
float confidence(Surface s, float map) {
  ShadowLookup at = shadow_lookup(shadow_map(int(map)), map, frame.layer.xy,
                                  ShadowSurface(s.position, s.normal, frame.light_place), frame.bias);
  vec2 away = abs(fract(at.texel) - 0.5);
  float power = history.settings.x;
  float scale = 0.5 * (power + 1.0) * (power + 2.0);
  // No texel is without any weight: what was seen once is better than nothing.
  const float kLeast = 1e-6;
  return scale * max(pow(max(1.0 - 2.0 * max(away.x, away.y), 0.0), power), kLeast);
}

// Weights of the four pixels round a place whose share of the step from the second to the third is x: Catmull and Rom's
// spline, which keeps edges sharp however often the history is read between pixels.
vec4 spline(float x) {
  float x2 = x * x, x3 = x2 * x;
  return 0.5 * vec4(-x3 + 2.0 * x2 - x, 3.0 * x3 - 5.0 * x2 + 2.0, -3.0 * x3 + 4.0 * x2 + x, x3 - x2);
}

// Weight > 0 where the history of this pixel is that of a surface at this depth.
vec4 known_at(ivec2 pixel, ivec2 size, float depth) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) return vec4(0.0);
  vec4 before = texelFetch(history_image, pixel, 0);
  return abs(before.z - depth) <= history.settings.z * abs(depth) ? before : vec4(0.0);
}

// Mean and weight at the place where the point was; of the nearest four pixels where the sixteen show other surfaces as well.
vec2 history_at(Surface s) {
  vec4 h = history.clip_before * vec4(s.position, 1.0);
  if (history.settings.w < 0.5 || h.w <= 0.0) return vec2(0.0);
  ivec2 size = textureSize(history_image, 0);
  vec2 place = (h.xy / h.w * 0.5 + 0.5) * vec2(size) - 0.5;
  float depth = dot(history.depth_before.xyz, s.position) + history.depth_before.w;
  const float kSame = 1.0 / 256.0;  // of a pixel: rounding, where the camera is at rest
  vec2 nearest = round(place);
  if (all(lessThan(abs(place - nearest), vec2(kSame)))) return known_at(ivec2(nearest), size, depth).xy;
  ivec2 first = ivec2(floor(place));
  vec2 part = place - vec2(first);
  vec4 spline_x = spline(part.x), spline_y = spline(part.y);
  vec4 bilinear_x = vec4(0.0, 1.0 - part.x, part.x, 0.0), bilinear_y = vec4(0.0, 1.0 - part.y, part.y, 0.0);
  float curve = 0.0, sum = 0.0, weights = 0.0;
  bool whole = true;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      vec4 before = known_at(first + ivec2(x - 1, y - 1), size, depth);
      whole = whole && before.y > 0.0;
      curve += spline_x[x] * spline_y[y] * before.x;
      float weight = bilinear_x[x] * bilinear_y[y] * before.y;
      weights += weight;
      sum += weight * before.x;
    }
  }
  if (weights <= 0.0) return vec2(0.0);
  return vec2(whole ? clamp(curve, 0.0, 1.0) : sum / weights, weights);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  mask = texelFetch(mask_image, pixel, 0).rg;
  kept = vec4(mask.r, 0.0, s.depth, 0.0);
  // No map was read: the result is certain, and the same in every frame.
  if (s.sky || mask.g < 0.0 || dot(s.normal, light_at(frame.light_place, s.position)) >= 0.0) return;
  vec2 before = history_at(s);
  before.y = min(before.y, history.settings.y);
  float weight = confidence(s, mask.g);
  float total = before.y + weight;
  if (before.y > 0.0) mask.r = (before.x * before.y + mask.r * weight) / total;
  kept = vec4(mask.r, total, s.depth, 0.0);
}
