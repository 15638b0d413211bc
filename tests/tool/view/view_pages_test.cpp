// Pages in the viewer: their views, what is kept from picture to picture, and what is refused.
#include <malloc.h>

#include <glm/geometric.hpp>

#include "page_aliasing.hpp"
#include "page_pictures.hpp"
#include "probe.hpp"
#include "view_pictures.hpp"

namespace gnomon::tool::view {
namespace {

State with_pages(const PagePolicy& policy = page_policies::resolution) {
  State state = hangar();
  state.a.pages.policy = &policy;
  state.a.pages.page_texels = 64;
  return state;
}

/// A frame with maps, after which the pool of pages is empty.
void forget_pages() {
  (void)picture(hangar());
}

const Side& side() {
  return stage().side(0);
}

std::size_t drawn_pages() {
  const std::vector<bool>& drawn = side().pages->drawn();
  return static_cast<std::size_t>(std::count(drawn.begin(), drawn.end(), true));
}

TEST(ViewPages, of_every_policy_are_planned_and_drawn) {
  for (const PagePolicy* policy : all_page_policies()) {
    forget_pages();
    const Image lit = picture(with_pages(*policy));
    ASSERT_TRUE(side().pages) << policy->name;
    const PagePlan& plan = side().pages->plan();
    EXPECT_EQ(plan.status, PlanStatus::ok) << policy->name;
    EXPECT_EQ(plan.policy, policy);
    EXPECT_GT(plan.pages.size(), 8u) << policy->name;
    EXPECT_EQ(side().stats.pages, static_cast<int>(plan.pages.size()));
    EXPECT_EQ(drawn_pages(), plan.pages.size()) << policy->name << ": the pool was empty";
    EXPECT_GT(side().m.p95, 0.0);
    EXPECT_FALSE(stage().unfinished()) << policy->name << ": this picture was settled";
  }
  (void)picture(hangar());
  EXPECT_FALSE(side().pages) << "off again";
}

TEST(ViewPages, show_something_else_in_every_view_than_maps_do) {
  for (const View view :
       {View::lit, View::heat, View::mask, View::cascades, View::checker, View::map, View::kept}) {
    State maps = hangar(), pages = with_pages();
    maps.view = pages.view = view;
    maps.map = pages.map = 3;
    const Image of_maps = picture(maps), of_pages = picture(pages);
    // Legends cover most of so small a picture, and most of what is lit is lit either way.
    const bool alike = view == View::lit || view == View::mask || view == View::heat;
    const double most = alike ? 0.999 : 0.9;
    EXPECT_LT(share_equal(of_maps, of_pages, 0, kWidth), most)
        << view_names()[static_cast<std::size_t>(view)].name;
  }
  // The exact shadow knows neither.
  State maps = hangar(), pages = with_pages();
  maps.view = pages.view = View::truth;
  EXPECT_EQ(share_equal(picture(maps), picture(pages), 0, kWidth), 1.0);
}

TEST(ViewPages, of_the_scene_are_the_renderers) {
  const State state = with_pages();
  const Image image = picture(state);
  render::Renderer renderer(stage().loaded().scene);
  const Light light = light_of(state.light, stage().loaded().scene.bounds_world);
  const Camera camera = eye_camera(state, stage().loaded().path, {}, kWidth, kHeight);
  const SceneBounds bounds = stage().loaded().boxes.bounds();
  const auto seen =
      std::make_shared<const VisibleSurfaces>(draw_surfaces(renderer, camera, render::DepthLayer::front));
  FramePages pages({light, bounds, page_options_of(state.a.pages, plan_options_of(state.a))}, seen);
  render::FrameOptions frame;
  frame.light = &light;
  (void)pages.draw(renderer, camera, renderer.prepare(state.a.filter, render::Source::pages), frame);
  EXPECT_EQ(share_equal(image, renderer.image(), 0, kWidth), 1.0);
}

TEST(ViewPages, are_kept_while_the_camera_moves_over_a_stable_grid) {
  State state = with_pages(page_policies::clipmap);
  state.view = View::kept;
  forget_pages();
  const Image first = picture(state);
  EXPECT_EQ(drawn_pages(), side().pages->plan().pages.size());
  const Image again = picture(state);
  EXPECT_EQ(drawn_pages(), 0u) << "nothing moved";
  EXPECT_EQ(side().stats.pages_drawn, 0);
  EXPECT_LT(share_equal(first, again, 0, kWidth), 0.92) << "orange and blue, beside sky and legend";
  const auto orange = [](const Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) count += image.rgba[i] > image.rgba[i + 2] + 40;
    return count;
  };
  EXPECT_GT(orange(first), 1000);
  EXPECT_LT(orange(again), 200) << "the legend's field";
  state.eye = CameraKey{stage().camera().position, stage().camera().position + stage().camera().forward};
  state.eye->position += 0.3 * stage().camera().forward;
  state.eye->target += 0.3 * stage().camera().forward;
  (void)picture(state);
  EXPECT_GT(drawn_pages(), 0u);
  EXPECT_LT(drawn_pages(), side().pages->plan().pages.size() / 2);
  EXPECT_EQ(side().stats.pages_drawn, static_cast<int>(drawn_pages()));
}

TEST(ViewPages, that_read_the_picture_are_refined_once_it_is_settled) {
  for (const PagePolicy* policy : {&page_policies::edges, &page_policies::queried}) {
    const State state = with_pages(*policy);
    forget_pages();
    const Image settled = picture(state);
    const std::size_t pages = side().pages->plan().pages.size();
    forget_pages();
    EXPECT_EQ(stage().draw(state, kWidth, kHeight, false), "");
    EXPECT_TRUE(stage().unfinished()) << policy->name;
    EXPECT_NE(side().pages->plan().pages.size(), pages) << policy->name;
    // The way there makes no difference.
    EXPECT_EQ(share_equal(settled, picture(state), 0, kWidth), 1.0) << policy->name;
    EXPECT_EQ(side().pages->plan().pages.size(), pages) << policy->name;
  }
}

TEST(ViewPages, are_kept_while_a_turning_sun_is_held) {
  State state = with_pages();
  state.a.plan.fit = Fit::stable;
  state.motion.hold_sun_pixels = 0.5;
  stage().cut();
  ASSERT_EQ(stage().draw(state, kWidth, kHeight, false), "");
  const glm::dvec3 held = std::get<DirectionalLight>(stage().light()).direction;
  state.light.sun.azimuth_deg += 1e-3;
  ASSERT_EQ(stage().draw(state, kWidth, kHeight, false), "");
  EXPECT_EQ(drawn_pages(), 0u);
  EXPECT_EQ(std::get<DirectionalLight>(stage().light()).direction, held);
  state.light.sun.azimuth_deg += 5.0;
  ASSERT_EQ(stage().draw(state, kWidth, kHeight, false), "");
  EXPECT_EQ(drawn_pages(), side().pages->plan().pages.size()) << "so far it is not held";
  EXPECT_NE(std::get<DirectionalLight>(stage().light()).direction, held);
  state.motion.hold_sun_pixels = 0.0;
  state.light.sun.azimuth_deg += 1e-3;
  ASSERT_EQ(stage().draw(state, kWidth, kHeight, false), "");
  EXPECT_EQ(drawn_pages(), side().pages->plan().pages.size());
}

TEST(ViewPages, that_no_filter_or_pool_serves_leave_the_last_picture) {
  const Image good = picture(with_pages());
  const auto refused = [&](auto&& change, const std::string& why) {
    State bad = with_pages();
    change(bad);
    EXPECT_EQ(stage().draw(bad, kWidth, kHeight, true), why);
    EXPECT_EQ(share_equal(stage().canvas().image(), good, 0, kWidth), 1.0) << why;
    EXPECT_TRUE(side().pages) << why;
  };
  refused([](State& s) { s.a.filter = render::parse_filter("savsm").settings; },
          "no pages with savsm: sums up the texels of whole maps, which no page holds");
  refused([](State& s) { s.a.filter = render::parse_filter("pcf:radius=0.1,unit=world").settings; },
          "no pages with pcf:radius=0.1,unit=world: kernel in world units, which no page border holds");
  refused([](State& s) { s.a.pages.capacity = 3; }, "page_capacity 3: this light needs at least 4 pages");
  refused(
      [](State& s) {
        s.a.pages.capacity = 23;
        s.light.sun.kind = LightKind::point;
      },
      "page_capacity 23: this light needs at least 24 pages");
  EXPECT_EQ(share_equal(picture(with_pages()), good, 0, kWidth), 1.0);
}

TEST(ViewPages, under_a_small_pool_coarsen) {
  State state = with_pages();
  (void)picture(state);
  const std::size_t pages = side().pages->plan().pages.size();
  const double p95 = side().m.p95;
  state.a.pages.capacity = static_cast<int>(pages) / 3;
  (void)picture(state);
  EXPECT_LE(side().pages->plan().pages.size(), pages / 3);
  EXPECT_GT(side().m.p95, p95);
  EXPECT_FALSE(side().omitted().empty());
}

TEST(ViewPages, are_named_by_the_probe_with_the_m_of_the_heat_map) {
  const State state = with_pages();
  (void)picture(state);
  stage().finish_truth();
  ASSERT_NE(stage().tracer(), nullptr);
  const PagePlan& plan = *side().page_plan();
  const Camera& camera = stage().camera();
  render::Renderer renderer(stage().loaded().scene);
  render::FrameOptions frame;
  frame.light = &stage().light();
  renderer.draw(plan, camera, renderer.prepare(state.a.filter, render::Source::pages), frame);
  const PageFrameImages images{renderer.mask(), renderer.positions(), renderer.normals()};
  const std::vector<float> m = page_aliasing(plan, camera, images);
  int compared = 0, equal = 0;
  for (int y = kHeight / 2; y < kHeight; y += 3) {
    for (int x = 1; x < kWidth; x += 3) {
      const Probed probed =
          probe(*stage().tracer(), side().drawn, camera, stage().light(), x + 0.5, y + 0.5, &plan);
      const auto pixel = static_cast<std::size_t>(y * kWidth + x);
      if (!probed.hit || probed.map < 0 || !(m[pixel] > 0.0f)) continue;
      ASSERT_TRUE(probed.page);
      ++compared;
      const bool same_page = probed.map == static_cast<int>(images.mask.values[2 * pixel + 1]);
      equal += same_page && std::abs(probed.aliasing.m_max / static_cast<double>(m[pixel]) - 1.0) < 0.01;
      const Page& page = plan.pages[static_cast<std::size_t>(probed.map)];
      EXPECT_EQ(probed.page->level, page.level);
      EXPECT_EQ(static_cast<int>(probed.texel.x) / 64, page.column);
      EXPECT_EQ(static_cast<int>(probed.texel.y) / 64, page.row);
      EXPECT_EQ(probed.footprint.size(), 4u);
    }
  }
  EXPECT_GT(compared, 300);
  // Edges within a pixel aside.
  EXPECT_GT(equal, compared * 9 / 10);
}

TEST(ViewPages, of_a_frozen_plan_stay_while_the_eye_moves) {
  State state = with_pages();
  state.view = View::mask;
  state.drawn = {false, false, false, false};
  const Image before = picture(state);
  const std::vector<Page> pages(side().pages->plan().pages.begin(), side().pages->plan().pages.end());
  state.eye = state.frozen =
      CameraKey{stage().camera().position, stage().camera().position + stage().camera().forward};
  EXPECT_GT(share_equal(picture(state), before, 0, kWidth), 0.99);
  state.eye->position += glm::dvec3(4.0, 3.0, 5.0);
  const Image bare = picture(state);
  ASSERT_EQ(side().pages->plan().pages.size(), pages.size());
  for (std::size_t i = 0; i < pages.size(); ++i)
    EXPECT_EQ(side().pages->plan().pages[i].column, pages[i].column);
  EXPECT_EQ(side().pages->plan().origin_world, stage().camera().position);
  for (const Drawn& drawn : {Drawn{true, false, false, false}, Drawn{false, false, true, false},
                             Drawn{false, false, false, false, true}}) {
    state.drawn = drawn;
    EXPECT_LT(share_equal(picture(state), bare, 0, kWidth), 1.0);
  }
}

TEST(ViewPages, beside_maps_are_compared_under_the_wipe) {
  State both = with_pages();
  both.b = hangar().a;
  both.comparison = Comparison::wipe;
  (void)picture(both);
  EXPECT_TRUE(stage().side(0).pages);
  EXPECT_FALSE(stage().side(1).pages);
  EXPECT_GT(stage().side(1).plan.map_count, 0);
}

TEST(ViewPages, leave_nothing_behind_when_they_go) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer finds leaks by itself";
#endif
  const auto switch_to = [](int i) {
    State state = with_pages(*all_page_policies()[static_cast<std::size_t>(i) % all_page_policies().size()]);
    if (i % 2 == 0) state.a.pages.policy = nullptr;
    state.view = i % 3 == 0 ? View::map : View::kept;
    state.comparison = static_cast<Comparison>(i % 3);
    state.a.plan.resolution.max_size = state.b.plan.resolution.max_size = 64;
    EXPECT_EQ(stage().draw(state, 64, 36, i % 2 == 0), "");
  };
  // In use, not held back by the allocator; the driver frees pools some frames late.
  const auto least_in_use = [&switch_to] {
    constexpr int kPeriod = 30, kPeriods = 3;
    std::size_t least = ~std::size_t{0};
    for (int i = 0; i < kPeriods * kPeriod; ++i) {
      switch_to(i);
      const struct mallinfo2 info = mallinfo2();
      least = std::min(least, info.uordblks + info.hblkhd);
    }
    return least;
  };
  (void)least_in_use();
  const std::size_t before = least_in_use();
  // The pages of one frame take 1 MB, and 90 frames lie between.
  constexpr std::size_t kRoom = 5'000'000;
  EXPECT_LT(least_in_use(), before + kRoom);
}

TEST(ViewPages, colours_of_levels_rise_in_brightness) {
  const auto brightness = [](const render::Color& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  for (std::size_t level = 1; level < 20; ++level)
    EXPECT_GT(brightness(level_color(level, 20)), brightness(level_color(level - 1, 20))) << level;
  EXPECT_EQ(level_color(0, 1), level_color(19, 20)) << "one level is the finest";
}

}  // namespace
}  // namespace gnomon::tool::view
