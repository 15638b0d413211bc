#version 450 core
// A short march towards the light through what the camera sees, where a shadow map lights what lies close behind a caster: by
// its bias, or by the filter's fall-off. The least of it and the mask counts.
#include "pass/common/frame_maps.glsl"
#include "pass/common/surface.glsl"
#include "library/receiver.glsl"
#include "library/select_map.glsl"

layout(location = 0) uniform float fall_off[GNOMON_MAX_MAPS];  // per map: contact_reach_world
layout(location = 0) out vec2 mask;                            // 0 in shadow; more than the number of any map

// How far along the ray to the light the bias passes casters by, world units.
float bias_reach(ShadowMap map, Surface s, vec3 light) {
  vec3 side_x, side_y;
  texel_sides(map_point(map, s.position), light, side_x, side_y);
  float texel = max(length(side_x), length(side_y));
  float cosine = -dot(s.normal, light), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  float tangent = min(sine / max(cosine, 1e-6), frame.bias.w);
  return texel * (frame.bias.x + 2.0 * frame.bias.y * tangent + frame.bias.z * tangent);
}

float depth_of(vec3 position) { return dot(frame.forward.xyz, position); }

vec3 clip_of(vec3 position) {
  vec4 h = frame.clip_from_camera_relative * vec4(position, 1.0);
  return vec3(h.xy, h.w);
}

// Whether the surface of a pixel stands in the way from `before` to `point`, which is seen there: by crossing it, or by lying
// nearer to the eye than `point` by no more than `thick`. Nothing is known of what lies farther behind a surface.
bool blocks(ivec2 pixel, vec3 before, vec3 point, float depth, float room, float reach, float thick) {
  vec4 at = texelFetch(position_image, pixel, 0);
  float away = distance(point, at.xyz);
  if (depth < at.w || away >= reach || texelFetch(albedo_image, pixel, 0).a == 0.0) return false;
  vec3 normal = unit_from_octahedral(texelFetch(normal_image, pixel, 0).xy);
  return dot(point - at.xyz, normal) < -room && (away < thick || dot(before - at.xyz, normal) >= -room);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), size = textureSize(position_image, 0);
  Surface s = surface_at(pixel);
  vec3 light = light_at(frame.light_place, s.position);
  if (!s.receives || dot(s.normal, light) >= 0.0) discard;
  int map = map_serving(s.position, s.depth, light, frame.selection.x, int(frame.light.w));
  if (map < 0) discard;
  float by_bias = bias_reach(shadow_map(map), s, light), reach = max(fall_off[map], by_bias);
  if (frame.light_place.w != 0.0) reach = min(reach, distance(s.position, frame.light_place.xyz));
  // Casters are as thick as what the bias passes by: thinner, the march leaves gaps; thicker, wires shadow what they hide.
  float thick = 0.5 * by_bias;
  vec3 way = -light * reach;
  vec3 begin = clip_of(s.position), end = clip_of(s.position + way);
  // Not to the eye and behind it.
  const float kNearest = 0.5;
  if (end.z < kNearest * begin.z) {
    float part = (1.0 - kNearest) * begin.z / (begin.z - end.z);
    way *= part;
    end = mix(begin, end, part);
  }
  vec2 first = (begin.xy / begin.z * 0.5 + 0.5) * vec2(size), last = (end.xy / end.z * 0.5 + 0.5) * vec2(size);
  const float kMaxSteps = 32.0, kRoom = 1e-5;  // of the view depth: rounding of positions
  // Longer steps would pass casters by at some pixels and not at others: what is far along the way stays as the map has it.
  const float kLongestStep = 2.0;  // pixels
  float pixels = distance(first, last);
  way *= min(1.0, kLongestStep * kMaxSteps / max(pixels, 1.0));
  float steps = min(ceil(pixels), kMaxSteps), room = kRoom * s.depth;
  float step_world = length(way) / steps;
  thick = max(thick, step_world);
  vec3 before = s.position;
  for (float i = 1.0; i <= steps; ++i) {
    vec3 point = s.position + way * (i / steps);
    vec3 h = clip_of(point);
    ivec2 seen = ivec2(floor((h.xy / h.z * 0.5 + 0.5) * vec2(size)));
    if (any(lessThan(seen, ivec2(0))) || any(greaterThanEqual(seen, size))) break;
    if (seen != pixel && blocks(seen, before, point, depth_of(point), room, min(reach, 2.0 * step_world), thick)) {
      mask = vec2(0.0, 1e30);
      return;
    }
    before = point;
  }
  discard;
}
