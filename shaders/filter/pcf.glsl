// The average of comparisons over a kernel (Reeves, Salesin, Cook 1987): the hardware's bilinear 2 x 2, a box of any
// sides, or a disc of samples turned from pixel to pixel. Each depth is compared with the receiver's plane at its texel,
// so that the kernel's width needs no bias (Isidoro 2006). The kernel covers at least at.pixel.
#include "filter/option/pcf.glsl"
#include "library/compare.glsl"
#include "library/disc.glsl"

// Box of texels, four depths at a time, those at its border weighted by the share that is inside.
float compare_box(sampler2DArray depth_map, ShadowLookup at) {
  // Counted from the point's own texel: small numbers, so that the weights add up to 1.
  vec2 own = floor(at.texel), part = at.texel - own;
  vec2 low = part - at.box, high = part + at.box;
  ivec2 first = ivec2(floor(low)), last = ivec2(ceil(high)) - 1;
  float sum = 0.0;
  for (int y = first.y; y <= last.y; y += 2) {
    vec2 weight_y = clamp(min(vec2(high.y), vec2(y + 1, y + 2)) - max(vec2(low.y), vec2(y, y + 1)), 0.0, 1.0);
    for (int x = first.x; x <= last.x; x += 2) {
      vec2 weight_x = clamp(min(vec2(high.x), vec2(x + 1, x + 2)) - max(vec2(low.x), vec2(x, x + 1)), 0.0, 1.0);
      vec2 corner = vec2(x + 1, y + 1);  // shared by the four texels
      vec4 stored = depth_of_texel(textureGather(depth_map, vec3((own + corner) / at.layer_size, at.layer)));
      sum += dot(weight_x.xyyx * weight_y.yyxx, vec4(lessThanEqual(plane_depths(at, corner - part), stored)));
    }
  }
  return sum / (4.0 * at.box.x * at.box.y);
}

float shadow_visibility(sampler2DArrayShadow compare_map, sampler2DArray depth_map, ShadowLookup at,
                        ShadowOptions options) {
  const float kBox = 0.0, kVogel = 1.0, kPoisson = 2.0;
  const float kBoxOfDisc = 0.8660254;  // half side of the box over radius of the disc, of equal variance
  float pattern = options.value[option_pattern];
  int samples = int(options.value[option_samples]);
  at.box = max(at.box, at.pixel);
  if (pattern == kBox) {
    if (max(at.box.x, at.box.y) > 0.5) return compare_box(depth_map, at);
    // One depth for four texels, each up to a texel away: off the plane by as much, for the bias covers half a texel of
    // the surface's slope and none of the slant that a warp adds.
    vec2 farthest = 1.0 + max(beyond_piece(at, vec2(1.0)), -beyond_piece(at, vec2(-1.0)));
    float off_plane = abs(at.depth_gradient.x) * farthest.x + abs(at.depth_gradient.y) * farthest.y;
    return texture(compare_map, vec4(at.texel / at.layer_size, at.layer, texel_of_depth(min(at.depth - off_plane, 1.0))));
  }
  // Stretched along the map's axes to the pixel where it is narrower.
  vec2 reach = vec2(length(vec2(at.disc[0].x, at.disc[1].x)), length(vec2(at.disc[0].y, at.disc[1].y)));
  vec2 stretch = max(vec2(1.0), at.pixel / (kBoxOfDisc * max(reach, 1e-20)));
  at.disc = mat2(at.disc[0] * stretch, at.disc[1] * stretch);
  vec2 direction = vogel_first(options.value[option_rotate] > 0.5 ? at.rotation : 0.0);
  float sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    vec2 point = pattern == kPoisson ? poisson_point(i, direction) : vogel_radius(i, samples) * direction;
    sum += compare_2x2(depth_map, at, at.texel + at.disc * point);
    if (pattern != kPoisson) direction = vogel_turned(direction);
  }
  return sum / float(samples);
}
