// Are picks held against what was measured as they are said to be, in a frame and over a flight?
#include "calibrate/picks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "animated_gltf.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

using tool::PricedTechnique;
using tool::Score;

/// By measured times the third is worse than the second, by the model's it is not.
constexpr PricedTechnique kAll[] = {{1.0, 1.0, 0.08}, {2.0, 6.0, 0.02}, {4.0, 3.0, 0.03}, {8.0, 8.0, 0.01}};

Budget within(double milliseconds) {
  Budget budget;
  budget.milliseconds = milliseconds;
  return budget;
}
Budget at_error(double error) {
  Budget budget;
  budget.target_error = error;
  return budget;
}

TEST(Picks, are_beyond_the_front_where_another_is_better_in_both) {
  for (const std::size_t on_front : {0, 1, 3})
    EXPECT_EQ(tool::score_of(kAll[on_front], kAll, within(8.0)).beyond_front, 1.0);
  const Score third = tool::score_of(kAll[2], kAll, within(8.0));
  EXPECT_DOUBLE_EQ(third.beyond_front, 1.5) << "half as much again in error, twice in time";
  EXPECT_EQ(third.beyond_front_by_model, 1.0);
}

TEST(Picks, are_off_a_request_that_they_miss_or_that_another_meets_better) {
  const Score too_long = tool::score_of(kAll[3], kAll, within(5.0));
  EXPECT_DOUBLE_EQ(too_long.over_request, 1.6);
  EXPECT_DOUBLE_EQ(too_long.off_request, 1.6);
  const Score wasteful = tool::score_of(kAll[0], kAll, within(5.0));
  EXPECT_EQ(wasteful.over_request, 1.0);
  EXPECT_DOUBLE_EQ(wasteful.off_request, 4.0) << "the second has a quarter of the error in time";
  EXPECT_EQ(tool::score_of(kAll[1], kAll, within(5.0)).off_request, 1.0);
  EXPECT_DOUBLE_EQ(tool::score_of(kAll[0], kAll, at_error(0.04)).off_request, 2.0);
  EXPECT_DOUBLE_EQ(tool::score_of(kAll[3], kAll, at_error(0.04)).off_request, 4.0);
}

TEST(Picks, requests_lie_between_the_ends_of_what_was_measured) {
  const std::vector<Budget> requests = tool::requests_between(kAll);
  ASSERT_EQ(requests.size(), 6u);
  EXPECT_DOUBLE_EQ(requests[2].milliseconds, std::sqrt(8.0));
  EXPECT_EQ(requests[2].target_error, 0.0);
  EXPECT_DOUBLE_EQ(requests[5].target_error, 0.01 * std::pow(8.0, 0.75));
}

/// A model by which a map's texels cost next to nothing.
report::StoredCostModel some_model() {
  report::StoredCostModel model;
  model.drawing.per_map = 1.0;
  model.filters = {{"hard", {}}, {"pcf", {}}};
  model.filters[1].cost.lookup_ms_per_megapixel = 100.0;
  model.filters[1].cost.kernel_texels = 1.5;
  return model;
}

