#version 450 core
// A caster's fragment in a map. The part <depth> says how deep it lies there, and may discard it: place_fragment(), texcoord_here().
// The part <alpha> says whether its texture cuts it out: is_cut_out().
#include <alpha>
#include <depth>

void main() {
  place_fragment();
  if (is_cut_out(texcoord_here())) discard;
}
