#version 450 core
// The blur along y, of what store.frag has blurred along x.
#include "common/blur_texels.glsl"
