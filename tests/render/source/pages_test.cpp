// Are pages drawn and read as one map would be: at their borders, under every filter that reads depths?
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/render/page_filter.hpp"
#include "gnomon/render/renderer.hpp"
#include "mask_frame.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

/// A scene with what its camera sees.
struct Stage {
  Scene scene;
  Camera camera = camera_on_box(kSize, kSize);
  Light light = DirectionalLight{kSlant};
  Renderer renderer{scene};
  std::vector<Box> boxes = boxes_of(scene);
  std::vector<glm::dvec3> points;
  std::vector<std::size_t> pixels;  ///< of the points
  FloatImage normals;
  std::vector<std::byte> memory = std::vector<std::byte>(page_memory(4096, 1 << 17));

  explicit Stage(Scene of = box_on_ground()) : scene(std::move(of)) {
    const Frame frame = render::draw(renderer, camera, ShadowPlan{}, filters::hard);
    normals = frame.normals;
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      if (!frame.surface(i)) continue;
      points.push_back(frame.point(i));
      pixels.push_back(i);
    }
  }
  [[nodiscard]] PagePlan plan(const FilterSettings& filter, PageOptions pages = {},
                              const PlanOptions& options = {}) {
    pages.plan = options;
    set_margin(filter, pages.plan);
    return plan_pages({.camera = camera, .points_world = points}, light, {boxes, boxes}, pages, memory);
  }
  FloatImage mask(const PagePlan& plan, const FilterSettings& filter) {
    FrameOptions options;
    options.time_passes = false;
    renderer.draw(plan, camera, renderer.prepare(filter, Source::pages), options);
    return renderer.mask();
  }
};

FilterSettings settings_of(const char* text) {
  return parse_filter(text).settings;
}

TEST(PagesRender, pages_store_the_layer_of_their_own_two_surfaces) {
  Stage stage;
  stage.scene.materials[0].double_sided = false;
  Renderer renderer(stage.scene);
  const FilterSettings filter = settings_of("hard");
  PageOptions pages;
  pages.policy = &page_policies::queried;
  pages.page_texels = 64;
  const PagePlan plan = stage.plan(filter, pages);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  const auto drawn = [&](DepthLayer layer) {
    FrameOptions options;
    options.time_passes = false;
    options.depth_layer = layer;
    options.map_passes = MapPasses::each;  // as peeled pages are drawn
    // The second frame keeps what the first one drew.
    for (int frame = 0; frame < 2; ++frame)
      renderer.draw(plan, stage.camera, renderer.prepare(filter, Source::pages), options);
    std::vector<float> depths;
    for (std::size_t page = 0; page < plan.pages.size(); ++page) {
      const FloatImage of_page = renderer.page_depths(page);
      depths.insert(depths.end(), of_page.values.begin(), of_page.values.end());
    }
    return depths;
  };
  const std::vector<float> front = drawn(DepthLayer::front), second = drawn(DepthLayer::second),
                           midpoint = drawn(DepthLayer::midpoint), dual = drawn(DepthLayer::dual);
  ASSERT_EQ(front.size(), midpoint.size());
  constexpr double kRounding = 4.0 / 16777216.0;
  std::size_t solid = 0, wrong = 0;
  for (std::size_t i = 0; i < front.size(); ++i) {
    solid += second[i] > front[i];
    // Without a second surface, `second` holds the first.
    const double middle = depth_of_layer(DepthLayer::midpoint, front[i], second[i], 0.0, 0.0);
    wrong += std::abs(midpoint[i] - middle) > kRounding || dual[i] < front[i] - kRounding;
    wrong += second[i] > front[i] && dual[i] > midpoint[i] + kRounding;
  }
  EXPECT_GT(solid, 1000u);
  EXPECT_EQ(wrong, 0u);
}

