// Does the report say how well errors were expected, and draw it?
#include "expected.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "reported.hpp"
#include "sample_rows.hpp"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

/// Four rows of hard comparison on each of two frames, that were expected to misclassify `factor` times what
/// they did.
std::vector<Row> expected_rows(double factor) {
  std::vector<Row> rows;
  for (int i = 0; i < 8; ++i) {
    Row row = sample_row(static_cast<std::uint64_t>(i));
    row.frame = i / 4;
    row.technique.map_size = 256 << i % 4;
    row.errors.false_lit = row.errors.false_shadow = 0.001 * (1 + i % 4);
    row.expected_wrong = factor * 0.002 * (1 + i % 4);
    rows.push_back(row);
  }
  return rows;
}

TEST(Expected, agrees_as_far_as_ratios_and_ranks_do) {
  std::vector<Row> rows = expected_rows(0.9);
  const ExpectedCheck alike = check_expected(rows);
  EXPECT_EQ(alike.rows, 8u);
  EXPECT_EQ(alike.views, 2u);
  EXPECT_NEAR(alike.ratio, 0.9, 1e-12);
  EXPECT_EQ(alike.within, 1.0);
  EXPECT_NEAR(alike.correlation, 1.0, 1e-12);
  rows[0].expected_wrong = 1.0;      // the least of its view is expected to be the worst
  rows[5].technique.filter = "pcf";  // another filter
  rows[6].expected_wrong.reset();    // masks of others
  rows[7].errors.false_lit = rows[7].errors.false_shadow = 1e-5;  // too few pixels
  const ExpectedCheck off = check_expected(rows);
  EXPECT_EQ(off.rows, 5u);
  EXPECT_EQ(off.views, 1u);
  EXPECT_EQ(off.within, 0.8);
  EXPECT_NEAR(off.correlation, -0.2, 1e-12);
  // Nothing was expected where something is wrong: a miss, without a logarithm.
  std::vector<Row> none = expected_rows(0.9);
  none[0].expected_wrong = 0.0;
  const ExpectedCheck missed = check_expected(none);
  EXPECT_EQ(missed.rows, 8u);
  EXPECT_EQ(missed.without, 1u);
  EXPECT_EQ(missed.within, 7.0 / 8.0);
  EXPECT_NEAR(missed.ratio, 0.9, 1e-12);
  // Nothing was expected in one view of two, though its settings differ: no order there.
  for (std::size_t i = 0; i < 4; ++i) none[i].expected_wrong = 0.0;
  EXPECT_EQ(check_expected(none).views, 2u);
  EXPECT_NEAR(check_expected(none).correlation, 0.5, 1e-12);
  // Equal errors have no order.
  for (Row& row : none) row.errors.false_lit = row.errors.false_shadow = 0.001;
  EXPECT_EQ(check_expected(none).views, 0u);
  EXPECT_EQ(check_expected({}).rows, 0u);
}

TEST(Expected, draws_some_of_many_rows_and_all_scenes) {
  std::vector<Row> rows;
  for (int i = 0; i < 700; ++i) {
    for (Row row : expected_rows(0.9)) {
      row.scene = i < 350 ? "builtin:first" : "builtin:last";
      row.frame += 2 * i;
      rows.push_back(row);
    }
  }
  const std::string few = expected_part(expected_rows(0.9)), part = expected_part(rows);
  EXPECT_EQ(count(few, ": measured "), 8u);
  EXPECT_EQ(count(few, "The chart shows"), 0u);
  EXPECT_EQ(count(part, ": measured "), 5600u / 3 + 1);
  EXPECT_EQ(count(part, "The chart shows one of 3 rows."), 1u);
  EXPECT_GT(count(part, "first frame"), 900u);
  EXPECT_GT(count(part, "last frame"), 900u);
  EXPECT_EQ(count(part, "5600 rows"), 1u) << "all are counted";
}

TEST(Expected, is_shown_where_rows_have_it) {
  EXPECT_EQ(count(Reported(sample_rows(1, 2)).page, "Expected without drawing"), 0u);
  const Reported report(expected_rows(2.0));
  EXPECT_EQ(count(report.page, "Expected without drawing"), 1u);
  EXPECT_EQ(
      count(report.page, "8 rows of hard comparison with at least 30 misclassified pixels: 0 % are expected"),
      1u);
  EXPECT_EQ(count(report.page, "mean of 2 views: 1."), 1u);
  EXPECT_TRUE(fs::exists(report.folder.path() / "charts" / "expected.svg"));
}

}  // namespace
}  // namespace gnomon::report
