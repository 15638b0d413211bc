// Shadow-map ray tracing: rays from the receiver to points of the light's disc, each marched through the depth map. A
// stretch of the ray is blocked by what the map stores in it, or by what joins casters above and below the ray.
#include "library/compare.glsl"
#include "library/disc.glsl"
#include "library/penumbra.glsl"

// Where that reaches the kernel's radius, which bounds the march; beyond it the ray keeps to its last texel.
vec2 within_kernel(ShadowLookup at, vec2 offset) {
  float widest = max(sqrt(max(dot(at.disc[0], at.disc[0]), dot(at.disc[1], at.disc[1]))), 1.0);
  return offset * min(1.0, widest / max(length(offset), 1e-6));
}

// Distance to what the texel under the offset stores; below 0 where that does not stand before the receiver's plane.
float caster_at(sampler2DArray depth_map, ShadowLookup at, vec2 offset) {
  vec2 texel = floor(at.texel + offset) + 0.5;
  float stored = depth_of_texel(textureLod(depth_map, vec3(texel / at.layer_size, at.layer), 0.0).r);
  return plane_depth(at, texel - at.texel) <= stored ? -1.0 : max(distance_to_depth(at, stored), 0.0);
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  int rays = int(options.value[2]), steps = int(options.value[3]);
  float turn = options.value[4] > 0.5 ? at.rotation : 0.0;
  vec2 first = vogel_first(turn), direction = first;
  // Most points have no caster at all, and casters lie at a few distances.
  const int kSearched = 16;
  float reach = max(distance_to_depth(at, 0.0), 0.0), nearest = reach, farthest = 0.0;
  float search = penumbra_radius(at, options, reach);
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
      float caster = caster_at(depth_map, at, within_kernel(at, at.texels_per_world * (penumbra_radius(at, options, away) * aim)));
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
