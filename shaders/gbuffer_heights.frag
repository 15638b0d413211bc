#version 450 core
// The surfaces that the camera sees, and how far off its triangle each point was rounded.
#define GNOMON_HEIGHTS
#include "common/gbuffer.glsl"
