// Reads the mean over at.box out of a summed-area table of integers (Crow 1984; Lauritzen 2007, GPU Gems 3). Sums wrap
// round at 2^32; differences over a box come out right all the same, as long as the box's own sum fits.
#ifndef GNOMON_LIBRARY_FETCH_SUMMED_GLSL
#define GNOMON_LIBRARY_FETCH_SUMMED_GLSL
#include "library/lookup.glsl"

// Four channels at most.
ShadowTexel fetch_summed(usampler2DArray sums, ShadowLookup at, float steps_per_one) {
  // The box is cut at whole texels: the sum of the inner box, plus its edge texels weighted by their share.
  ivec2 last = textureSize(sums, 0).xy - 1;
  // Counted from the point's own texel: small numbers, so that the weights are good.
  ivec2 own = ivec2(floor(at.texel));
  vec2 low = at.texel - vec2(own) - at.box, high = at.texel - vec2(own) + at.box;
  vec4 total = vec4(0.0);
  float area = 0.0;
  // Columns and rows by share: [first partial | whole ones | last partial].
  ivec2 a = ivec2(floor(low)), b = ivec2(ceil(high));
  for (int j = 0; j < 3; ++j) {
    ivec2 rows = j == 0 ? ivec2(a.y, a.y + 1) : j == 1 ? ivec2(a.y + 1, b.y - 1) : ivec2(b.y - 1, b.y);
    float share_y = j == 0 ? float(a.y + 1) - low.y : j == 1 ? 1.0 : high.y - float(b.y - 1);
    if (b.y - a.y == 1) share_y = j == 0 ? high.y - low.y : 0.0;
    if (rows.y <= rows.x || share_y <= 0.0) continue;
    for (int i = 0; i < 3; ++i) {
      ivec2 columns = i == 0 ? ivec2(a.x, a.x + 1) : i == 1 ? ivec2(a.x + 1, b.x - 1) : ivec2(b.x - 1, b.x);
      float share_x = i == 0 ? float(a.x + 1) - low.x : i == 1 ? 1.0 : high.x - float(b.x - 1);
      if (b.x - a.x == 1) share_x = i == 0 ? high.x - low.x : 0.0;
      if (columns.y <= columns.x || share_x <= 0.0) continue;
      // The table's entry (x, y) is the sum of all texels up to and including it; before the first there is nothing.
      ivec2 from = clamp(own + ivec2(columns.x, rows.x) - 1, ivec2(-1), last);
      ivec2 to = clamp(own + ivec2(columns.y, rows.y) - 1, ivec2(-1), last);
      uvec4 none = uvec4(0u);
      int layer = int(at.layer);
      uvec4 d = to.x < 0 || to.y < 0 ? none : texelFetch(sums, ivec3(to.x, to.y, layer), 0);
      uvec4 l = from.x < 0 || to.y < 0 ? none : texelFetch(sums, ivec3(from.x, to.y, layer), 0);
      uvec4 u = to.x < 0 || from.y < 0 ? none : texelFetch(sums, ivec3(to.x, from.y, layer), 0);
      uvec4 o = from.x < 0 || from.y < 0 ? none : texelFetch(sums, ivec3(from.x, from.y, layer), 0);
      total += share_x * share_y * vec4(d - l - u + o);
      area += share_x * share_y * float((to.x - from.x) * (to.y - from.y));
    }
  }
  ShadowTexel texel;
  for (int i = 0; i < GNOMON_SHADOW_VECTORS; ++i) texel.v[i] = vec4(0.0);
  texel.v[0] = total / (max(area, 1e-6) * steps_per_one);
  return texel;
}
#endif
