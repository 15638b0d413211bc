// Does a renderer take no more memory from one round of frames to the next?
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <string>
#include <vector>

#include "gnomon/motion.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "mask_frame.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

constexpr int kRound = 60, kRounds = 10;
// A fifth of a kilobyte in each frame; an image of 64 x 64 bytes that each leaves behind takes 240 KiB.
constexpr double kMostKib = 12.0;

/// KiB that are taken from the heap, the driver's among them.
double heap_kib() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / 1024.0;
}

/// A flight past boxes, one of which walks.
class SteadyMemory : public testing::Test {
 protected:
  /// Draws the frames, and compares what is taken after each round of them. A driver may take a megabyte at
  /// once in one round; what leaks does so in each.
  void expect_steady(const std::function<void(int frame)>& draw) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "the sanitizer has a heap of its own";
#endif
    std::vector<double> taken, growth;
    for (int frame = 0; frame < kRounds * kRound; ++frame) {
      walk(frame);
      draw(frame);
      EXPECT_FALSE(renderer_.mask().values.empty());
      if (frame % kRound == kRound - 1) taken.push_back(heap_kib());
    }
    for (std::size_t i = 1; i < taken.size(); ++i) growth.push_back(taken[i] - taken[i - 1]);
    const auto middle = growth.begin() + static_cast<std::ptrdiff_t>(growth.size() / 2);
    std::nth_element(growth.begin(), middle, growth.end());
    RecordProperty("kibibytes", std::to_string(taken.front()) + " then " + std::to_string(taken.back()));
    EXPECT_GT(taken.front(), 100.0);
    EXPECT_LT(*middle, kMostKib) << "from " << taken.front() << " KiB";
  }
  /// There and back, so that later frames are like the first.
  [[nodiscard]] static double place(int frame) {
    return 15.0 - std::abs(frame % kRound - 30.0) / 2.0;
  }
  void walk(int frame) {
    Instance at = scene_.instances[1];
    const glm::dvec3 by(0.05 * place(frame), 0.0, 0.0);
    at.world_from_object = glm::translate(glm::dmat4(1.0), by) * at.world_from_object;
    at.bounds_world = {at.bounds_world.min + by, at.bounds_world.max + by};
    ASSERT_TRUE(renderer_.move_instance(1, at));
    boxes_[1] = at.bounds_world;
  }
  [[nodiscard]] static FrameOptions options() {
    FrameOptions options;
    options.time_passes = false;
    return options;
  }

  std::unique_ptr<Context> context_ = create_context();
  Scene scene_ = boxes_on_ground();
  std::vector<Box> boxes_ = boxes_of(scene_);
  Renderer renderer_{scene_};
};

TEST_F(SteadyMemory, maps_with_a_history) {
  PlanOptions plan;
  plan.resolution.max_size = 128;
  plan.cascades = 2;
  PlanHistory history;
  expect_steady([&](int frame) {
    const Camera camera = going(place(frame));
    const ShadowPlan planned = make_plan(camera, DirectionalLight{kSlant}, {boxes_, boxes_}, plan, &history);
    renderer_.draw(planned, camera, renderer_.prepare(filters::vsm), options());
  });
}

TEST_F(SteadyMemory, pages_that_are_kept) {
  PageOptions pages;
  pages.plan.fit = Fit::stable;
  pages.page_texels = 64;
  pages.capacity = 32;
  std::vector<std::byte> memory(page_memory(pages.capacity, 4096));
  expect_steady([&](int frame) {
    const Camera camera = going(place(frame));
    const PagePlan planned = plan_pages(camera, DirectionalLight{kSlant}, {boxes_, boxes_}, pages, memory);
    ASSERT_EQ(planned.status, PlanStatus::ok);
    renderer_.draw(planned, camera, renderer_.prepare(filters::hard, Source::pages), options());
  });
}

TEST_F(SteadyMemory, many_lights) {
  const std::vector<LightRequest> requests{{DirectionalLight{kSlant}},
                                           {SpotLight{{-4, 6, 4}, {0.6, -1, -0.5}, 0.6, 20.0}},
                                           {PointLight{{3, 3, 2}, 9.0}}};
  LightOptions pool;
  pool.pool_width = pool.pool_height = 512;
  pool.most_size = 128;
  std::vector<std::byte> memory(light_memory(requests.size(), 0));
  std::vector<LightState> states(requests.size());
  LightHistory history{states, 0, {}};
  std::vector<ShadowPlan> own(requests.size());
  expect_steady([&](int frame) {
    const Camera camera = going(place(frame));
    const LightPlan planned = plan_lights(camera, requests, {boxes_, boxes_}, pool, memory, &history);
    ASSERT_EQ(planned.status, PlanStatus::ok);
    std::vector<DrawnLight> drawn;
    for (std::size_t i = 0; i < requests.size(); ++i) {
      const LightMaps& maps = planned.lights[i];
      const Light& light = requests[i].light;
      if (maps.due)
        own[i] = make_plan(maps.frames > 1 ? camera_round(light, camera) : camera, light, {boxes_, boxes_},
                           light_options(pool, maps));
      drawn.push_back({light, &own[i], glm::vec3(0.5f)});
    }
    renderer_.draw({planned, drawn}, camera, renderer_.prepare(filters::hard, Source::lights), options());
  });
}

}  // namespace
}  // namespace gnomon::render
