#version 450 core
// Lists the tiles of one map that a frame has to fill, and the strips that their blur reads.
#include "pass/store/tiles.glsl"

layout(local_size_x = 64) in;
layout(binding = 0, r8ui) readonly uniform uimage2DArray states;
layout(std430, binding = 3) buffer TileLists GNOMON_TILE_LISTS lists;
layout(std430, binding = 4) buffer Count { uint texels; } count;
layout(location = 0) uniform int layer;
layout(location = 1) uniform ivec3 job;  // texels along x and y to be filled; taps of the blur to either side

const int kStripsOfTile = kTileSide / kStripRows;

bool wanted(ivec2 tile) {
  ivec2 size = imageSize(states).xy;
  bool inside = all(greaterThanEqual(tile, ivec2(0))) && all(lessThan(tile, size));
  return inside && imageLoad(states, ivec3(tile, layer)).x == kWanted;
}

// `per_group`: entries that one group fills.
void append(int which, ivec2 place, int per_group) {
  ivec2 size = imageSize(states).xy;
  uint at = atomicAdd(lists.entries[which], 1u);
  lists.entry[list_begin(which, size.x * size.y) + int(at)] = uint(place.x) | uint(place.y) << 16;
  if (int(at) % per_group == 0) atomicAdd(lists.groups[which].x, 1u);
}

void main() {
  ivec2 size = imageSize(states).xy;
  int index = int(gl_GlobalInvocationID.x);
  if (index >= size.x * size.y * kStripsOfTile) return;
  ivec2 strip = ivec2(index % size.x, index / size.x);
  ivec2 tile = ivec2(strip.x, strip.y / kStripsOfTile);
  ivec2 filled = min(job.xy - tile * kTileSide, ivec2(kTileSide));
  if (any(lessThanEqual(filled, ivec2(0)))) return;
  if (strip.y % kStripsOfTile == 0 && wanted(tile)) {
    append(kTiles, tile, 1);
    atomicAdd(count.texels, uint(filled.x * filled.y));
  }
  // No blur is wider than a tile to either side.
  int low = strip.y * kStripRows - job.z, high = strip.y * kStripRows + kStripRows - 1 + job.z;
  bool rows = false;
  for (int y = low < 0 ? 0 : low / kTileSide; y <= high / kTileSide; ++y) rows = rows || wanted(ivec2(tile.x, y));
  const int kStripsOfGroup = 4;
  if (rows) append(kRows, strip, kStripsOfGroup);
}
