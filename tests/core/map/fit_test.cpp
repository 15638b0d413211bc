// Is the stable map's square large enough for its slice from every side, and no larger than it must be?
#include "gnomon/options.hpp"
#include "gnomon/study/formulas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <utility>

#include "support/near.hpp"
#include "support/property.hpp"

namespace gnomon::test {
namespace {

constexpr double kRounding = 1e-12;

glm::dvec3 corner(const double (&edges)[4], bool orthographic, double depth, int i) {
  const double scale = orthographic ? 1.0 : depth;
  return {edges[i & 1] * scale, edges[2 + (i >> 1 & 1)] * scale, depth};
}

TEST(Fit, a_slice_of_no_depth_is_as_long_as_its_diagonal) {
  EXPECT_CLOSE(longest_chord(-3, 3, -4, 4, true, 5, 5), 10.0, kRounding);
  EXPECT_CLOSE(longest_chord(-0.3, 0.3, -0.4, 0.4, false, 10, 10), 10.0, kRounding);
}

TEST(Fit, a_long_narrow_slice_is_as_long_as_its_space_diagonal) {
  EXPECT_CLOSE(longest_chord(-0.5, 0.5, -0.5, 0.5, true, 0, 10), std::sqrt(102.0), kRounding);
}

TEST(Fit, names_are_printed_and_read_back) {
  constexpr std::pair<Fit, std::string_view> kNames[] = {{Fit::tight, "tight"},
                                                         {Fit::rotated, "rotated"},
                                                         {Fit::stable, "stable"},
                                                         {Fit::warped_stable, "warped_stable"}};
  for (const auto& [fit, name] : kNames) {
    EXPECT_EQ(to_string(fit), name);
    Fit found = fit == Fit::tight ? Fit::stable : Fit::tight;
    EXPECT_TRUE(fit_from_name(name, found)) << name;
    EXPECT_EQ(found, fit) << name;
  }
  Fit untouched = Fit::rotated;
  EXPECT_FALSE(fit_from_name("loose", untouched));
  EXPECT_EQ(untouched, Fit::rotated);
}

TEST(FitProperty, the_longest_chord_is_that_of_all_pairs_of_corners) {
  for_all(1000, [&] {
    const double left = between(-2, 1), bottom = between(-2, 1);
    const double edges[4] = {left, left + between(0.01, 3), bottom, bottom + between(0.01, 3)};
    const bool orthographic = chance(0.3);
    const double begin = between(0.0, 10.0), end = begin + between(0.0, 20.0);
    double longest = 0.0;
    for (int i = 0; i < 8; ++i) {
      for (int k = 0; k < 8; ++k) {
        longest = std::max(longest, glm::distance(corner(edges, orthographic, i < 4 ? begin : end, i),
                                                  corner(edges, orthographic, k < 4 ? begin : end, k)));
      }
    }
    const double chord = longest_chord(edges[0], edges[1], edges[2], edges[3], orthographic, begin, end);
    require(deviation(chord, longest) <= kRounding, "chord", chord, "all pairs", longest);
  });
}

}  // namespace
}  // namespace gnomon::test
