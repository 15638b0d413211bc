// What does each source of shadows honour, and does a frame report the rest?
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/render/renderer.hpp"
#include "gnomon/study/bias.hpp"
#include "shared_context.hpp"
#include "test_scene.hpp"

namespace gnomon::render {
namespace {

constexpr int kSide = 32;
const DirectionalLight kSun{{0.4, -1.0, -0.3}};
const SpotLight kWideSpot{{0, 9, 0}, {0, -1, 0.1}, 1.35, 40.0};

/// Asks for nothing.
FrameOptions nothing() {
  FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  options.prune = kPruneNothing;
  return options;
}

struct Asked {
  FrameOption option;
  std::function<void(FrameOptions&)> ask;
};

const Light kShown = kWideSpot;
const Box kMoved{{-1.0, 0.0, -1.0}, {1.0, 1.0, 1.0}};

Asked by_rule(FrameOption option, PruneRule rule) {
  return {option, [rule](FrameOptions& o) { o.prune = o.prune.with(rule); }};
}

/// All that FrameOptions can ask for.
std::vector<Asked> options_to_ask() {
  return {
      {FrameOption::transition, [](FrameOptions& o) { o.transition = SplitTransition::dither; }},
      {FrameOption::noise, [](FrameOptions& o) { o.noise = SampleNoise::blue; }},
      {FrameOption::accumulation, [](FrameOptions& o) { o.accumulation.on = true; }},
      {FrameOption::depth_layer, [](FrameOptions& o) { o.depth_layer = DepthLayer::second; }},
      {FrameOption::linear_depth, [](FrameOptions& o) { o.linear_depth = true; }},
      {FrameOption::map_passes, [](FrameOptions& o) { o.map_passes = MapPasses::each; }},
      {FrameOption::receiver_plane, [](FrameOptions& o) { o.receiver_plane = false; }},
      {FrameOption::light, [](FrameOptions& o) { o.light = &kShown; }},
      {FrameOption::aliasing, [](FrameOptions& o) { o.aliasing = true; }},
      {FrameOption::cascade_tint, [](FrameOptions& o) { o.cascade_tint = true; }},
      {FrameOption::light_clusters, [](FrameOptions& o) { o.light_clusters.tile_pixels = 16; }},
      {FrameOption::moved_world,
       [](FrameOptions& o) {
         o.moved_world = {&kMoved, 1};
       }},
      by_rule(FrameOption::small_casters, PruneRule::small_casters),
      by_rule(FrameOption::caster_clusters, PruneRule::caster_clusters),
      by_rule(FrameOption::alpha_test, PruneRule::alpha_test),
      by_rule(FrameOption::held_maps, PruneRule::held_maps),
      by_rule(FrameOption::scrolled_maps, PruneRule::scrolled_maps),
      by_rule(FrameOption::static_casters, PruneRule::static_casters),
      by_rule(FrameOption::unread_tiles, PruneRule::unread_tiles),
  };
}

const SourceSupport& row_of(const std::string& name) {
  for (const SourceSupport& source : source_supports())
    if (source.name == name) return source;
  throw std::runtime_error("no source " + name);
}

/// Small frames of one scene, from each source.
class Support : public ::testing::Test {
 protected:
  Support() {
    static_cast<void>(shared_context());
    PlanOptions options;
    options.resolution.max_size = 64;
    plan_ = make_plan(camera_, kSun, {boxes_, boxes_}, options);
    options.cascades = 1;
    options.warp.shape = &shapes::paraboloid;
    bent_ = make_plan(camera_, kWideSpot, {boxes_, boxes_}, options);
  }

  /// Draws a frame of the source that is named so.
  FrameStats draw(const std::string& source, const FrameOptions& options, FilterSettings filter = kHard) {
    return draw_by(renderer_, source, options, filter);
  }

  FrameStats draw_by(Renderer& renderer, const std::string& source, const FrameOptions& options,
                     FilterSettings filter = kHard) {
    if (source == "pages") return draw_pages(renderer, options, filter);
    if (source == "lights") return draw_lights(renderer, plan_, options, filter);
    const Source by = source == "irregular"     ? Source::irregular()
                      : source == "identifiers" ? Source::identifiers()
                                                : Source::maps;
    const ShadowPlan& plan = source == "bent maps" ? bent_ : plan_;
    const FrameStats stats = renderer.draw(plan, camera_, renderer.prepare(filter, by), options);
    EXPECT_EQ(stats.irregular, source == "irregular");
    EXPECT_EQ(stats.identified, source == "identifiers");
    return stats;
  }