TEST(PagesRender, pages_have_the_same_bits_whichever_neighbours_are_drawn_with_them) {
  Stage stage;
  const FilterSettings filter = settings_of("pcf:radius=2");
  FrameOptions options;
  options.time_passes = false;
  for (const Light& light : {Light{DirectionalLight{kSlant}}, Light{PointLight{{-4.0, 6.0, 3.0}, 60.0}},
                             Light{SpotLight{{-4.0, 6.0, 3.0}, {0.5, -0.8, -0.3}, 0.9, 60.0}}}) {
    for (const Fit fit : {Fit::tight, Fit::stable}) {
      SCOPED_TRACE(std::string(to_string(fit)) + ", light " + std::to_string(light.index()));
      stage.light = light;
      PageOptions pages;
      pages.page_texels = 64;
      pages.target_m = 2.0;
      PlanOptions of_plan;
      of_plan.fit = fit;
      const PagePlan plan = stage.plan(filter, pages, of_plan);
      ASSERT_EQ(plan.status, PlanStatus::ok);
      ASSERT_GT(plan.pages.size(), 8u);
      Renderer together(stage.scene), alone(stage.scene);
      const FrameStats all =
          together.draw(plan, stage.camera, together.prepare(filter, Source::pages), options);
      EXPECT_EQ(static_cast<std::size_t>(all.pages_drawn), plan.pages.size());
      std::uint64_t triangles = 0;
      for (std::size_t count = 1; count <= plan.pages.size(); ++count) {
        PagePlan first = plan;
        first.pages = plan.pages.first(count);
        const FrameStats one = alone.draw(first, stage.camera, alone.prepare(filter, Source::pages), options);
        ASSERT_EQ(one.pages_drawn, 1);  // the pool keeps the others
        triangles += one.map[0].triangles;
      }
      EXPECT_LT(all.map[0].triangles, triangles);
      std::size_t covered = 0;
      for (std::size_t page = 0; page < plan.pages.size(); ++page) {
        const std::vector<float> depths = together.page_depths(page).values;
        EXPECT_EQ(depths, alone.page_depths(page).values) << "page " << page;
        covered += std::any_of(depths.begin(), depths.end(), [](float depth) { return depth < 1.0f; });
      }
      EXPECT_GT(covered, plan.pages.size() / 2);
    }
  }
}

TEST(PagesRender, pages_of_one_level_are_that_level_drawn_whole) {
  Stage stage;
  for (const char* name : {"hard", "pcf:radius=2", "pcf:radius=5", "pcss:radius=6", "smrt:radius=6"}) {
    SCOPED_TRACE(name);
    const FilterSettings filter = settings_of(name);
    PageOptions pages;
    pages.policy = &page_policies::queried;  // its first frame has one level
    pages.page_texels = 64;
    const PagePlan plan = stage.plan(filter, pages);
    ASSERT_EQ(plan.levels.size(), 1u);
    ASSERT_GT(plan.pages.size(), 100u);
    const FloatImage by_pages = stage.mask(plan, filter);

    ShadowPlan whole = make_plan(stage.camera, stage.light, {stage.boxes, stage.boxes});
    whole.map_count = 1;
    const double begin = whole.map[0].depth_begin;
    whole.map[0] = plan.levels[0];
    whole.map[0].depth_begin = begin;
    whole.map[0].depth_end = stage.camera.far_depth;
    const Frame by_map = render::draw(stage.renderer, stage.camera, whole, filter);
    std::size_t differ = 0, dark = 0;
    for (const std::size_t i : stage.pixels) {
      differ += std::abs(by_pages.values[2 * i] - by_map.lit(i)) > 0.02f;
      dark += by_map.lit(i) < 0.5f;
      EXPECT_GE(by_pages.values[2 * i + 1], 0.0f);
    }
    // Triangles are rasterized relative to their page: samples on an edge fall to either side of it.
    EXPECT_LE(differ, stage.pixels.size() / 500);
    EXPECT_GT(dark, 300u);
  }
}

TEST(PagesRender, the_shader_takes_the_page_that_the_plan_names) {
  Stage stage;
  for (const Light& light : {Light{DirectionalLight{kSlant}}, Light{PointLight{{-4.0, 6.0, 3.0}, 60.0}},
                             Light{SpotLight{{-4.0, 6.0, 3.0}, {0.5, -0.8, -0.3}, 0.9, 60.0}}}) {
    stage.light = light;
    const FilterSettings filter = settings_of("hard");
    const PagePlan plan = stage.plan(filter);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    ASSERT_GT(plan.levels.size(), 1u);
    const FloatImage mask = stage.mask(plan, filter);
    std::size_t differ = 0;
    for (std::size_t k = 0; k < stage.points.size(); ++k)
      differ += static_cast<int>(mask.values[2 * stage.pixels[k] + 1]) != page_serving(plan, stage.points[k]);
    // On the edge of a page its neighbour is as good.
    EXPECT_LE(differ, stage.points.size() / 200);
  }
}

