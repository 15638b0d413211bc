// Absorbance of the panes before each listed sample, in whole steps by colour.
#ifndef GNOMON_LISTS_LISTED_PANES_GLSL
#define GNOMON_LISTS_LISTED_PANES_GLSL
const float kAbsorbanceSteps = 262144.0;  // of -ln(transmittance) 1: a pane is rounded by 2e-6 of the light
const uint kBlack = 0x80000000u;          // more is not counted: no light passes, and the sum would overflow

layout(std430, binding = 2) buffer ListedPanes { uint absorbed[]; };  // red, green, blue of a sample
#endif