  FrameStats draw_pages(Renderer& renderer, const FrameOptions& options, const FilterSettings& filter) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 256; ++i) points.emplace_back(-4.0 + 0.5 * (i % 16), 0.0, -4.0 + 0.5 * (i / 16));
    std::vector<std::byte> memory(page_memory(1024, 1 << 12));
    PageOptions pages;
    pages.page_texels = 64;
    pages.capacity = 1024;
    pages.target_m = 2.0;
    set_margin(filter, pages.plan);
    const PagePlan plan =
        plan_pages({.camera = camera_, .points_world = points}, kSun, {boxes_, boxes_}, pages, memory);
    const FrameStats stats = renderer.draw(plan, camera_, renderer.prepare(filter, Source::pages), options);
    EXPECT_GT(stats.pages, 0) << static_cast<int>(plan.status);
    return stats;
  }

  FrameStats draw_lights(Renderer& renderer, const ShadowPlan& own, const FrameOptions& options,
                         const FilterSettings& filter) {
    const std::vector<LightRequest> requests{{kSun}};
    std::vector<std::byte> memory(light_memory(requests.size(), 0));
    LightOptions pool;
    pool.pool_width = pool.pool_height = 256;
    const LightPlan plan = plan_lights(camera_, requests, {boxes_, boxes_}, pool, memory);
    const std::vector<DrawnLight> lights{{kSun, &own}};
    return renderer.draw({plan, lights}, camera_, renderer.prepare(filter, Source::lights), options);
  }

  static inline const FilterSettings kHard = default_settings(filters::hard);
  Scene scene_ = box_on_ground();
  std::vector<Box> boxes_ = boxes_of(scene_);
  Camera camera_ = camera_on_box(kSide, kSide);
  ShadowPlan plan_, bent_;
  Renderer renderer_{scene_};
};

TEST_F(Support, a_frame_without_options_ignores_none) {
  ASSERT_FALSE(bent_.map[0].shape->affine);
  for (const SourceSupport& source : source_supports()) {
    SCOPED_TRACE(source.name);
    EXPECT_EQ(to_string(draw(std::string(source.name), nothing()).ignored), "");
  }
}

TEST_F(Support, the_default_frame_of_maps_is_honoured_whole) {
  EXPECT_TRUE(draw("maps", FrameOptions{}).ignored.empty());
}

TEST_F(Support, a_frame_reports_each_option_that_its_source_does_not_honour_and_no_other) {
  for (const SourceSupport& source : source_supports()) {
    for (const Asked& asked : options_to_ask()) {
      FrameOptions options = nothing();
      asked.ask(options);
      const bool honoured = source.supports.has(asked.option);
      EXPECT_EQ(to_string(draw(std::string(source.name), options).ignored),
                honoured ? "" : to_string(asked.option))
          << source.name;
    }
    FrameOptions options = nothing();
    options.aliasing = options.heat_map = true;
    const FrameOptionSet both{FrameOption::aliasing, FrameOption::heat_map};
    EXPECT_EQ(to_string(draw(std::string(source.name), options).ignored),
              to_string(both.without(source.supports)))
        << source.name;
  }
}

TEST_F(Support, panes_are_reported_where_maps_bend_lines) {
  Renderer renderer(scene_);
  Scene panes = empty_scene();
  Material glass;
  glass.transmission = 0.8f;
  add_quad(panes, {-3, 3, 3}, {4, 0, 0}, {0, 0, -6}, add_material(panes, glass));
  renderer.add_panes(panes);
  for (const SourceSupport& source : source_supports()) {
    const bool honoured = source.supports.has(FrameOption::panes);
    EXPECT_EQ(honoured, source.name != "bent maps");
    EXPECT_EQ(to_string(draw_by(renderer, std::string(source.name), nothing()).ignored),
              honoured ? "" : "panes")
        << source.name;
  }
}

TEST_F(Support, contacts_are_reported_where_no_depth_is_compared) {
  const FilterSettings contacts = parse_filter("hard:contacts=1").settings;
  for (const char* source : {"maps", "bent maps", "irregular", "identifiers"}) {
    const bool honoured = row_of(source).supports.has(FrameOption::contacts);
    EXPECT_EQ(to_string(draw(source, nothing(), contacts).ignored), honoured ? "" : "contacts") << source;
  }
  EXPECT_FALSE(row_of("irregular").supports.has(FrameOption::contacts));
  EXPECT_FALSE(row_of("identifiers").supports.has(FrameOption::contacts));
  EXPECT_TRUE(row_of("maps").supports.has(FrameOption::contacts));
}

