// The viewer without its window: the pictures of every view, and what is measured in them.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <string>

#include "framing.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/reference.hpp"
#include "lines.hpp"
#include "pictures.hpp"
#include "probe.hpp"
#include "view_pictures.hpp"

namespace gnomon::tool::view {
namespace {

std::size_t colors_of(const Image& image) {
  std::set<std::array<std::uint8_t, 3>> colors;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    colors.insert({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  return colors.size();
}

TEST(ViewFraming, puts_an_object_in_the_middle_as_large_as_the_picture_holds) {
  const Box crate{{4, 0, -1}, {5, 2, 0}};
  CameraKey eye{{0, 3, 9}, {0, 3, 0}};
  const glm::dvec3 before = glm::normalize(eye.target - eye.position);
  frame(eye, crate, {4.5, 2, -0.5}, 0.5);
  EXPECT_LT(glm::length(eye.target - glm::dvec3(4.5, 1, -0.5)), 1e-12);
  EXPECT_LT(glm::length(glm::normalize(eye.target - eye.position) - before), 1e-12)
      << "the view keeps its direction";
  const double radius = 0.5 * glm::length(crate.max - crate.min);
  const double angle = std::asin(radius / glm::length(eye.target - eye.position));
  EXPECT_LT(angle, 0.5);
  EXPECT_GT(angle, 0.4);
}

TEST(ViewFraming, of_an_orthographic_picture_is_its_height) {
  const Box crate{{4, 0, -1}, {5, 2, 0}};
  const double radius = 0.5 * std::sqrt(6.0);
  EXPECT_NEAR(20.0 * framed_share(crate, 20.0), 1.1 * radius, 1e-12);
  EXPECT_EQ(framed_share(crate, 1.0), 0.5) << "it is larger than the picture";
  EXPECT_EQ(framed_share({{1, 1, 1}, {1, 1, 1}}, 1.0), 0.5);
}

TEST(ViewFraming, comes_half_of_the_way_to_what_surrounds_the_eye_or_is_far_larger) {
  for (const Box& large : {Box{{-50, -50, -50}, {50, 50, 50}}, Box{{100, -1, -900}, {2000, 0, 900}},
                           Box{{0, 0, 0}, {0, 0, 0}}}) {
    CameraKey eye{{0, 2, 10}, {0, 2, 0}};
    frame(eye, large, {0, 0, 4}, 0.5);
    EXPECT_EQ(eye.target, glm::dvec3(0, 0, 4));
    EXPECT_NEAR(glm::length(eye.position - eye.target), 0.5 * std::sqrt(40.0), 1e-12);
  }
}

TEST(ViewPicture, of_every_view_shows_something_else) {
  std::vector<Image> pictures;
  for (int i = 0; i < kViewCount; ++i) {
    State state = hangar();
    state.view = static_cast<View>(i);
    const Image image = picture(state);
    EXPECT_EQ(image.width, kWidth);
    // The truth has three colours, and its sky.
    EXPECT_GE(colors_of(image), 3u) << view_names()[static_cast<std::size_t>(i)].name;
    for (const Image& before : pictures) EXPECT_LT(share_equal(before, image, 0, kWidth), 0.9) << i;
    pictures.push_back(image);
  }
}

TEST(ViewPicture, of_the_scene_is_the_renderers) {
  const State state = hangar();
  const Image image = picture(state);
  render::Renderer renderer(stage().loaded().scene);
  render::FrameOptions frame;
  const Light light = light_of(state.light, stage().loaded().scene.bounds_world);
  frame.light = &light;
  const Camera camera = eye_camera(state, stage().loaded().path, {}, kWidth, kHeight);
  renderer.draw(make_plan(camera, light, stage().loaded().boxes.bounds(), plan_options_of(state.a)), camera,
                renderer.prepare(state.a.filter), frame);
  EXPECT_EQ(share_equal(image, renderer.image(), 0, kWidth), 1.0);
}

TEST(ViewPicture, that_is_orthographic_agrees_with_exact_rays_and_so_does_its_probe) {
  State state = hangar();
  state.height_world = 40.0;
  state.view = View::misclassified;
  state.a.plan.resolution.max_size = 2048;
  state.a.filter = render::parse_filter("hard").settings;
  (void)picture(state);
  const Camera& camera = stage().camera();
  ASSERT_TRUE(camera.orthographic);
  EXPECT_DOUBLE_EQ(camera.top - camera.bottom, 40.0);
  const std::optional<report::MaskErrors> errors = stage().side(0).errors;
  ASSERT_TRUE(errors);
  EXPECT_GT(errors->pixels, 1000u);
  EXPECT_LT(errors->false_lit + errors->false_shadow, 0.05);
  const trace::Tracer* const tracer = stage().tracer();
  ASSERT_NE(tracer, nullptr);
  const Probed left = probe(*tracer, stage().side(0).drawn, camera, stage().light(), 0.0, 60.0),
               right = probe(*tracer, stage().side(0).drawn, camera, stage().light(), kWidth, 60.0);
  ASSERT_TRUE(left.hit && right.hit);
  EXPECT_NEAR(glm::dot(right.point - left.point, camera_axes(camera).right), 40.0 * kWidth / kHeight, 1e-6);
}

TEST(ViewPicture, by_identifiers_is_the_renderers) {
  State state = hangar();
  state.view = View::mask;
  const Image by_filter = picture(state);
  for (const render::IdentifierOf of : {render::IdentifierOf::instance, render::IdentifierOf::triangle}) {
    state.a.identifiers = render::IdentifierTest{of, 1};
    const Image image = picture(state);
    EXPECT_LT(share_equal(image, by_filter, 0, kWidth), 0.99);
    EXPECT_TRUE(stage().side(0).stats.identified);
    render::Renderer renderer(stage().loaded().scene);
    const Camera camera = stage().camera();
    const render::Source by = render::Source::identifiers({of, 1});
    renderer.draw(stage().side(0).plan, camera, renderer.prepare(render::filters::hard, by));
    EXPECT_EQ(share_equal(image, mask_picture(renderer.mask(), renderer.normals()), 0, kWidth), 1.0);
  }
}

TEST(ViewPicture, takes_linear_depths_and_layered_passes) {
  State state = hangar();
  state.light.sun.kind = LightKind::point;
  state.view = View::map;
  const Image divided = picture(state);
  state.a.linear_depth = true;
  EXPECT_LT(share_equal(picture(state), divided, 0, kWidth), 0.92);
  // The depths are the same bits, in whatever passes.
  state.a.linear_depth = false;
  for (const render::MapPasses passes : {render::MapPasses::each, render::MapPasses::layered}) {
    state.a.map_passes = passes;
    EXPECT_EQ(share_equal(picture(state), divided, 0, kWidth), 1.0);
  }
}

TEST(ViewPicture, of_a_wipe_has_a_on_the_left_and_b_on_the_right) {
  State a = hangar(), b = hangar();
  a.view = b.view = View::mask;
  b.a.filter = render::parse_filter("hard").settings;
  b.a.plan.cascades = 1;
  const Image only_a = picture(a), only_b = picture(b);
  State both = a;
  both.b = b.a;
  both.comparison = Comparison::wipe;
  const Image wiped = picture(both);
  const int middle = kWidth / 2;
  // All but the labels and the line itself.
  EXPECT_GT(share_equal(wiped, only_a, 0, middle - 2), 0.6);
  EXPECT_GT(share_equal(wiped, only_b, middle + 2, kWidth), 0.6);
  EXPECT_GT(share_equal(wiped, only_b, middle + 2, kWidth), share_equal(wiped, only_a, middle + 2, kWidth));
  EXPECT_GT(share_equal(wiped, only_a, 0, middle - 2), share_equal(wiped, only_b, 0, middle - 2));
  both.wipe = 1.0;
  EXPECT_GT(share_equal(picture(both), only_a, 0, kWidth), 0.6);
}

TEST(ViewPicture, of_the_difference_is_flat_where_both_are_equal) {
  State state = hangar();
  state.comparison = Comparison::difference;
  const Image equal = picture(state);
  state.b.filter = render::parse_filter("hard").settings;
  const Image apart = picture(state);
  const auto grey = [](const Image& image) {
    const std::size_t last = image.rgba.size() - 4;  // off the label
    std::size_t same = 0;
    for (std::size_t i = image.rgba.size() / 2; i < image.rgba.size(); i += 4)
      same += std::equal(&image.rgba[i], &image.rgba[i] + 3, &image.rgba[last]) ? 1 : 0;
    return static_cast<double>(same) / static_cast<double>(image.rgba.size() / 8);
  };
  EXPECT_EQ(grey(equal), 1.0);
  EXPECT_LT(grey(apart), 0.99);
  EXPECT_GT(grey(apart), 0.2);
}

TEST(ViewPicture, with_a_frozen_plan_keeps_its_maps_while_the_eye_moves) {
  State state = hangar();
  state.view = View::mask;
  state.drawn = {false, false, false, false};
  const Image before = picture(state);
  const ShadowPlan plan = stage().side(0).plan;
  const CameraKey eye{stage().camera().position, stage().camera().position + stage().camera().forward};
  state.eye = state.frozen = eye;
  // The same eye: what the plan served it serves now, but for pixels at the maps' borders and splits.
  EXPECT_GT(share_equal(picture(state), before, 0, kWidth), 0.98);
  state.eye->position += glm::dvec3(4.0, 3.0, 5.0);
  (void)picture(state);
  ASSERT_EQ(stage().side(0).plan.map_count, plan.map_count);
  for (std::size_t i = 0; i < plan.maps().size(); ++i)
    EXPECT_EQ(stage().side(0).plan.map[i].clip_from_world, plan.map[i].clip_from_world);
  const Image bare = stage().canvas().image();
  for (int lines = 0; lines < 5; ++lines) {
    state.drawn = {lines == 0, lines == 1, lines == 2, lines == 3, lines == 4};
    EXPECT_LT(share_equal(picture(state), bare, 0, kWidth), 1.0) << lines;
  }
}

TEST(ViewPicture, stays_as_it_was_where_the_state_is_refused) {
  State state = hangar();
  const Image good = picture(state);
  const auto refused = [&](auto&& change, const std::string& key) {
    State bad = hangar();
    change(bad);
    EXPECT_NE(stage().draw(bad, kWidth, kHeight, true).find(key), std::string::npos) << key;
    EXPECT_EQ(share_equal(stage().canvas().image(), good, 0, kWidth), 1.0) << key;
  };
  refused([](State& s) { s.a.plan.cascades = 0; }, "cascades");
  refused([](State& s) { s.a.plan.resolution.max_size = 1; }, "map_size");
  refused([](State& s) { s.a.plan.cadence.largest_step = -1.0; }, "cadence_step");
  refused(
      [](State& s) {
        s.a.pages.policy = &page_policies::resolution;
        s.a.identifiers = render::IdentifierTest{};
      },
      "identifiers");
  refused(
      [](State& s) {
        s.a.pages.policy = &page_policies::resolution;
        s.a.linear_depth = true;
      },
      "linear_depth");
  refused(
      [](State& s) {
        s.light.sun.kind = LightKind::point;
        s.light.point = PointLight{{0, 1, 0}, -1.0};
      },
      "light.range");
  EXPECT_EQ(share_equal(picture(state), good, 0, kWidth), 1.0);
}

TEST(ViewTruth, counts_what_the_reference_counts) {
  State state = hangar();
  state.view = View::misclassified;
  (void)picture(state);
  ASSERT_TRUE(stage().side(0).errors);
  const report::MaskErrors counted = *stage().side(0).errors;
  EXPECT_GT(counted.pixels, 1000u);
  EXPECT_GT(counted.false_lit + counted.false_shadow, 0.0);
  render::Renderer renderer(stage().loaded().scene);
  const Side& side = stage().side(0);
  renderer.draw(side.plan, stage().camera(), renderer.prepare(state.a.filter));
  const trace::Tracer tracer(stage().loaded().scene);
  const trace::HardReference exact =
      trace::hard_reference(tracer,
                            trace::surface_points(tracer, stage().camera(), stage().light(),
                                                  renderer.positions(), renderer.normals()),
                            stage().light());
  const report::MaskErrors expected = errors_of(renderer.mask(), exact.pixels);
  EXPECT_EQ(counted.false_lit, expected.false_lit);
  EXPECT_EQ(counted.false_shadow, expected.false_shadow);
  EXPECT_EQ(counted.pixels, expected.pixels);
}

TEST(ViewTruth, counts_acne_below_one_half_within_exact_light_alone) {
  // A frame that rays find lit but for its last column, and a mask that is a fifth too dark in one pixel of
  // each.
  constexpr int kSide = 9, kMiddle = 4 * kSide + 4, kBesideShadow = 4 * kSide + 7;
  std::vector<trace::Verdict> verdicts(kSide * kSide, trace::Verdict::lit);
  FloatImage mask{kSide, kSide, 2, std::vector<float>(2 * kSide * kSide, 1.0f), {}};
  for (std::size_t y = 0; y < kSide; ++y) {
    verdicts[y * kSide + kSide - 1] = trace::Verdict::shadow;
    mask.values[2 * (y * kSide + kSide - 1)] = 0.0f;
  }
  for (const int pixel : {kMiddle, kBesideShadow}) mask.values[2 * static_cast<std::size_t>(pixel)] = 0.8f;
  const report::MaskErrors errors = errors_of(mask, verdicts);
  EXPECT_EQ(errors.pixels, 81u);
  EXPECT_EQ(errors.false_lit + errors.false_shadow, 0.0);
  EXPECT_DOUBLE_EQ(errors.too_dark, 1.0 / 81.0);
}

TEST(ViewTruth, is_of_one_light_alone) {
  const SpotLight spot{{1, 9, 2}, {0.1, -1, 0.2}, 0.7, 55.5};
  const PointLight point{{1, 9, 2}, 55.5};
  std::vector<SpotLight> spots(5, spot);
  spots[1].position.x = 2;
  spots[2].direction.z = 0.3;
  spots[3].outer_radians = 0.8;
  spots[4].range = 44;
  std::set<std::string> texts{light_text(point), light_text(PointLight{{1, 9, 2}, 44}),
                              light_text(PointLight{{1, 8, 2}, 55.5}),
                              light_text(DirectionalLight{{0.1, -1, 0.2}})};
  for (const SpotLight& other : spots) texts.insert(light_text(other));
  EXPECT_EQ(texts.size(), 4u + spots.size());
}

TEST(ViewProbe, finds_the_shadow_of_a_local_light_that_the_maps_have) {
  State state = hangar();
  state.light.sun.kind = LightKind::point;
  state.a.plan.resolution.max_size = 1024;
  state.a.filter = render::default_settings(render::filters::hard);
  (void)picture(state);
  stage().finish_truth();
  const Side& side = stage().side(0);
  render::Renderer renderer(stage().loaded().scene);
  renderer.draw(side.plan, stage().camera(), renderer.prepare(state.a.filter));
  const FloatImage mask = renderer.mask();
  int facing = 0, lit = 0, equal = 0;
  for (int y = 1; y < kHeight; y += 4) {
    for (int x = 1; x < kWidth; x += 4) {
      const Probed probed =
          probe(*stage().tracer(), side.plan, stage().camera(), stage().light(), x + 0.5, y + 0.5);
      if (!probed.hit || probed.turned_away || probed.map < 0) continue;
      const bool shadow = mask.values[2 * static_cast<std::size_t>(y * kWidth + x)] < 0.5f;
      ++facing;
      lit += shadow ? 0 : 1;
      equal += shadow == probed.shadow ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 50);
  EXPECT_GT(facing - lit, 20);
  EXPECT_GT(equal, facing * 9 / 10);  // edges aside
}

TEST(ViewProbe, reports_the_m_of_the_heat_map) {
  State state = hangar();
  (void)picture(state);
  stage().finish_truth();
  ASSERT_NE(stage().tracer(), nullptr);
  render::Renderer renderer(stage().loaded().scene);
  const Side& side = stage().side(0);
  const Camera& camera = stage().camera();
  renderer.draw(side.plan, camera, renderer.prepare(state.a.filter));
  const FloatImage aliasing = renderer.aliasing();
  int compared = 0, equal = 0;
  for (int y = kHeight / 2; y < kHeight; y += 3) {
    for (int x = 1; x < kWidth; x += 3) {
      const Probed probed = probe(*stage().tracer(), side.plan, camera, stage().light(), x + 0.5, y + 0.5);
      const float* pixel = &aliasing.values[4 * static_cast<std::size_t>(y * kWidth + x)];
      if (!probed.hit || probed.map < 0 || probed.aliasing.status != PointAliasing::Status::ok ||
          pixel[0] <= 0.0f)
        continue;
      ++compared;
      equal += std::abs(probed.aliasing.m_max / static_cast<double>(pixel[0]) - 1.0) < 0.01 &&
                       probed.map == static_cast<int>(pixel[3])
                   ? 1
                   : 0;
      EXPECT_EQ(probed.footprint.size(), 4u);
    }
  }
  EXPECT_GT(compared, 300);
  // Edges within a pixel aside.
  EXPECT_GT(equal, compared * 9 / 10);
  Camera up = camera;
  up.position = {0.0, 1000.0, 0.0};
  up.forward = {0.0, 1.0, 0.0};
  EXPECT_FALSE(probe(*stage().tracer(), side.plan, up, stage().light(), kWidth / 2.0, kHeight / 2.0).hit);
}

TEST(ViewLines, of_culling_lie_in_the_scene_and_on_the_inner_side_of_every_plane) {
  const State state = hangar();
  ASSERT_EQ(stage().draw(state, kWidth, kHeight, true), "");
  const Box& scene = stage().loaded().scene.bounds_world;
  const double size = glm::length(scene.max - scene.min);
  std::size_t cut = 0;
  for (const ShadowMap& map : stage().side(0).plan.maps()) {
    const std::vector<WorldLine> lines = culling_lines(map, scene, {255, 0, 0, 255});
    ASSERT_GE(lines.size(), 6u);
    for (const WorldLine& line : lines) {
      for (const glm::dvec3& end : {line.from, line.to}) {
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_GE(end[axis], scene.min[axis] - 1e-9 * size);
          EXPECT_LE(end[axis], scene.max[axis] + 1e-9 * size);
        }
        for (int i = 0; i < map.cull_plane_count; ++i) {
          const double inside = glm::dot(map.cull_planes[static_cast<std::size_t>(i)], glm::dvec4(end, 1.0));
          EXPECT_GE(inside, -1e-9 * size);
          cut += inside < 1e-9 * size ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(cut, 10u) << "edges on the planes themselves";
}

TEST(ViewLines, behind_the_eye_are_cut) {
  const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 2.0, 0.1, 100.0, 200, 100);
  EXPECT_TRUE(on_screen({{{0, 0, 5}, {1, 0, 5}, {}, 1.0}}, camera).empty());
  const auto through =
      on_screen({{{0, 0, 5}, {0, 0, -5}, {}, 1.0}, {{-1000, 0, -5}, {1000, 0, -5}, {}, 1.0}}, camera);
  ASSERT_EQ(through.size(), 2u);
  for (const ScreenLine& line : through) {
    for (const glm::dvec2& end : {line.from, line.to}) {
      EXPECT_NEAR(end.y, 50.0, 1e-9);
      EXPECT_GE(end.x, -30.0);
      EXPECT_LE(end.x, 230.0);
    }
  }
}

std::size_t resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  std::size_t size = 0, resident = 0;
  statm >> size >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

TEST(ViewMemory, is_steady_over_five_hundred_switches) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer keeps freed memory back, and finds leaks by itself";
#endif
  const std::array filters{"hard", "pcf:radius=2", "vsm", "esm", "msm"};
  const auto switch_to = [&](int i) {
    State state = hangar();
    state.a.filter = render::parse_filter(filters[static_cast<std::size_t>(i) % filters.size()]).settings;
    state.view =
        static_cast<View>(i % 7);  // all but the exact shadow, whose threads have stacks of their own
    if (state.view == View::misclassified) state.view = View::lit;
    state.a.plan.cascades = 1 + i % 3;
    state.comparison = static_cast<Comparison>(i % 3);
    state.a.plan.resolution.max_size = state.b.plan.resolution.max_size = 64;
    EXPECT_EQ(stage().draw(state, 64, 36, false), "");
  };
  constexpr int kWarm = 70, kSwitches = 500;
  for (int i = 0; i < kWarm; ++i) switch_to(i);
  const std::size_t before = resident_bytes();
  for (int i = 0; i < kSwitches; ++i) switch_to(i);
  // The allocator's own movement; a leak of one 64 x 36 picture each time would be 4.6 MB.
  constexpr std::size_t kRoom = 3'000'000;
  EXPECT_LT(resident_bytes(), before + kRoom);
}

/// Mean of all channels, 0..255.
double brightness_of(const Image& image) {
  double sum = 0.0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    sum += image.rgba[i] + image.rgba[i + 1] + image.rgba[i + 2];
  return sum / (0.75 * static_cast<double>(image.rgba.size()));
}

TEST(ViewLight, that_reaches_nothing_lights_nothing_and_one_without_range_all) {
  State state = hangar();
  state.light.sun.kind = LightKind::point;
  const Box& scene = stage().loaded().scene.bounds_world;
  const glm::dvec3 over = 0.5 * (scene.min + scene.max) + glm::dvec3(0.0, 3.0 * scene.max.y, 0.0);
  state.light.point = PointLight{over, 1.0};
  const double dark = brightness_of(picture(state));
  state.light.point->range = 0.0;
  EXPECT_GT(brightness_of(picture(state)), 1.5 * dark);
  EXPECT_EQ(std::get<PointLight>(stage().light()).range, covering_range(over, scene));
  state.light.sun.kind = LightKind::spot;
  state.light.spot = SpotLight{over, {0.0, 1.0, 0.0}, 0.5, 1e3};
  EXPECT_NEAR(brightness_of(picture(state)), dark, 1.0) << "it looks away";
}

}  // namespace
}  // namespace gnomon::tool::view
