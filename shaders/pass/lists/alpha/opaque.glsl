// Opaque casters.
bool is_there(vec3 weights) { return true; }
