// Percentage-closer filtering with a tent: comparisons weighted by how close their texels lie to the point, as if bilinear
// comparisons were taken at 2 radius + 1 places a side. An edge's ramp has no steps however it lies to the texels, and its
// ends are soft. Each depth is compared with the receiver's plane at its texel, so that the kernel's width needs no bias.
#include "filter/option/pcf_tent.glsl"
#include "library/compare.glsl"

// Heights of a tent over the centres of texels i and i + 1.
vec2 tent_heights(float i, float part, float half_base) {
  return max(half_base - abs(vec2(i + 0.5, i + 1.5) - part), 0.0);
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  const float kBaseOfBox = 1.4142136;  // half base of the tent over half side of the box, of equal variance
  // In texels, one bilinear comparison (half base 1) at each of 2 radius + 1 places, weighted 1, 2, .. radius + 1, .. 1.
  vec2 half_base = max(options.value[option_in_world] > 0.5 ? kBaseOfBox * at.box : at.box + 0.5, 1.0);
  half_base = max(half_base, kBaseOfBox * at.pixel);
  vec2 own = floor(at.texel), part = at.texel - own;
  ivec2 first = ivec2(floor(part - half_base + 0.5)), last = ivec2(ceil(part + half_base - 0.5)) - 1;
  float sum = 0.0, weights = 0.0;
  for (int y = first.y; y <= last.y; y += 2) {
    vec2 weight_y = tent_heights(float(y), part.y, half_base.y);
    for (int x = first.x; x <= last.x; x += 2) {
      vec2 weight_x = tent_heights(float(x), part.x, half_base.x);
      vec2 corner = vec2(x + 1, y + 1);  // shared by the four texels
      vec4 stored = depth_of_texel(textureGather(depth_map, vec3((own + corner) / at.layer_size, at.layer)));
      vec4 weight = weight_x.xyyx * weight_y.yyxx;
      sum += dot(weight, vec4(lessThanEqual(plane_depths(at, corner - part), stored)));
      weights += dot(weight, vec4(1.0));
    }
  }
  return weights > 0.0 ? sum / weights : 1.0;  // 0: the point is no number
}
