// Percentage-closer soft shadows (Fernando 2005): the mean distance of what blocks gives the penumbra's width, and that
// the kernel. Distances are world units along the light, whatever the map's warp.
#include "library/compare.glsl"
#include "library/disc.glsl"
#include "library/penumbra.glsl"

// The disc of that radius in texels, at least one and at most the kernel's own.
mat2 disc_of(ShadowLookup at, float radius_world) {
  mat2 disc = radius_world * at.texels_per_world;
  float width = sqrt(max(dot(disc[0], disc[0]), dot(disc[1], disc[1])));
  float widest = sqrt(max(dot(at.disc[0], at.disc[0]), dot(at.disc[1], at.disc[1])));
  if (width < 1.0) return width > 0.0 ? disc / width : mat2(1.0);
  return disc * min(1.0, max(widest, 1.0) / width);
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  int search_samples = int(options.value[2]), samples = int(options.value[3]);
  vec2 first = vogel_first(options.value[4] > 0.5 ? at.rotation : 0.0);
  mat2 search = disc_of(at, penumbra_radius(at, options, max(distance_to_depth(at, 0.0), 0.0)));
  float sum = 0.0;
  int blockers = 0;
  vec2 direction = first;
  for (int i = 0; i < search_samples; ++i) {
    vec2 texel = floor(at.texel + search * (vogel_radius(i, search_samples) * direction)) + 0.5;
    direction = vogel_turned(direction);
    float stored = depth_of_texel(textureLod(depth_map, vec3(texel / at.layer_size, at.layer), 0.0).r);
    if (plane_depth(at, texel - at.texel) <= stored) continue;
    sum += max(distance_to_depth(at, stored), 0.0);
    ++blockers;
  }
  if (blockers == 0) return 1.0;
  mat2 disc = disc_of(at, penumbra_radius(at, options, sum / float(blockers)));
  float lit = 0.0;
  direction = first;
  for (int i = 0; i < samples; ++i) {
    lit += compare_2x2(depth_map, at, at.texel + disc * (vogel_radius(i, samples) * direction));
    direction = vogel_turned(direction);
  }
  return lit / float(samples);
}
