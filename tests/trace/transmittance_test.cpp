// Do rays through panes multiply what each pane lets through?
#include "gnomon/trace/transmittance.hpp"

#include <gtest/gtest.h>

#include "render/test_scene.hpp"

namespace gnomon::trace {
namespace {

/// Two level panes of one material each, at these heights.
Scene two_panes(const Material& low, const Material& high) {
  Scene scene = render::empty_scene();
  const int a = render::add_material(scene, low), b = render::add_material(scene, high);
  render::add_quad(scene, {-1, 1, 1}, {2, 0, 0}, {0, 0, -2}, a);
  render::add_quad(scene, {-1, 2, 1}, {2, 0, 0}, {0, 0, -2}, b);
  return scene;
}

Material tinted(const glm::vec3& color) {
  Material material;
  material.base_color = glm::vec4(color, 1.0f);
  material.transmission = 1.0f;
  return material;
}

Ray upwards(double x, double z, double from = 0.0) {
  Ray ray;
  ray.origin = {x, from, z};
  return ray;
}

TEST(PaneTracer, two_panes_multiply_and_one_behind_the_start_or_the_end_counts_nothing) {
  const PaneTracer panes(two_panes(tinted({0.5f, 0.25f, 1.0f}), tinted({0.5f, 0.5f, 0.5f})));
  EXPECT_EQ(panes.transmittance(upwards(0.3, 0.2)), glm::dvec3(0.25, 0.125, 0.5));
  EXPECT_EQ(panes.transmittance(upwards(0.3, 0.2, 1.5)), glm::dvec3(0.5, 0.5, 0.5));
  EXPECT_EQ(panes.transmittance(upwards(0.3, 0.2, 2.5)), glm::dvec3(1.0));
  EXPECT_EQ(panes.transmittance(upwards(5.0, 0.2)), glm::dvec3(1.0));
  Ray ends = upwards(0.3, 0.2);
  ends.end = 1.5;
  EXPECT_EQ(panes.transmittance(ends), glm::dvec3(0.5, 0.25, 1.0));
}

TEST(PaneTracer, pictures_are_read_linear_and_between_texels) {
  Material material = tinted({1.0f, 1.0f, 1.0f});
  material.base_color_image = 0;
  material.wrap_u = material.wrap_v = TextureWrap::clamp_to_edge;
  Scene scene = two_panes(material, tinted({1.0f, 1.0f, 1.0f}));
  scene.images.push_back({"half", 2, 1, {255, 188, 0, 255, 0, 188, 0, 255}});
  const PaneTracer panes(scene);
  const glm::dvec3 middle = panes.transmittance(upwards(0.0, 0.2));
  EXPECT_NEAR(middle.r, 0.5, 1e-6);
  EXPECT_NEAR(middle.g, 0.5029, 1e-3);  // 188 encodes half of the light
  EXPECT_EQ(middle.b, 0.0);
  EXPECT_NEAR(panes.transmittance(upwards(-0.9, 0.2)).r, 1.0, 1e-6);
  EXPECT_NEAR(panes.transmittance(upwards(0.9, 0.2)).r, 0.0, 1e-6);
}

TEST(PaneTracer, alpha_covers_and_masks_cut_out) {
  Material smoke;
  smoke.alpha_mode = AlphaMode::blend;
  smoke.base_color.a = 0.25f;
  Material hole = tinted({0.5f, 0.5f, 0.5f});
  hole.alpha_mode = AlphaMode::mask;
  hole.base_color.a = 0.1f;
  const PaneTracer panes(two_panes(smoke, hole));
  EXPECT_EQ(panes.transmittance(upwards(0.3, 0.2)), glm::dvec3(0.75));
}

}  // namespace
}  // namespace gnomon::trace
