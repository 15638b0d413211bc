// No panes.
vec3 transmitted(ivec2 pixel) { return vec3(1.0); }