TEST(PagesRender, shadows_are_those_of_the_box_but_for_a_texel) {
  Stage stage;
  for (const char* name : {"hard", "pcf:radius=1"}) {
    SCOPED_TRACE(name);
    const FilterSettings filter = settings_of(name);
    PageOptions pages;
    pages.target_m = 0.5;
    const PagePlan plan = stage.plan(filter, pages);
    const FloatImage mask = stage.mask(plan, filter);
    std::size_t wrong = 0, shadow = 0;
    for (std::size_t k = 0; k < stage.points.size(); ++k) {
      const std::size_t i = stage.pixels[k];
      const glm::dvec3 n{stage.normals.values[4 * i], stage.normals.values[4 * i + 1],
                         stage.normals.values[4 * i + 2]};
      if (glm::dot(n, kSlant) > -0.1) continue;
      const glm::dvec3 from = stage.points[k] + n * 1e-3;
      const bool dark = hits_box(from, -kSlant, glm::dvec3(kBoxMin), glm::dvec3(kBoxMax));
      shadow += dark;
      wrong += dark == (mask.values[2 * i] > 0.5f);
    }
    EXPECT_GT(shadow, 300u);
    EXPECT_LE(wrong, stage.points.size() / 200);
  }
}

TEST(PagesRender, filters_that_want_more_than_a_page_holds_are_refused_by_name) {
  Stage stage;
  for (const char* text : {"savsm", "mssm", "vsm:mipmap=1", "esm:fallback=2", "lvsm:placement=1"}) {
    SCOPED_TRACE(text);
    const ParsedFilter parsed = parse_filter(text);
    ASSERT_EQ(parsed.error, "");
    EXPECT_FALSE(page_filter_refusal(parsed.settings).empty());
    try {
      (void)stage.renderer.prepare(parsed.settings, Source::pages);
      FAIL() << "not refused";
    } catch (const RenderError& error) {
      const std::string name(parsed.settings.filter->info.name);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

/// The plan's one level as the only map.
ShadowPlan whole_level(const Stage& stage, const PagePlan& plan) {
  ShadowPlan whole = make_plan(stage.camera, stage.light, {stage.boxes, stage.boxes});
  whole.map_count = 1;
  const double begin = whole.map[0].depth_begin;
  whole.map[0] = plan.levels[0];
  whole.map[0].depth_begin = begin;
  whole.map[0].depth_end = stage.camera.far_depth;
  return whole;
}

TEST(PagesRender, stored_texels_of_pages_are_those_of_the_level_drawn_whole) {
  Stage stage;
  for (const Filter* filter : all_filters()) {
    if (filter->info.reads != MapRead::filtered && filter->info.reads != MapRead::joined) continue;
    for (const double radius : {0.0, 1.5, 4.0}) {
      // The passes are the same for all filters: one of them tries all radii.
      if (radius != 1.5 && filter != &filters::vsm) continue;
      FilterSettings settings = default_settings(*filter);
      settings.radius = radius;
      settings = settings_for_pages(settings);
      SCOPED_TRACE(to_string(settings));
      ASSERT_EQ(page_filter_refusal(settings), "");
      PageOptions pages;
      pages.policy = &page_policies::queried;  // its first frame has one level
      pages.page_texels = 64;
      pages.target_m = 2.0;
      const PagePlan plan = stage.plan(settings, pages);
      ASSERT_EQ(plan.levels.size(), 1u);
      ASSERT_GT(plan.pages.size(), 20u);
      const FloatImage by_pages = stage.mask(plan, settings);
      const Frame by_map = render::draw(stage.renderer, stage.camera, whole_level(stage, plan), settings);
      std::size_t differ = 0, dark = 0;
      for (const std::size_t i : stage.pixels) {
        differ += std::abs(by_pages.values[2 * i] - by_map.lit(i)) > 0.02f;
        dark += by_map.lit(i) < 0.5f;
      }
      EXPECT_LE(differ, stage.pixels.size() / 500);
      EXPECT_GT(dark, 300u);
    }
  }
}

TEST(PagesRender, a_border_without_room_for_the_blur_leaves_seams) {
  // A border without room for the blur must show: else the test above would prove nothing.
  Stage stage;
  const FilterSettings settings = settings_of("vsm:radius=4");
  PageOptions pages;
  pages.policy = &page_policies::queried;
  pages.page_texels = 64;
  pages.target_m = 2.0;
  pages.plan.filter.texels = 0.0;
  const PagePlan plan = plan_pages({.camera = stage.camera, .points_world = stage.points}, stage.light,
                                   {stage.boxes, stage.boxes}, pages, stage.memory);
  ASSERT_EQ(plan.border_texels, 0);
  const FloatImage by_pages = stage.mask(plan, settings);
  const Frame by_map = render::draw(stage.renderer, stage.camera, whole_level(stage, plan), settings);
  std::size_t differ = 0;
  for (const std::size_t i : stage.pixels) differ += std::abs(by_pages.values[2 * i] - by_map.lit(i)) > 0.02f;
  EXPECT_GT(differ, stage.pixels.size() / 200);
}

TEST(PagesRender, levels_and_faces_with_stored_texels_have_the_box_s_shadow) {
  Stage stage;
  for (const Light& light : {Light{DirectionalLight{kSlant}}, Light{PointLight{{-4.0, 6.0, 3.0}, 60.0}},
                             Light{SpotLight{{-4.0, 6.0, 3.0}, {0.5, -0.8, -0.3}, 0.9, 60.0}}}) {
    stage.light = light;
    for (const char* name : {"vsm", "esm", "evsm4"}) {
      SCOPED_TRACE(name);
      const FilterSettings settings = settings_of(name);
      PageOptions pages;
      pages.page_texels = 64;
      const PagePlan plan = stage.plan(settings, pages);
      ASSERT_EQ(plan.status, PlanStatus::ok);
      ASSERT_GT(plan.levels.size(), 1u);
      const FloatImage stored = stage.mask(plan, settings);
      const FilterSettings compared = settings_of("pcf:radius=1");
      const FloatImage exact = stage.mask(stage.plan(compared, pages), compared);
      std::size_t wrong = 0, dark = 0;
      for (const std::size_t i : stage.pixels) {
        wrong += (stored.values[2 * i] > 0.5f) != (exact.values[2 * i] > 0.5f);
        dark += exact.values[2 * i] < 0.5f;
      }
      EXPECT_GT(dark, 300u);
      EXPECT_LE(wrong, stage.pixels.size() / 40);
    }
  }
}

TEST(PagesRender, exponents_fade_shadows_in_by_the_kernel_however_high_casters_stand) {
  // A box far above the view: stable levels span its depth too.
  Scene scene = box_on_ground();
  Instance high = scene.instances.back();
  const glm::dvec3 up(0.0, 600.0, 0.0);
  high.world_from_object[3] += glm::dvec4(up, 0.0);
  high.bounds_world = {high.bounds_world.min + up, high.bounds_world.max + up};
  scene.instances.push_back(high);
  scene.bounds_world.extend(high.bounds_world);
  Stage stage(std::move(scene));
  const auto leak = [&](const char* text) {
    const FilterSettings settings = settings_of(text);
    PageOptions pages;
    pages.page_texels = 64;
    PlanOptions stable;
    stable.fit = Fit::stable;
    const PagePlan plan = stage.plan(settings, pages, stable);
    EXPECT_EQ(plan.status, PlanStatus::ok);
    const FloatImage mask = stage.mask(plan, settings);
    double lit = 0.0, dark = 0.0;
    for (std::size_t k = 0; k < stage.points.size(); ++k) {
      const std::size_t i = stage.pixels[k];
      const glm::dvec3 n{stage.normals.values[4 * i], stage.normals.values[4 * i + 1],
                         stage.normals.values[4 * i + 2]};
      if (glm::dot(n, kSlant) > -0.1) continue;
      if (!hits_box(stage.points[k] + n * 1e-3, -kSlant, glm::dvec3(kBoxMin), glm::dvec3(kBoxMax))) continue;
      lit += mask.values[2 * i];
      dark += 1.0;
    }
    EXPECT_GT(dark, 300.0);
    return lit / dark;
  };
  // An exponent below the default is taken as it is.
  const double fitted = leak("esm"), limited = leak("esm:c=159");
  EXPECT_LT(fitted, 0.15);
  EXPECT_GT(limited, 2.0 * fitted);
}

TEST(PagesRender, a_plan_without_pages_leaves_everything_lit) {
  Stage stage;
  const FilterSettings filter = settings_of("hard");
  const std::vector<Box> none;
  const PagePlan plan = plan_pages({.camera = stage.camera, .points_world = stage.points}, stage.light,
                                   {none, stage.boxes}, {}, stage.memory);
  ASSERT_EQ(plan.status, PlanStatus::no_caster);
  const FloatImage mask = stage.mask(plan, filter);
  for (const std::size_t i : stage.pixels) EXPECT_EQ(mask.values[2 * i], 1.0f);
}

}  // namespace
}  // namespace gnomon::render
