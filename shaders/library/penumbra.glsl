// How wide is the penumbra of a light with a size? Options 0 and 1 of every filter that includes this: the angle in degrees
// of a directional light, and the radius of a local light.
#ifndef GNOMON_LIBRARY_PENUMBRA_GLSL
#define GNOMON_LIBRARY_PENUMBRA_GLSL
#include "library/lookup.glsl"

// Radius of the light's disc seen through a point `away` from the receiver, across the light at the receiver.
float penumbra_radius(ShadowLookup at, ShadowOptions options, float away) {
  if (at.light_distance == 0.0) return tan(0.5 * radians(options.value[0])) * away;
  return options.value[1] * away / max(at.light_distance - away, 0.01 * at.light_distance);
}
#endif
