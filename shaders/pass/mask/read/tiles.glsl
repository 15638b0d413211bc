// No filter: marks the tiles of filtered maps that the look-ups would read.
#include "library/footprint.glsl"
#include "pass/store/tiles.glsl"

layout(binding = 0, r8ui) uniform uimage2DArray tile_states;
layout(location = 1) uniform int levels;  // of the stored texels' mip-maps, 1: none

// The largest level of four neighbouring pixels: software renderers read all four at the level of one.
float level_of_quad(float level) {
  vec2 odd = vec2(ivec2(gl_FragCoord.xy) & 1);
  float along_x = level + max(dFdxFine(level) * (1.0 - 2.0 * odd.x), 0.0);
  return along_x + max(dFdyFine(along_x) * (1.0 - 2.0 * odd.y), 0.0);
}

void mark_texels(vec2 low, vec2 high, int layer) {
  ivec2 last = imageSize(tile_states).xy - 1;
  // Not-a-number and places beyond integers end at the layer's corners.
  ivec2 first = clamp(ivec2(clamp(low, vec2(0.0), vec2(65536.0))) / kTileSide, ivec2(0), last);
  ivec2 end = clamp(ivec2(clamp(high, vec2(0.0), vec2(65536.0))) / kTileSide, ivec2(0), last);
  for (int y = first.y; y <= end.y; ++y) {
    for (int x = first.x; x <= end.x; ++x) {
      if (imageLoad(tile_states, ivec3(x, y, layer)).x == kStale) {
        imageStore(tile_states, ivec3(x, y, layer), uvec4(kWanted, 0u, 0u, 0u));
      }
    }
  }
}

float visibility(ShadowLookup at, ShadowMap map, ShadowOptions options) {
  int layer = int(at.layer);
  const float kBilinear = 1.0;  // texels to either side of a point
  if (levels <= 1) {
    mark_texels(at.texel - kBilinear, at.texel + kBilinear, layer);
    return 1.0;
  }
  FootprintReads reads = footprint_reads(at, int(filtering.sums.z));
  float level = level_of_quad(reads.level), top = float(levels - 1);
  int coarsest = level < top ? int(ceil(max(level, 0.0))) : levels - 1;  // not-a-number: all
  // A texel of a level spans this much, also where sizes are no powers of two; one more to either side for how drivers
  // make such levels.
  vec2 span = at.layer_size / vec2(max(ivec2(at.layer_size) >> coarsest, ivec2(1)));
  vec2 beyond = coarsest == 0 ? vec2(kBilinear) : 2.5 * span;
  for (int read = 0; read < reads.count; ++read) {
    vec2 place = at.texel + (float(read) - 0.5 * float(reads.count - 1)) * reads.apart;
    mark_texels(place - beyond, place + beyond, layer);
  }
  return 1.0;
}
