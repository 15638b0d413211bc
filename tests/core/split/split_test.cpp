// Are the borders of the cascades where the scheme says, whatever it is given?
#include "gnomon/options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "gnomon/study/formulas.hpp"
#include "support/near.hpp"
#include "support/property.hpp"

namespace gnomon::test {
namespace {

constexpr double kRounding = 1e-13;
constexpr SplitScheme kSchemes[] = {
    SplitScheme::uniform, SplitScheme::logarithmic, SplitScheme::practical, SplitScheme::pseudo_near,
    SplitScheme::optimal, SplitScheme::automatic,   SplitScheme::given};

std::vector<double> edges_of(double n, double f, const SplitOptions& options, std::size_t maps) {
  std::vector<double> edges(maps + 1, -1.0);
  split_depths(n, f, options, edges);
  return edges;
}

TEST(Split, equal_depths_give_equal_edges) {
  for (const SplitScheme scheme : kSchemes) {
    for (const double edge : edges_of(3.0, 3.0, {scheme, 0.5, 3.0}, 4)) EXPECT_EQ(edge, 3.0);
  }
}

TEST(Split, a_near_depth_of_zero_or_less_falls_back_to_even_shares) {
  for (const double n : {0.0, -4.0}) {
    const auto edges = edges_of(n, n + 8.0, {SplitScheme::logarithmic, 1.0, 0.0}, 4);
    for (std::size_t i = 0; i < edges.size(); ++i) EXPECT_EQ(edges[i], n + 2.0 * static_cast<double>(i));
  }
}

TEST(Split, given_borders_are_kept_inside_the_range) {
  SplitOptions given{SplitScheme::given};
  given.given = {0.5, 20.0, 2000.0};
  const auto edges = edges_of(1.0, 100.0, given, 4);
  EXPECT_EQ(edges, (std::vector<double>{1.0, 1.0, 20.0, 100.0, 100.0}));
  // Missing ones leave the last maps nothing.
  given.given = SplitOptions::endless_splits();
  given.given[0] = 0.5;
  const auto few = edges_of(-2.0, 100.0, given, 3);
  EXPECT_EQ(few, (std::vector<double>{-2.0, 0.5, 100.0, 100.0}));
}

TEST(Split, no_edges_are_no_work) {
  split_depths(1.0, 2.0, {}, {});
  const auto one = edges_of(1.0, 2.0, {}, 1);
  EXPECT_EQ(one, (std::vector<double>{1.0, 2.0}));
}

TEST(Split, logarithmic_borders_have_equal_ratios_and_uniform_ones_equal_steps) {
  const auto log = edges_of(1.0, 1000.0, {SplitScheme::logarithmic, 0.0, 0.0}, 3);
  EXPECT_CLOSE(log[1], 10.0, kRounding);
  EXPECT_CLOSE(log[2], 100.0, kRounding);
  const auto even = edges_of(1.0, 4.0, {SplitScheme::uniform, 1.0, 0.0}, 3);
  EXPECT_CLOSE(even[1], 2.0, kRounding);
  EXPECT_CLOSE(even[2], 3.0, kRounding);
}

TEST(Split, a_blend_that_is_no_number_counts_as_a_half_and_others_are_clamped) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(edges_of(1, 100, {SplitScheme::practical, nan, 0}, 4),
            edges_of(1, 100, {SplitScheme::practical, 0.5, 0}, 4));
  EXPECT_EQ(edges_of(1, 100, {SplitScheme::practical, 7.0, 0}, 4),
            edges_of(1, 100, {SplitScheme::logarithmic, 0, 0}, 4));
  EXPECT_EQ(edges_of(1, 100, {SplitScheme::practical, -1.0, 0}, 4),
            edges_of(1, 100, {SplitScheme::uniform, 0, 0}, 4));
}

TEST(Split, every_scheme_has_the_name_that_case_files_use) {
  constexpr std::pair<SplitScheme, std::string_view> kNames[] = {
      {SplitScheme::uniform, "uniform"},     {SplitScheme::logarithmic, "logarithmic"},
      {SplitScheme::practical, "practical"}, {SplitScheme::pseudo_near, "pseudo_near"},
      {SplitScheme::optimal, "optimal"},     {SplitScheme::automatic, "auto"},
      {SplitScheme::given, "given"}};
  for (const auto& [scheme, name] : kNames) {
    EXPECT_EQ(to_string(scheme), name);
    SplitScheme found = scheme == SplitScheme::uniform ? SplitScheme::given : SplitScheme::uniform;
    EXPECT_TRUE(split_scheme_from_name(name, found)) << name;
    EXPECT_EQ(found, scheme) << name;
  }
}

TEST(Split, every_partition_has_the_name_that_case_files_use) {
  constexpr std::pair<Partition, std::string_view> kNames[] = {
      {Partition::view_depth, "view_depth"},
      {Partition::frustum_faces, "frustum_faces"},
      {Partition::separating_plane, "separating_plane"},
      {Partition::tetrahedron, "tetrahedron"},
      {Partition::receiver_clusters, "receiver_clusters"}};
  for (const auto& [partition, name] : kNames) {
    EXPECT_EQ(to_string(partition), name);
    Partition found = partition == Partition::view_depth ? Partition::frustum_faces : Partition::view_depth;
    EXPECT_TRUE(partition_from_name(name, found)) << name;
    EXPECT_EQ(found, partition) << name;
  }
}

TEST(Split, names_lead_back_to_their_schemes) {
  for (const SplitScheme scheme : kSchemes) {
    SplitScheme found{};
    EXPECT_TRUE(split_scheme_from_name(to_string(scheme), found));
    EXPECT_EQ(found, scheme);
  }
  SplitScheme untouched = SplitScheme::uniform;
  EXPECT_FALSE(split_scheme_from_name("evenly", untouched));
  EXPECT_EQ(untouched, SplitScheme::uniform);
}

TEST(SplitProperty, borders_ascend_from_exactly_near_to_exactly_far) {
  for_all(2000, [&] {
    const double n = std::exp2(between(-60.0, 60.0)), f = n * (1.0 + std::exp2(between(-50.0, 30.0)));
    const SplitOptions options{static_cast<SplitScheme>(pick(5)), between(-0.5, 1.5),
                               n * std::exp2(between(-5.0, 35.0))};
    const auto edges = edges_of(n, f, options, static_cast<std::size_t>(1 + pick(16)));
    require(edges.front() == n && edges.back() == f, "ends", edges.front(), edges.back());
    require(std::is_sorted(edges.begin(), edges.end()), "not ascending");
  });
}

}  // namespace
}  // namespace gnomon::test
