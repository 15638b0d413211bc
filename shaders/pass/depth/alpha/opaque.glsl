// Opaque casters.
bool is_cut_out(vec2 texcoord) { return false; }
