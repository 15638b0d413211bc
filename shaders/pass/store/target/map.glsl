// A layer of the stored maps.
layout(location = 0) uniform int map;

const bool kTiled = true;  // tiles that no look-up reads are skipped
ivec4 place_in(ivec2 size) { return ivec4(0, 0, size); }
int layer() { return map; }
