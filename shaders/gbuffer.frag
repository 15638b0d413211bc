#version 450 core
// The surfaces that the camera sees.
#include "common/gbuffer.glsl"
