#version 450 core
// Opaque casters into a map whose shape bends lines: the depth alone.
#include "common/bent.glsl"

void main() { covered(); }
