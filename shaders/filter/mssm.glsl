// Moment soft shadow maps (Peters et al. 2016): four moments over the widest kernel say how far away what blocks is, and
// four over the penumbra that follows from that say which share is dark. Both come out of one summed-area table.
#include "filter/option/mssm.glsl"
#include "library/mean.glsl"
#include "library/moments.glsl"
#include "library/penumbra.glsl"
#include "library/variance.glsl"

// The mean over at.box, from the table that the includer binds: fetch_summed().
ShadowTexel shadow_mean(ShadowLookup at);

ShadowTexel shadow_store(float depth, vec2 slope, ShadowOptions options) { return store_four_moments(depth, options); }

// `texel`: the mean over the widest kernel.
float shadow_visibility(ShadowTexel texel, sampler2DArray depth_map, sampler2DArray depth_max, ShadowLookup at,
                        ShadowOptions options) {
  const float kRoundings = 64.0;
  vec4 b = moments_of(texel, options, options.value[option_bias], kRoundings);
  // The receiver's own plane counts as what touches it: a search that left it out would miss contacts.
  float u = receiver_of_moments(at, vec2(0.0));
  vec2 z;
  float blocked = share_in_front(b, u, z);
  // Nothing that blocks for certain: what touches the receiver may, and has no penumbra.
  float radius = 0.0;
  if (blocked > 0.0) {
    // The mean of what lies in front of the receiver in the distribution with that share.
    float blocker = u > z.y ? (b.x - (1.0 - blocked) * u) / blocked : z.x;
    float map_depth = depth_from_linear(clamp(0.5 * blocker + 0.5, 0.0, 1.0), at.depth_curve);
    radius = penumbra_radius(at, options.value[option_angle_deg], options.value[option_light_radius],
                             max(distance_to_depth(at, map_depth), 0.0));
  }
  // The box with a disc's variance, as far as the widest kernel reaches.
  const float kDiscToBox = 0.8660254;
  mat2 axes = kDiscToBox * radius * at.texels_per_world;
  vec2 box = vec2(length(vec2(axes[0].x, axes[1].x)), length(vec2(axes[0].y, axes[1].y)));
  vec2 widest = at.box;
  vec2 over = box / widest;
  box = box / max(max(over.x, over.y), 1.0);
  at.box = clamp(box, min(vec2(0.5), widest), widest);
  b = moments_of(shadow_mean(at), options, options.value[option_bias], kRoundings);
  float lit = 1.0 - share_in_front(b, receiver_of_moments(at, at.box), z);
  return without_bleeding(lit < 1.0 ? max(lit, 0.0) : 1.0, options.value[option_bleed]);
}
