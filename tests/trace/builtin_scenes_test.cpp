// Does Embree see the builtin scenes as our own rays do, masks and all?
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/reference.hpp"
#include "picture.hpp"

namespace gnomon::trace {
namespace {

class BuiltinScenes : public testing::TestWithParam<std::string> {};

TEST_P(BuiltinScenes, both_engines_give_the_same_shadow_off_the_undecided_pixels) {
  if (!built_with_embree()) GTEST_SKIP() << "built without Embree";
  const Scene scene = load_builtin(GetParam());
  const Tracer own(scene, Engine::own), embree(scene, Engine::embree);
  const glm::dvec3 middle = 0.5 * (scene.bounds_world.min + scene.bounds_world.max);
  const CameraPath path = default_path(scene);
  const Light local =
      PointLight{middle + glm::dvec3(1.3, 0.3 * (scene.bounds_world.max.y - middle.y), 2.7), 1e4};
  for (const Light& light : {Light(DirectionalLight{{-0.7, -0.2, 0.5}}), local}) {
    const Camera camera = path.at(0.3, 128, 72);
    const Picture picture = picture_of(own, camera);
    const SurfacePoints points = surface_points(own, camera, light, picture.positions, picture.normals);
    const HardReference truth = hard_reference(own, points, light),
                        fast = hard_reference(embree, points, light);
    int decided = 0, undecided_truth = 0, undecided_fast = 0, shadow = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
      undecided_truth += truth.pixels[i] == Verdict::undecided;
      undecided_fast += fast.pixels[i] == Verdict::undecided;
      if (truth.pixels[i] == Verdict::none || fast.pixels[i] == Verdict::none) {
        EXPECT_EQ(truth.pixels[i], fast.pixels[i]);
        continue;
      }
      if (truth.pixels[i] == Verdict::undecided || fast.pixels[i] == Verdict::undecided) continue;
      EXPECT_EQ(truth.pixels[i], fast.pixels[i]) << GetParam() << " pixel " << i;
      ++decided;
      shadow += truth.pixels[i] == Verdict::shadow;
    }
    RecordProperty("undecided_own", undecided_truth);
    RecordProperty("undecided_embree", undecided_fast);
    EXPECT_GT(decided, 500);
    EXPECT_GT(shadow, 0);
    // In double an edge passes too close by chance alone.
    EXPECT_LE(undecided_truth, decided / 100);
    EXPECT_LE(undecided_fast, decided / 20);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScenes, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const BuiltinScene& scene : builtin_scenes()) names.emplace_back(scene.name);
                           return names;
                         }()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace gnomon::trace
