// Which page of a page plan serves a point: gnomon::page_serving over the tables that gnomon::PagePlan holds. The includer
// supplies page_level(), page_key() and page_table().
#ifndef GNOMON_LIBRARY_PAGES_GLSL
#define GNOMON_LIBRARY_PAGES_GLSL

struct PageLevel {
  mat4 clip_from_point;   // x, y -1..1 over the whole virtual map
  vec4 select_planes[4];  // of the face of a cube: holds points with dot(xyz, point) + w >= 0; (0, 0, 0, 1) where unused
  ivec4 grid;             // columns, rows; face; 0
};

PageLevel page_level(int index);  // levels are ordered from coarse to fine
uvec4 page_key(uint page);        // level, column, row; place in the pool
uint page_table(uint at);         // gnomon::PagePlan::table

// As gnomon::page_hash.
uint page_hash(uint level, ivec2 cell) {
  uint h = level * 0x9E3779B1u;
  h = (h ^ uint(cell.x)) * 0x85EBCA77u;
  h ^= h >> 15;
  h = (h ^ uint(cell.y)) * 0xC2B2AE3Du;
  return h ^ (h >> 13);
}

// The resident page at a cell of a level, or -1. `mask`: entries of the table less 1.
int page_at(uint level, ivec2 cell, uint mask) {
  for (uint at = page_hash(level, cell) & mask;; at = (at + 1u) & mask) {
    uint entry = page_table(at);
    if (entry == 0u) return -1;
    if (page_key(entry - 1u).xyz == uvec3(level, uvec2(cell))) return int(entry - 1u);
  }
}

bool in_face(PageLevel level, vec3 position) {
  bool held = true;
  for (int i = 0; i < 4; ++i) held = held && dot(level.select_planes[i].xyz, position) + level.select_planes[i].w >= 0.0;
  return held;
}

// The page of the last level of a face that has a resident one there, or -1.
int page_of_face(vec3 position, int face, int level_count, uint table_mask) {
  for (int i = level_count - 1; i >= 0; --i) {
    PageLevel level = page_level(i);
    if (level.grid.z != face) continue;
    vec4 h = level.clip_from_point * vec4(position, 1.0);
    if (h.w <= 0.0 || any(greaterThan(abs(h.xy), vec2(h.w)))) continue;
    ivec2 cell = min(ivec2((h.xy / h.w * 0.5 + 0.5) * vec2(level.grid.xy)), level.grid.xy - 1);
    int page = page_at(uint(i), cell, table_mask);
    if (page >= 0) return page;
  }
  return -1;
}

// The page that serves a point: of the last level that has a resident page there, or -1. Faces of a cube share a
// little at their edges, where the map of one may end at what it serves: the first with a page there serves it.
int page_serving(vec3 position, int level_count, uint table_mask) {
  const int kNoFace = 1 << 20;
  for (int tried = -1;;) {
    int face = kNoFace;
    for (int i = 0; i < level_count; ++i) {
      PageLevel level = page_level(i);
      if (level.grid.z > tried && level.grid.z < face && in_face(level, position)) face = level.grid.z;
    }
    if (face == kNoFace) return -1;
    int page = page_of_face(position, face, level_count, table_mask);
    if (page >= 0) return page;
    tried = face;
  }
}
#endif
