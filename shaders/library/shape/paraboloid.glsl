// gnomon::shapes::paraboloid: even in angle round a local light (Brabec et al. 2002).
#ifndef GNOMON_LIBRARY_SHAPE_PARABOLOID_GLSL
#define GNOMON_LIBRARY_SHAPE_PARABOLOID_GLSL
#include "library/shaped_point.glsl"

// Parameters of the shape by their names, as in C++.
struct ParaboloidFrame {
  vec2 middle, half_size;  // slopes off the light's axis that the square shows
  vec2 low, extent;        // of the tangents of half the angles, less the middle's, without the margin
  float margin;            // texels
};

ParaboloidFrame paraboloid_frame(mat4 shape) {
  ParaboloidFrame f;
  f.middle = shape[0].yz;
  f.half_size = vec2(shape[0].w, shape[1].x);
  f.low = shape[1].yz;
  f.extent = vec2(shape[1].w, shape[2].x) - f.low;
  f.margin = shape[2].y;
  return f;
}

bool paraboloid_is_linear(ParaboloidFrame f) { return !(f.half_size.x > 0.0 && f.half_size.y > 0.0 && f.extent.x > 0.0 && f.extent.y > 0.0); }

// Counted from the middle, so that a narrow map is exact: the tangents at slopes that are `step` beyond it, and the inverse.
vec2 paraboloid_beyond(vec2 middle, vec2 step) {
  vec2 slope = middle + step;
  float first = sqrt(1.0 + dot(middle, middle)), root = sqrt(1.0 + dot(slope, slope));
  float longer = dot(middle + slope, step) / (root + first);
  return (step * (1.0 + first) - middle * longer) / ((1.0 + root) * (1.0 + first));
}

vec2 slope_beyond(vec2 middle, vec2 step) {
  const float kLongest = 0.99;
  vec2 first = middle / (1.0 + sqrt(1.0 + dot(middle, middle))), u = first + step;
  float length_u = length(u);
  if (length_u > kLongest) {
    u *= kLongest / length_u;
    step = u - first;
  }
  float left = 1.0 - dot(first, first);
  return (step * left + first * dot(first + u, step)) * (2.0 / ((1.0 - dot(u, u)) * left));
}

ShapedPoint place_paraboloid(mat4 shape, vec2 size, vec2 ndc) {
  ParaboloidFrame f = paraboloid_frame(shape);
  if (paraboloid_is_linear(f)) return smooth_point((ndc * 0.5 + 0.5) * size, mat2(0.5 * size.x, 0.0, 0.0, 0.5 * size.y));
  vec2 step = f.half_size * ndc, s = f.middle + step, scale = (size - 2.0 * f.margin) / f.extent;
  float root = sqrt(1.0 + dot(s, s)), inverse = 1.0 / (1.0 + root), bend = inverse * inverse / root, turned = -s.x * s.y * bend;
  return smooth_point(f.margin + (paraboloid_beyond(f.middle, step) - f.low) * scale,
                      mat2((inverse - s.x * s.x * bend) * f.half_size.x * scale.x, turned * f.half_size.x * scale.y,
                           turned * f.half_size.y * scale.x, (inverse - s.y * s.y * bend) * f.half_size.y * scale.y));
}

vec2 ndc_of_paraboloid(mat4 shape, vec2 size, vec2 texel) {
  ParaboloidFrame f = paraboloid_frame(shape);
  if (paraboloid_is_linear(f)) return texel / size * 2.0 - 1.0;
  return slope_beyond(f.middle, f.low + (texel - f.margin) * f.extent / (size - 2.0 * f.margin)) / f.half_size;
}

// The texels round the image of a rectangle of ndc: xy the lowest, zw the highest.
vec4 texel_bounds_paraboloid(mat4 shape, vec2 size, vec2 low, vec2 high) {
  ParaboloidFrame f = paraboloid_frame(shape);
  if (paraboloid_is_linear(f)) return vec4(low, high) * (0.5 * size.xyxy) + 0.5 * size.xyxy;
  // Each tangent grows with the slope of its name, and shrinks with the length of the other. All counts from the middle.
  vec2 from = f.half_size * low, to = f.half_size * high;
  vec2 near = clamp(-f.middle, from, to), far = mix(to, from, greaterThan(-from - f.middle, to + f.middle));
  bvec2 below = lessThan(from + f.middle, vec2(0.0)), above = greaterThan(to + f.middle, vec2(0.0));
  vec2 first = vec2(paraboloid_beyond(f.middle, vec2(from.x, below.x ? near.y : far.y)).x,
                    paraboloid_beyond(f.middle, vec2(below.y ? near.x : far.x, from.y)).y);
  vec2 last = vec2(paraboloid_beyond(f.middle, vec2(to.x, above.x ? near.y : far.y)).x,
                   paraboloid_beyond(f.middle, vec2(above.y ? near.x : far.x, to.y)).y);
  vec2 scale = (size - 2.0 * f.margin) / f.extent;
  return f.margin + (vec4(first, last) - f.low.xyxy) * scale.xyxy;
}
#endif
