// Does the coarse pass over a scene hold every depth that the renderer draws?
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/coarse_view.hpp"
#include "gnomon/scene/load.hpp"
#include "prune_pair.hpp"

namespace gnomon::render {
namespace {

struct Held {
  std::size_t pixels = 0, outside = 0;
  double near_share = 0.0, far_share = 0.0;  ///< coarse over drawn
};

Held held_in(Renderer& renderer, const PreparedFilter& filter, const Scene& scene, const Camera& camera,
             std::uint64_t triangles, CoarseView& view) {
  renderer.draw(ShadowPlan{}, camera, filter, mask_only(kPruneNothing));
  const FloatImage positions = renderer.positions();
  const VisibleDepths coarse = view.depths(scene, camera, triangles);
  VisibleDepths drawn;
  Held held;
  for (std::size_t i = 3; i < positions.values.size(); i += 4) {
    const double depth = positions.values[i];
    drawn.add(depth);
    if (!(depth > 0.0)) continue;
    ++held.pixels;
    const bool in = depth >= coarse.min && depth <= coarse.max &&
                    coarse.count[static_cast<std::size_t>(depth_bin(depth))] > 0;
    held.outside += in ? 0 : 1;
  }
  if (held.pixels > 0) held.near_share = coarse.min / drawn.min, held.far_share = coarse.max / drawn.max;
  return held;
}

TEST(CoarseView, every_depth_that_is_drawn_is_held) {
  constexpr std::uint64_t kAll = 10'000'000, kSome = 2'000;
  constexpr int kWidth = 333, kHeight = 187;
  std::size_t pixels = 0;
  int views = 0;
  double doublings = 0.0;  ///< of depth, by which the range is too wide
  for (const BuiltinScene& builtin : builtin_scenes()) {
    const Scene scene = load_builtin(std::string(builtin.name));
    Renderer renderer(scene);
    const PreparedFilter filter = renderer.prepare(filters::hard);
    const CameraPath path = default_path(scene);
    CoarseView view;
    for (const double t : {0.1, 0.45, 0.8}) {
      Camera camera = path.at(t, kWidth, kHeight);
      for (const std::uint64_t triangles : {kAll, kSome, std::uint64_t{0}}) {
        const Held held = held_in(renderer, filter, scene, camera, triangles, view);
        EXPECT_EQ(held.outside, 0u) << builtin.name << ", " << t << ", " << triangles;
        pixels += held.pixels;
        EXPECT_LE(held.near_share, 1.0);
        EXPECT_GE(held.far_share, 1.0);
        if (triangles != kAll) continue;
        ++views;
        doublings += std::log2(held.far_share / held.near_share);
      }
    }
  }
  EXPECT_GT(pixels, 1'000'000u);
  EXPECT_GE(views, 18);
  EXPECT_LT(doublings / views, 0.5);
}

}  // namespace
}  // namespace gnomon::render
