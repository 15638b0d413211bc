#version 450 core
// Panes before the picture: what shines through is multiplied with what is there.
#include "pass/panes/pane.glsl"

layout(location = 1) in vec2 texcoord;
layout(location = 0) out vec4 factor_out;

void main() { factor_out = vec4(pane_transmittance(texcoord), 1.0); }
