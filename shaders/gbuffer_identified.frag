#version 450 core
// The surfaces that the camera sees, and the numbers that maps know them by.
#define GNOMON_IDENTIFIED
#include "common/gbuffer.glsl"
