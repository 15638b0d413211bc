// Points of the facet that a pixel shows: its plane, as far as the pixel's square reaches. gnomon::trace::facet_axes is its twin.
// Based on: Pan et al., "Fast, Sub-pixel Antialiased Shadow Maps", 2009.
#ifndef GNOMON_LISTS_FACET_GLSL
#define GNOMON_LISTS_FACET_GLSL
#include "pass/common/frame.glsl"
#include "pass/common/surface.glsl"

// Place of a sample in its pixel, from -0.5 to 0.5 along both sides: a lattice by the golden ratio, symmetric about the centre. The
// mean error of a straight edge is about half of 1 / count, where that of a sequence that serves any count is as large as that.
vec2 place_in_pixel(int index, int count) {
  const float kGolden = 0.6180339887498949;
  float from_middle = float(index) - 0.5 * float(count - 1);
  return vec2(from_middle / float(count), fract(0.5 + from_middle * kGolden) - 0.5);
}

// A step of one pixel, moved along the eye's ray onto the surface's plane. A facet that is seen from its edge would reach to
// infinity: it ends at twice its distance.
vec3 step_on_plane(Surface s, vec4 side) {
  bool orthographic = frame.forward.w > 0.5;
  vec3 step = side.xyz * (side.w * (orthographic ? 1.0 : s.depth)), ray = orthographic ? frame.forward.xyz : s.position;
  float across = dot(s.normal, ray);
  return across < 0.0 ? step - ray * clamp(dot(s.normal, step) / across, -1.0, 1.0) : vec3(0.0);
}

vec3 facet_point(Surface s, int index, int count) {
  vec2 place = place_in_pixel(index, count);
  return s.position + step_on_plane(s, frame.right) * place.x + step_on_plane(s, frame.up) * place.y;
}
#endif
