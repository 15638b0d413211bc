// The pages of the frame: each is a map of its own, somewhere in a layer of the pool.
#ifndef GNOMON_PAGE_TABLES_GLSL
#define GNOMON_PAGE_TABLES_GLSL
#include "library/pages.glsl"

struct PageRecord {
  mat4 clip_from_point;  // x, y -1..1 over the layer of the pool, z 0 near the light .. w
  uvec4 key;             // level, column, row; layer
};

layout(std430, binding = 2) readonly buffer PageLevels { PageLevel page_levels[]; };
layout(std430, binding = 3) readonly buffer PageRecords { PageRecord page_records[]; };
layout(std430, binding = 4) readonly buffer PageTable {
  uvec4 page_counts;  // levels; entries of the table; border of a page, texels; 0
  uint page_entries[];
};

struct PageFilter {
  vec4 options[4];  // FilterSettings::option of the level
  vec4 curve;       // depth curve of its stored texels; 0
};
layout(std430, binding = 5) readonly buffer PageFilters { PageFilter page_filters[]; };

PageLevel page_level(int index) { return page_levels[index]; }
uvec4 page_key(uint page) { return page_records[page].key; }
uint page_table(uint at) { return page_entries[at]; }
#endif
