// Do two renderers on two threads draw what one draws alone?
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <thread>
#include <vector>

#include "gnomon/render/context.hpp"
#include "mask_frame.hpp"

namespace gnomon::render {
namespace {

/// Masks of a walk past some boxes, under every one of these filters: with a context of this thread's own.
std::vector<std::vector<float>> walk(ContextKind kind, const Scene& scene) {
  constexpr int kFrames = 3;
  const auto context = create_context(kind);
  std::vector<std::vector<float>> masks;
  Renderer renderer(scene);
  for (const Filter* filter : {&filters::hard, &filters::pcf, &filters::evsm2}) {
    for (int frame = 0; frame < kFrames; ++frame) {
      const Camera camera = going(4.0 * frame);
      PlanOptions options;
      options.resolution.max_size = 128;
      set_margin(default_settings(*filter), options);
      masks.push_back(draw(renderer, camera, plan_for(scene, camera, kSlant, options), *filter).mask.values);
      check_context();
    }
  }
  return masks;
}

TEST(RendererThreads, draw_what_one_draws_alone) {
  const Scene scene = boxes_on_ground();
  // The scene is shared, and nothing else.
  const std::vector<std::vector<float>> alone = walk(ContextKind::osmesa, scene);
  std::array<std::vector<std::vector<float>>, 2> drawn;
  const auto run = [&](std::size_t thread) { drawn[thread] = walk(ContextKind::osmesa, scene); };
  std::thread first(run, 0u), second(run, 1u);
  first.join();
  second.join();
  std::size_t dark = 0;
  for (const float value : alone.front()) dark += value == 0.0f ? 1 : 0;
  EXPECT_GT(dark, 50u);
  for (const auto& of_thread : drawn) {
    ASSERT_EQ(of_thread.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(of_thread[i], alone[i]) << i;
  }
}

}  // namespace
}  // namespace gnomon::render
