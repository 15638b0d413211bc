// Whether a texel, or one that its blur along y goes into, lies in a tile that the frame has to fill.
#ifndef GNOMON_STORE_WANTED_GLSL
#define GNOMON_STORE_WANTED_GLSL
#include "pass/store/tiles.glsl"

layout(binding = 0, r8ui) readonly uniform uimage2DArray tile_states;

bool wanted_within(ivec2 texel, int reach, int layer) {
  int last = imageSize(tile_states).y - 1;
  int low = max(texel.y - reach, 0) / kTileSide, high = min((texel.y + reach) / kTileSide, last);
  bool wanted = false;
  for (int y = low; y <= high; ++y) {
    wanted = wanted || imageLoad(tile_states, ivec3(texel.x / kTileSide, y, layer)).x == kWanted;
  }
  return wanted;
}
#endif
