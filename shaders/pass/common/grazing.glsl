// When does light only graze a surface? As src/base/grazing.hpp has it.
#ifndef GNOMON_COMMON_GRAZING_GLSL
#define GNOMON_COMMON_GRAZING_GLSL
const float kGrazing = 1e-3;  // at less than this cosine
#endif
