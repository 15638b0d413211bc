// Reads stored texels through the hardware's filters: bilinear, and over at.footprint where there are mip-maps. A long
// footprint is read at several places along it: what drivers make of one differs, in width and at widths near zero.
#include "library/lookup.glsl"

// `probes`: at most so many reads along at.footprint[0], the longer axis. Spread so that together they have the ellipse's
// variance, of which a trilinear read over r texels has r^2 / 4.
ShadowTexel fetch_filtered(sampler2DArray stored[GNOMON_SHADOW_VECTORS], ShadowLookup at, int probes) {
  const float kApart = 1.7320508;  // steps between probes in reads' radii: many in a row then have the right variance
  float longest = length(at.footprint[0]);
  float radius = max(length(at.footprint[1]), 1.0);
  if (probes <= 1 || longest <= radius) {
    radius = max(longest, 1.0);
    probes = 1;
  } else {
    radius = min(max(radius, kApart * longest / float(probes)), longest);
    probes = min(int(ceil(kApart * longest / radius)), probes);
  }
  float level = log2(radius);
  float apart = probes > 1 ? sqrt(3.0 * (longest * longest - radius * radius) / float(probes * probes - 1)) : 0.0;
  vec2 step_to = probes > 1 ? at.footprint[0] * (apart / longest) : vec2(0.0);
  ShadowTexel texel;
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel.v[i] = vec4(0.0);
  for (int probe = 0; probe < probes; ++probe) {
    vec2 place = at.texel + (float(probe) - 0.5 * float(probes - 1)) * step_to;
    vec3 coordinate = vec3(place / at.layer_size, at.layer);
    for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel.v[i] += textureLod(stored[i], coordinate, level);
  }
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel.v[i] /= float(probes);
  return texel;
}
