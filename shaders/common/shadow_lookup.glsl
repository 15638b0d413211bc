// What a filter is asked: a point in one layer of the map array, in texels.
struct ShadowLookup {
  vec2 texel;           // position; the centre of texel i is at i + 0.5
  float layer;
  float depth;          // of the receiver, 0 near the light .. 1, bias taken off
  vec2 depth_gradient;  // change of the receiver plane's depth per texel
  vec2 layer_size;      // texels of a layer along x and y
};

// Mirrors FilterParameters.
struct ShadowParameters {
  float radius_texels;
};
