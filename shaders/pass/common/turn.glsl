// On which side of an edge the origin lies.
#ifndef GNOMON_COMMON_TURN_GLSL
#define GNOMON_COMMON_TURN_GLSL
// Both sides of an edge get the same bits but for the sign, so that no ray slips through between two triangles.
float turn(vec2 a, vec2 b) {
  precise float turn = a.x * b.y - a.y * b.x;
  return turn;
}
#endif
