// Which biases of an engine's own kind do what a map's bias does?
#include "gnomon/study/engine_bias.hpp"

#include <cmath>

#include "geometry/vector.hpp"

namespace gnomon {

EngineBias engine_bias(const ShadowMap& map, const BiasOptions& bias, BiasWay way,
                       double kernel_radius_texels) noexcept {
  EngineBias result;
  if (!(map.depth_range_world > 0.0)) return result;
  const double radius = bias.slope_texels + max_of(0.0, kernel_radius_texels);
  result.depth = map.bias_world.constant / map.depth_range_world;
  if (way == BiasWay::rasterizer) {
    result.slope_factor = 2.0 * radius;
  } else {
    const glm::dvec2 texel = map.texel_world_max;
    result.normal_world = radius * std::sqrt(texel.x * texel.x + texel.y * texel.y);
  }
  return result;
}

double rasterizer_units(double depth, int depth_bits) noexcept {
  constexpr int kSingleBits = 24;
  return std::ldexp(depth, depth_bits == 0 ? kSingleBits : depth_bits);
}

}  // namespace gnomon
