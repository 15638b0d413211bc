// How strongly a light lights a surface: the mask, the angle, and a local light's cone and range.
#ifndef GNOMON_SHADE_LIT_GLSL
#define GNOMON_SHADE_LIT_GLSL
#include "pass/common/frame.glsl"
#include "pass/shade/sky.glsl"
#include "pass/common/surface.glsl"

layout(binding = 6) uniform sampler2D mask_image;

vec3 view_ray(vec2 pixel) {
  vec2 at = vec2(pixel.x * frame.right.w + frame.image_edges.x, pixel.y * frame.up.w + frame.image_edges.z);
  if (frame.forward.w > 0.5) return frame.forward.xyz;
  return normalize(frame.forward.xyz + at.x * frame.right.xyz + at.y * frame.up.xyz);
}

// Falloff by distance, which ends softly at the range. By the inverse square as KHR_lights_punctual recommends it.
float distance_falloff(LightRecord by, float away) {
  const float kNearest = 0.01;  // world units: at the light itself the square would have no end
  float range = by.layer.z;
  float part = range > 0.0 ? away / range : 0.0;
  float fade = clamp(1.0 - part, 0.0, 1.0);
  bool inverse_square = by.light_place.w > 1.5;
  if (!inverse_square) return fade * (2.0 - fade);
  float square = max(away, kNearest);
  return clamp(1.0 - part * part * part * part, 0.0, 1.0) / (square * square);
}

// Falloff of a local light by its cone and range; both end softly.
float local_light_falloff(LightRecord by, vec3 ray, float away) {
  float cone = smoothstep(by.light_cone.w, mix(by.light_cone.w, 1.0, 0.1), dot(ray, by.light_cone.xyz));
  return (by.light_cone.w > -1.0 ? cone : 1.0) * distance_falloff(by, away);
}

bool is_local_light(LightRecord by) { return by.light_place.w > 0.5; }

// 1 for a sun.
float falloff_at(LightRecord by, Surface s) {
  vec3 ray_of_light = light_at(by.light_place, s.position);
  return is_local_light(by) ? local_light_falloff(by, ray_of_light, length(s.position - by.light_place.xyz)) : 1.0;
}

// `lit`: of the mask, 1 lit .. 0 in shadow.
float light_on(LightRecord by, Surface s, float lit) {
  vec3 ray_of_light = light_at(by.light_place, s.position);
  float cosine = max(-dot(s.shading_normal, ray_of_light), 0.0);
  // Faded where smooth normals still see the sun and their flat triangles no longer do: else triangles show.
  const float kTerminator = 0.2;
  float sun = cosine * smoothstep(0.0, kTerminator, cosine) * lit;
  if (is_local_light(by)) sun *= local_light_falloff(by, ray_of_light, length(s.position - by.light_place.xyz));
  return sun;
}
float light_on(LightRecord by, Surface s, ivec2 pixel) { return light_on(by, s, texelFetch(mask_image, pixel, 0).r); }

// A little air in the distance.
vec3 through_air(vec3 color, Surface s, vec3 ray, vec3 light) {
  const float kHazeAtFar = 0.35;  // share of the horizon's colour where the air is thick
  float haze = kHazeAtFar * smoothstep(0.2, 1.0, s.depth / frame.layer.w);
  vec3 horizon = sky_color(normalize(vec3(ray.x, 0.02, ray.z)), light);
  return mix(color, horizon, haze);
}
#endif
