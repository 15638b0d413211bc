// By identifiers: a surface is lit where it is what the light sees, whatever the depths.
// Based on: Hourcade, Nicolas, "Algorithms for Antialiased Cast Shadows", 1985.

layout(binding = 8) uniform usampler2DArray seen_by_light;
layout(binding = 9) uniform usampler2D seen_by_camera;
layout(location = 1) uniform int neighbours;  // texels to either side that may hold the identifier as well

float visibility(ShadowLookup at, ShadowMap map, ShadowOptions options) {
  uint own = texelFetch(seen_by_camera, ivec2(gl_FragCoord.xy), 0).r;
  // Casters alone are in the maps: of others the depth says what is before them.
  if (own == 0u) return shadow_visibility(shadow_compare, shadow_depth, at, options);
  ivec2 texel = ivec2(floor(at.texel)), last = ivec2(map.interval_size.zw) - 1;
  for (int y = -neighbours; y <= neighbours; ++y) {
    for (int x = -neighbours; x <= neighbours; ++x) {
      ivec2 place = texel + ivec2(x, y);
      bool inside = all(greaterThanEqual(place, ivec2(0))) && all(lessThanEqual(place, last));
      uint there = inside ? texelFetch(seen_by_light, ivec3(place, int(at.layer)), 0).r : 0u;
      // Nothing is before a surface whose own texel is empty.
      if (there == own || (there == 0u && place == texel)) return 1.0;
    }
  }
  return 0.0;
}
