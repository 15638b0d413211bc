#version 450 core
// The mask over several frames: this frame's result joins what re-projection finds of the frames before, weighted by how
// close the look-up came to its texel's centre (Scherzer, Jeschke, Wimmer 2007).
#include "pass/common/filter.glsl"
#include "pass/common/frame.glsl"
#include "pass/common/surface.glsl"
#include "library/receiver.glsl"

layout(binding = 6) uniform sampler2D mask_image;     // of this frame alone
layout(binding = 7) uniform sampler2D history_image;  // mean, weight, view depth; weight 0: nothing
layout(std140, binding = 2) uniform History {
  mat4 clip_before;    // of the camera one frame before, from points relative to this frame's
  vec4 depth_before;   // view depth there: dot(xyz, point) + w
  vec4 settings;       // confidence's power, most weight, share that depths may be off, 1: there is a history
  uvec4 moved_count;   // x: boxes round casters that moved, before and after
  vec4 moved_min[32];  // relative to this frame's camera
  vec4 moved_max[32];
} history;
layout(location = 0) out vec2 mask;  // 1 lit .. 0 in shadow; map or -1
layout(location = 1) out vec4 kept;

ShadowLookup lookup_of(Surface s, float map) {
  ShadowMap m = frame.maps[int(map)];
  ShadowLookup at =
      shadow_lookup(m, map, frame.layer.xy, ShadowSurface(s.position, s.normal, frame.light_place), frame.bias);
  set_kernel(at, m, ShadowKernel(filtering.kernel.x, filtering.kernel.y > 0.5, false), mat2(0.0));
  return at;
}

// Whether a caster that moved is between the surface and the light now, or was before, the kernel's radius beside it included.
bool behind_moved(Surface s, ShadowLookup at) {
  float radius = (max(at.box.x, at.box.y) + 1.0) * texel_side(at);
  vec3 to_light = -light_at(frame.light_place, s.position);
  const float kFar = 1e30, kAlong = 1e-20;
  float most = at.light_distance > 0.0 ? at.light_distance : kFar;
  for (uint i = 0u; i < history.moved_count.x; ++i) {
    vec3 low = history.moved_min[i].xyz - radius - s.position, high = history.moved_max[i].xyz + radius - s.position;
    float enter = 0.0, leave = most;
    for (int axis = 0; axis < 3; ++axis) {
      float way = abs(to_light[axis]) > kAlong ? to_light[axis] : kAlong;
      float one = low[axis] / way, other = high[axis] / way;
      enter = max(enter, min(one, other));
      leave = min(leave, max(one, other));
    }
    if (enter <= leave) return true;
  }
  return false;
}

// 1 at a texel's centre .. 0 at its border, to the power, in units of a frame's mean over evenly spread places.
float confidence(ShadowLookup at) {
  vec2 away = abs(fract(at.texel) - 0.5);
  float power = history.settings.x;
  float scale = 0.5 * (power + 1.0) * (power + 2.0);
  // No texel is without any weight: what was seen once is better than nothing.
  const float kLeast = 1e-6;
  return scale * max(pow(max(1.0 - 2.0 * max(away.x, away.y), 0.0), power), kLeast);
}

// How much of the most weight a history keeps that is read between pixels. These reads wear off details of a few pixels. The map
// has none that are smaller than its texels and its kernel; where those are small, this frame alone is closer.
float kept_share(Surface s, ShadowLookup at) {
  float pixel = frame.up.w * (frame.forward.w > 0.5 ? 1.0 : s.depth);
  float pixels = 2.0 * max(at.box.x, at.box.y) * texel_side(at) / pixel;
  const float kNone = 1.0, kWhole = 4.0;
  return smoothstep(kNone, kWhole, pixels);
}

// Weights of the four pixels round a place whose share of the step from the second to the third is x: Catmull and Rom's
// spline, which keeps edges sharp however often the history is read between pixels.
vec4 spline(float x) {
  float x2 = x * x, x3 = x2 * x;
  return 0.5 * vec4(-x3 + 2.0 * x2 - x, 3.0 * x3 - 5.0 * x2 + 2.0, -3.0 * x3 + 4.0 * x2 + x, x3 - x2);
}

// A surface one frame before: its place among the pixels' centres, and the depths that its plane has at others.
struct Before {
  bool in_front;
  vec2 place;
  float depth;
  vec2 depth_step, w_step;  // to the right and upwards: what the depth's numerator and denominator change by
};

