// Do an engine's slope factor and normal offset cover what a plane needs, whichever way it lies?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "gnomon/study/engine_bias.hpp"

namespace gnomon::test {
namespace {

TEST(EngineBiasOfCore, covers_a_texel_and_the_kernel_on_any_plane) {
  ShadowMap map;
  map.depth_range_world = 200.0;
  map.bias_world.constant = 0.5;
  map.texel_world_max = {0.3, 0.2};
  const BiasOptions options;
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const double radius = random.between(0.0, 4.0), reach = options.slope_texels + radius;
    const EngineBias raster = engine_bias(map, options, BiasWay::rasterizer, radius);
    const EngineBias offset = engine_bias(map, options, BiasWay::normal_offset, radius);
    EXPECT_EQ(raster.depth, 0.0025);
    // The light falls along -z; texels lie along x and y.
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3(random.between(-1, 1), random.between(-1, 1), random.between(0.2, 1)));
    const double over_x = std::abs(normal.x) * map.texel_world_max.x / normal.z;
    const double over_y = std::abs(normal.y) * map.texel_world_max.y / normal.z;
    const double needed = reach * (over_x + over_y);
    EXPECT_GE(raster.slope_factor * std::max(over_x, over_y), needed * (1.0 - 1e-12));
    EXPECT_GE(offset.normal_world / normal.z, needed * (1.0 - 1e-12));
    EXPECT_LE(raster.slope_factor, 2.0 * reach);
  }
}

}  // namespace
}  // namespace gnomon::test
