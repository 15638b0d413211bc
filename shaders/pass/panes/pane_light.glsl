// How far along the light a point lies, as a share of the panes' own extent: 0 at the nearest pane, 1 at the farthest.
#ifndef GNOMON_PANES_PANE_LIGHT_GLSL
#define GNOMON_PANES_PANE_LIGHT_GLSL
layout(location = 5) uniform vec4 pane_light;  // way of parallel light; position and 1
layout(location = 6) uniform vec2 pane_range;  // of the panes' distances

float share_of_range(vec3 position) {
  float away = pane_light.w > 0.5 ? length(position - pane_light.xyz) : dot(position, pane_light.xyz);
  return (away - pane_range.x) / (pane_range.y - pane_range.x);
}
#endif
