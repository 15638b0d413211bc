#version 450 core
// Panes as sums over a texel: their absorbance by colour, and the moments of where along the light they absorb.
#include "pass/panes/pane.glsl"
#include "pass/panes/pane_light.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texcoord;
layout(location = 0) out vec4 absorbance_out;  // -ln(transmittance) by colour
layout(location = 1) out vec4 moments_out;     // mean absorbance times u, u^2, u^3, u^4; u from -1 to 1
layout(location = 2) out vec4 places_out;      // absorbance times u by colour; the mean absorbance

void main() {
  const float kLeast = 1e-3;  // what absorbs more is black in eight bits as well
  vec3 absorbance = -log(clamp(pane_transmittance(texcoord), kLeast, 1.0));
  float mean = (absorbance.r + absorbance.g + absorbance.b) / 3.0;
  float u = 2.0 * clamp(share_of_range(position), 0.0, 1.0) - 1.0, u2 = u * u;
  absorbance_out = vec4(absorbance, 0.0);
  moments_out = mean * vec4(u, u2, u2 * u, u2 * u2);
  places_out = vec4(absorbance * u, mean);
}
