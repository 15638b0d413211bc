// The part of a listed tile that an invocation of a walk fills.
#ifndef GNOMON_STORE_LISTED_TILES_GLSL
#define GNOMON_STORE_LISTED_TILES_GLSL
#include "pass/store/tiles.glsl"

layout(std430, binding = 3) readonly buffer TileLists GNOMON_TILE_LISTS lists;

// Row, and first column, of a walk of one tile's width along x. Row -1: nothing is left to do.
ivec2 listed_row(int tiles) {
  int index = int(gl_GlobalInvocationID.x) / kStripRows;
  if (index >= int(lists.entries[kRows])) return ivec2(0, -1);
  uint strip = lists.entry[list_begin(kRows, tiles) + index];
  return ivec2(int(strip & 0xffffu) * kTileSide,
               int(strip >> 16) * kStripRows + int(gl_GlobalInvocationID.x) % kStripRows);
}

// Column, and first row, of a walk of one tile's height along y: a group is a tile.
ivec2 listed_column() {
  uint tile = lists.entry[gl_WorkGroupID.x];
  return ivec2(int(tile & 0xffffu), int(tile >> 16)) * kTileSide + ivec2(int(gl_LocalInvocationID.x), 0);
}
#endif
