// From a surface point to a filter's input: the position in the map, the depth less the plan's bias, the receiver plane in
// the map, and the kernel in texels.
#ifndef GNOMON_LIBRARY_RECEIVER_GLSL
#define GNOMON_LIBRARY_RECEIVER_GLSL
#include "library/shadow_map.glsl"
#include "library/lookup.glsl"

// A surface point and its light.
struct ShadowSurface {
  vec3 position;
  vec3 normal;  // unit, of the triangle, towards the viewer
  vec4 light;   // as light_at takes it
};

// The kernel as the options request it.
struct ShadowKernel {
  float radius;    // half width, see gnomon::render::FilterSettings::radius
  bool in_world;   // radius in world units across the light, else in texels
  bool minify;     // take the pixel's own footprint in, too
};

// Two axes across `direction`, without a jump but at (0, 0, -1) (Duff et al. 2017, "Building an Orthonormal Basis,
// Revisited").
void axes_across(vec3 direction, out vec3 a, out vec3 b) {
  float s = direction.z >= 0.0 ? 1.0 : -1.0;
  float p = -1.0 / (s + direction.z);
  float q = direction.x * direction.y * p;
  a = vec3(1.0 + s * direction.x * direction.x * p, s * q, -s * direction.x);
  b = vec3(q, s + direction.y * direction.y * p, -direction.y);
}

