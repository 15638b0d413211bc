// Nothing more.
void store_extra(vec3 geometric) {}
