// Layered variance shadow maps (Lauritzen, McCool 2008): two moments per layer of depth, and the least of the layers'
// bounds. Depths in front of a layer count as one depth there, and bleed no light into it.
#include "filter/option/lvsm.glsl"
#include "library/mean.glsl"
#include "library/variance.glsl"

int layer_count(ShadowOptions options) { return min(int(options.value[option_layers] + 0.5), 2 * GNOMON_SHADOW_VECTORS); }

// Where layer i - 1 ends and layer i begins, without overlap.
float end_before(int i, ShadowOptions options) {
  float count = options.value[option_layers];
  if (i <= 0) return 0.0;
  if (float(i) > count - 0.5) return 1.0;
  float placed = options.value[option_ends + i - 1];
  return placed > 0.0 ? placed : float(i) / count;
}

// Where layer i begins and ends.
vec2 layer_ends(int i, ShadowOptions options) {
  float overlap = options.value[option_overlap], begin = end_before(i, options), end = end_before(i + 1, options);
  return vec2(begin - overlap * (begin - end_before(i - 1, options)),
              end + overlap * (end_before(i + 2, options) - end));
}

// At its end a slanted surface's depths pile up and shadow it: there a layer returns 1, and the next one decides.
float beyond_layer(int i, float deepest, ShadowOptions options) {
  float end = end_before(i + 1, options);
  return clamp((min(deepest, 1.0) - end) / max(layer_ends(i, options).y - end, 1e-6), 0.0, 1.0);
}

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) {
  ShadowTexel texel = shadow_nothing(options);
  for (int i = 0; i < layer_count(options); ++i) {
    vec2 ends = layer_ends(i, options);
    float size = ends.y - ends.x;
    bool within = depth > ends.x && depth < ends.y;
    vec2 moments = store_moments(clamp((depth - ends.x) / size, 0.0, 1.0), within ? slope / size : vec2(0.0),
                                 options.value[option_slope], options).v[0].xy;
    if ((i & 1) == 0) {
      texel.v[i >> 1].xy = moments;
    } else {
      texel.v[i >> 1].zw = moments;
    }
  }
  return texel;
}

float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  float lit = 1.0;
  float spread = dot(abs(at.depth_gradient), at.box + 1.0);  // of the receiver's plane under kernel and bilinear read
  ShadowLookup in_layer = at;
  ShadowTexel moments = texel;
  for (int i = 0; i < layer_count(options); ++i) {
    vec2 ends = layer_ends(i, options);
    in_layer.depth = clamp((min(at.depth, 1.0) - ends.x) / (ends.y - ends.x), 0.0, 1.0);
    moments.v[0].xy = (i & 1) == 0 ? texel.v[i >> 1].xy : texel.v[i >> 1].zw;
    float beyond = beyond_layer(i, min(at.depth, 1.0) + spread, options);
    float bound =
        variance_visibility(moments, in_layer, options.value[option_bleed], options.value[option_floor], options);
    lit = min(lit, max(bound, beyond));
  }
  return lit;
}