// Axes of the ellipse whose covariance is a aT + b bT - less, none shorter than zero.
mat2 ellipse_of_sum(mat2 a, mat2 b, float less) {
  float xx = dot(vec2(a[0].x, a[1].x), vec2(a[0].x, a[1].x)) + dot(vec2(b[0].x, b[1].x), vec2(b[0].x, b[1].x));
  float yy = dot(vec2(a[0].y, a[1].y), vec2(a[0].y, a[1].y)) + dot(vec2(b[0].y, b[1].y), vec2(b[0].y, b[1].y));
  float xy = dot(vec2(a[0].x, a[1].x), vec2(a[0].y, a[1].y)) + dot(vec2(b[0].x, b[1].x), vec2(b[0].y, b[1].y));
  float middle = 0.5 * (xx + yy);
  float apart = sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  vec2 axis = abs(xy) > 1e-6 * middle ? normalize(vec2(xy, middle + apart - xx))
                                      : (xx >= yy ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
  return mat2(axis * sqrt(max(middle + apart - less, 0.0)),
              vec2(-axis.y, axis.x) * sqrt(max(middle - apart - less, 0.0)));
}

// Half sides of the box that has the variance of a pixel: ShadowLookup::pixel, for kernels that cover it. At most
// gnomon::render::kMaxRadiusTexels, which is also the result where the surface is seen from its edge.
vec2 pixel_box(mat2 texels_per_pixel) {
  const float kWidest = 32.0;
  vec2 x = vec2(texels_per_pixel[0].x, texels_per_pixel[1].x), y = vec2(texels_per_pixel[0].y, texels_per_pixel[1].y);
  vec2 half_sides = 0.5 * vec2(length(x), length(y));
  return vec2(half_sides.x < kWidest ? half_sides.x : kWidest, half_sides.y < kWidest ? half_sides.y : kWidest);
}

// Kernel of the question. A disc of radius r and a box of half side r sqrt(3) / 2 have the same variance, and so has a
// trilinear read over a footprint of r texels; what the stored texels' own blur did of it is taken off.
void set_kernel(inout ShadowLookup at, ShadowMap map, ShadowKernel kernel, mat2 texels_per_pixel) {
  const float kBoxOfDisc = 0.8660254;
  const float kWidest = 32.0;  // texels: nothing costs without end, gnomon::render::kMaxRadiusTexels
  mat2 none = mat2(0.0);
  if (kernel.in_world) {
    at.disc = kernel.radius * at.texels_per_world;
    float widest = max(length(vec2(at.disc[0].x, at.disc[1].x)), length(vec2(at.disc[0].y, at.disc[1].y)));
    at.disc *= min(1.0, kWidest / max(widest, 1e-20));
    at.box = max(kBoxOfDisc * vec2(length(vec2(at.disc[0].x, at.disc[1].x)), length(vec2(at.disc[0].y, at.disc[1].y))),
                 0.5);
  } else {
    float half_side = min(kernel.radius, kWidest) + 0.5;
    at.disc = mat2(half_side);
    at.box = vec2(half_side);
  }
  if (kernel.minify) {
    vec2 across_x = vec2(texels_per_pixel[0].x, texels_per_pixel[1].x);
    vec2 across_y = vec2(texels_per_pixel[0].y, texels_per_pixel[1].y);
    vec2 squared = vec2(dot(across_x, across_x), dot(across_y, across_y));
    at.box = sqrt(at.box * at.box + kBoxOfDisc * kBoxOfDisc * squared);
  }
  float stored = 2.0 * map.kernel.y;  // the box that was blurred with: its variance is that of a disc of side^2 / 3
  at.footprint = ellipse_of_sum(kernel.in_world ? at.disc : none, kernel.minify ? texels_per_pixel : none,
                                kernel.in_world ? stored * stored / 3.0 : 0.0);
}

// The same lookup with depths as stored texels have them, linear in distance under local lights.
ShadowLookup stored_lookup(ShadowLookup at, ShadowMap map) {
  float curve = max(map.kernel.w, 0.0);
  float depth = min(at.depth, 1.0);  // what lies beyond the far plane would pass the curve's pole
  float scale = 1.0 + (1.0 - depth) * curve;
  at.depth = linear_depth(depth, curve);
  at.depth_gradient *= (1.0 + curve) / (scale * scale);
  at.depth_curve = curve;
  return at;
}

// `bias`: gnomon::BiasOptions, constant, slope, normal offset in texels of this map at this point, largest slope. The
// kernel's radius needs none: filters follow the receiver's plane by its gradient. The cap of the slope is the bias's: it
// would move shadows of what lies nearly along the light off their casters. The plane itself is exact.
ShadowLookup shadow_lookup(ShadowMap map, float layer, vec2 layer_size, ShadowSurface s, vec4 bias) {
  const float kDepthRounding = 4.0 / 16777216.0;  // the rasterizer's depth is good to a few units of 2^-24
  const float kSteepestPlane = 100.0;  // gnomon::kSteepestPlane
  vec3 light = light_at(s.light, s.position);
  float cosine = max(-dot(s.normal, light), 0.0);
  vec3 across = s.normal + cosine * light;
  float sine = length(across);
  float tangent = min(sine / max(cosine, 1e-6), kSteepestPlane);
  vec3 slope = across * (sine > 0.0 ? tangent / sine : 0.0);

  vec3 side_x, side_y;
  texel_sides(map_point(map, s.position), light, side_x, side_y);
  float texel_world = max(length(side_x), length(side_y));
  vec3 position = s.position + s.normal * (bias.z * texel_world * sine);
  MapPoint p = map_point(map, position);
  texel_sides(p, light, side_x, side_y);

  // Distance along the light, towards it, by which the plane rises per texel; a plane that faces the light has none.
  vec2 rise = vec2(dot(slope, side_x), dot(slope, side_y));
  float along_light = dot(p.d_depth, light);  // depth per world unit along the light, exact: its rays are the map's
  float capped = min(1.0, bias.w / max(tangent, 1e-6));
  float bias_world = bias.x * texel_world + bias.y * capped * (abs(rise.x) + abs(rise.y));

  ShadowLookup at;
  at.texel = p.texel;
  at.layer = layer;
  at.depth_curve = 0.0;
  at.layer_size = layer_size;
  at.depth = p.ndc.z - along_light * bias_world - kDepthRounding;
  at.depth_gradient = vec2(dot(p.d_depth, side_x), dot(p.d_depth, side_y)) + along_light * rise;
  at.ends = p.ends;
  at.longer = p.longer;
  vec3 a, b;
  axes_across(light, a, b);
  at.texels_per_world =
      mat2(dot(p.d_texel_x, a), dot(p.d_texel_y, a), dot(p.d_texel_x, b), dot(p.d_texel_y, b));
  mat4 m = map.clip_from_point;
  at.ray = even_scale_of(map) > 0.0 ? vec4(p.ndc.z, 1.0, along_light, 0.0)
                                    : vec4(p.ndc.z * p.w, p.w, dot(matrix_row(m, 2), light), dot(matrix_row(m, 3), light));
  at.light_distance = s.light.w == 0.0 ? 0.0 : length(position - s.light.xyz);
  at.box = vec2(0.5);
  at.disc = mat2(0.5);
  at.footprint = mat2(0.0);
  at.pixel = vec2(0.0);
  at.rotation = 0.0;
  return at;
}
#endif
