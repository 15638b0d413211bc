// Are exact shadows by lists of pixels a technique of gnomon compare like any other?
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

/// Arguments of one frame of the fence with maps of 64 texels.
std::vector<std::string> sweep(const std::filesystem::path& out, const std::string& warps,
                               const std::string& cascades, const std::string& filters,
                               const std::string& size) {
  return {"compare",     "builtin:fence",
          "--warps",     warps,
          "--cascades",  cascades,
          "--filters",   filters,
          "--size",      size,
          "--frames",    "1",
          "--rounds",    "1",
          "--map-sizes", "64",
          "--context",   "osmesa",
          "--out",       out.string()};
}

TEST(CompareIrregular, is_a_technique_without_misclassified_pixels_and_with_its_price) {
  const TemporaryFolder folder;
  const Finished finished =
      run_gnomon(sweep(folder.path(), "none,optimal", "1,4", "hard,irregular", "96x54"));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path());
  ASSERT_EQ(rows.size(), 8u);
  std::uint64_t longest_unwarped = 0, longest_warped = 0;
  for (const report::Row& row : rows) {
    if (row.technique.filter == "hard") {
      EXPECT_GT(row.errors.false_lit + row.errors.false_shadow, 0.01) << row.technique.name();
      EXPECT_EQ(row.costs.lists.most, 0u);
      continue;
    }
    EXPECT_EQ(row.technique.filter, "irregular");
    EXPECT_EQ(row.truth, "hard");
    EXPECT_EQ(row.errors.false_lit, 0.0) << row.technique.name();
    EXPECT_EQ(row.errors.false_shadow, 0.0) << row.technique.name();
    EXPECT_EQ(row.errors.mean_error, 0.0) << row.technique.name();
    EXPECT_GT(row.errors.pixels, 500u);
    EXPECT_GT(row.times.depth_ms.median, 0.0);
    EXPECT_GT(row.times.shade_ms.median, 0.0);
    EXPECT_GE(row.costs.lists.mean, 1.0);
    EXPECT_GE(row.costs.lists.most, row.costs.lists.p99);
    EXPECT_EQ(row.costs.map_bytes, 4 * row.costs.texels + 16u * 96u * 54u);
    if (row.technique.cascades == 1)
      (row.technique.warp == "none" ? longest_unwarped : longest_warped) = row.costs.lists.most;
  }
  EXPECT_GT(longest_unwarped, 2 * longest_warped);
  std::ifstream fronts(folder.path() / "fronts.md");
  const std::string text{std::istreambuf_iterator<char>(fronts), {}};
  EXPECT_NE(text.find("irregular"), std::string::npos);
  const Finished refused = run_gnomon({"compare", "builtin:fence", "--filters", "irregular:radius=2"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("irregular"), std::string::npos) << refused.err;
}

TEST(CompareIrregular, samples_over_facets_are_measured_against_the_mean_over_facets) {
  const TemporaryFolder folder;
  const Finished finished =
      run_gnomon(sweep(folder.path(), "optimal", "1", "irregular,irregular:samples=8", "64x36"));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path());
  ASSERT_EQ(rows.size(), 2u);
  const report::Row& facets = rows[1];
  EXPECT_EQ(facets.technique.filter, "irregular:samples=8");
  EXPECT_EQ(facets.truth, "facet");
  EXPECT_GT(facets.errors.mean_error, 0.0);
  EXPECT_LT(facets.errors.mean_error, 1.0 / 8.0);
  EXPECT_EQ(facets.costs.map_bytes, 4 * facets.costs.texels + 8u * 16u * 64u * 36u);
  for (const char* word : {"irregular:samples=0", "irregular:samples=65", "irregular:samples=8x"}) {
    const Finished refused = run_gnomon({"compare", "builtin:fence", "--filters", word});
    EXPECT_EQ(refused.exit_code, 2) << word;
    EXPECT_NE(refused.err.find("N from 1 to 64"), std::string::npos) << refused.err;
  }
}

}  // namespace
}  // namespace gnomon::test
