#version 450 core
// The point that an outline leaves in a texel: an end of the edge, or the middle of where it crosses the texel's diagonals.
// The texel's corners are centres of the depth map's texels. An outline that all four hide leaves none.
layout(binding = 5) uniform sampler2DArray depth_map;
layout(location = 5) uniform int layer;
layout(location = 10) uniform float even_scale;  // as even_depth.glsl has it
layout(location = 0) flat in vec4 segment;
layout(location = 1) flat in vec4 depths;
layout(location = 0) out vec2 point;

bool is_inside(vec2 p) { return all(greaterThanEqual(p, vec2(0.0))) && all(lessThanEqual(p, vec2(1.0))); }

// Where from a to b a diagonal is crossed, whose points have zero of what is given for both ends; -1: not within the texel.
float crossing(vec2 a, vec2 b, float at_a, float at_b) {
  if (at_a == at_b) return -1.0;
  float t = at_a / (at_a - at_b);
  return t >= 0.0 && t <= 1.0 && is_inside(mix(a, b, t)) ? t : -1.0;
}

float farthest_corner() {
  ivec2 first = ivec2(gl_FragCoord.xy), last = textureSize(depth_map, 0).xy - 1;
  float farthest = 0.0;
  for (int i = 0; i < 4; ++i) {
    farthest = max(farthest, texelFetch(depth_map, ivec3(min(first + ivec2(i & 1, i >> 1), last), layer), 0).r);
  }
  return farthest;
}

void main() {
  vec2 corner = gl_FragCoord.xy - 0.5;
  vec2 a = segment.xy - corner, b = segment.zw - corner;
  float t;
  if (is_inside(a)) {
    t = 0.0;
  } else if (is_inside(b)) {
    t = 1.0;
  } else {
    float rising = crossing(a, b, a.x - a.y, b.x - b.y), falling = crossing(a, b, a.x + a.y - 1.0, b.x + b.y - 1.0);
    if (rising < 0.0 && falling < 0.0) discard;
    t = rising < 0.0 ? falling : falling < 0.0 ? rising : 0.5 * (rising + falling);
  }
  const float kRounding = 4.0 / 16777216.0;  // the rasterizer's depth is good to a few units of 2^-24
  // Straight over the map: depth over w, and 1 over w.
  float depth = mix(depths.x, depths.y, t);
  if (even_scale > 0.0) depth = clamp(depth * even_scale / mix(depths.z, depths.w, t), 0.0, 1.0);
  if (depth > farthest_corner() + kRounding) discard;
  point = mix(a, b, t) * (254.0 / 255.0);  // so that the middle is a number of 8 bits
  gl_FragDepth = depth;
}