TEST_F(Support, many_lights_report_maps_that_bend_lines) {
  EXPECT_EQ(to_string(draw_lights(renderer_, bent_, nothing(), kHard).ignored), "bent_maps");
}

TEST_F(Support, a_frame_that_a_source_cannot_draw_reports_what_the_maps_do_not_honour) {
  FrameOptions options = nothing();
  options.depth_layer = DepthLayer::back;
  const FrameStats stats =
      renderer_.draw(bent_, camera_, renderer_.prepare(kHard, Source::identifiers()), options);
  EXPECT_FALSE(stats.identified);
  EXPECT_EQ(to_string(stats.ignored), "depth_layer");
}

TEST(FrameOptionSet, adds_takes_away_and_names_in_order) {
  FrameOptionSet set{FrameOption::panes, FrameOption::noise};
  EXPECT_EQ(to_string(set), "noise, panes");
  set.add(FrameOption::contacts, false);
  EXPECT_FALSE(set.has(FrameOption::contacts));
  EXPECT_EQ(to_string(set.without({FrameOption::noise})), "panes");
  EXPECT_TRUE(set.without(FrameOptionSet::all()).empty());
  EXPECT_EQ(FrameOptionSet::all().without({}), FrameOptionSet::all());
  EXPECT_EQ(to_string(FrameOptionSet{}), "");
}

TEST(SourceTable, is_the_one_of_the_page) {
  std::ifstream file(std::string(GNOMON_SOURCE_DIR) + "/docs/renderer.md");
  std::stringstream page;
  page << file.rdbuf();
  ASSERT_FALSE(page.str().empty());
  EXPECT_NE(page.str().find("\n\n" + source_table() + "\n"), std::string::npos) << source_table();
}

TEST(Sources, take_the_nearest_number_within_bounds) {
  EXPECT_EQ(Source::irregular(0).samples, 1);
  EXPECT_EQ(Source::irregular(1000).samples, kMaxFacetSamples);
  EXPECT_EQ(Source::identifiers({IdentifierOf::instance, -3}).test.neighbours, 0);
  EXPECT_EQ(Source::identifiers({IdentifierOf::triangle, 3}).test.neighbours, 3);
  EXPECT_EQ(Source{}, Source::maps);
  EXPECT_NE(Source::pages, Source::lights);
}

TEST(ShadowsOf, point_to_the_plan_of_their_kind_alone) {
  const ShadowPlan maps;
  const PagePlan pages;
  const LightPlan lights;
  const std::vector<DrawnLight> drawn(3);
  const Shadows of_maps = maps, of_pages = pages, of_lights{lights, drawn};
  EXPECT_EQ(of_maps.maps(), &maps);
  EXPECT_EQ(of_maps.pages(), nullptr);
  EXPECT_EQ(of_maps.light_plan(), nullptr);
  EXPECT_EQ(of_pages.pages(), &pages);
  EXPECT_EQ(of_pages.maps(), nullptr);
  EXPECT_EQ(of_lights.light_plan(), &lights);
  EXPECT_EQ(of_lights.lights().data(), drawn.data());
  EXPECT_EQ(of_lights.lights().size(), 3u);
  EXPECT_TRUE(of_maps.lights().empty());
}

TEST_F(Support, a_plan_of_another_kind_than_the_filters_source_leaves_everything_lit) {
  const PreparedFilter of_maps = renderer_.prepare(parse_filter("pcf:radius=3").settings);
  const auto all_lit = [&] {
    const FloatImage mask = renderer_.mask();
    for (std::size_t i = 0; i < mask.values.size(); i += 2)
      if (mask.values[i] != 1.0f) return false;
    return true;
  };
  renderer_.draw(plan_, camera_, of_maps, nothing());
  EXPECT_FALSE(all_lit());
  renderer_.draw(PagePlan{}, camera_, of_maps, nothing());
  EXPECT_TRUE(all_lit());
  renderer_.draw({LightPlan{}, {}}, camera_, of_maps, nothing());
  EXPECT_TRUE(all_lit());
}

}  // namespace
}  // namespace gnomon::render
