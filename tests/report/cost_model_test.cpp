// Does the fit find the costs that made the times, and does a model survive its file?
#include "gnomon/report/cost_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "gnomon/report/row.hpp"
#include "rows/cost_model_text.hpp"
#include "sample_rows.hpp"

namespace gnomon::report {
namespace {

/// Times that are exactly those of a model, of techniques that are drawn at random.
std::vector<Observation> made_observations() {
  std::mt19937 random(7);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  std::vector<Observation> all;
  for (int i = 0; i < 60; ++i) {
    Observation o;
    o.view = i % 3 == 0 ? "a" : "b";
    o.filter = i % 2 == 0 ? "hard" : "vsm";
    o.work.maps = 1.0 + i % 4;
    o.work.megatexels = o.work.maps * draw(0.1, 4.0);
    o.work.kilodraws = o.work.maps * draw(0.0, 2.0);
    o.work.megatriangles = o.work.kilodraws * draw(0.01, 0.2);
    o.work.megatexels_tested = i % 5 == 0 ? 0.3 * o.work.megatexels : 0.0;
    o.megapixels = draw(0.05, 0.5);
    o.bytes_per_texel = i % 2 == 0 ? 4.0 : 12.0;
    o.work.megatexels_covered = static_cast<double>(i % 7) / 3.0;
    o.depth_ms = 0.5 + 0.25 * o.work.maps + 3.0 * o.work.megatexels + 1.5 * o.work.kilodraws +
                 40.0 * o.work.megatriangles + 2.0 * o.work.megatexels_covered +
                 9.0 * o.work.megatexels_tested;
    o.prefilter_ms = i % 2 == 0 ? 0.0 : 0.1 * o.work.maps + 7.0 * o.work.megatexels;
    o.lookup_ms = (i % 2 == 0 ? 20.0 : 50.0) * o.megapixels;
    o.expected = draw(0.003, 0.1);
    // Leaks multiply the errors of one view as they divide those of the other.
    const double view = o.view == "a" ? 0.5 : 2.0;
    o.compares = i % 2 == 0;
    o.wrong = view * (o.compares ? 1.25 * std::pow(o.expected, 0.7) : 0.4 * std::pow(o.expected, 0.3));
    o.pixels = 1e6 * o.megapixels;
    o.kernel_texels = i % 2 == 0 ? 0.0 : 1.5;
    o.extent = i % 2 == 0 ? FilterExtent{0.0, 0.0} : FilterExtent{2.5, 0.25};
    all.push_back(o);
  }
  return all;
}

TEST(CostModel, fit_finds_the_costs_that_made_the_times) {
  const StoredCostModel model = fit_costs(made_observations(), "a machine");
  EXPECT_NEAR(model.drawing.per_frame, 0.5, 1e-4);
  EXPECT_NEAR(model.drawing.per_map, 0.25, 1e-4);
  EXPECT_NEAR(model.drawing.per_megatexel, 3.0, 1e-4);
  EXPECT_NEAR(model.drawing.per_kilodraw, 1.5, 1e-3);
  EXPECT_NEAR(model.drawing.per_megatriangle, 40.0, 1e-2);
  EXPECT_NEAR(model.drawing.per_megatexel_covered, 2.0, 1e-3);
  EXPECT_NEAR(model.drawing.per_megatexel_tested, 9.0, 1e-3);
  EXPECT_LT(model.depth_error, 1e-4);
  ASSERT_EQ(model.filters.size(), 2u);
  const FilterCost &hard = model.filters[0].cost, &vsm = model.filters[1].cost;
  EXPECT_EQ(hard.prefilter_ms_per_megatexel, 0.0);
  EXPECT_NEAR(vsm.prefilter_ms_per_map, 0.1, 1e-5);
  EXPECT_NEAR(vsm.prefilter_ms_per_megatexel, 7.0, 1e-5);
  EXPECT_NEAR(hard.lookup_ms_per_megapixel, 20.0, 1e-9);
  EXPECT_EQ(vsm.bytes_per_texel, 12.0);
  EXPECT_NEAR(hard.error_ratio, 1.25, 1e-6);
  EXPECT_NEAR(vsm.error_ratio, 0.4, 1e-6);
  EXPECT_NEAR(hard.error_power, 0.7, 1e-9);
  EXPECT_NEAR(vsm.error_power, 0.3, 1e-9);
  EXPECT_EQ(hard.kernel_texels, 0.0);
  EXPECT_EQ(vsm.kernel_texels, 1.5);
}

/// The same of maps, and beside them pages: each is a third as dear, and its look-ups are twice.
std::vector<Observation> with_pages() {
  std::vector<Observation> all = made_observations(), pages = all;
  for (Observation& o : pages) {
    o.pages = true;
    o.depth_ms /= 3.0;
    o.lookup_ms *= 2.0;
    o.wrong *= 0.5;
  }
  all.insert(all.end(), pages.begin(), pages.end());
  return all;
}

TEST(CostModel, pages_have_costs_and_errors_of_their_own) {
  const std::vector<Observation> all = with_pages();
  const StoredCostModel model = fit_costs(all, "a machine");
  EXPECT_NEAR(model.drawing.per_megatexel, 3.0, 1e-4);
  EXPECT_NEAR(model.pages.drawing.per_megatexel, 1.0, 1e-4);
  ASSERT_EQ(model.filters.size(), 2u);
  ASSERT_EQ(model.pages.filters.size(), 2u);
  EXPECT_NEAR(model.filters[0].cost.lookup_ms_per_megapixel, 20.0, 1e-9);
  EXPECT_NEAR(model.pages.filters[0].cost.lookup_ms_per_megapixel, 40.0, 1e-9);
  EXPECT_NEAR(model.filters[0].cost.error_ratio, 1.25, 1e-6);
  EXPECT_NEAR(model.pages.filters[0].cost.error_ratio, 0.625, 1e-6);
  for (const Observation& o : all) {
    const double ms = o.frame_ms + o.depth_ms + o.prefilter_ms + o.lookup_ms;
    EXPECT_NEAR(predicted_ms(model, o), ms, 1e-3 * ms) << o.pages;
  }
  std::vector<FilterCost> storage;
  const CostModel view = cost_model_from_text(to_text(model), "file").view(storage);
  ASSERT_EQ(view.filters.size(), 2u);
  ASSERT_EQ(view.pages.filters.size(), 2u);
  EXPECT_EQ(view.pages.drawing.per_megatexel, model.pages.drawing.per_megatexel);
  EXPECT_EQ(view.filters[1].error_ratio, model.filters[1].cost.error_ratio);
  EXPECT_EQ(view.pages.filters[1].error_ratio, model.pages.filters[1].cost.error_ratio);
  // Without them pages are not known, and too few say nothing.
  const StoredCostModel maps = fit_costs(made_observations(), "a machine");
  EXPECT_EQ(predicted_ms(maps, all.back()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(to_text(maps).find("\"pages\""), std::string::npos);
  EXPECT_THROW((void)fit_costs({all.data(), 67}, "a machine"), ReportError);
  EXPECT_THROW((void)fit_costs({all.data() + 60, 60}, "a machine"), ReportError) << "no maps";
}

TEST(CostModel, pages_in_a_file_are_checked_like_maps) {
  StoredCostModel model = fit_costs(with_pages(), "a machine");
  model.pages.drawing.per_map = -1.0;
  EXPECT_THROW((void)cost_model_from_text(to_text(model), "file"), ReportError);
  std::string text = to_text(fit_costs(made_observations(), "a machine"));
  text.insert(1, "\"pages\": 7,");
  EXPECT_THROW((void)cost_model_from_text(text, "file"), ReportError);
}

TEST(CostModel, filters_that_compare_have_one_power) {
  std::vector<Observation> all = made_observations();
  for (Observation& o : all) o.compares = true;
  const StoredCostModel model = fit_costs(all, "a machine");
  EXPECT_EQ(model.filters[0].cost.error_power, model.filters[1].cost.error_power);
  EXPECT_GT(model.filters[0].cost.error_power, 0.31);
  EXPECT_LT(model.filters[0].cost.error_power, 0.69);
}

TEST(CostModel, few_pixels_say_little_about_the_errors) {
  // Of two views the second has another slope, and a light that reaches next to none of its pixels.
  std::vector<Observation> all = made_observations();
  for (Observation& o : all) {
    if (o.view != "b") continue;
    o.wrong = 0.5 * std::pow(o.expected, 0.1);
    o.pixels = 10.0;
  }
  EXPECT_NEAR(fit_costs(all, "a machine").filters[0].cost.error_power, 0.7, 0.1);
}

TEST(CostModel, predicts_the_times_that_it_was_fitted_to) {
  const std::vector<Observation> all = made_observations();
  const StoredCostModel model = fit_costs(all, "a machine");
  for (const Observation& o : all) {
    const double ms = o.frame_ms + o.depth_ms + o.prefilter_ms + o.lookup_ms;
    EXPECT_NEAR(predicted_ms(model, o), ms, 1e-3 * ms);
  }
  Observation other = all.front();
  other.filter = "msm";
  EXPECT_EQ(predicted_ms(model, other), std::numeric_limits<double>::infinity());
}

TEST(CostModel, no_cost_is_below_zero) {
  // Values that fall as the second feature rises: without the limit its coefficient would be -1.
  const std::vector<std::vector<double>> rows{{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}};
  const std::vector<double> values{4.0, 3.0, 2.0};
  const std::vector<double> x = least_squares(rows, values);
  EXPECT_GT(x[0], 2.0);
  EXPECT_EQ(x[1], 0.0);
}

TEST(CostModel, features_that_say_the_same_do_no_harm) {
  const std::vector<std::vector<double>> rows{{1.0, 1.0}, {2.0, 2.0}};
  const std::vector<double> x = least_squares(rows, std::vector<double>{3.0, 6.0});
  EXPECT_NEAR(x[0] + x[1], 3.0, 1e-9);
}

TEST(CostModel, too_few_rows_are_refused) {
  const std::vector<Observation> all = made_observations();
  EXPECT_THROW((void)fit_costs({all.data(), 7}, "a machine"), ReportError);
}

TEST(CostModel, comes_back_from_its_file) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "model.json";
  const StoredCostModel model = fit_costs(made_observations(), "a \"machine\"");
  save_cost_model(model, file);
  const StoredCostModel read = load_cost_model(file);
  EXPECT_EQ(read.machine, model.machine);
  EXPECT_EQ(read.drawing.per_megatexel, model.drawing.per_megatexel);
  EXPECT_EQ(read.drawing.per_megatexel_tested, model.drawing.per_megatexel_tested);
  ASSERT_EQ(read.filters.size(), 2u);
  EXPECT_EQ(read.filters[1].cost.error_ratio, model.filters[1].cost.error_ratio);
  EXPECT_EQ(read.filters[1].cost.error_power, model.filters[1].cost.error_power);
  EXPECT_EQ(read.filters[1].cost.kernel_texels, 1.5);
  EXPECT_EQ(read.filters[0].cost.extent, (FilterExtent{0.0, 0.0}));
  EXPECT_EQ(read.filters[1].cost.extent, (FilterExtent{2.5, 0.25}));
  std::vector<FilterCost> storage;
  const CostModel view = read.view(storage);
  EXPECT_EQ(view.filters[1].name, "vsm");
}

TEST(CostModel, hostile_values_are_refused_with_one_line) {
  const std::string good = to_text(fit_costs(made_observations(), "a machine"));
  EXPECT_EQ(to_text(cost_model_from_text(good, "file")), good);
  const auto refused = [&](const std::string& key, const std::string& value, const std::string& why) {
    std::string text = good;
    const std::size_t at = text.find("\"" + key + "\":") + key.size() + 4;
    text.replace(at, text.find_first_of(",\n", at) - at, value);
    try {
      (void)cost_model_from_text(text, "file");
      ADD_FAILURE() << "accepted: " << key << " " << value;
    } catch (const ReportError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.rfind("file: ", 0), 0u) << what;
      EXPECT_NE(what.find(why), std::string::npos) << what;
      EXPECT_EQ(what.find_first_of("\n\r\x1b"), std::string::npos) << what;
    }
  };
  refused("frame_ms", "-1", "frame_ms: wants a number from 0 to 1e30");
  refused("ms_per_map", "true", "ms_per_map: wants");
  refused("bytes_per_texel", "1e31", "bytes_per_texel: wants");
  refused("lookup", "1e999", "number overflow");
  refused("name", "\"hard\\u001b[31m\\n\"", "name: wants one line of printable text");
  refused("machine", "\"" + std::string(500, 'x') + "\"", "machine: wants");
  refused("schema", "\"\\n\\u001b[31m\"", "schema");
  refused("machine", "7", "file: needs string, is number");
}

TEST(CostModel, a_model_without_filters_is_refused) {
  StoredCostModel model = fit_costs(made_observations(), "a machine");
  model.filters.clear();
  EXPECT_THROW((void)cost_model_from_text(to_text(model), "file"), ReportError);
}

TEST(CostModel, a_file_that_is_none_is_refused_by_name) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "model.json";
  const std::string deep(1000, '[');
  for (const char* text :
       {"", "{}", "[1]", "{\"schema\":\"gnomon.cost.5\"}", "{\"schema\":\"gnomon.cost.6\"}", deep.c_str()}) {
    std::ofstream(file) << text;
    try {
      (void)load_cost_model(file);
      ADD_FAILURE() << text;
    } catch (const ReportError& error) {
      EXPECT_NE(std::string(error.what()).find("model.json"), std::string::npos);
    }
  }
  EXPECT_THROW((void)load_cost_model(folder.path() / "missing.json"), ReportError);
}

}  // namespace
}  // namespace gnomon::report
