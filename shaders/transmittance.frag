#version 450 core
// Share of the light that panes leave at each pixel, from a layer for each map.
#include "common/transmittance.glsl"

layout(location = 7) uniform vec4 drawn[kMaxMaps];  // by map: PanePlace::drawn

PanePlace pane_place(int index, vec3 position) {
  ShadowMap map = shadow_map(index);
  vec4 h = map.clip_from_point * vec4(position, 1.0);
  return PanePlace(shaped_point(map.shape, map.interval_size.zw, h.xy / h.w).texel, layer_of_map(index), drawn[index]);
}
