// Where mip-maps are read so that together the reads have the footprint's variance: a long footprint at several places
// along it, for what drivers make of one differs, in width and at widths near zero.
#ifndef GNOMON_LIBRARY_FOOTPRINT_GLSL
#define GNOMON_LIBRARY_FOOTPRINT_GLSL
#include "library/lookup.glsl"

struct FootprintReads {
  float level;
  int count;
  vec2 apart;  // texels from each read to the next, along the longer axis
};

// `probes`: at most so many reads along at.footprint[0], the longer axis. The variance of a trilinear read
// over r texels is r^2 / 4.
FootprintReads footprint_reads(ShadowLookup at, int probes) {
  const float kApart = 1.7320508;  // steps between probes in reads' radii: many in a row then have the right variance
  float longest = length(at.footprint[0]);
  float radius = max(length(at.footprint[1]), 1.0);
  if (probes <= 1 || longest <= radius) return FootprintReads(log2(max(longest, 1.0)), 1, vec2(0.0));
  radius = min(max(radius, kApart * longest / float(probes)), longest);
  int count = min(int(ceil(kApart * longest / radius)), probes);
  if (count <= 1) return FootprintReads(log2(radius), 1, vec2(0.0));
  float apart = sqrt(3.0 * (longest * longest - radius * radius) / float(count * count - 1));
  return FootprintReads(log2(radius), count, at.footprint[0] * (apart / longest));
}
#endif
