// What is made of a sweep that was measured: a cost model, picks held against it, the page written anew.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "calibrate/replanned.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

TEST(Calibrate, fits_a_cost_model_to_a_sweep_and_holds_its_picks_against_another) {
  const TemporaryFolder folder;
  const std::string model = (folder.path() / "model.json").string();
  const Finished fitted = run_gnomon({"calibrate", whole().string(), "--model", model});
  ASSERT_EQ(fitted.exit_code, 0) << fitted.err;
  EXPECT_NE(fitted.out.find("| hard |"), std::string::npos);
  const Finished checked = run_gnomon({"calibrate", whole().string(), "--model", model, "--check"});
  ASSERT_EQ(checked.exit_code, 0) << checked.err;
  EXPECT_NE(checked.out.find("of 12 picks"), std::string::npos) << "two views, six questions each";
}

TEST(Calibrate, says_what_to_do_with_what_was_measured_before) {
  const TemporaryFolder folder;
  const Finished again = run_gnomon(
      {"calibrate", "--out", whole().string(), "--model", (folder.path() / "model.json").string()});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("gnomon calibrate " + whole().string()), std::string::npos) << again.err;
}

TEST(Calibrate, refuses_what_it_cannot_use) {
  const TemporaryFolder folder;
  const std::string model = (folder.path() / "model.json").string();
  EXPECT_EQ(run_gnomon({"calibrate", "--check"}).exit_code, 2);
  EXPECT_EQ(run_gnomon({"calibrate", "/does/not/exist", "--model", model}).exit_code, 2);
  const Finished unfitted = run_gnomon({"calibrate", whole().string(), "--model", model, "--check"});
  EXPECT_EQ(unfitted.exit_code, 2);
  EXPECT_NE(unfitted.err.find("model.json"), std::string::npos);
  EXPECT_FALSE(fs::exists(model));
}

TEST(Calibrate, views_differ_by_light_and_observations_are_in_milliseconds) {
  report::Row row = report::read_rows(whole()).front();
  row.times.plan_ns.median = 250'000.0;
  report::Row spot = row;
  spot.light = "spot";
  EXPECT_EQ(tool::views_of({row, row, spot}).size(), 2u);
  const std::vector<tool::View> views = tool::views_of({row});
  EXPECT_DOUBLE_EQ(tool::Replanned(views.at(0)).observe(row).frame_ms, 0.25);
}

TEST(Report, is_written_again_without_measuring) {
  fs::remove(whole() / "report.html");
  const Finished finished = run_gnomon({"report", whole().string()});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_EQ(finished.lines(), std::vector<std::string>{(whole() / "report.html").string()});
  EXPECT_TRUE(fs::exists(whole() / "report.html"));
  EXPECT_EQ(run_gnomon({"report", "/nowhere"}).exit_code, 2);
  const Finished of_a_file = run_gnomon({"report", (whole() / report::kRowsFile).string()});
  EXPECT_EQ(of_a_file.exit_code, 2);
  EXPECT_NE(of_a_file.err.find("is not a folder"), std::string::npos) << of_a_file.err;
}

}  // namespace
}  // namespace gnomon::test
