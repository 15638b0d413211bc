// Does a march through what the camera sees close the contacts that filters leave lit, and nothing else?
#include "gnomon/render/contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gnomon/render/error.hpp"
#include "gnomon/render/page_filter.hpp"
#include "mask_frame.hpp"
#include "shared_context.hpp"

namespace gnomon::render {
namespace {

TEST(Contacts, light_fades_behind_a_caster_over_the_filters_own_length) {
  const MapDepths depths{50.0, 0.1};
  // ESM's visibility is exp(-c d): a twentieth at ln(20) / c.
  EXPECT_NEAR(contact_reach_world(parse_filter("esm:c=100,falloff_kernel=0").settings, depths),
              50.0 * std::log(20.0) / 100.0, 0.02);
  EXPECT_NEAR(contact_reach_world(parse_filter("esm:falloff_world=3").settings, depths), 3.0, 0.04);
  for (const Filter* filter : all_filters()) {
    const double reach = contact_reach_world(default_settings(*filter), depths);
    EXPECT_TRUE(reach >= 0.0 && reach <= 25.0) << filter->info.name << " " << reach;
    if (filter->info.channels == nullptr) {
      EXPECT_EQ(reach, 0.0) << filter->info.name;
    }
  }
}

TEST(Contacts, of_a_map_of_unknown_depths_are_those_of_the_bias) {
  for (const double range : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(contact_reach_world(default_settings(filters::esm), {range, 0.1}), 0.0);
}

const glm::vec3 kWallMin{-1.5f, 0.0f, -0.02f}, kWallMax{1.0f, 2.5f, 0.0f};
/// A bar that hangs in front of ground far behind it.
const glm::vec3 kBarMin{-4.0f, 1.5f, 3.0f}, kBarMax{4.0f, 1.6f, 3.1f};
/// From behind the wall, towards the camera.
const glm::dvec3 kLight = glm::normalize(glm::dvec3(0.3, -1.0, 0.8));

/// A thin wall on the ground: the camera sees its dark side, and its shadow.
class Wall {
 public:
  explicit Wall(const char* filter, int map_size = 512)
      : scene_(wall_on_ground()), renderer_(scene_), filter_(parse_filter(filter).settings) {
    options_.resolution.max_size = map_size;
    options_.cascades = 1;
    options_.warp.warp = &warps::none;
    set_margin(filter_, options_);
  }
  [[nodiscard]] Frame frame(bool contacts) {
    const Camera camera = camera_on_box(kSize, kSize);
    filter_.contacts = contacts;
    return draw(renderer_, camera, plan_for(scene_, camera, kLight, options_), filter_);
  }

 private:
  static Scene wall_on_ground() {
    Scene scene = empty_scene();
    add_quad(scene, {-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
    add_box(scene, kWallMin, kWallMax);
    add_box(scene, kBarMin, kBarMax);
    return scene;
  }
  Scene scene_;
  Renderer renderer_;
  FilterSettings filter_;
  PlanOptions options_;
};

/// Pixels of the ground by what rays to the light find, away from the shadow's sides and upper end, and from
/// the bar's shadow.
struct Ground {
  int dark = 0, false_light = 0;
  int open = 0, false_shadow = 0;
};
Ground ground_of(const Frame& frame) {
  constexpr double kEdge = 0.3;  // world units
  Ground ground;
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (!frame.surface(i) || std::abs(frame.point(i).y) > 1e-3) continue;
    if (hits_box(frame.point(i), -kLight, glm::dvec3(kBarMin) - kEdge, glm::dvec3(kBarMax) + kEdge)) continue;
    const glm::dvec3 low(kWallMin), high(kWallMax);
    if (hits_box(frame.point(i), -kLight, low + glm::dvec3(kEdge, 0.0, 0.0),
                 high - glm::dvec3(kEdge, kEdge, 0.0))) {
      ++ground.dark;
      ground.false_light += frame.lit(i) > 0.5f ? 1 : 0;
    } else if (!hits_box(frame.point(i), -kLight, low - kEdge, high + kEdge)) {
      ++ground.open;
      ground.false_shadow += frame.lit(i) < 0.5f ? 1 : 0;
    }
  }
  return ground;
}

TEST(Contacts, that_the_camera_sees_are_closed) {
  Wall wall("esm:falloff_world=4,falloff_kernel=0,c=10000");
  const Ground without = ground_of(wall.frame(false)), with = ground_of(wall.frame(true));
  EXPECT_GT(without.dark, 300);
  EXPECT_GT(without.false_light, 100) << "a fade over four units lights the foot";
  EXPECT_LT(with.false_light, without.false_light / 10);
  EXPECT_GT(with.open, 5000);
  EXPECT_LE(with.false_shadow, 3) << "behind the bar";
}

TEST(Contacts, darken_only_and_leave_every_pixel_its_map) {
  Wall wall("vsm");
  const Frame without = wall.frame(false), with = wall.frame(true);
  int darker = 0;
  for (std::size_t i = 0; i < with.pixels(); ++i) {
    ASSERT_LE(with.lit(i), without.lit(i));
    ASSERT_EQ(with.map(i), without.map(i));
    if (with.surface(i)) darker += with.lit(i) < without.lit(i) ? 1 : 0;
  }
  EXPECT_GT(darker, 0);
}

TEST(Contacts, of_comparisons_are_as_long_as_the_bias) {
  // The offset of so large texels moves receivers past the wall's foot.
  Wall wall("hard", 64);
  const Ground without = ground_of(wall.frame(false)), with = ground_of(wall.frame(true));
  EXPECT_GT(without.false_light, 0);
  EXPECT_LT(with.false_light, without.false_light);
  EXPECT_EQ(with.false_shadow, without.false_shadow);
}

TEST(Contacts, are_refused_where_no_plan_is_drawn_whole) {
  const FilterSettings settings = parse_filter("hard:contacts=1").settings;
  EXPECT_TRUE(settings.contacts);
  EXPECT_EQ(to_string(settings), "hard:contacts=1");
  EXPECT_NE(page_filter_refusal(settings).find("contacts"), std::string_view::npos);
  const Scene scene = box_on_ground();
  Renderer renderer(scene);
  try {
    (void)renderer.prepare(settings, Source::lights);
    FAIL() << "not refused";
  } catch (const RenderError& error) {
    EXPECT_NE(std::string(error.what()).find("contacts"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace gnomon::render
