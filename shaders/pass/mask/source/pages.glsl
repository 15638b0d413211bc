// Pages of a pool: each is a map of its own, somewhere in a layer.
#include "pass/common/frame.glsl"
#include "pass/page/tables.glsl"

LightRecord lit_by() { return light_of_frame(); }
int map_at(Surface s, vec3 light) { return page_serving(s.position, int(page_counts.x), page_counts.y - 1u); }

ShadowMap shadow_map(int index) {
  ShadowMap map = frame.maps[0];
  map.clip_from_point = page_records[index].clip_from_point;
  map.interval_size.zw = frame.layer.xy;
  map.kernel.w = page_filters[page_records[index].key.x].curve.x;
  return map;
}
float layer_of_map(int index) { return float(page_records[index].key.w); }

// Those of the page's level.
ShadowOptions options_of_map(int index) {
  ShadowOptions options = shadow_options(0);
  for (int i = 0; i < 4 * kOptionVectors; ++i)
    options.value[i] = page_filters[page_records[index].key.x].options[i / 4][i & 3];
  return options;
}
