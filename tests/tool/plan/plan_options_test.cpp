// `gnomon plan`: every option and every way to give a camera reaches the plan.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases.hpp"
#include "process.hpp"

namespace gnomon::test {
namespace {

json plan_of(const json& input) {
  const Finished finished = run_gnomon({"plan", "-"}, input.dump());
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  return finished.exit_code == 0 ? json::parse(finished.out) : json{};
}

// Casters over the whole floor, so that no cascade is left out for want of one.
json plan_with_options(const json& options) {
  json input = base_case_with("/options", options);
  input["casters"] = {{"min", {-10, 0, -10}}, {"max", {10, 3, 10}}};
  return plan_of(input);
}

// tan() of degrees turned to radians against a slope written by hand: a few roundings apart.
constexpr double kSlopeTolerance = 1e-12;

void expect_close_maps(const json& a, const json& b) {
  ASSERT_FALSE(a["maps"].empty());
  ASSERT_EQ(a["maps"].size(), b["maps"].size());
  for (std::size_t k = 0; k < a["maps"].size(); ++k) {
    for (std::size_t i = 0; i < 16; ++i) {
      const double value = a["maps"][k]["clip_from_world"][i / 4][i % 4];
      const double other = b["maps"][k]["clip_from_world"][i / 4][i % 4];
      EXPECT_NEAR(value, other, kSlopeTolerance * (1.0 + std::abs(value)));
    }
  }
}

TEST(PlanOptions, absent_options_are_the_defaults) {
  json empty = base_case();
  empty["options"] = json::object();
  EXPECT_EQ(plan_of(base_case()), plan_of(empty));
  EXPECT_EQ(
      plan_with_options(json::object()),
      plan_with_options({{"warp", "auto"}, {"split", "auto"}, {"split_range", "auto"}, {"stable", false}}));
}

TEST(PlanOptions, a_blend_alone_means_the_split_that_blends) {
  EXPECT_EQ(plan_with_options({{"lambda", 0.3}}),
            plan_with_options({{"split", "practical"}, {"lambda", 0.3}}));
  EXPECT_NE(plan_with_options({{"lambda", 0.3}}), plan_with_options(json::object()));
}

TEST(PlanOptions, map_size_and_cascades) {
  const json plan = plan_with_options({{"map_size", 256}, {"cascades", 2}});
  ASSERT_FALSE(plan["maps"].empty());
  EXPECT_LE(plan["maps"].size(), 2u);
  for (const json& map : plan["maps"]) EXPECT_EQ(map["size"], json({256, 256}));
}

TEST(PlanOptions, warp_by_name) {
  const json plain = plan_with_options({{"warp", "none"}, {"cascades", 1}});
  EXPECT_EQ(plain["maps"][0]["warp"], "none");
  EXPECT_EQ(plain["maps"][0]["kappa"].get<double>(), 0.0);
  const json warped = plan_with_options({{"warp", "lispsm04"}, {"cascades", 1}});
  EXPECT_EQ(warped["maps"][0]["warp"], "lispsm04");
}

TEST(PlanOptions, shape_by_name_is_printed_where_it_is_not_linear) {
  const json plain = plan_with_options({{"shape", "linear"}, {"cascades", 1}});
  EXPECT_EQ(plain, plan_with_options({{"cascades", 1}}));
  EXPECT_FALSE(plain["maps"][0].contains("shape"));
  const json bent = plan_with_options({{"shape", "logarithmic"}, {"cascades", 1}});
  EXPECT_EQ(bent["maps"][0]["shape"]["name"], "logarithmic");
  EXPECT_GT(bent["maps"][0]["shape"]["parameters"][0].get<double>(), 0.0);
  EXPECT_EQ(bent["maps"][0]["shape"]["parameters"].size(), 1u);
}

TEST(PlanOptions, stable_maps_carry_a_snap_key_and_tight_ones_do_not) {
  const json stable = plan_with_options({{"stable", true}});
  ASSERT_FALSE(stable["maps"].empty());
  for (const json& map : stable["maps"]) {
    for (const char* key : {"snap_key", "snap_depth"}) {
      ASSERT_EQ(map[key].size(), 2u);
      for (const json& part : map[key]) EXPECT_TRUE(part.is_number_integer());
    }
  }
  EXPECT_TRUE(plan_with_options({{"stable", false}})["maps"][0]["snap_key"].is_null());
}

TEST(PlanOptions, split_lambda_and_near_hint_move_the_borders) {
  const auto first_border = [](const json& options) {
    return plan_with_options(options)["maps"][0]["depth_end"].get<double>();
  };
  const double uniform = first_border({{"split", "uniform"}});
  EXPECT_LT(first_border({{"split", "logarithmic"}}), uniform);
  EXPECT_DOUBLE_EQ(first_border({{"split", "practical"}, {"lambda", 0}}), uniform);
  const json hinted = plan_with_options({{"split", "pseudo_near"}, {"near_hint", 8}});
  EXPECT_NE(hinted, plan_with_options({{"split", "pseudo_near"}}));
  EXPECT_EQ(hinted, plan_with_options({{"split", "pseudo_near"}, {"pseudo_near", 8}}));
}

TEST(PlanOptions, split_range_of_the_camera_begins_at_its_near_plane) {
  const json plan = plan_with_options({{"split_range", "camera"}, {"cascades", 1}});
  EXPECT_EQ(plan["maps"][0]["depth_begin"].get<double>(), 0.5);
  EXPECT_GT(plan_with_options({{"split_range", "receivers"}, {"cascades", 1}})["maps"][0]["depth_begin"]
                .get<double>(),
            0.5);
}

TEST(PlanOptions, filter_radius_widens_the_margin) {
  const json narrow = plan_with_options({{"filter_radius_texels", 0}});
  const json wide = plan_with_options({{"filter_radius_texels", 8}});
  EXPECT_GT(wide["maps"][0]["filter_margin_texels"].get<int>(),
            narrow["maps"][0]["filter_margin_texels"].get<int>());
}

TEST(PlanOptions, bias_scales_with_its_options) {
  const json none = plan_with_options(
      {{"bias", {{"constant_texels", 0}, {"slope_texels", 0}, {"normal_offset_texels", 0}}}});
  for (const char* key : {"constant", "slope", "normal_offset"})
    EXPECT_EQ(none["maps"][0]["bias_world"][key].get<double>(), 0.0) << key;
  EXPECT_GT(plan_with_options({})["maps"][0]["bias_world"]["slope"].get<double>(), 0.0);
}

TEST(PlanOptions, clip_space_changes_rows_of_the_matrix) {
  const json base{{"cascades", 1}, {"warp", "none"}};
  json down = base, zero = base;
  down["clip_space"] = {{"y_down", true}};
  zero["clip_space"] = {{"ndc_depth", "zero_to_one"}, {"reversed_z", true}};
  const json rows = plan_with_options(base)["maps"][0]["clip_from_world"];
  const json rows_down = plan_with_options(down)["maps"][0]["clip_from_world"];
  const json rows_zero = plan_with_options(zero)["maps"][0]["clip_from_world"];
  for (std::size_t column = 0; column < 4; ++column) {
    EXPECT_EQ(rows_down[0][column], rows[0][column]);
    EXPECT_EQ(rows_down[1][column].get<double>(), -rows[1][column].get<double>());
  }
  EXPECT_NE(rows_zero[2], rows[2]);
  EXPECT_EQ(rows_zero[1], rows[1]);
}

TEST(PlanCamera, by_edges_equals_the_one_by_angle) {
  json edges = base_case();
  const double top = std::tan(std::numbers::pi / 6.0);
  edges["camera"].erase("fov_y_deg");
  edges["camera"].erase("aspect");
  edges["camera"].update({{"left", -1.5 * top}, {"right", 1.5 * top}, {"bottom", -top}, {"top", top}});
  expect_close_maps(plan_of(edges), plan_of(base_case()));
}

TEST(PlanCamera, by_height_equals_the_one_by_orthographic_edges) {
  json height = base_case();
  height["camera"].erase("fov_y_deg");
  height["camera"]["height_world"] = 8;
  json edges = height;
  edges["camera"].erase("height_world");
  edges["camera"].erase("aspect");
  edges["camera"].update({{"left", -6}, {"right", 6}, {"bottom", -4}, {"top", 4}, {"orthographic", true}});
  expect_close_maps(plan_of(edges), plan_of(height));
}

TEST(PlanCamera, off_axis_is_not_the_symmetric_one) {
  json edges = base_case();
  edges["camera"].erase("fov_y_deg");
  edges["camera"].erase("aspect");
  edges["camera"].update({{"left", -0.2}, {"right", 0.9}, {"bottom", -0.6}, {"top", 0.4}});
  EXPECT_EQ(plan_of(edges)["status"], "ok");
  EXPECT_NE(plan_of(edges), plan_of(base_case()));
}

}  // namespace
}  // namespace gnomon::test
