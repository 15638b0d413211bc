// Do a plan's maps lie in one texture without touching each other?
#include "gnomon/atlas.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

#include "support/near.hpp"
#include "support/property.hpp"

namespace gnomon::test {
namespace {

ShadowPlan plan_of(const std::vector<std::pair<int, int>>& sizes) {
  ShadowPlan plan;
  for (const auto& [width, height] : sizes) {
    ShadowMap& map = plan.map[static_cast<std::size_t>(plan.map_count++)];
    map = {};
    map.width = width;
    map.height = height;
  }
  return plan;
}

bool apart(const TexelRect& a, const TexelRect& b) {
  return a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
}

TEST(Atlas, a_plan_without_maps_needs_no_texture) {
  const Atlas atlas = pack_atlas(ShadowPlan{});
  EXPECT_EQ(atlas.count, 0);
  EXPECT_EQ(atlas.width, 0);
  EXPECT_EQ(pack_atlas(ShadowPlan{}, 64, 64).count, 0);
  EXPECT_EQ(array_efficiency(ShadowPlan{}), 0.0);
}

TEST(Atlas, four_equal_squares_fill_a_square) {
  const Atlas atlas = pack_atlas(plan_of({{512, 512}, {512, 512}, {512, 512}, {512, 512}}));
  EXPECT_EQ(atlas.width, 1024);
  EXPECT_EQ(atlas.height, 1024);
  EXPECT_EQ(atlas.efficiency, 1.0);
}

TEST(Atlas, a_large_map_and_four_quarters_of_it_fill_two_of_its_size) {
  const ShadowPlan plan = plan_of({{256, 256}, {512, 512}, {256, 256}, {256, 256}, {256, 256}});
  const Atlas atlas = pack_atlas(plan);
  EXPECT_EQ(atlas.width * atlas.height, 2 * 512 * 512);
  EXPECT_EQ(atlas.efficiency, 1.0);
  EXPECT_CLOSE(array_efficiency(plan), 2.0 / 5.0, 1e-15);
}

TEST(Atlas, too_small_a_texture_takes_none) {
  const ShadowPlan plan = plan_of({{512, 512}, {512, 512}});
  EXPECT_EQ(pack_atlas(plan, 1023, 512).count, 0);
  EXPECT_EQ(pack_atlas(plan, 511, 4096).count, 0);
  EXPECT_EQ(pack_atlas(plan, 1024, 512).count, 2);
  EXPECT_EQ(pack_atlas(plan, 512, 1024).count, 2);
}

TEST(Atlas, eight_of_the_largest_maps_fit) {
  const std::vector<std::pair<int, int>> largest(kMaxMaps, {kMaxMapSize, kMaxMapSize});
  EXPECT_EQ(pack_atlas(plan_of(largest)).count, kMaxMaps);
}

TEST(Atlas, maps_of_any_size_lie_inside_and_apart) {
  for_all(1000, [] {
    std::vector<std::pair<int, int>> sizes;
    const int count = 1 + pick(kMaxMaps);
    for (int i = 0; i < count; ++i) sizes.emplace_back(4 + pick(2000), 4 + pick(2000));
    const Atlas atlas = pack_atlas(plan_of(sizes));
    require(atlas.count == count, "placed", atlas.count, "of", count);
    for (int i = 0; i < count; ++i) {
      const TexelRect& a = atlas.place[static_cast<std::size_t>(i)];
      const auto [width, height] = sizes[static_cast<std::size_t>(i)];
      require(a.width == width && a.height == height, "size of", i);
      require(a.x >= 0 && a.y >= 0 && a.x + a.width <= atlas.width && a.y + a.height <= atlas.height, i);
      for (int j = 0; j < i; ++j) require(apart(a, atlas.place[static_cast<std::size_t>(j)]), i, "on", j);
    }
  });
}

TEST(Atlas, corners_of_a_map_land_on_the_corners_of_its_place) {
  const Atlas atlas = pack_atlas(plan_of({{512, 256}, {128, 64}, {300, 300}}));
  for (const ClipSpace& space : {kOpenGl, kVulkan, kDirect3D}) {
    for (int map = 0; map < atlas.count; ++map) {
      const TexelRect& place = atlas.place[static_cast<std::size_t>(map)];
      const glm::dmat4 own = texture_from_clip(space), all = atlas_from_clip(atlas, space, map);
      for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {0.25, 0.5}, {1.0, 1.0}}) {
        const glm::dvec4 uv = own * glm::dvec4(x, y, 0.3, 1.0), at = all * glm::dvec4(x, y, 0.3, 1.0);
        EXPECT_CLOSE(at.x * atlas.width, place.x + uv.x * place.width, 1e-12);
        EXPECT_CLOSE(at.y * atlas.height, place.y + uv.y * place.height, 1e-12);
        EXPECT_EQ(at.z, uv.z);
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
