// The slot of a page in a layer of the pool. In its level's numbers the page is the first map.
const int map = 0;
layout(location = 0) uniform int slot_layer;
layout(location = 1) uniform ivec4 slot;  // lower left corner, width, height

const bool kTiled = false;
ivec4 place_in(ivec2 size) { return slot; }
int layer() { return slot_layer; }
