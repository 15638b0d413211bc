// Do jittered maps show the same scene on a grid moved by so much, and nothing outside of it?
#include "gnomon/motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "gnomon/extend/shape.hpp"
#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

struct Street {
  std::vector<Box> boxes = {{{-30, -1, -200}, {30, 20, 10}}};
  Camera camera = perspective_camera({0, 1.7, 0}, {0, -0.05, -1}, {0, 1, 0}, 1.2, 1.6, 0.1, 200, 1000, 625);
  PlanOptions options;
  [[nodiscard]] ShadowPlan plan(const Light& light) const {
    return make_plan(camera, light, {boxes, boxes}, options);
  }
};

const Light kSun = DirectionalLight{{0.3, -1, 0.2}};
const Light kSpot = SpotLight{{5, 15, -20}, {0, -1, -0.5}, 0.9, 100};

glm::dvec2 texel_of(const ShadowPlan& plan, const ShadowMap& map, const glm::dvec3& point) {
  const glm::dmat4 gl_from_plan = glm::inverse(clip_from_gl_clip(plan.clip_space));
  const glm::dvec4 h = gl_from_plan * map.clip_from_world * glm::dvec4(point, 1.0);
  return map.texels().place(glm::dvec2(h) / h.w).texel;
}

const std::array<glm::dvec3, 3> kPoints = {glm::dvec3(1, 0, -5), {-4, 2, -30}, {10, 0, -90}};

TEST(Jitter, moves_texels_by_the_offset_under_every_warp_light_and_clip_space) {
  constexpr glm::dvec2 kOffset{0.3, -0.45};
  int maps = 0;
  for (const Warp* warp : all_warps()) {
    for (const Light& light : {kSun, kSpot}) {
      for (const bool y_down : {false, true}) {
        Street street;
        street.options.warp.warp = warp;
        street.options.cascades = 3;
        street.options.clip_space.y_down = y_down;
        const ShadowPlan plan = street.plan(light), moved = jittered(plan, kOffset);
        ASSERT_EQ(plan.map_count, moved.map_count);
        for (std::size_t i = 0; i < plan.maps().size(); ++i) {
          ++maps;
          for (const glm::dvec3& point : kPoints) {
            const glm::dvec2 before = texel_of(plan, plan.map[i], point),
                             after = texel_of(moved, moved.map[i], point);
            constexpr double kRounding = 1e-7;
            EXPECT_NEAR(after.x - before.x, kOffset.x, kRounding * (1.0 + std::abs(before.x))) << warp->name;
            EXPECT_NEAR(after.y - before.y, kOffset.y, kRounding * (1.0 + std::abs(before.y))) << warp->name;
            const glm::vec4 relative = moved.map[i].clip_from_camera_relative *
                                       glm::vec4(glm::vec3(point - moved.origin_world), 1.0f);
            const glm::dvec4 world = moved.map[i].clip_from_world * glm::dvec4(point, 1.0);
            EXPECT_NEAR(relative.x / relative.w, world.x / world.w,
                        1e-4 * (1.0 + std::abs(world.x / world.w)));
          }
        }
      }
    }
  }
  EXPECT_GT(maps, 20);
}

TEST(Jitter, keeps_served_points_inside_of_the_margin_that_is_left) {
  int held = 0;
  for (const Light& light : {kSun, kSpot}) {
    Street street;
    street.options.filter.texels = 2.5 + kJitterReachTexels;
    const ShadowPlan plan = street.plan(light);
    for (const glm::dvec2& offset : {glm::dvec2(0.5, 0.5), glm::dvec2(-0.5, 0.5), glm::dvec2(-0.5, -0.5)}) {
      const ShadowPlan moved = jittered(plan, offset);
      for (std::size_t i = 0; i < plan.maps().size(); ++i) {
        for (double x = -30.0; x <= 30.0; x += 0.5) {
          for (double z = -60.0; z <= 10.0; z += 0.5) {
            const glm::dvec3 point{x, 0.0, z};
            if (!map_holds(plan, plan.map[i], point)) continue;
            ++held;
            EXPECT_TRUE(map_holds(moved, moved.map[i], point)) << x << " " << z;
          }
        }
      }
    }
  }
  EXPECT_GT(held, 1000);
}

TEST(Jitter, clamps_offsets_and_leaves_a_plan_without_maps_and_without_offset_as_it_is) {
  const Street street;
  const ShadowPlan plan = street.plan(kSun);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(jittered(plan, {0.0, nan}).map[0].clip_from_world, plan.map[0].clip_from_world);
  EXPECT_EQ(jittered(plan, {0.0, 0.0}).map[0].filter_margin_texels, plan.map[0].filter_margin_texels);
  EXPECT_EQ(jittered(plan, {1e30, -7.0}).map[0].clip_from_world,
            jittered(plan, {0.5, -0.5}).map[0].clip_from_world);
  EXPECT_EQ(jittered(ShadowPlan{}, {0.5, 0.5}).map_count, 0);
}

TEST(Jitter, moved_maps_are_never_taken_for_those_of_the_frame_before) {
  Street street;
  street.options.fit = Fit::stable;
  const ShadowPlan plan = street.plan(kSun);
  ASSERT_TRUE(plan.map[0].snap_key.valid);
  EXPECT_FALSE(jittered(plan, {0.25, 0.0}).map[0].snap_key.valid);
}

TEST(Jitter, sequence_covers_the_texel_evenly_from_the_first_frames_on) {
  for (const std::uint32_t frames : {16u, 64u}) {
    // Cells of a fourth of a texel.
    std::array<int, 16> cells{};
    glm::dvec2 mean(0.0);
    for (std::uint32_t i = 0; i < frames; ++i) {
      const glm::dvec2 offset = jitter_texels(i);
      ASSERT_GE(offset.x, -0.5);
      ASSERT_LT(offset.x, 0.5);
      ASSERT_GE(offset.y, -0.5);
      ASSERT_LT(offset.y, 0.5);
      mean += offset / static_cast<double>(frames);
      const int x = static_cast<int>((offset.x + 0.5) * 4.0), y = static_cast<int>((offset.y + 0.5) * 4.0);
      ++cells[static_cast<std::size_t>(4 * y + x)];
    }
    for (const int count : cells) EXPECT_NEAR(count, frames / 16.0, 1.0) << frames;
    EXPECT_LT(glm::length(mean), 0.05);
  }
}

TEST(Jitter, any_frames_in_a_row_hold_the_whole_lattice) {
  const auto places_from = [](std::uint32_t first) {
    std::set<std::pair<double, double>> places;
    for (std::uint32_t i = 0; i < kJitterFrames; ++i) {
      const glm::dvec2 offset = jitter_texels(first + i);
      places.emplace(offset.x, offset.y);
    }
    return places;
  };
  const auto all = places_from(0);
  EXPECT_EQ(all.size(), kJitterFrames);
  // Across the texel's sides as well. No lattice of 64 points keeps them farther than 0.134 apart.
  for (const auto& [ax, ay] : all) {
    for (const auto& [bx, by] : all) {
      const double x = std::remainder(ax - bx, 1.0), y = std::remainder(ay - by, 1.0);
      EXPECT_TRUE((x == 0.0 && y == 0.0) || std::hypot(x, y) > 0.11) << ax << ' ' << ay;
    }
  }
  for (const std::uint32_t first : {1u, 37u, 4000000000u, 4294967290u})
    EXPECT_EQ(places_from(first), all) << first;
}

}  // namespace
}  // namespace gnomon::test
