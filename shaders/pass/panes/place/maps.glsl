// A layer for each map.
#include "pass/common/frame.glsl"

layout(location = 7) uniform vec4 drawn[kMaxMaps];  // by map: PanePlace::drawn

PanePlace pane_place(int index, vec3 position) {
  ShadowMap map = frame.maps[index];
  vec4 h = map.clip_from_point * vec4(position, 1.0);
  return PanePlace(shaped_point(map.shape, map.interval_size.zw, h.xy / h.w).texel, float(index), drawn[index]);
}
