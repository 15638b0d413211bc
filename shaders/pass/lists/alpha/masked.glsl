// Alpha-masked casters. The mask is read between texels in full precision: hardware interpolates with eight bits.
#include "pass/common/alpha.glsl"

layout(location = 4) uniform ivec2 wrap;  // gnomon::TextureWrap along u and v
layout(location = 3) flat in vec2 texcoord[3];

int wrapped(int texel, int size, int mode) {
  const int kMirrored = 1, kClamped = 2;
  if (mode == kClamped) return clamp(texel, 0, size - 1);
  int period = mode == kMirrored ? 2 * size : size;
  int at = texel - period * int(floor(float(texel) / float(period)));
  at = at < 0 ? at + period : at >= period ? at - period : at;
  return at < size ? at : 2 * size - 1 - at;
}

float alpha_of(ivec2 texel, ivec2 size) {
  return texelFetch(color_image, ivec2(wrapped(texel.x, size.x, wrap.x), wrapped(texel.y, size.y, wrap.y)), 0).a;
}

bool is_there(vec3 weights) {
  ivec2 size = textureSize(color_image, 0);
  vec2 at = (weights.x * texcoord[0] + weights.y * texcoord[1] + weights.z * texcoord[2]) * vec2(size) - 0.5;
  const float kFar = 1e6;  // texels: beyond it a float has no fraction worth reading
  at = clamp(at, vec2(-kFar), vec2(kFar));
  ivec2 first = ivec2(floor(at));
  vec2 part = at - vec2(first);
  float upper = mix(alpha_of(first, size), alpha_of(first + ivec2(1, 0), size), part.x);
  float lower = mix(alpha_of(first + ivec2(0, 1), size), alpha_of(first + ivec2(1, 1), size), part.x);
  return mix(upper, lower, part.y) * base_color.a >= alpha_cutoff;
}
