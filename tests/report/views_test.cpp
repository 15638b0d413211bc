// What a report gathers over views: medians, sign tests, budgets, ranks, kinds of scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "budgets.hpp"
#include "front_table.hpp"
#include "kinds.hpp"
#include "ranks.hpp"
#include "reported.hpp"
#include "sample_rows.hpp"
#include "summary.hpp"
#include "views.hpp"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

/// Ten views, in which "wide" has the smaller pixel error and "hard" fewer misclassified pixels, but for one.
std::vector<Row> rows_that_disagree() {
  std::vector<Row> rows;
  for (int frame = 0; frame < 10; ++frame) {
    for (const char* filter : {"hard", "wide"}) {
      Row row = sample_row(0);
      row.frame = frame;
      row.frames = 10;
      row.technique.filter = filter;
      const bool wide = row.technique.filter == "wide";
      row.errors.false_lit = (wide ? 0.03 : 0.01) + 0.0001 * frame;
      row.errors.false_shadow = 0.0;
      row.pixel.emplace();
      row.pixel->pixels = 50'000;
      row.pixel->error = (wide == (frame != 3) ? 0.02 : 0.05) + 0.001 * frame;
      row.pixel->twinkle = wide ? 0.0 : 0.048;
      row.times.total_ms = {wide ? 12.0 : 8.0, 7.0, 13.0};
      row.times.baseline_ms = 8.0;
      row.times.baseline_again_ms = frame % 2 == 0 ? 8.4 : 7.8;
      rows.push_back(row);
    }
  }
  return rows;
}

/// Each frame as a view of its own: through another camera.
std::vector<Row> as_views(std::vector<Row> rows) {
  for (Row& row : rows) {
    row.camera = std::to_string(row.frame);
    row.frame = 0;
    row.frames = 1;
  }
  return rows;
}

TEST(Views, give_medians_with_intervals_and_count_the_views_that_say_so) {
  std::vector<Row> rows = as_views(rows_that_disagree());
  const Summary summary = summarize(rows);
  const ViewTable table = view_table(rows, summary);
  EXPECT_EQ(table.views, 10u);
  EXPECT_EQ(table.error, "pixel_error");
  const SignTest test = table.compared("pixel_error", 1, 0);
  EXPECT_EQ(test.less, 9u);
  EXPECT_EQ(test.more, 1u);
  EXPECT_NEAR(test.chance, 2.0 * 11.0 / 1024.0, 1e-12);
  EXPECT_EQ(table.compared("wrong", 1, 0).less, 0u);
  const Estimate wide = *table.over("pixel_error", 1);
  EXPECT_NEAR(wide.median, 0.0255, 1e-12);
  EXPECT_LT(wide.low, wide.median);
  EXPECT_GT(wide.high, wide.median);
  EXPECT_NEAR(table.noise(), 8.4 / 8.0, 1e-12);
  EXPECT_EQ(table.over("ratio", 1)->median, 1.5);
  // A view with few pixels is named and not counted.
  for (Row& row : rows)
    if (row.camera == "4") row.errors.pixels = 143;
  const ViewTable fewer = view_table(rows, summary);
  EXPECT_EQ(fewer.views, 9u);
  EXPECT_EQ(fewer.dropped, 1u);
}

TEST(Views, are_flights_whose_frames_weigh_by_their_pixels_and_of_which_some_are_timed) {
  std::vector<Row> rows;
  for (int frame = 0; frame < 3; ++frame) {
    Row row = sample_row(0);
    row.frame = frame;
    row.frames = 3;
    row.errors.false_lit = 0.01 * (frame + 1);
    row.errors.false_shadow = 0.0;
    row.errors.pixels = frame == 0 ? 3000 : frame == 1 ? 1000 : 143;
    row.times = {};
    if (frame == 1) row.times.total_ms = {8.0, 7.0, 9.0};
    if (frame == 1) row.times.baseline_ms = row.times.baseline_again_ms = 4.0;
    rows.push_back(row);
  }
  const Summary summary = summarize(rows);
  const ViewTable table = view_table(rows, summary);
  EXPECT_EQ(table.views, 1u);
  EXPECT_EQ(table.dropped, 0u) << "the flight has frames that count";
  EXPECT_NEAR(table.over("wrong", 0)->median, 0.0125, 1e-12);
  EXPECT_EQ(table.over("total_ms", 0)->median, 8.0);
  EXPECT_EQ(table.over("ratio", 0)->median, 2.0);
  EXPECT_EQ(table.again.size(), 1u);
  EXPECT_EQ(summary.cells[1][0].values[measure_index("total_ms")], 8.0);
  EXPECT_EQ(summary.cells[1][0].values[measure_index("ratio")], 2.0);
  // A frame that was not timed has no time of 0.
  std::erase_if(rows, [](const Row& row) { return row.frame == 1; });
  for (const char* measure : {"total_ms", "ratio", "plan_us", "depth_ms", "shade_ms"})
    EXPECT_TRUE(std::isnan(summarize(rows).cells[1][0].values[measure_index(measure)])) << measure;
}

