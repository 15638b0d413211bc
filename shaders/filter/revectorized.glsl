// Straight edges in place of stairs (after Macedo, Apolinario 2016; lines as in Reshetov 2009): the outline between lit and
// dark texels is followed both ways to the steps that end it, and a line through their middles decides. One comparison per
// texel that is looked at; only points within half a texel of the outline look at more than three.
#include "filter/option/revectorized.glsl"
#include "library/compare.glsl"

struct ShadowTests {
  vec2 own;  // corner of the point's own texel
  bool lit;  // state of that texel
};

// State of the texel `cell` away from the point's own.
bool lit_at(sampler2DArray depth_map, ShadowLookup at, vec2 own, vec2 cell) {
  vec2 centre = own + cell + 0.5;
  float stored = depth_of_texel(textureLod(depth_map, vec3(centre / at.layer_size, at.layer), 0.0).r);
  return plane_depth(at, centre - at.texel) <= stored;
}

// Follows the outline between the own row and the one `across` it. Returns the whole texels passed behind the own one, and
// whether the step at the end leads into the own row (1), out of it (-1), or there is none, or one too high for a line (0).
vec2 end_of_run(sampler2DArray depth_map, ShadowLookup at, ShadowTests tests, vec2 along, vec2 across, int longest) {
  for (int i = 1; i <= longest; ++i) {
    vec2 cell = float(i) * along;
    bool near_same = lit_at(depth_map, at, tests.own, cell) == tests.lit;
    bool far_same = lit_at(depth_map, at, tests.own, cell + across) == tests.lit;
    if (near_same && !far_same) continue;
    if (near_same == far_same) {
      vec2 beyond = near_same ? cell + 2.0 * across : cell - across;
      bool one_high = (lit_at(depth_map, at, tests.own, beyond) == tests.lit) != near_same;
      return vec2(float(i - 1), one_high ? (near_same ? -1.0 : 1.0) : 0.0);
    }
    return vec2(float(i - 1), 0.0);
  }
  return vec2(float(longest), 0.0);
}

// True where the outline's line runs on the far side of the point. `to_outline`: distance to it, in texels; `before`: from
// the own texel's side that lies against `along` to the point.
bool is_beyond_line(sampler2DArray depth_map, ShadowLookup at, ShadowTests tests, vec2 along, vec2 across,
                    float to_outline, float before, int longest) {
  if (lit_at(depth_map, at, tests.own, across) == tests.lit) return false;
  vec2 back = end_of_run(depth_map, at, tests, -along, across, longest);
  vec2 forth = end_of_run(depth_map, at, tests, along, across, longest);
  // From half a step at either end to nothing in the middle.
  float a = back.x + before, b = forth.x + 1.0 - before;
  float height = 0.5 * (a < b ? back.y * (b - a) : forth.y * (a - b));
  return height > to_outline * (a + b);
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  int longest = int(options.value[option_run]);
  ShadowTests tests;
  tests.own = floor(at.texel);
  tests.lit = lit_at(depth_map, at, tests.own, vec2(0.0));
  vec2 part = at.texel - tests.own;
  vec2 side = vec2(part.x < 0.5 ? -1.0 : 1.0, part.y < 0.5 ? -1.0 : 1.0);
  vec2 to_outline = min(part, 1.0 - part);
  bool flips = is_beyond_line(depth_map, at, tests, vec2(0.0, 1.0), vec2(side.x, 0.0), to_outline.x, part.y, longest) ||
               is_beyond_line(depth_map, at, tests, vec2(1.0, 0.0), vec2(0.0, side.y), to_outline.y, part.x, longest);
  return tests.lit != flips ? 1.0 : 0.0;
}
