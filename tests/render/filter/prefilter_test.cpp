// Does prefiltering cost the passes and images that it should? And does the shader find the maps that the
// core does?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "gnomon/camera.hpp"
#include "mask_frame.hpp"

namespace gnomon::render {
namespace {

FilterSettings parsed(const std::string& text) {
  const ParsedFilter filter = parse_filter(text);
  EXPECT_EQ(filter.error, "");
  return filter.settings;
}

class Prefilter : public testing::Test {
 protected:
  FrameStats stats_of(const FilterSettings& filter, int map_size) {
    PlanOptions options;
    options.resolution.max_size = map_size;
    options.cascades = 1;
    options.prune = kPruneNothing;  // the sizes asked for
    set_margin(filter, options);
    const Camera camera = camera_on_box(kSize, kSize);
    const ShadowPlan plan = plan_for(scene_, camera, kSlant, options);
    EXPECT_GT(plan.map_count, 0);
    FrameOptions frame;
    frame.aliasing = frame.cascade_tint = frame.time_passes = false;
    frame.prune = kPruneNothing;
    return renderer_.draw(plan, camera, renderer_.prepare(filter), frame);
  }

  Scene scene_ = box_on_ground();
  Renderer renderer_{scene_};
};

TEST_F(Prefilter, blurs_7_by_7_on_1024_texels_of_two_floats_in_two_passes_and_one_more_image) {
  const FrameStats stats = stats_of(parsed("vsm:radius=3,format=fp32"), 1024);
  EXPECT_EQ(stats.prefilter_passes, 2);
  constexpr std::uint64_t kTexels = 1024u * 1024u, kDepth = 4, kMoments = 8;
  EXPECT_EQ(stats.map_bytes, kTexels * (kDepth + kMoments));
  constexpr std::uint64_t kTiles = 32 * 32, kLists = 48 + kTiles * 5 * 4;
  EXPECT_EQ(stats.scratch_bytes, kTexels * kMoments + kTiles + kLists);  // blurred one way; which tiles
}

TEST_F(Prefilter, builds_mip_maps_and_pyramids_only_for_filters_that_read_them) {
  EXPECT_EQ(stats_of(parsed("vsm:radius=0,mipmap=1"), 64).prefilter_passes,
            2);  // the driver's own count as one
  EXPECT_EQ(stats_of(parsed("esm:radius=0,mipmap=1"), 64).prefilter_passes, 2);
  EXPECT_EQ(stats_of(parsed("esm:c=200,radius=0,mipmap=1"), 64).prefilter_passes, 1 + 6);  // 32, 16, .. 1
  EXPECT_EQ(stats_of(parsed("esm:radius=0,fallback=1"), 64).prefilter_passes, 1);
  EXPECT_EQ(stats_of(parsed("esm:radius=0,fallback=2"), 64).prefilter_passes, 1 + 6);
}

TEST(Mask, names_for_every_pixel_the_map_that_the_core_names) {
  Scene scene = empty_scene();
  add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40}, add_material(scene, {}));
  for (int i = 0; i < 12; ++i)
    add_box(scene, {-1.0f, 0.0f, 10.0f - 2.0f * static_cast<float>(i)},
            {1.0f, 1.0f, 11.0f - 2.0f * static_cast<float>(i)});
  Renderer renderer(scene);
  const Camera camera =
      perspective_camera({0.3, 4.0, 16.0}, {0.0, -0.3, -1.0}, {0, 1, 0}, 0.9, 1.0, 0.5, 60.0, kSize, kSize);
  for (const Fit fit : {Fit::tight, Fit::stable}) {
    PlanOptions options;
    options.resolution.max_size = 128;
    options.fit = fit;
    set_margin(default_settings(filters::hard), options);
    const ShadowPlan plan = plan_for(scene, camera, kSlant, options);
    ASSERT_GT(plan.map_count, 2);
    const Frame frame = draw(renderer, camera, plan, filters::hard);
    std::array<int, kMaxMaps> seen{};
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      if (!frame.surface(i)) continue;
      constexpr double kFloat = 1e-5;  // of depths: at a split either map may be named
      const double depth = frame.positions.values[4 * i + 3];
      const int low = map_serving(plan, frame.point(i), depth * (1.0 - kFloat)),
                high = map_serving(plan, frame.point(i), depth * (1.0 + kFloat));
      ASSERT_TRUE(frame.map(i) == low || frame.map(i) == high)
          << depth << ": " << frame.map(i) << " for " << low;
      if (frame.map(i) >= 0) ++seen[static_cast<std::size_t>(frame.map(i))];
    }
    EXPECT_GT(std::count_if(seen.begin(), seen.end(), [](int pixels) { return pixels > 20; }), 1);
  }
}

}  // namespace
}  // namespace gnomon::render
