#version 450 core
// Panes against the pixels of a texel's list: what each absorbs on the light's way to a pixel, summed up in whole numbers, so
// that the order of the sum does not matter.
#include "pass/lists/triangle.glsl"
#include "pass/lists/listed_panes.glsl"
#include "pass/panes/pane.glsl"

layout(location = 3) flat in vec2 texcoord[3];

vec3 weights_of_hit;

bool is_there(vec3 weights) {
  weights_of_hit = weights;
  return true;
}

void main() {
  const float kLeast = 1e-3;  // as map.frag
  uint next = texelFetch(heads, ivec3(gl_FragCoord.xy, map), 0).r;
  while (next != 0u) {
    uint index = next - 1u;
    ListedPixel pixel = listed[index];
    next = pixel.next & ~kShadowed;
    if (!shadows(pixel.at)) continue;
    vec3 w = weights_of_hit;
    vec3 passes = pane_transmittance(w.x * texcoord[0] + w.y * texcoord[1] + w.z * texcoord[2]);
    vec3 absorbance = -log(clamp(passes, kLeast, 1.0));
    for (int c = 0; c < 3; ++c) {
      uint steps = uint(absorbance[c] * kAbsorbanceSteps + 0.5);
      if (absorbed[3u * index + uint(c)] < kBlack) atomicAdd(absorbed[3u * index + uint(c)], steps);
    }
  }
}
