// Does `gnomon compare` measure each split with what it gives to the plan?
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "compare/technique_words.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

/// Rows of a small frame of the hangar by these splits, unwarped and hard.
std::vector<report::Row> rows_by(const std::string& splits, const std::string& cascades,
                                 const std::vector<std::string>& more = {}) {
  const TemporaryFolder folder;
  std::vector<std::string> words{"compare",     "builtin:hangar",
                                 "--warps",     "none",
                                 "--splits",    splits,
                                 "--cascades",  cascades,
                                 "--filters",   "hard",
                                 "--frames",    "1",
                                 "--size",      "96x54",
                                 "--map-sizes", "512",
                                 "--rounds",    "1",
                                 "--context",   "osmesa",
                                 "--out",       folder.path().string()};
  words.insert(words.end(), more.begin(), more.end());
  const Finished finished = run_gnomon(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  return report::read_rows(folder.path());
}

void expect_refused(const std::vector<const char*>& splits) {
  for (const char* bad : splits) {
    const Finished refused = run_gnomon({"compare", "builtin:hangar", "--splits", bad});
    EXPECT_EQ(refused.exit_code, 2) << bad;
    EXPECT_NE(refused.err.find(bad), std::string::npos) << refused.err;
  }
}

TEST(Compare, takes_each_split_that_it_lists_and_no_other_name_of_one) {
  std::set<std::string> taken;
  for (const std::string& name : tool::split_names()) {
    ASSERT_EQ(tool::read_splits("--splits", {name}).size(), 1u) << name;
    EXPECT_TRUE(taken.insert(name).second) << name;
  }
  // `auto` divides by view depth.
  EXPECT_THROW((void)tool::read_splits("--splits", {"view_depth"}), std::runtime_error);
}

TEST(Compare, plans_with_the_finest_map_and_with_what_the_frame_shows) {
  const std::vector<report::Row> rows =
      rows_by("auto,auto:finest", "4", {"--visible-depths", "--visible-points"});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].technique.split, "auto:visible_depths:visible_points");
  EXPECT_EQ(rows[1].technique.split, "auto:finest:visible_depths:visible_points");
  for (const report::Row& row : rows) {
    EXPECT_EQ(row.plan_status, "ok");
    EXPECT_LT(row.errors.false_lit + row.errors.false_shadow, 0.1) << row.technique.name();
  }
  EXPECT_LE(rows[1].aliasing.p95, rows[0].aliasing.p95);
  expect_refused({"auto:best"});
}

TEST(Compare, divides_the_faces_of_the_frustum_further) {
  const std::vector<report::Row> rows = rows_by("frustum_faces,frustum_faces:slices=2", "4");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].technique.split, "frustum_faces:slices=2");
  EXPECT_GT(rows[1].costs.maps, rows[0].costs.maps);
  EXPECT_LE(rows[1].aliasing.p95, rows[0].aliasing.p95);
  EXPECT_LT(rows[1].aliasing.p50, rows[0].aliasing.p50);
  expect_refused({"frustum_faces:slices=0", "frustum_faces:slices=9", "frustum_faces:slices=x",
                  "frustum_faces:slices=", "auto:slices=2", "separating_plane:slices=2"});
}

TEST(Compare, blends_practical_splits_by_lambda) {
  const std::vector<report::Row> rows = rows_by(
      "uniform,practical:lambda=0,practical:lambda=0.5,practical,practical:lambda=1,logarithmic", "2");
  ASSERT_EQ(rows.size(), 6u);
  const auto m = [&](std::size_t row) { return rows[row].aliasing.p95; };
  EXPECT_EQ(rows[2].technique.split, "practical:lambda=0.5");
  EXPECT_EQ(m(1), m(0));
  EXPECT_EQ(m(4), m(5));
  EXPECT_NE(m(2), m(0));
  EXPECT_NE(m(3), m(2));
  expect_refused({"practical:lambda=1.1", "practical:lambda=-1", "practical:lambda=nan",
                  "practical:lambda=", "practical:lambda=0.5x", "auto:lambda=0.5"});
}

TEST(Compare, plans_with_the_edges_of_the_last_frames_shadow) {
  const TemporaryFolder folder;
  const Finished finished = run_gnomon({"compare",     "builtin:room",
                                        "--warps",     "optimal",
                                        "--splits",    "auto,auto:shadow_edges",
                                        "--cascades",  "4",
                                        "--filters",   "hard",
                                        "--frames",    "2",
                                        "--size",      "320x180",
                                        "--map-sizes", "256",
                                        "--rounds",    "1",
                                        "--out",       (folder.path() / "out").string()});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path() / "out");
  ASSERT_EQ(rows.size(), 4u);
  double without = 0.0, with = 0.0;
  for (const report::Row& row : rows)
    (row.technique.split == "auto:shadow_edges" ? with : without) +=
        row.errors.false_lit + row.errors.false_shadow;
  // Edges alone would leave most of the room beyond all maps.
  EXPECT_LT(with, 0.95 * without);
  EXPECT_GT(with, 0.5 * without);
  EXPECT_EQ(
      run_gnomon({"compare", "builtin:hangar", "--splits", "auto:visible_points:shadow_edges"}).exit_code, 2);
}

TEST(Compare, maps_that_share_a_budget_have_no_more_texels_and_other_shadows) {
  const TemporaryFolder folder;
  const Finished finished = run_gnomon({"compare",     "builtin:hangar",
                                        "--warps",     "auto",
                                        "--splits",    "auto,auto:budget",
                                        "--filters",   "hard",
                                        "--cascades",  "3",
                                        "--map-sizes", "256",
                                        "--frames",    "2",
                                        "--rounds",    "1",
                                        "--size",      "320x180",
                                        "--out",       folder.path().string()});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path());
  ASSERT_EQ(rows.size(), 4u);
  double equal = 0.0, shared = 0.0;
  for (const report::Row& row : rows) {
    const bool shares = row.technique.split == "auto:budget";
    (shares ? shared : equal) += row.errors.false_lit + row.errors.false_shadow;
    EXPECT_LE(row.costs.texels, 3u * 256u * 256u);
    EXPECT_EQ(row.costs.texels == 3u * 256u * 256u, !shares);
  }
  EXPECT_NE(shared, equal);
}

}  // namespace
}  // namespace gnomon::test
