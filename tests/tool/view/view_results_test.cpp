// The viewer's chart of measured techniques, its times, and the benchmark's rows, without a window.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "benchmark.hpp"
#include "gauge.hpp"
#include "gnomon/report/rows_file.hpp"
#include "process.hpp"
#include "sweep_results.hpp"
#include "view_pictures.hpp"

namespace gnomon::tool::view {
namespace {

using report::Technique;

report::Row row_of(const char* scene, const Technique& technique, double ms, double wrong) {
  report::Row row;
  row.scene = scene;
  row.width = 320;
  row.height = 180;
  row.light = "sun";
  row.technique = technique;
  row.plan_status = "ok";
  row.truth = "filtered";
  row.errors.false_lit = 0.25 * wrong;
  row.errors.false_shadow = 0.75 * wrong;
  row.times.total_ms = {ms, ms, ms};
  row.times.baseline_ms = 2.0;
  row.times.rounds = 3;
  row.machine.renderer = "a renderer";
  return row;
}

const Technique kCheap{"none", "uniform", "tight", "hard", 1, 512};
const Technique kGood{"lispsm", "logarithmic", "tight", "vsm:radius=2", 3, 1024};
const Technique kPoor{"none", "uniform", "stable", "pcf", 2, 512};

std::filesystem::path written(const test::TemporaryFolder& folder, const std::vector<report::Row>& rows) {
  report::RowsFile file(folder.path() / report::kRowsFile);
  for (const report::Row& row : rows) file.append(row);
  return folder.path();
}

TEST(ViewResults, are_points_of_each_scene_with_their_front) {
  const test::TemporaryFolder folder;
  const SweepResults results = read_sweep_results(
      written(folder, {row_of("builtin:city", kGood, 8.0, 0.01), row_of("builtin:city", kCheap, 2.0, 0.09),
                       row_of("builtin:city", kPoor, 9.0, 0.05), row_of("builtin:fence", kCheap, 3.0, 0.2)}));
  ASSERT_EQ(results.scenes.size(), 2u);
  EXPECT_NE(results.measured.find("320 x 180"), std::string::npos) << results.measured;
  EXPECT_NE(results.measured.find("a renderer"), std::string::npos) << results.measured;
  EXPECT_EQ(results_of(results, "builtin:hangar"), nullptr);
  const SceneResults* const city = results_of(results, "builtin:city");
  ASSERT_NE(city, nullptr);
  ASSERT_EQ(city->points.size(), 3u);
  // By rising time; the slowest is beaten in both.
  EXPECT_EQ(city->points[0].technique, kCheap);
  EXPECT_EQ(city->points[1].technique, kGood);
  EXPECT_EQ(city->points[2].technique, kPoor);
  EXPECT_EQ(city->points[0].ratio, 1.0);
  EXPECT_EQ(city->points[1].ratio, 4.0);
  EXPECT_EQ(city->points[1].ms, 8.0);
  EXPECT_NEAR(city->points[1].wrong, 0.01, 1e-12);
  EXPECT_TRUE(city->points[0].on_front);
  EXPECT_TRUE(city->points[1].on_front);
  EXPECT_FALSE(city->points[2].on_front);
}

TEST(ViewResults, that_say_nothing_are_refused_with_their_place) {
  const test::TemporaryFolder folder;
  EXPECT_THROW((void)read_sweep_results(folder.path() / "nowhere"), report::ReportError);
  EXPECT_THROW((void)read_sweep_results(folder.write("empty.jsonl", "")), report::ReportError);
  EXPECT_THROW((void)read_sweep_results(folder.write("other.jsonl", "{\"a\": 1}\n")), report::ReportError);
  report::Row untimed = row_of("builtin:city", kCheap, 2.0, 0.1);
  untimed.times.baseline_ms = 0.0;
  EXPECT_THROW((void)read_sweep_results(written(folder, {untimed})), report::ReportError);
}

TEST(ViewResults, become_the_settings_that_were_measured) {
  const Settings good = settings_of(kGood, LightKind::sun);
  EXPECT_EQ(good.plan.cascades, 3);
  EXPECT_EQ(good.plan.resolution.max_size, 1024);
  EXPECT_EQ(good.plan.warp.warp, &warps::lispsm);
  EXPECT_EQ(good.plan.split.scheme, SplitScheme::logarithmic);
  EXPECT_EQ(good.plan.fit, Fit::tight);
  EXPECT_EQ(render::to_string(good.filter), "vsm:radius=2");
  EXPECT_FALSE(good.pages.on());
  EXPECT_EQ(settings_of(kPoor, LightKind::sun).plan.fit, Fit::stable);

  Technique pages{"none", "uniform", "tight", "pcf", 2, 1024};
  pages.pages = "clipmap";
  pages.page_texels = 64;
  pages.page_target_m = 1.5;
  pages.layer = "midpoint";
  const Settings of_pages = settings_of(pages, LightKind::sun);
  EXPECT_EQ(of_pages.pages.policy, &page_policies::clipmap);
  EXPECT_EQ(of_pages.pages.page_texels, 64);
  EXPECT_EQ(of_pages.pages.target_m, 1.5);
  // Two maps of 1024 x 1024 texels, in pages of 64 with a border of pcf's two texels and more on each side.
  EXPECT_GT(of_pages.pages.capacity, 2 * 1024 * 1024 / (80 * 80));
  EXPECT_LT(of_pages.pages.capacity, 2 * 1024 * 1024 / (64 * 64));
  EXPECT_EQ(of_pages.layer, render::DepthLayer::midpoint);
  Technique numbered = kCheap;
  numbered.filter = "identifiers:of=triangle,neighbours=1";
  const Settings by_identifiers = settings_of(numbered, LightKind::sun);
  ASSERT_TRUE(by_identifiers.identifiers);
  EXPECT_EQ(by_identifiers.identifiers->of, render::IdentifierOf::triangle);
  Technique even = kCheap;
  even.layer = "front:linear";
  even.split = "frustum_faces:slices=2";
  const Settings linear = settings_of(even, LightKind::sun);
  EXPECT_TRUE(linear.linear_depth);
  EXPECT_EQ(linear.plan.split.face_slices, 2);
  for (const Settings& settings : {good, of_pages, by_identifiers, linear}) {
    State state = hangar();
    state.a = settings;
    EXPECT_EQ(state_text(read_state(state_text(state))), state_text(state));
    EXPECT_EQ(stage().draw(state, kWidth, kHeight, true), "");
  }

  Technique lists = kCheap;
  lists.filter = "irregular";
  EXPECT_THROW((void)settings_of(lists, LightKind::sun), std::runtime_error);
  Technique unknown = kCheap;
  unknown.warp = "none_such";
  EXPECT_THROW((void)settings_of(unknown, LightKind::sun), std::runtime_error);
}

TEST(ViewTimes, leave_the_picture_and_count_errors_in_every_view) {
  State state = hangar();
  const Image before = picture(state);
  EXPECT_FALSE(stage().side(0).errors.has_value());
  for (const Stage::Timed what : {Stage::Timed::baseline, Stage::Timed::side_a})
    EXPECT_GT(stage().time_frame(state, what), stage().side(0).plan_ms) << "maps are drawn and read as well";
  EXPECT_EQ(stage().canvas().image().rgba, before.rgba);
  stage().count_errors(true);
  EXPECT_EQ(picture(state).rgba, before.rgba);
  const auto lit_view = stage().side(0).errors;
  stage().count_errors(false);
  state.view = View::misclassified;
  (void)picture(state);
  const auto own_view = stage().side(0).errors;
  ASSERT_TRUE(lit_view && own_view);
  EXPECT_GT(own_view->pixels, 1000u);
  EXPECT_GT(own_view->false_lit + own_view->false_shadow, 0.0);
  EXPECT_EQ(lit_view->false_lit, own_view->false_lit);
  EXPECT_EQ(lit_view->false_shadow, own_view->false_shadow);
  EXPECT_EQ(lit_view->pixels, own_view->pixels);
}

TEST(ViewTimes, what_is_expected_without_drawing_is_near_what_is_counted) {
  State state = hangar();
  state.a.filter = render::default_settings(render::filters::hard);
  state.view = View::misclassified;
  (void)picture(state);
  const Side& side = stage().side(0);
  ASSERT_TRUE(side.errors && side.expected_wrong);
  const double wrong = side.errors->false_lit + side.errors->false_shadow;
  EXPECT_GT(*side.expected_wrong, 0.3 * wrong);
  EXPECT_LT(*side.expected_wrong, 2.0 * wrong);
  state.view = View::lit;
  (void)picture(state);
  EXPECT_FALSE(stage().side(0).expected_wrong.has_value());
}

TEST(ViewTimes, of_a_gauge_are_the_ratio_of_medians_without_the_draws_that_warm_up) {
  Gauge gauge;
  EXPECT_EQ(gauge.ratio(), 0.0);
  for (int draw = 0; !gauge.done(); ++draw) {
    const int of_round = draw % 4;
    EXPECT_EQ(gauge.wants_baseline(), of_round < 2);
    // One round is disturbed; draws that warm up take a hundred times as long.
    const double counted = of_round < 2 ? 2.0 : draw / 4 == 1 ? 90.0 : 5.0;
    gauge.take(of_round % 2 == 0 ? 100.0 * counted : counted);
    EXPECT_TRUE(draw >= 3 || gauge.ratio() == 0.0) << "before the first round has ended";
  }
  EXPECT_DOUBLE_EQ(gauge.ratio(), 2.5);
}

/// Flipped pixels of a step of the camera along the path.
std::optional<double> flips_of_step(State state, double step) {
  stage().cut();
  stage().count_flips(true);
  EXPECT_EQ(stage().draw(state, kWidth, kHeight, false), "");
  state.path_time += step;
  EXPECT_EQ(stage().draw(state, kWidth, kHeight, false), "");
  const auto flips = stage().side(0).flips;
  stage().count_flips(false);
  return flips;
}

TEST(ViewTimes, count_the_shimmering_of_tight_maps_and_none_of_stable_ones) {
  State state = hangar();
  state.a.filter = render::default_settings(render::filters::hard);
  state.a.plan.resolution.max_size = 128;
  constexpr double kStep = 1e-3;
  const auto tight = flips_of_step(state, kStep);
  state.a.plan.fit = Fit::stable;
  const auto stable = flips_of_step(state, kStep), at_rest = flips_of_step(state, 0.0);
  ASSERT_TRUE(tight && stable && at_rest);
  EXPECT_GT(*tight, 0.01);
  EXPECT_LT(*stable, 0.1 * *tight);
  EXPECT_EQ(*at_rest, 0.0);
  EXPECT_EQ(stage().draw(state, kWidth, kHeight, false), "");
  EXPECT_FALSE(stage().side(0).flips.has_value());
  stage().count_flips(true);
  state.light.sun.azimuth_deg += 5.0;
  EXPECT_EQ(stage().draw(state, kWidth, kHeight, false), "");
  EXPECT_FALSE(stage().side(0).flips.has_value()) << "the shadows themselves moved";
  stage().count_flips(false);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(ViewBenchmark, flies_the_same_frames_each_time_and_writes_a_row_of_each_side) {
  State from = hangar();
  from.comparison = Comparison::wipe;
  from.b.plan.cascades = 1;
  from.motion.sun = true;
  from.motion.path_seconds = 8.0;
  from.light.sun.azimuth_deg = 170.0;
  Benchmark benchmark(from, 4, "flight.csv", "a renderer");
  std::vector<double> times, azimuths;
  while (!benchmark.done()) {
    const State state = benchmark.next();
    times.push_back(state.path_time);
    azimuths.push_back(state.light.sun.azimuth_deg);
    ASSERT_EQ(stage().draw(state, kWidth, kHeight, false), "");
    benchmark.take(stage(), 5.0);
  }
  EXPECT_EQ(times, (std::vector<double>{0.75, 0.0, 0.25, 0.5, 0.75}));
  // Ten degrees a second, two seconds a frame; a turn ends at 180.
  EXPECT_EQ(azimuths, (std::vector<double>{-130.0, 170.0, -170.0, -150.0, -130.0}));
  std::istringstream text(benchmark.text());
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> head = cells_of(line);
  const auto column = [&head](const char* name) {
    return static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin());
  };
  int rows = 0;
  for (; std::getline(text, line); ++rows) {
    const std::vector<std::string> cells = cells_of(line);
    ASSERT_EQ(cells.size(), head.size()) << line;
    EXPECT_EQ(cells[column("frame")], std::to_string(rows / 2));
    EXPECT_EQ(cells[column("side")], rows % 2 == 0 ? "A" : "B");
    EXPECT_EQ(cells[column("maps")], rows % 2 == 0 ? std::to_string(stage().side(0).plan.map_count) : "1");
    const auto number = [&](const char* name) { return std::stod(cells[column(name)]); };
    EXPECT_NEAR(number("shadows_ms"),
                number("plan_us") * 1e-3 + number("maps_ms") + number("prefilter_ms") + number("lookup_ms"),
                2e-3);
    EXPECT_GT(number("maps_ms"), 0.0);
    EXPECT_GT(number("m_p95"), 0.0);
    EXPECT_EQ(cells[column("renderer")], "\"a renderer\"");
  }
  EXPECT_EQ(rows, 8);
  EXPECT_EQ(benchmark.summary().rfind("4 frames, ", 0), 0u) << benchmark.summary();
}

}  // namespace
}  // namespace gnomon::tool::view
