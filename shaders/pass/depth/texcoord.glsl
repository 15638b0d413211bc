// Where a fragment lies in its texture, from depth.vert or layered.vert.
#ifndef GNOMON_DEPTH_TEXCOORD_GLSL
#define GNOMON_DEPTH_TEXCOORD_GLSL
layout(location = 0) in vec2 texcoord;

vec2 texcoord_here() { return texcoord; }
#endif