Before before_at(Surface s, vec2 size) {
  vec4 h = history.clip_before * vec4(s.position, 1.0);
  if (h.w <= 0.0) return Before(false, vec2(0.0), 0.0, vec2(0.0), vec2(0.0));
  vec2 image = h.xy / h.w;
  float depth = dot(history.depth_before.xyz, s.position) + history.depth_before.w;
  Before before = Before(true, (image * 0.5 + 0.5) * size - 0.5, depth, vec2(0.0), vec2(0.0));
  // Two steps on the plane, as long as the depth.
  vec3 aside = abs(s.normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 one = normalize(cross(s.normal, aside)) * depth, two = cross(s.normal, one);
  vec4 clip_one = history.clip_before * vec4(one, 0.0), clip_two = history.clip_before * vec4(two, 0.0);
  vec2 pixels_one = (clip_one.xy - image * clip_one.w) * (0.5 * size / h.w);
  vec2 pixels_two = (clip_two.xy - image * clip_two.w) * (0.5 * size / h.w);
  float area = pixels_one.x * pixels_two.y - pixels_one.y * pixels_two.x;
  // Beside a plane that is seen from its edge, neighbours count that are as deep as the point.
  const float kLeastArea = 1e-3;
  if (abs(area) < kLeastArea * size.x * size.y) return before;
  vec2 depths = vec2(dot(history.depth_before.xyz, one), dot(history.depth_before.xyz, two));
  vec2 ws = vec2(clip_one.w, clip_two.w) / h.w;
  mat2 per_pixel = mat2(pixels_two.y, -pixels_two.x, -pixels_one.y, pixels_one.x) * (1.0 / area);
  before.w_step = -(per_pixel * ws);
  before.depth_step = per_pixel * depths + depth * before.w_step;
  return before;
}

// Weight > 0 where the history of this pixel is that of a surface in the same plane.
vec4 known_at(ivec2 pixel, ivec2 size, Before at) {
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) return vec4(0.0);
  vec4 known = texelFetch(history_image, pixel, 0);
  vec2 away = vec2(pixel) - at.place;
  float w = 1.0 + dot(at.w_step, away);
  // Towards the plane's horizon all depths are near each other.
  const float kLeastW = 0.25;
  if (w < kLeastW) return vec4(0.0);
  float depth = (at.depth + dot(at.depth_step, away)) / w;
  return abs(known.z - depth) <= history.settings.z * abs(depth) ? known : vec4(0.0);
}

// Mean and weight at the place where the point was; of the nearest four pixels where the sixteen show other surfaces as well.
vec2 history_at(Surface s, ShadowLookup lookup) {
  ivec2 size = textureSize(history_image, 0);
  Before at = before_at(s, vec2(size));
  if (history.settings.w < 0.5 || !at.in_front) return vec2(0.0);
  const float kSame = 1.0 / 256.0;  // of a pixel: rounding, where the camera is at rest
  vec2 nearest = round(at.place);
  if (all(lessThan(abs(at.place - nearest), vec2(kSame)))) return known_at(ivec2(nearest), size, at).xy;
  ivec2 first = ivec2(floor(at.place));
  vec2 part = at.place - vec2(first);
  vec4 spline_x = spline(part.x), spline_y = spline(part.y);
  vec4 bilinear_x = vec4(0.0, 1.0 - part.x, part.x, 0.0), bilinear_y = vec4(0.0, 1.0 - part.y, part.y, 0.0);
  float curve = 0.0, sum = 0.0, weights = 0.0;
  bool whole = true;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      vec4 known = known_at(first + ivec2(x - 1, y - 1), size, at);
      whole = whole && known.y > 0.0;
      curve += spline_x[x] * spline_y[y] * known.x;
      float weight = bilinear_x[x] * bilinear_y[y] * known.y;
      weights += weight;
      sum += weight * known.x;
    }
  }
  if (weights <= 0.0) return vec2(0.0);
  float most = history.settings.y * kept_share(s, lookup);
  return vec2(whole ? clamp(curve, 0.0, 1.0) : sum / weights, min(weights, most));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Surface s = surface_at(pixel);
  mask = texelFetch(mask_image, pixel, 0).rg;
  kept = vec4(mask.r, 0.0, s.depth, 0.0);
  // No map was read: the result is certain, and the same in every frame.
  if (s.sky || mask.g < 0.0 || dot(s.normal, light_at(frame.light_place, s.position)) >= 0.0) return;
  ShadowLookup at = lookup_of(s, mask.g);
  vec2 before = behind_moved(s, at) ? vec2(0.0) : history_at(s, at);
  before.y = min(before.y, history.settings.y);
  float weight = confidence(at);
  float total = before.y + weight;
  if (before.y > 0.0) mask.r = (before.x * before.y + mask.r * weight) / total;
  kept = vec4(mask.r, total, s.depth, 0.0);
}
