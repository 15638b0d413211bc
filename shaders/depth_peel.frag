#version 450 core
// Opaque casters behind the first surface: the depth alone.
#include "common/peel.glsl"

void main() {
  if (is_peeled_off()) discard;
  gl_FragDepth = fragment_depth();
}