TEST(Views, go_by_misclassified_pixels_where_no_row_has_a_pixel_error) {
  std::vector<Row> rows = rows_that_disagree();
  for (Row& row : rows) row.pixel.reset();
  EXPECT_EQ(view_table(rows, summarize(rows)).error, "wrong");
}

/// Techniques of 1 to 4 maps on eight views, with these times in milliseconds. Their misclassified shares are
/// 4, 3.9, 5 and 1 %, but that of two maps is larger than that of one in half of the views.
std::vector<Row> rows_of_budgets(const std::vector<double>& ms) {
  constexpr double kWrong[] = {0.04, 0.039, 0.05, 0.01};
  std::vector<Row> rows;
  for (int frame = 0; frame < 8; ++frame) {
    for (std::size_t t = 0; t < ms.size(); ++t) {
      Row row = sample_row(t);
      row.frame = frame;
      row.errors.false_lit = kWrong[t] + 1e-5 * frame + (t == 1 && frame > 4 ? 0.0015 : 0.0);
      row.errors.false_shadow = 0.0;
      row.times.total_ms = {ms[t], ms[t], ms[t]};
      row.times.baseline_again_ms = row.times.baseline_ms * (frame == 0 ? 1.25 : 1.0);
      rows.push_back(row);
    }
  }
  return rows;
}

TEST(Budgets, take_the_least_error_that_time_allows_and_name_what_is_as_good) {
  const std::vector<Row> rows = as_views(rows_of_budgets({10.0, 12.0, 15.0, 20.0}));
  const Summary summary = summarize(rows);
  const std::vector<BudgetChoice> choices = budget_choices(view_table(rows, summary), summary, "wrong");
  ASSERT_EQ(choices.size(), 3u) << "five percent for more time are no choice";
  EXPECT_EQ(choices[0].technique, 0u);
  EXPECT_EQ(choices[0].budget_ms, 10.0);
  EXPECT_FALSE(choices[0].test.has_value());
  EXPECT_EQ(choices[1].technique, 1u);
  EXPECT_EQ(choices[1].test->less, 5u);
  EXPECT_EQ(choices[1].as_good, std::vector<std::size_t>{0})
      << "a coin may be as uneven as 5 of 8; five percent are surely more";
  EXPECT_EQ(choices[2].technique, 3u);
  EXPECT_EQ(choices[2].budget_ms, 20.0);
  EXPECT_LT(choices[2].test->chance, 0.05);
  EXPECT_TRUE(choices[2].as_good.empty());
}

TEST(Budgets, are_those_of_the_upper_end_of_the_time_and_of_techniques_of_all_views) {
  std::vector<Row> rows = rows_of_budgets({10.0, 12.0, 15.0, 20.0});
  for (Row& row : rows)
    if (row.technique.cascades == 2) row.times.total_ms.median = row.frame < 4 ? 5.0 : 30.0;
  std::erase_if(rows, [](const Row& row) { return row.technique.cascades == 4 && row.frame == 3; });
  rows = as_views(std::move(rows));
  const Summary summary = summarize(rows);
  const std::vector<BudgetChoice> choices = budget_choices(view_table(rows, summary), summary, "wrong");
  ASSERT_EQ(choices.size(), 2u);
  EXPECT_EQ(choices[1].technique, 1u);
  EXPECT_EQ(choices[1].budget_ms, 30.0) << "its median is 17.5";
}

TEST(Budgets, stand_on_the_page_and_in_json_with_the_machine_and_its_noise) {
  const Reported reported(as_views(rows_of_budgets({10.0, 12.0, 15.0, 20.0})));
  for (const char* text : {"Which technique for which budget", "<b>8 of 8</b>", "less than a factor of 1.25",
                           "llvmpipe, some cpu, 2 cores, load 0.5 to 0.5."})
    EXPECT_NE(reported.page.find(text), std::string::npos) << text;
  const std::string json = text_of(reported.folder.path() / "budgets.json");
  for (const char* text : {"\"schema\": \"gnomon-budgets/1\"", "\"noise_factor\": 1.25",
                           "\"budget_ms\": 20.0", "\"load_most\": 0.5"})
    EXPECT_NE(json.find(text), std::string::npos) << text << "\n" << json;
  // One view decides nothing.
  std::vector<Row> one = rows_of_budgets({10.0, 12.0});
  std::erase_if(one, [](const Row& row) { return row.frame != 0; });
  const Reported alone(one);
  EXPECT_EQ(alone.page.find("Which technique for which budget"), std::string::npos);
  EXPECT_EQ(count(text_of(alone.folder.path() / "budgets.json"), "budget_ms"), 0u);
}

