// How wide is the penumbra of a light with a size?
#ifndef GNOMON_LIBRARY_PENUMBRA_GLSL
#define GNOMON_LIBRARY_PENUMBRA_GLSL
#include "library/lookup.glsl"

// Radius of the light's disc seen through a point `away` from the receiver, across the light at the receiver. The disc is
// `angle_deg` degrees wide for a directional light; a local light has `light_radius`.
float penumbra_radius(ShadowLookup at, float angle_deg, float light_radius, float away) {
  if (at.light_distance == 0.0) return tan(0.5 * radians(angle_deg)) * away;
  return light_radius * away / max(at.light_distance - away, 0.01 * at.light_distance);
}
#endif
