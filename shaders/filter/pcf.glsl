// The average of comparisons over a box of k x k texels, k odd (Reeves, Salesin, Cook 1987). k = 1 is the hardware's
// bilinear 2 x 2; wider kernels gather four depths at a time and compare each with the receiver's plane at its texel.
#include "common/shadow_lookup.glsl"

vec4 shadow_store(float depth) { return vec4(depth, 0.0, 0.0, 0.0); }

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray map, ShadowLookup at,
                        ShadowParameters parameters) {
  int radius = int(clamp(floor(parameters.radius_texels + 0.5), 0.0, 4.0));
  if (radius == 0) return texture(compare_map, vec4(at.texel / at.layer_size, at.layer, at.depth));
  int width = 2 * radius + 1;
  vec2 base = floor(at.texel - 0.5);
  vec2 fraction = at.texel - 0.5 - base;
  vec2 first = base - float(radius);
  float sum = 0.0;
  for (int j = 0; j <= width; j += 2) {
    // Weights along y of rows j and j + 1: the box starts `fraction` into the first row and ends in the last.
    vec2 weight_y = vec2(j == 0 ? 1.0 - fraction.y : 1.0, j + 1 == width ? fraction.y : 1.0);
    for (int i = 0; i <= width; i += 2) {
      vec2 weight_x = vec2(i == 0 ? 1.0 - fraction.x : 1.0, i + 1 == width ? fraction.x : 1.0);
      vec2 corner = first + vec2(i, j) + 1.0;  // shared by the four texels
      vec4 stored = textureGather(map, vec3(corner / at.layer_size, at.layer));
      vec2 to_corner = corner - at.texel;
      float middle = at.depth + dot(at.depth_gradient, to_corner);
      vec2 half_step = 0.5 * at.depth_gradient;
      // textureGather's order: (left, top), (right, top), (right, bottom), (left, bottom); top is the higher row.
      vec4 depth = middle + vec4(-half_step.x + half_step.y, half_step.x + half_step.y, half_step.x - half_step.y,
                                 -half_step.x - half_step.y);
      depth = min(depth, 1.0);  // the plane may go on behind the map's far plane, where nothing is drawn: lit
      vec4 weight = vec4(weight_x.xyyx * weight_y.yyxx);
      sum += dot(weight, vec4(lessThanEqual(depth, stored)));
    }
  }
  return sum / float(width * width);
}
