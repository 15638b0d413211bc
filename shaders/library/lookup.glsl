// Input, options and stored texel of a filter. The includer defines GNOMON_SHADOW_VECTORS, the number of
// vec4 that a stored texel takes (1 for filters that store nothing).
#ifndef GNOMON_LIBRARY_LOOKUP_GLSL
#define GNOMON_LIBRARY_LOOKUP_GLSL
struct ShadowTexel {
  vec4 v[GNOMON_SHADOW_VECTORS];
};

// A point in one layer of the map array, in texels.
struct ShadowLookup {
  vec2 texel;             // position; the centre of texel i is at i + 0.5
  float layer;
  float depth_curve;      // map depths are read through linear_depth with it; 0: as they are
  float depth;            // of the receiver, 0 near the light .. 1, bias taken off
  vec2 depth_gradient;    // change of the receiver plane's depth per texel of the point's own lengths
  vec4 ends;              // offsets, texels, beyond which texels have other lengths: xy below the point, zw above
  vec4 longer;            // of those texels over the point's own, less 1; 0: all are alike
  vec2 layer_size;        // texels of a layer along x and y
  vec2 box;               // half sides of the kernel as a box, texels
  mat2 disc;              // the kernel as an ellipse: texels from the unit disc
  mat2 footprint;         // axes of what is left to average after the stored texels' own blur, texels
  vec2 pixel;             // half sides of the box that has the pixel's variance, texels; 0: kernels take no part of it
  mat2 texels_per_world;  // texels per world unit along two axes across the light
  vec4 ray;               // see distance_to_depth
  float light_distance;   // world units; 0: parallel light
  float rotation;         // radians, random from pixel to pixel
};

// The filter's options, and what the stored format does to numbers.
struct ShadowOptions {
  float value[16];  // at option_NAME of filter/option/FILTER.glsl: those of gnomon::render::FilterInfo, then the filter's own
  float rounding;  // of a number near 1
  bool unsigned_unit;  // only 0..1 can be stored
};

// Depths as maps are read, 0 near the light .. 1, from depths as a depth buffer holds them. The includer defines
// GNOMON_REVERSED_Z where the maps were drawn with ClipSpace::reversed_z; its comparing sampler then takes GREATER_OR_EQUAL
// in place of LESS_OR_EQUAL.
#ifdef GNOMON_REVERSED_Z
float depth_of_texel(float texel) { return 1.0 - texel; }
vec4 depth_of_texel(vec4 texels) { return 1.0 - texels; }
float texel_of_depth(float depth) { return 1.0 - depth; }
#else
float depth_of_texel(float texel) { return texel; }
vec4 depth_of_texel(vec4 texels) { return texels; }
float texel_of_depth(float depth) { return depth; }
#endif

// Perspective crowds the depths of a local light's map at the far end. With curve = far / near - 1 this makes them linear in
// distance, 0 near .. 1 far; curve 0, for directional lights, changes nothing.
float linear_depth(float depth, float curve) { return depth / (1.0 + (1.0 - depth) * curve); }
// The other way.
float depth_from_linear(float linear, float curve) { return linear * (1.0 + curve) / (1.0 + linear * curve); }

// The longest side of a texel across the light, world units.
float texel_side(ShadowLookup at) {
  mat2 m = at.texels_per_world;
  return max(length(vec2(m[0].x, m[1].x)), length(vec2(m[0].y, m[1].y))) / abs(m[0].x * m[1].y - m[1].x * m[0].y);
}

// From the receiver towards the light to where the map's depth is z, world units; negative behind the receiver.
float distance_to_depth(ShadowLookup at, float z) {
  float slope = at.ray.z - z * at.ray.w;
  return slope == 0.0 ? 0.0 : (at.ray.x - z * at.ray.y) / slope;
}
#endif
