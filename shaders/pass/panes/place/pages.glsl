// Places for the pages that panes reach.
#include "pass/common/frame.glsl"
#include "pass/page/tables.glsl"

struct PanePage {
  vec4 from_pool;  // texel of the images from one of the page's layer in the pool: scale, offset
  vec4 drawn;      // PanePlace::drawn; none: no texel
  vec4 layer;      // of the images; 0, 0, 0
};
layout(std430, binding = 6) readonly buffer PanePages { PanePage pane_pages[]; };

PanePlace pane_place(int index, vec3 position) {
  PanePage page = pane_pages[index];
  vec4 h = page_records[index].clip_from_point * vec4(position, 1.0);
  vec2 texel = (h.xy / h.w * 0.5 + 0.5) * frame.layer.xy;
  return PanePlace(texel * page.from_pool.xy + page.from_pool.zw, page.layer.x, page.drawn);
}
