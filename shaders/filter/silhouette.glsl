// Hard shadows whose edges are the casters' own (Sen, Cammarano, Hanrahan 2003): between four comparisons at the centres of
// texels, lines through points of the outline say which of them holds.
#include "library/compare.glsl"

// A point of the outline between the centres of the texels `texel` and `texel` + 1, 0..1; (0.5, 0.5) where none runs there.
vec2 shadow_silhouette(ShadowLookup at, vec2 texel);

float lit_at_centre(sampler2DArray depth_map, ShadowLookup at, vec2 texel) {
  float stored = depth_of_texel(textureLod(depth_map, vec3((texel + 0.5) / at.layer_size, at.layer), 0.0).r);
  return plane_depth(at, texel + 0.5 - at.texel) <= stored ? 1.0 : 0.0;
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  vec2 own = floor(at.texel - 0.5), part = at.texel - 0.5 - own;
  vec4 lit = vec4(lit_at_centre(depth_map, at, own), lit_at_centre(depth_map, at, own + vec2(1.0, 0.0)),
                  lit_at_centre(depth_map, at, own + vec2(0.0, 1.0)), lit_at_centre(depth_map, at, own + vec2(1.0)));
  if (all(equal(lit, lit.xxxx))) return lit.x;
  // Lines run from the point to the neighbours' points: one to either side, one up, one down. The one of each
  // pair that lies on the point's side of the middle decides.
  vec2 middle = shadow_silhouette(at, own);
  vec2 side = vec2(part.x < middle.x ? -1.0 : 1.0, part.y < middle.y ? -1.0 : 1.0);
  vec2 beside = shadow_silhouette(at, own + vec2(side.x, 0.0)) + vec2(side.x, 0.0) - middle;
  vec2 beyond = shadow_silhouette(at, own + vec2(0.0, side.y)) + vec2(0.0, side.y) - middle;
  vec2 away = part - middle;
  bool upper = away.y * abs(beside.x) > beside.y * abs(away.x);
  bool right = away.x * abs(beyond.y) > beyond.x * abs(away.y);
  return upper ? (right ? lit.w : lit.z) : (right ? lit.y : lit.x);
}
