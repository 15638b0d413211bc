// Shadow-map ray tracing: rays from the receiver to points of the light's disc, each marched through the depth map. A
// step's stretch of the ray is blocked by what the map stores in it, or less than the thickness towards the light of it.
#include "library/compare.glsl"
#include "library/disc.glsl"

// Distance across the light from the ray to the disc's middle where it is `away` from the receiver, as texels at the
// receiver see it. Options: angle in degrees of a directional light; radius of a local light.
float spread_at(ShadowLookup at, ShadowOptions options, float away) {
  if (at.light_distance == 0.0) return tan(0.5 * radians(options.value[0])) * away;
  return options.value[1] * away / max(at.light_distance - away, 0.01 * at.light_distance);
}

// Where that reaches the kernel's radius, which bounds the march; beyond it the ray keeps to its last texel.
vec2 within_kernel(ShadowLookup at, vec2 offset) {
  float widest = max(sqrt(max(dot(at.disc[0], at.disc[0]), dot(at.disc[1], at.disc[1]))), 1.0);
  return offset * min(1.0, widest / max(length(offset), 1e-6));
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  int rays = int(options.value[2]), steps = int(options.value[3]);
  float turn = options.value[5] > 0.5 ? at.rotation : 0.0;
  vec2 direction = vogel_first(turn);
  float reach = max(distance_to_depth(at, 0.0), 0.0);
  int blocked = 0;
  for (int i = 0; i < rays; ++i) {
    vec2 aim = vogel_radius(i, rays) * direction;
    direction = vogel_turned(direction);
    float inside = fract(turn * 0.15915494 + 0.5 + 0.41421356 * float(i));
    for (int k = 0; k < steps; ++k) {
      // Quadratic: short steps where contacts are, long ones where the penumbra is wide.
      float from = float(k) / float(steps), to = float(k + 1) / float(steps);
      float begin = reach * from * from, end = reach * to * to;
      float away = mix(begin, end, inside);
      vec2 offset = within_kernel(at, at.texels_per_world * (spread_at(at, options, away) * aim));
      vec2 texel = floor(at.texel + offset) + 0.5;
      float stored = depth_of_texel(textureLod(depth_map, vec3(texel / at.layer_size, at.layer), 0.0).r);
      if (plane_depth(at, texel - at.texel) <= stored) continue;
      float caster = distance_to_depth(at, stored);
      if ((k > 0 && caster < begin) || (k + 1 < steps && caster >= end + options.value[4])) continue;
      ++blocked;
      break;
    }
  }
  return 1.0 - float(blocked) / float(rays);
}
