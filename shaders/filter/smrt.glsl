// Shadow-map ray tracing: rays from the receiver to points of the light's disc, each marched through the depth map. A
// stretch of the ray is blocked by what the map stores in it, or by what joins casters above and below the ray.
#include "filter/option/smrt.glsl"
#include "library/caster.glsl"
#include "library/disc.glsl"
#include "library/penumbra.glsl"

// Where that reaches the kernel's radius, which bounds the march; beyond it the ray keeps to its last texel.
vec2 within_kernel(ShadowLookup at, vec2 offset) {
  float widest = max(widest_axis(at.disc), 1.0);
  return offset * min(1.0, widest / max(length(offset), 1e-6));
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  int rays = int(options.value[option_rays]), steps = int(options.value[option_steps]);
  float turn = options.value[option_rotate] > 0.5 ? at.rotation : 0.0;
  float angle_deg = options.value[option_angle_deg], light_radius = options.value[option_light_radius];
  vec2 first = vogel_first(turn), direction = first;
  // Most points have no caster at all, and casters lie at a few distances.
  const int kSearched = 16;
  float reach = max(distance_to_depth(at, 0.0), 0.0), nearest = reach, farthest = 0.0;
  float search = penumbra_radius(at, angle_deg, light_radius, reach);
  bool any = false;
  for (int i = 0; i < kSearched; ++i) {
    vec2 offset = within_kernel(at, at.texels_per_world * (search * vogel_radius(i, kSearched) * direction));
    direction = vogel_turned(direction);
    float caster = caster_at(depth_map, at, offset);
    if (caster < 0.0) continue;
    any = true;
    nearest = min(nearest, caster);
    farthest = max(farthest, caster);
  }
  if (!any) return 1.0;
  direction = first;
  int blocked = 0;
  for (int i = 0; i < rays; ++i) {
    vec2 aim = vogel_radius(i, rays) * direction;
    direction = vogel_turned(direction);
    float inside = fract(turn * 0.15915494 + 0.5 + 0.41421356 * float(i));
    bool under = false;
    for (int k = 0; k < steps; ++k) {
      // The first stretch ends at the nearest caster found, the last has no end.
      float begin = k == 0 ? 0.0 : mix(nearest, farthest, float(k - 1) / float(steps - 1));
      float end = k == 0 && steps > 1 ? nearest : mix(nearest, farthest, float(k) / float(max(steps - 1, 1)));
      float away = mix(begin, end, inside);
      float radius = penumbra_radius(at, angle_deg, light_radius, away);
      float caster = caster_at(depth_map, at, within_kernel(at, at.texels_per_world * (radius * aim)));
      bool beyond = k + 1 < steps && caster >= end, before = caster < begin;
      // From under one caster to above another: through what joins them.
      bool crossed = under && before && caster >= 0.0;
      under = beyond;
      if ((beyond || before) && !crossed) continue;
      ++blocked;
      break;
    }
  }
  return 1.0 - float(blocked) / float(rays);
}
