// The depth that a layer of gnomon::render::DepthLayer stores, from the depths of the first and the second surface in a texel:
// 0 near the light .. 1, where 1 is no surface (Woo 1992; Weiskopf, Ertl 2003).
#ifndef GNOMON_LIBRARY_DEPTH_LAYER_GLSL
#define GNOMON_LIBRARY_DEPTH_LAYER_GLSL
#include "library/lookup.glsl"

const int kLayerSecond = 2, kLayerMidpoint = 3, kLayerDual = 4;

// `curve`: see linear_depth. `limit`: how far behind the first surface kLayerDual may store, as a share of the map's range.
float depth_of_layer(int layer, float first, float second, float curve, float limit) {
  if (layer < kLayerSecond || first >= 1.0) return first;
  bool has_second = second < 1.0;
  if (layer == kLayerSecond) return has_second ? second : first;
  if (layer == kLayerMidpoint && !has_second) return first;
  float near_end = linear_depth(first, curve);
  float stored = has_second ? 0.5 * (near_end + linear_depth(second, curve)) : 1.0;
  if (layer == kLayerDual) stored = min(stored, near_end + limit);
  return depth_from_linear(min(stored, 1.0), curve);
}
#endif