TEST(Picks, of_a_flight_are_held_against_the_means_of_its_frames) {
  std::vector<report::Row> rows = report::read_rows(whole());
  // As if the second frame took three times as long.
  for (report::Row& row : rows) {
    row.times.total_ms.median = 1.0 + static_cast<double>(row.index % 4);
    if (row.frame == 1) row.times.total_ms.median *= 3.0;
  }
  const std::vector<tool::View> views = tool::views_of(rows);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].flight, views[1].flight);
  // `hard` is taken where time is short, under the warp that errs less in the frame.
  report::StoredCostModel model = some_model();
  model.filters[1].cost.lookup_ms_per_megapixel = 2000.0;
  const tool::FlightPicks picks = tool::picks_of({&views[0], &views[1]}, model);
  ASSERT_EQ(picks.of_frames.size(), 12u);
  ASSERT_EQ(picks.first_kept.size(), 6u);
  ASSERT_EQ(picks.hardest_kept.size(), 6u);
  ASSERT_EQ(picks.renewed.size(), 6u);
  EXPECT_EQ(picks.techniques, 8);
  int differ = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const tool::Pick &first = picks.of_frames[i], &second = picks.of_frames[6 + i];
    EXPECT_EQ(picks.first_kept[i].technique, first.technique);
    // All maps have as many texels: the first frame is as hard as the second where an error is asked for.
    const bool second_is_harder = first.request.target_error == 0.0 && *second.expected > *first.expected;
    EXPECT_EQ(picks.hardest_kept[i].technique, second_is_harder ? second.technique : first.technique);
    differ += first.technique != second.technique ? 1 : 0;
    EXPECT_TRUE(picks.renewed[i].technique.empty());
    // Of the same technique, the second frame takes three times as long.
    EXPECT_DOUBLE_EQ(picks.first_kept[i].score.priced.ms, 2.0 * first.score.priced.ms);
    EXPECT_DOUBLE_EQ(picks.renewed[i].score.priced.error,
                     0.5 * (first.score.priced.error + second.score.priced.error));
    EXPECT_DOUBLE_EQ(picks.renewed[i].score.priced.model_ms,
                     0.5 * (first.score.priced.model_ms + second.score.priced.model_ms));
  }
  EXPECT_GT(differ, 0) << "else the first frame's pick is any frame's";
  const tool::FlightPicks alone = tool::picks_of({&views[0]}, model);
  EXPECT_EQ(alone.of_frames.size(), 6u);
  EXPECT_TRUE(alone.first_kept.empty());
}

TEST(Picks, frames_of_a_flight_need_the_same_techniques) {
  std::vector<tool::View> views = tool::views_of(report::read_rows(whole()));
  views[1].rows.pop_back();
  EXPECT_THROW((void)tool::picks_of({&views[0], &views[1]}, some_model()), std::runtime_error);
}

TEST(Picks, rows_that_no_model_predicts_are_not_of_a_view) {
  report::Row row = report::read_rows(whole()).front();
  EXPECT_EQ(tool::views_of({row}).size(), 1u);
  for (const char* filter : {"irregular", "irregular:samples=8", "identifiers", "identifiers:of=triangle"}) {
    row.technique.filter = filter;
    EXPECT_TRUE(tool::views_of({row}).empty()) << filter;
  }
}

TEST(Picks, pages_are_picked_where_they_cost_less) {
  const TemporaryFolder folder;
  const Finished swept = run_gnomon({"compare",     "builtin:hangar",
                                     "--warps",     "none,lispsm",
                                     "--cascades",  "1",
                                     "--map-sizes", "512,1024",
                                     "--filters",   "hard",
                                     "--frames",    "1",
                                     "--size",      "96x54",
                                     "--rounds",    "1",
                                     "--pages",     "all",
                                     "--context",   "osmesa",
                                     "--out",       folder.path().string()});
  ASSERT_EQ(swept.exit_code, 0) << swept.err;
  const std::vector<tool::View> views = tool::views_of(report::read_rows(folder.path()));
  ASSERT_EQ(views.size(), 1u);
  // Four maps, and pages of either size by each policy, but by queried ones, which take several frames.
  EXPECT_EQ(views[0].rows.size(), 4u + 2u * (all_page_policies().size() - 1u));
  const tool::Replanned replanned(views[0]);
  for (const report::Row& row : views[0].rows) {
    const report::Observation o = replanned.observe(row);
    EXPECT_EQ(o.pages, !row.technique.pages.empty());
    EXPECT_GT(o.expected, 0.3 * o.wrong) << row.technique.name();
    EXPECT_LT(o.expected, 3.0 * o.wrong) << row.technique.name();
    // The renderer draws no page that it can do without.
    if (o.pages) {
      EXPECT_NEAR(o.work.maps, row.costs.maps, 0.25 * row.costs.maps) << row.technique.name();
    }
  }
  report::StoredCostModel model = some_model();
  model.filters.resize(1);
  model.pages = model;
  for (const bool pages_are_dear : {false, true}) {
    model.pages.drawing.per_map = pages_are_dear ? 1e6 : 1e-6;
    model.drawing.per_map = pages_are_dear ? 1.0 : 1e6;
    const tool::FlightPicks picks = tool::picks_of({&views[0]}, model);
    ASSERT_EQ(picks.of_frames.size(), 6u);
    for (const tool::Pick& pick : picks.of_frames) {
      if (pick.request.milliseconds > 0.0) {
        EXPECT_NE(pick.technique.starts_with("pages "), pages_are_dear) << pick.technique;
      }
    }
  }
  model.pages.filters.clear();
  EXPECT_THROW((void)tool::picks_of({&views[0]}, model), std::runtime_error);
}

