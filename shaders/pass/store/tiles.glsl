// States of the tiles of filtered maps, and the lists of tiles that the passes of a blur fill.
#ifndef GNOMON_STORE_TILES_GLSL
#define GNOMON_STORE_TILES_GLSL
const int kTileSide = 32;  // texels, gnomon::render::kTileSide
const int kStripRows = 8;  // texels: a quarter of a tile high, so that a blur's border costs little

// A tile holds no valid texels; holds them; or is read by this frame and has to be filled.
const uint kStale = 0u, kHolds = 1u, kWanted = 2u;

// Two lists, each after what an indirect dispatch reads: tiles, and strips of 8 rows of a tile whose blur along y ends in a
// wanted tile. An entry is a column and a row, 16 bits each.
const int kTiles = 0, kRows = 1;
#define GNOMON_TILE_LISTS                                                                                    \
  {                                                                                                          \
    uvec4 groups[2];                                                                                         \
    uvec4 entries; /* of each list */                                                                        \
    uint entry[];                                                                                            \
  }

// Where a list begins, of a layer of so many tiles.
int list_begin(int which, int tiles) { return which == kTiles ? 0 : tiles; }
#endif
