// Do pages carry the light of panes, in images no larger than the frame needs?
#include <gtest/gtest.h>

#include "pane_scenes.hpp"

namespace gnomon::render {
namespace {

/// Pages for what a camera sees of a scene.
struct Pages {
  Camera camera = camera_on_box(kSize, kSize);
  std::vector<glm::dvec3> points;
  std::vector<std::byte> memory = std::vector<std::byte>(page_memory(4096, 1 << 17));
  PagePlan plan;

  Pages(const Scene& opaque, const Scene& panes, const Light& light, const PagePolicy& policy,
        int page_texels = 64) {
    Renderer renderer(opaque);
    const Frame frame = render::draw(renderer, camera, ShadowPlan{}, filters::hard);
    for (std::size_t i = 0; i < frame.pixels(); ++i)
      if (frame.surface(i)) points.push_back(frame.point(i));
    const std::vector<Box> boxes = all_boxes(opaque, panes);
    PageOptions pages;
    set_margin(default_settings(filters::hard), pages.plan);
    pages.policy = &policy;
    pages.page_texels = page_texels;
    plan = plan_pages({.camera = camera, .points_world = points}, light, {boxes, boxes}, pages, memory);
  }
};

TEST_F(Panes, pages_are_tinted_like_maps) {
  const Scene opaque = box_on_ground(), panes = panes_over_ground(4);
  for (const Light& light : {Light{DirectionalLight{kSlant}}, Light{PointLight{{0.5, 9.0, 0.5}, 60.0}}})
    for (const PagePolicy* policy : {&page_policies::queried, &page_policies::resolution}) {
      Pages pages(opaque, panes, light, *policy);
      ASSERT_EQ(pages.plan.status, PlanStatus::ok);
      ASSERT_GT(pages.plan.pages.size(), 20u);
      Renderer renderer(opaque);
      renderer.add_panes(panes);
      const PreparedFilter hard = renderer.prepare(filters::hard, Source::pages);
      const FrameStats stats = renderer.draw(pages.plan, pages.camera, hard, plain_options());
      EXPECT_GT(stats.pane_texels, 0u);
      const Judged j = judged(renderer, pages.camera, opaque, panes, light);
      EXPECT_GT(j.coloured, 500u);
      EXPECT_LT(j.worst_inside, 0.005) << policy->name;
      EXPECT_LT(j.mean, 0.004) << policy->name;
      const FloatImage before = renderer.transmittance();
      // Nothing changed, nothing is drawn; a pane that moves is.
      EXPECT_EQ(renderer.draw(pages.plan, pages.camera, hard, plain_options()).pane_texels, 0u);
      EXPECT_EQ(renderer.transmittance().values, before.values);
      Scene moved = panes;
      moved.instances[1] = shifted(moved.instances[1], {0.5, 0.1, -0.25});
      ASSERT_TRUE(renderer.move_pane(1, moved.instances[1]));
      renderer.draw(pages.plan, pages.camera, hard, plain_options());
      EXPECT_LT(judged(renderer, pages.camera, opaque, moved, light).worst_inside, 0.005);
      Renderer fresh(opaque);
      (void)fresh.prepare(filters::hard, Source::pages);
      fresh.add_panes(moved);  // after the filter: either order is fine
      fresh.draw(pages.plan, pages.camera, fresh.prepare(filters::hard, Source::pages), plain_options());
      EXPECT_EQ(renderer.transmittance().values, fresh.transmittance().values);
      // Maps in between take the images, and no pane is left where there is none any more.
      const std::vector<Box> boxes = all_boxes(opaque, panes);
      renderer.draw(make_plan(pages.camera, light, {boxes, boxes}, plan_options("none", 2)), pages.camera,
                    renderer.prepare(filters::hard), plain_options());
      renderer.draw(pages.plan, pages.camera, hard, plain_options());
      EXPECT_EQ(renderer.transmittance().values, fresh.transmittance().values);
      renderer.add_panes(empty_scene());
      Renderer plain(opaque);
      renderer.draw(pages.plan, pages.camera, hard, plain_options());
      plain.draw(pages.plan, pages.camera, plain.prepare(filters::hard, Source::pages), plain_options());
      EXPECT_EQ(renderer.image().rgba, plain.image().rgba);
    }
}

TEST_F(Panes, images_are_as_large_as_the_frame_needs_them_whatever_came_before) {
  const Scene opaque = box_on_ground(), panes = panes_over_ground(4);
  const Light light = DirectionalLight{kSlant};
  for (const int texels : {64, 256}) {
    Pages pages(opaque, panes, light, page_policies::resolution, texels);
    ASSERT_EQ(pages.plan.status, PlanStatus::ok);
    Renderer renderer(opaque), plain(opaque);
    renderer.add_panes(panes);
    const auto bytes_of_panes = [&] {
      const auto bytes = [&](Renderer& of) {
        return of.draw(pages.plan, pages.camera, of.prepare(filters::hard, Source::pages), plain_options())
            .map_bytes;
      };
      return bytes(renderer) - bytes(plain);
    };
    const auto slot = static_cast<std::uint64_t>(pages.plan.slot_texels());
    // Places are a square of squares.
    const auto most =
        static_cast<std::uint64_t>(2.0 * kPaneTexelBytes) * pages.plan.pages.size() * slot * slot;
    EXPECT_LT(bytes_of_panes(), most) << texels;
    const std::vector<Box> boxes = all_boxes(opaque, panes);
    PlanOptions large = plan_options("none", 4);
    large.resolution.max_size = 2048;
    constexpr std::uint64_t kMaxOfPages = std::uint64_t{256} << 20;
    const FrameStats large_frame =
        renderer.draw(make_plan(pages.camera, light, {boxes, boxes}, large), pages.camera,
                      renderer.prepare(filters::hard), plain_options());
    EXPECT_GT(large_frame.map_bytes, 2 * kMaxOfPages);
    EXPECT_LE(bytes_of_panes(), kMaxOfPages) << texels;
  }
}

TEST_F(Panes, pages_that_no_pane_reaches_are_not_tinted) {
  const Scene opaque = box_on_ground();
  Scene panes = empty_scene();
  const int tint = add_material(panes, glass({0.9f, 0.2f, 0.1f}, 0.8f));
  add_quad(panes, {400.0f, 3.0f, 403.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 0.0f, -6.0f}, tint);
  const Light light = DirectionalLight{{0.02, -1.0, 0.01}};
  Pages pages(opaque, empty_scene(), light, page_policies::queried);
  ASSERT_EQ(pages.plan.status, PlanStatus::ok);
  Renderer renderer(opaque);
  renderer.add_panes(panes);
  const FrameStats stats = renderer.draw(pages.plan, pages.camera,
                                         renderer.prepare(filters::hard, Source::pages), plain_options());
  EXPECT_EQ(stats.pane_texels, 0u);
  const FloatImage image = renderer.transmittance();
  for (const float value : image.values) ASSERT_EQ(value, 1.0f);
}

}  // namespace
}  // namespace gnomon::render
