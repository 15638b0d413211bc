// Parts of a flight, without flying: where its frames stand, and what its sheets show.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "all_lights.hpp"
#include "flight.hpp"
#include "gnomon/render/picture.hpp"
#include "lights_frame.hpp"
#include "report.hpp"

namespace gnomon::tool::fly {
namespace {

std::size_t ink_of(const Image& image, int rows) {
  std::size_t ink = 0;
  const auto end = static_cast<std::size_t>(4 * image.width * std::min(rows, image.height));
  for (std::size_t i = 0; i < end; i += 4) ink += image.rgba[i] > 200 ? 1 : 0;  // light text on dark paper
  return ink;
}

/// Light pixels of a text on one line that is wide enough for it.
std::size_t ink_of_text(const std::string& text, int scale) {
  Image line =
      render::blank_image(render::text_width(text, scale) + 8, render::text_height(scale) + 8, {24, 24, 28});
  render::draw_text(line, 4, 4, text, {240, 240, 236}, scale);
  return ink_of(line, line.height);
}

TEST(ContactSheet, shows_all_of_its_title_however_narrow_it_is) {
  constexpr int kHeight = 40;  // of a picture
  const std::string title =
      "builtin:hangar: 4 maps of 2048, pcf:radius=2,unit=texels,format=fp32, warped_stable";
  for (const int width : {64, 320, 2000}) {
    ContactSheet sheet(1, width, kHeight * width / 64, {"image", "m", "maps"});
    const Image black = render::blank_image(width, kHeight * width / 64, {0, 0, 0});
    sheet.add(0, {&black, &black, &black});
    const Image titled = sheet.sheet(title), plain = sheet.sheet("");
    // Pictures are black: what the title adds is all that its letters have.
    const std::size_t added = ink_of(titled, titled.height) - ink_of(plain, plain.height);
    const bool large = render::text_width(title, 2) < titled.width - 16;
    EXPECT_EQ(added, ink_of_text(title, large ? 2 : 1)) << width;
  }
}

TEST(ContactSheet, shows_the_first_and_the_last_frame_and_as_many_as_fit) {
  for (const int frames : {1, 2, 7, 8, 9, 100}) {
    const ContactSheet sheet(frames, 64, 36, {"image"});
    int columns = 0;
    for (int frame = 0; frame < frames; ++frame) columns += sheet.wants(frame) ? 1 : 0;
    EXPECT_EQ(columns, std::min(frames, 8)) << frames;
    EXPECT_TRUE(sheet.wants(0) && sheet.wants(frames - 1)) << frames;
  }
}

TEST(ContactSheet, has_as_many_rows_as_kinds_of_pictures) {
  const Image black = render::blank_image(64, 36, {0, 0, 0});
  ContactSheet one(1, 64, 36, {"image"}), three(1, 64, 36, {"image", "m", "maps"});
  one.add(0, {&black});
  three.add(0, {&black, &black, &black});
  EXPECT_GT(three.sheet("").height, one.sheet("").height + 2 * 36);
}

// A light that is alone has the texels of all: the maps that --scene-light 0 plans.
TEST(AllLights, of_a_file_with_one_are_planned_as_that_one_is) {
  const Box ground{{-20, -1, -20}, {20, 0, 20}}, crate{{-1, 0, -1}, {1, 3, 1}};
  const std::array<Box, 2> boxes{ground, crate};
  const SceneBounds bounds{boxes, boxes};
  const Camera camera =
      perspective_camera({8, 5, 12}, {-8, -4, -12}, {0, 1, 0}, 1.0, 1.5, 0.1, 60.0, 480, 320);
  for (const int cascades : {1, 3, 4}) {
    PlanOptions options;
    options.cascades = cascades;
    options.resolution.max_size = 512;
    const LightOptions pool = pool_options(options);
    EXPECT_EQ(pool.texel_budget, std::int64_t{cascades} * 512 * 512);
    for (const Light& light : {Light(DirectionalLight{{0.4, -1.0, 0.2}}),
                               Light(SpotLight{{-4, 9, 5}, {0.4, -1, -0.5}, 0.7, 30.0})}) {
      render::LightPool all({{{light}}}, pool);
      ASSERT_EQ(all.plan(camera, bounds).status, PlanStatus::ok);
      const ShadowPlan alone = make_plan(camera, light, bounds, options);
      ASSERT_EQ(all.plans()[0].map_count, alone.map_count);
      ASSERT_GT(alone.map_count, 0);
      for (std::size_t k = 0; k < alone.maps().size(); ++k) {
        EXPECT_EQ(all.plans()[0].map[k].clip_from_world, alone.map[k].clip_from_world) << cascades;
        EXPECT_EQ(all.plans()[0].map[k].width, alone.map[k].width) << cascades;
      }
    }
  }
}

TEST(AllLights, add_up_to_those_of_the_file_whatever_became_of_them) {
  Scene scene;
  scene.lights.resize(kMaxLights + 5);
  scene.lights[0].intensity = 0.0;
  scene.lights[7].color = glm::vec3(0.0f);
  FrameRow row;
  row.lights = LightCounts{0, 0, std::vector<char>(kMaxLights, 0)};
  FrameRow next = row;
  row.lights->in_view.assign(kMaxLights - 2, 1);
  row.lights->in_view.resize(kMaxLights, 0);
  next.lights->in_view[kMaxLights - 1] = 1;  // a later frame shows this one
  const LightsDrawn drawn = AllLights(scene).drawn({row, next});
  EXPECT_EQ(drawn.of_file, kMaxLights + 5);
  EXPECT_EQ(drawn.dark, 2u);
  EXPECT_EQ(drawn.beyond_limit, 3u);
  EXPECT_EQ(drawn.out_of_view, 1u);
  EXPECT_EQ(drawn.drawn, kMaxLights - 1);
  EXPECT_EQ(
      to_string(drawn),
      "4095 of 4101 drawn, 2 without intensity or colour, 1 without a surface in view, 3 beyond the first "
      "4096");
  for (SceneLight& light : scene.lights) light.intensity = 0.0;
  EXPECT_THROW(AllLights{scene}, std::runtime_error);
  EXPECT_THROW(AllLights{Scene()}, std::runtime_error);
}

Flight flight_of(bool closed) {
  Flight flight;
  flight.path.keys = {
      {{1, 0, 0}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, 0}}, {{-1, 0, 0}, {0, 0, 0}}, {{0, 0, -1}, {0, 0, 0}}};
  flight.path.closed = closed;
  return flight;
}

TEST(Flight, over_a_closed_path_draws_no_frame_twice) {
  Options options;
  options.frames = 4;
  const Flight round = flight_of(true);
  for (int a = 0; a < options.frames; ++a) {
    for (int b = 0; b < a; ++b) {
      const glm::dvec3 apart = camera_of(options, round, a).position - camera_of(options, round, b).position;
      EXPECT_GT(std::max({std::abs(apart.x), std::abs(apart.y), std::abs(apart.z)}), 0.5)
          << a << " and " << b;
    }
  }
  // An open path is flown from end to end.
  const Flight straight = flight_of(false);
  EXPECT_NEAR(camera_of(options, straight, 0).position.x, 1.0, 1e-12);
  EXPECT_NEAR(camera_of(options, straight, 3).position.z, -1.0, 1e-12);
}

}  // namespace
}  // namespace gnomon::tool::fly
