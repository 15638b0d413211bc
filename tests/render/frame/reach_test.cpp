// Does a local light that reaches nothing in view light nothing?
#include <gtest/gtest.h>

#include <vector>

#include "gnomon/render/renderer.hpp"
#include "shared_context.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

double brightness_under(const Light& light) {
  const Scene scene = box_on_ground();
  const std::vector<Box> boxes{scene.bounds_world};
  const Camera camera = camera_on_box(64, 64);
  Renderer renderer(scene);
  FrameOptions options;
  options.light = &light;
  const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, {});
  renderer.draw(plan, camera, renderer.prepare(default_settings(filters::hard)), options);
  const Image image = renderer.image();
  double sum = 0.0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) sum += i % 4 < 3 ? image.rgba[i] : 0;
  return sum / (0.75 * static_cast<double>(image.rgba.size()));
}

TEST(Reach, of_a_light_ends_where_its_range_and_its_cone_end) {
  (void)shared_context();
  const glm::dvec3 over{0.0, 20.0, 0.0}, down{0.0, -1.0, 0.0};
  const double dark = brightness_under(PointLight{over, 0.5});
  EXPECT_GT(brightness_under(PointLight{over, 100.0}), 1.3 * dark);
  EXPECT_GT(brightness_under(SpotLight{over, down, 0.5, 100.0}), 1.1 * dark);
  EXPECT_NEAR(brightness_under(SpotLight{over, down, 0.5, 0.5}), dark, 0.5);
  EXPECT_NEAR(brightness_under(SpotLight{over, -down, 0.5, 100.0}), dark, 0.5);
}

}  // namespace
}  // namespace gnomon::render
