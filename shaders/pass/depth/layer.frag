#version 450 core
// The depth that a map stores, from those of its first and its second surface.
#include "library/depth_layer.glsl"

layout(binding = 5) uniform sampler2DArray first_surface;
layout(binding = 6) uniform sampler2DArray second_surface;
layout(location = 0) uniform int layer;  // gnomon::render::DepthLayer
layout(location = 1) uniform vec2 curve_and_limit;

void main() {
  ivec3 texel = ivec3(gl_FragCoord.xy, 0);
  gl_FragDepth = depth_of_layer(layer, texelFetch(first_surface, texel, 0).r, texelFetch(second_surface, texel, 0).r,
                                curve_and_limit.x, curve_and_limit.y);
}
