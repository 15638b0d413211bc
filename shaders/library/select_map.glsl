// Which shadow map serves a point: by its view depth, by what the maps hold, or the finest one; and how one map passes
// into the next. -1: none does, and nothing can shadow the point.
#ifndef GNOMON_LIBRARY_SELECT_MAP_GLSL
#define GNOMON_LIBRARY_SELECT_MAP_GLSL
#include "library/shadow_map.glsl"

// True inside the planes that part the maps, and inside the map's rectangle less `border_texels` along each side. Any z.
bool map_spans(ShadowMap map, vec3 position, float border_texels) {
  vec4 h = map.clip_from_point * vec4(position, 1.0);
  // Less than nothing is kept free where rounding is forgiven: a little beyond the square then counts as well.
  vec2 square = vec2(1.0 + 2.0 * max(-border_texels, 0.0) / map.interval_size.zw);
  bool held = h.w > 0.0 && all(lessThanEqual(abs(h.xy), square * h.w));
  vec2 texel = held ? shaped_point(map.shape, map.interval_size.zw, h.xy / h.w).texel : vec2(0.0);
  held = held && all(greaterThanEqual(texel, vec2(border_texels))) &&
         all(lessThanEqual(texel, map.interval_size.zw - border_texels));
  for (int i = 0; i < 4; ++i) held = held && dot(map.select_planes[i].xyz, position) + map.select_planes[i].w >= 0.0;
  return held;
}

// Inside the border that the plan reserves for filters, and between the map's near and far plane: gnomon::map_holds, with a
// quarter texel of the border for rounding.
bool map_holds(ShadowMap map, vec3 position) {
  const float kRim = 0.25, kSlack = 1e-5;
  float z = dot(matrix_row(map.clip_from_point, 2), position) + map.clip_from_point[3][2];
  float w = dot(matrix_row(map.clip_from_point, 3), position) + map.clip_from_point[3][3];
  return map_spans(map, position, map.kernel.x - kRim) && z >= -kSlack * w && z <= (1.0 + kSlack) * w;
}

// The first map whose depths, widened by `slack` of themselves at both ends, hold this one.
int map_at_depth(float view_depth, float slack, int count) {
  for (int i = 0; i < count; ++i) {
    vec2 interval = shadow_map(i).interval_size.xy;
    vec2 wider = interval + vec2(-slack, slack) * max(abs(interval.x), abs(interval.y));
    if (view_depth >= wider.x && view_depth <= wider.y) return i;
  }
  return -1;
}

// Maps that follow each other in view depth, as in gnomon::map_serving: a point that no map holds belongs to the map
// whose end it misses by rounding. Depths between two maps that belong to neither hold no shadow: the plan pruned them, since
// no caster reaches them. A point that its own map does not hold goes to the next.
int map_by_depth(vec3 position, float view_depth, int count) {
  const float kSlack = 1e-5;  // view depths are rounded to float on their way here
  int own = map_at_depth(view_depth, 0.0, count);
  if (own < 0) own = map_at_depth(view_depth, kSlack, count);
  for (int i = own; i >= 0 && i < count; ++i) {
    if (map_spans(shadow_map(i), position, 0.0)) return i;
  }
  return -1;
}

// The first map that holds the point: the faces of a cube round the light, receivers parted by planes, and cascades
// whose maps were drawn with all casters.
int map_by_hold(vec3 position, int count) {
  for (int i = 0; i < count; ++i) {
    if (map_holds(shadow_map(i), position)) return i;
  }
  return -1;
}

// Among the maps that hold the point with a kernel of `radius_world` round it, the one with the smallest texels there; of
// equal ones the first. With a radius of 0: gnomon::map_serving of a plan with MapSelection::finest.
// `light`: the way it travels at the point.
int map_of_finest_texel(vec3 position, float radius_world, vec3 light, int count) {
  int best = -1;
  float best_area = 0.0;
  for (int i = 0; i < count; ++i) {
    ShadowMap map = shadow_map(i);
    if (!map_holds(map, position)) continue;
    MapPoint p = map_point(map, position);
    float reach = radius_world * sqrt(max(dot(p.d_texel_x, p.d_texel_x), dot(p.d_texel_y, p.d_texel_y)));
    if (!map_spans(map, position, reach)) continue;
    float density = abs(dot(cross(p.d_texel_x, p.d_texel_y), light));  // texels per area across the light
    if (best < 0 || density > best_area) {
      best = i;
      best_area = density;
    }
  }
  return best;
}

// The map that serves a point, as gnomon::map_serving finds it. `selection`: 0 by view depth, 1 by what the maps hold, 2 the
// finest of those: ShadowBlock::layer.w.
int map_serving(vec3 position, float view_depth, vec3 light, float selection, int count) {
  if (selection > 1.5) return map_of_finest_texel(position, 0.0, light, count);
  return selection > 0.5 ? map_by_hold(position, count) : map_by_depth(position, view_depth, count);
}

// Share of the next map in the result at a depth that the one before it serves: 0 up to where the next map begins to show
// receivers, 1 from where they are its own.
float share_of_next_map(ShadowMap next, float view_depth) {
  float overlap = next.kernel.z;
  return overlap > 0.0 ? clamp((view_depth - next.interval_size.x) / overlap + 1.0, 0.0, 1.0) : 0.0;
}

// Even noise in 0..1 from pixel to pixel, whose neighbourhoods of 3 x 3 hold all values (Jimenez, "Next Generation Post
// Processing in Call of Duty: Advanced Warfare", 2014). Dithers between maps, turns sample patterns.
float pixel_noise(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }
#endif
