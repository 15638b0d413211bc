// Do the cascades' borders, bounding spheres and texel indices match the golden tables?
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/study/dpds.hpp"
#include "gnomon/study/formulas.hpp"
#include "support/golden.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

// A power and a blend in double.
constexpr double kSplit = 1e-12;

void expect_edges(const Json& row, const SplitOptions& options) {
  const Json& expected = row.at("C");
  std::vector<double> edges(expected.size());
  split_depths(row.at("zn"), row.at("zf"), options, edges);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_CLOSE(edges[i], number(expected[i]), kSplit) << row.dump().substr(0, 60);
  }
}

TEST(SplitGolden, practical_splits_match_the_table_with_their_errors) {
  const Json& rows = golden("splits").at("practical");
  EXPECT_EQ(rows.size(), 160u);
  for (const Json& row : rows) {
    const double lambda = row.at("lam");
    expect_edges(row, {SplitScheme::practical, lambda, 0.0});
    if (lambda == 0.0) expect_edges(row, {SplitScheme::uniform, 0.5, 0.0});
    if (lambda == 1.0) expect_edges(row, {SplitScheme::logarithmic, 0.5, 0.0});
    const Json &edges = row.at("C"), &errors = row.at("dpds_t_max_per_split");
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double a = number(edges[i]), b = number(edges[i + 1]);
      // Border and error are both rounded in the table: the difference of borders loses what they share.
      EXPECT_CLOSE(dpds::uniform(a, a, b), number(errors[i]), 1e-10);
    }
  }
}

TEST(SplitGolden, pseudo_near_splits_match_the_table) {
  const Json& rows = golden("splits").at("pseudo_near");
  EXPECT_GT(rows.size(), 10u);
  for (const Json& row : rows) expect_edges(row, {SplitScheme::pseudo_near, 0.0, number(row.at("n_pseudo"))});
}

TEST(SplitGolden, texel_indices_are_exact_ten_thousand_kilometres_away) {
  for (const Json& row : golden("extra").at("snap")) {
    const double centre = row.at("center"), texel = row.at("texel");
    // The table rounds down, snap_index to the nearest: half a texel apart.
    EXPECT_EQ(snap_index(centre - 0.5 * texel, texel), row.at("snapped_index").get<std::int64_t>());
    EXPECT_LE(std::abs(static_cast<double>(snap_index(centre, texel)) * texel - centre),
              0.5 * texel * (1.0 + 1e-6));
  }
}

}  // namespace
}  // namespace gnomon::test
