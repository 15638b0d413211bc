#version 450 core
// The depths of static casters, bit for bit.
layout(location = 0) uniform int layer;
layout(binding = 5) uniform sampler2DArray static_depths;

void main() { gl_FragDepth = texelFetch(static_depths, ivec3(gl_FragCoord.xy, layer), 0).r; }