TEST(Calibrate, shows_the_first_frames_pick_over_its_flight) {
  const TemporaryFolder folder;
  const std::string model = (folder.path() / "model.json").string();
  report::save_cost_model(some_model(), model);
  const Finished checked = run_gnomon({"calibrate", whole().string(), "--model", model, "--check"});
  ASSERT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find("the first frame's pick: "), std::string::npos);
  const Finished json = run_gnomon({"calibrate", whole().string(), "--model", model, "--check", "--json"});
  EXPECT_NE(json.out.find("\"flights_by_each_frame\":[{"), std::string::npos);
}

TEST(Calibrate, knows_the_poses_of_a_scene_that_plays) {
  const TemporaryFolder folder;
  const std::string file = folder.write("animated.glb", animated_gltf().file());
  const fs::path out = folder.path() / "plays";
  const Finished measured = spawn_gnomon(
      {"compare",   file,   "--animation", "all",    "--warps",  "none",      "--cascades", "1",
       "--filters", "hard", "--map-sizes", "256",    "--frames", "2",         "--size",     "160x90",
       "--rounds",  "1",    "--context",   "osmesa", "--out",    out.string()});
  ASSERT_EQ(measured.exit_code, 0) << measured.err;
  std::vector<report::Row> rows = report::read_rows(out);
  ASSERT_EQ(rows.size(), 2u);
  const std::vector<tool::View> views = tool::views_of(rows);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_NE(views[0].name.find("playing all"), std::string::npos) << views[0].name;
  const auto expected = [](const report::Row& row) {
    return tool::Replanned(tool::views_of({row}).at(0)).observe(row).expected;
  };
  const double posed = expected(rows[1]);
  EXPECT_NEAR(posed, rows[1].expected_wrong.value(), 0.05 * posed);
  report::Row rest = rows[1];
  rest.animation_time_s = 0.0;
  EXPECT_NE(expected(rest), posed) << "another pose";
  rest.animation.clear();
  EXPECT_NE(expected(rest), posed) << "at rest";
  EXPECT_EQ(tool::views_of({rows[1], rest}).size(), 2u);
  rest.animation = "run";
  EXPECT_THROW((void)expected(rest), std::runtime_error);
}

TEST(Calibrate, knows_each_of_several_local_lights) {
  report::Row row = report::read_rows(whole()).front();
  const auto observed = [&](const std::string& light) {
    row.light = light;
    const std::vector<tool::View> views = tool::views_of({row});
    return tool::Replanned(views.at(0)).observe(row);
  };
  // Lights of --local-lights 4 over the fence: they reach other parts of it.
  EXPECT_GT(observed("spot 1 of 4").work.maps, 0.0);
  EXPECT_NE(observed("point 2 of 4").work.kilodraws, observed("point 3 of 4").work.kilodraws);
  EXPECT_NE(observed("spot 1 of 4").expected, observed("spot").expected);
  for (const char* light :
       {"lamp", "spot 0 of 4", "spot 5 of 4", "spot 1 of 65", "spot 1", "spot 1 of 4 more", "spot 1of"})
    EXPECT_THROW((void)observed(light), std::runtime_error) << light;
}

}  // namespace
}  // namespace gnomon::test
