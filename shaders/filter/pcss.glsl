// Percentage-closer soft shadows (Fernando 2005): the mean distance of what blocks gives the penumbra's width, and that
// the kernel. Distances are world units along the light, whatever the map's warp.
#include "filter/option/pcss.glsl"
#include "library/caster.glsl"
#include "library/compare.glsl"
#include "library/disc.glsl"
#include "library/penumbra.glsl"

// The disc of that radius in texels, at least one and at most the kernel's own.
mat2 disc_of(ShadowLookup at, float radius_world) {
  mat2 disc = radius_world * at.texels_per_world;
  float width = widest_axis(disc), widest = widest_axis(at.disc);
  if (width < 1.0) return width > 0.0 ? disc / width : mat2(1.0);
  return disc * min(1.0, max(widest, 1.0) / width);
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  int search_samples = int(options.value[option_search_samples]), samples = int(options.value[option_samples]);
  vec2 first = vogel_first(options.value[option_rotate] > 0.5 ? at.rotation : 0.0);
  float angle_deg = options.value[option_angle_deg], light_radius = options.value[option_light_radius];
  mat2 search = disc_of(at, penumbra_radius(at, angle_deg, light_radius, max(distance_to_depth(at, 0.0), 0.0)));
  float sum = 0.0;
  int blockers = 0;
  vec2 direction = first;
  for (int i = 0; i < search_samples; ++i) {
    float blocker = caster_at(depth_map, at, search * (vogel_radius(i, search_samples) * direction));
    direction = vogel_turned(direction);
    if (blocker < 0.0) continue;
    sum += blocker;
    ++blockers;
  }
  if (blockers == 0) return 1.0;
  mat2 disc = disc_of(at, penumbra_radius(at, angle_deg, light_radius, sum / float(blockers)));
  float lit = 0.0;
  direction = first;
  for (int i = 0; i < samples; ++i) {
    lit += compare_2x2(depth_map, at, at.texel + disc * (vogel_radius(i, samples) * direction));
    direction = vogel_turned(direction);
  }
  return lit / float(samples);
}
