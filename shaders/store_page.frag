#version 450 core
// The same within the slot of a page.
#define GNOMON_PAGES
#include "common/store_texels.glsl"
