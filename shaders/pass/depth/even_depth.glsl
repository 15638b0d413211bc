// Depths that grow evenly along the light: z of clip space without its division by w.
#ifndef GNOMON_DEPTH_EVEN_DEPTH_GLSL
#define GNOMON_DEPTH_EVEN_DEPTH_GLSL
layout(location = 2) in float clip_z;
layout(location = 10) uniform float even_scale;  // 1 over the largest clip z in the map; 0: depths are divided by w

float fragment_depth() { return even_scale > 0.0 ? clamp(clip_z * even_scale, 0.0, 1.0) : gl_FragCoord.z; }
#endif
