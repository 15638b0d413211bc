#version 450 core
// From depths to stored texels, and the blur along x in the same pass.
#include "common/store_texels.glsl"