TEST(Ranks, show_where_two_errors_disagree) {
  const std::vector<Row> rows = rows_that_disagree();
  const Summary summary = summarize(rows);
  EXPECT_EQ(places_by(summary, 1, "wrong"), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(places_by(summary, 1, "pixel_error"), (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(places_by(summary, 1, "flips"), (std::vector<std::size_t>{1, 1}));
  EXPECT_DOUBLE_EQ(rank_agreement(summary, 1, "wrong", "pixel_error"), -1.0);
  const std::string tables = front_tables(summary);
  EXPECT_EQ(count(tables, "misclassified pixels and pixel error: -1;"), 2u) << tables;
  EXPECT_EQ(count(tables, "front by pixel error"), 2u);
}

TEST(Page, has_views_ranks_and_their_files) {
  const Reported reported(as_views(rows_that_disagree()));
  for (const char* text : {"Over views", "In how many views", "<b>9 of 10</b>", "Places by each error",
                           "less than a factor of 1.05", "Questions and errors"})
    EXPECT_NE(reported.page.find(text), std::string::npos) << text;
  const std::string csv = text_of(reported.folder.path() / "views.csv");
  EXPECT_EQ(count(csv, "\n"), 3u);
  EXPECT_NE(csv.find(",views,wrong,wrong_low,wrong_high,pixel_error"), std::string::npos) << csv;
  EXPECT_TRUE(fs::exists(reported.folder.path() / "charts/views.svg"));
  // Rows of an earlier version have none of it.
  const Reported old(sample_rows(2, 3));
  EXPECT_EQ(old.page.find("Places by each error"), std::string::npos);
}

TEST(Kinds, name_the_least_error_and_the_best_of_the_other_filters) {
  std::vector<Row> rows;
  for (int view = 0; view < 8; ++view) {
    for (const char* filter : {"hard", "pcf", "vsm"}) {
      Row row = sample_row(0);
      row.index = rows.size();
      row.view = (view < 6 ? "thin: v" : "solid: v") + std::to_string(view);
      row.camera = std::to_string(view);
      row.technique.filter = filter;
      row.errors.pixels = 5000;
      // In thin views pcf has the least, in solid ones hard; vsm is in the middle.
      const bool thin = view < 6;
      const double error = *filter == 'v' ? 0.03 : (*filter == 'p') == thin ? 0.02 : 0.05;
      row.errors.false_lit = error + 1e-3 * view;
      row.errors.false_shadow = 0.0;
      rows.push_back(row);
    }
  }
  const Summary summary = summarize(rows);
  const std::vector<KindBest> best = best_of_kinds(rows, summary);
  ASSERT_GE(best.size(), 3u);
  EXPECT_EQ(best.front().kind, "thin");
  EXPECT_EQ(best.front().views, 6u);
  EXPECT_EQ(summary.techniques[best.front().technique].filter, "pcf");
  EXPECT_EQ(summary.techniques[best.front().next].filter, "vsm");
  EXPECT_EQ(best.front().error.median, 0.0225);
  EXPECT_EQ(best.front().test.less, 6u);
  EXPECT_NEAR(best.front().test.chance, 2.0 / 64.0, 1e-12);
  const auto solid =
      std::find_if(best.begin(), best.end(), [](const KindBest& b) { return b.kind == "solid"; });
  ASSERT_NE(solid, best.end());
  EXPECT_EQ(summary.techniques[solid->technique].filter, "hard");
  EXPECT_EQ(solid->views, 2u);
  const Reported report(rows);
  EXPECT_NE(report.page.find("By kind of scene"), std::string::npos);
  const std::string tables = text_of(report.folder.path() / "tables.tex");
  EXPECT_EQ(count(tables, "\\begin{tabular}"), 2u);
  EXPECT_NE(tables.find("Medians over 8 views"), std::string::npos);
  EXPECT_NE(text_of(report.folder.path() / "method.tex").find("3 techniques were measured on 8 views"),
            std::string::npos);
  EXPECT_NE(text_of(report.folder.path() / "kinds.csv").find("\"thin\",6,wrong,"), std::string::npos);
  // Each view once, whatever its frames: pcf has less than hard in the thin ones.
  EXPECT_NE(text_of(report.folder.path() / "pairs.csv").find(",8,"), std::string::npos);
  EXPECT_NE(text_of(report.folder.path() / "pairs.csv").find(",6,2,"), std::string::npos);
  // Rows without kinds have no such table.
  for (Row& row : rows) row.view.clear();
  EXPECT_TRUE(best_of_kinds(rows, summarize(rows)).empty());
}

}  // namespace
}  // namespace gnomon::report
