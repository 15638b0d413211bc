// The block of numbers that gnomon::shader_block fills: one layout under std140 and std430. The includer declares a buffer
// of this type and supplies shadow_map() from it.
#ifndef GNOMON_LIBRARY_SHADOW_BLOCK_GLSL
#define GNOMON_LIBRARY_SHADOW_BLOCK_GLSL
#include "library/shadow_map.glsl"

#ifndef GNOMON_MAX_MAPS
#define GNOMON_MAX_MAPS 8
#endif

struct ShadowBlock {
  vec4 light;  // as light_at takes it
  vec4 bias;   // constant, slope, normal offset in texels, largest slope: as shadow_lookup takes it
  vec4 layer;  // texels of a layer along x and y; number of maps; selection, as map_serving takes it
  ShadowMap maps[GNOMON_MAX_MAPS];
};
#endif
