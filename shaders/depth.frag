#version 450 core
// Opaque casters: the depth alone.
void main() {}
