// What does each page policy spend texels on?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include "gnomon/pages.hpp"
#include "pages/street.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

TEST(Pages, clipmap_levels_are_octaves_of_square_texels) {
  Street street;
  street.options.policy = &page_policies::clipmap;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  ASSERT_GT(plan.levels.size(), 2u);
  for (const ShadowMap& level : plan.levels) {
    EXPECT_NEAR(level.texel_world.x, level.texel_world.y, 1e-12 * level.texel_world.x);
    EXPECT_EQ(level.snap_key.texel.x, level.snap_key.texel.y);
    const double octave = std::log2(level.snap_key.texel.x);
    EXPECT_NEAR(octave, std::round(octave), 1e-12);
  }
  street.options.policy = &page_policies::resolution;
  std::vector<std::byte> other(page_memory(4096, 1 << 14));
  EXPECT_LT(street.plan(other).pages.size(), plan.pages.size());
}

TEST(Pages, edges_spend_texels_at_shadow_edges_alone) {
  Street street;
  street.options.policy = &page_policies::edges;
  street.feedback.assign(street.points.size(), 0);
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const std::size_t none = street.plan(memory).pages.size();
  for (std::size_t i = 1000; i < 1200; ++i) street.feedback[i] = kShadowEdge | kDepthEdge;
  const PagePlan plan = street.plan(memory);
  EXPECT_GT(plan.pages.size(), none);
  for (std::size_t i = 0; i < street.points.size(); ++i) {
    const Page& page = plan.pages[static_cast<std::size_t>(page_serving(plan, street.points[i]))];
    const PointAliasing m = measure_perspective(plan.levels[page.level], street.camera, street.points[i]);
    EXPECT_LE(std::max(m.m_s, m.m_t), (street.feedback[i] != 0 ? 1.0 : 8.0) + 1e-5);
  }
  street.options.policy = &page_policies::resolution;
  EXPECT_GT(street.plan(memory).pages.size(), 2 * plan.pages.size());
}

/// The larger of m_s and m_t at a place, in the page that serves it.
double error_at(const Street& street, const PagePlan& plan, const glm::dvec3& place) {
  const int page = page_serving(plan, place);
  EXPECT_GE(page, 0);
  if (page < 0) return std::numeric_limits<double>::infinity();
  const ShadowMap& level = plan.levels[plan.pages[static_cast<std::size_t>(page)].level];
  const PointAliasing m = measure_perspective(level, street.camera, place);
  return std::max(m.m_s, m.m_t);
}

/// Sum over the points at shadow edges.
double error_at_edges(const Street& street, const PagePlan& plan) {
  double sum = 0.0;
  for (std::size_t i = 0; i < street.points.size(); ++i) {
    if ((street.feedback[i] & kShadowEdge) != 0) sum += error_at(street, plan, street.points[i]);
  }
  return sum;
}

TEST(Pages, picture_leaves_the_least_error_at_edges_in_a_pool_that_is_too_small) {
  Street street;
  street.points.clear();
  // A wide ground, whose far half has few points to a page, and edges in stripes across it.
  for (int row = 0; row < 100; ++row) {
    for (int column = 0; column < 60; ++column)
      street.points.push_back({-18.0 + 0.6 * column, 0.0, -4.0 - 0.02 * row * row});
  }
  street.feedback.assign(street.points.size(), 0);
  for (std::size_t i = 0; i < street.points.size(); ++i)
    street.feedback[i] = i / 60 % 25 < 3 ? kShadowEdge : 0;
  street.options.page_texels = 64;
  street.options.target_m = 0.1;
  for (const int capacity : {12, 40, 150}) {
    street.options.capacity = capacity;
    std::vector<std::byte> memory(page_memory(capacity, street.points.size()));
    const auto error_by = [&](const PagePolicy& policy) {
      street.options.policy = &policy;
      const PagePlan plan = street.plan(memory);
      EXPECT_EQ(plan.status, PlanStatus::ok);
      EXPECT_LE(plan.pages.size(), static_cast<std::size_t>(capacity));
      return error_at_edges(street, plan);
    };
    const double picture = error_by(page_policies::picture);
    EXPECT_LT(picture, 0.7 * error_by(page_policies::resolution)) << capacity;
    EXPECT_LT(picture, 0.8 * error_by(page_policies::edges)) << capacity;
  }
}

TEST(Pages, picture_gives_points_that_lie_together_the_finest_page_that_holds_them) {
  // Thirty edges that a page of less than half the error holds each, and ground without an edge.
  Street street;
  street.points.clear();
  constexpr int kEdges = 30, kPointsOfEdge = 9;
  for (int edge = 0; edge < kEdges; ++edge) {
    for (int i = 0; i < kPointsOfEdge; ++i)
      street.points.push_back(
          {-9.0 + 3.7 * (edge % 6) + 0.013 * (i % 3), 0.0, -10.0 - 3.3 * (edge / 6) - 0.03 * (i / 3)});
  }
  street.feedback.assign(street.points.size(), kShadowEdge);
  for (int i = 0; i < 3000; ++i)
    street.points.push_back({-10.0 + 0.4 * (i % 50), 0.0, -8.0 - 0.4 * (i / 50)});
  street.feedback.resize(street.points.size(), 0);
  street.options.page_texels = 64;
  street.options.target_m = 0.1;
  street.options.capacity = kEdges + 10;
  std::vector<std::byte> memory(page_memory(street.options.capacity, street.points.size()));
  const auto error_by = [&](const PagePolicy& policy) {
    street.options.policy = &policy;
    return error_at_edges(street, street.plan(memory)) / (kEdges * kPointsOfEdge);
  };
  EXPECT_LT(error_by(page_policies::picture), 0.5 * error_by(page_policies::edges));
}

TEST(Pages, picture_opens_pages_for_the_pixels_between_points_at_edges) {
  // Ground at every twelfth pixel of some rows, with edges that run across.
  constexpr int kColumns = 40, kRows = 40;
  constexpr double kPixels = 12.0;
  Street street;
  const double spacing = kPixels * (street.camera.right - street.camera.left) / street.camera.width;
  street.points.clear();
  for (int row = 0; row < kRows; ++row) {
    const double depth = 8.0 + 0.4 * row + 0.02 * row * row;
    for (int column = 0; column < kColumns; ++column)
      street.points.push_back({(column - 0.5 * (kColumns - 1)) * spacing * depth, 0.0, -depth});
  }
  street.feedback.assign(street.points.size(), 0);
  for (std::size_t i = 0; i < street.points.size(); ++i)
    street.feedback[i] = (i % kColumns + i / kColumns) % 9 == 0 ? kShadowEdge : 0;
  street.options.fallback = true;
  street.options.page_texels = 64;
  street.options.target_m = 0.2;
  street.options.capacity = 1000;
  std::vector<std::byte> memory(page_memory(street.options.capacity, street.points.size()));
  const auto errors_beside = [&](const PagePolicy& policy) {
    street.options.policy = &policy;
    const PagePlan plan = street.plan(memory);
    std::vector<double> errors;
    for (std::size_t i = 0; i < street.points.size(); ++i) {
      if (street.feedback[i] == 0) continue;
      const glm::dvec3& point = street.points[i];
      for (const double side : {-0.25, 0.25})
        errors.push_back(error_at(street, plan, point + glm::dvec3(side * spacing * -point.z, 0.0, 0.0)));
    }
    return errors;
  };
  const auto sum = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
  const std::vector<double> picture = errors_beside(page_policies::picture);
  ASSERT_GT(picture.size(), 300u);
  // The coarsest level, where a page ends between two points, has an error of 280. Samples at the points
  // alone come to 0.57 of the sum by edges.
  EXPECT_LT(*std::max_element(picture.begin(), picture.end()), 4.0);
  EXPECT_LT(sum(picture), 0.53 * sum(errors_beside(page_policies::edges)));
}

TEST(Pages, picture_counts_the_points_of_all_places_that_open_a_page) {
  Street street;
  street.feedback.assign(street.points.size(), 0);
  street.options.policy = &page_policies::picture;
  std::vector<std::byte> memory(page_memory(street.options.capacity, street.points.size()));
  const PagePlan plan = street.plan(memory);
  std::vector<std::uint32_t> served(plan.pages.size());
  for (const glm::dvec3& point : street.points) {
    const int page = page_serving(plan, point);
    ASSERT_GE(page, 0);
    ++served[static_cast<std::size_t>(page)];
  }
  // A few points lie in a page that others have opened, and would do with a coarser one.
  std::size_t uncounted = 0;
  for (std::size_t i = 0; i < served.size(); ++i)
    uncounted += served[i] > plan.pages[i].points ? served[i] - plan.pages[i].points : 0;
  EXPECT_LT(uncounted, street.points.size() / 100);
}

TEST(Pages, picture_gives_all_points_the_target_where_the_pool_suffices) {
  Street street;
  street.feedback.assign(street.points.size(), 0);
  for (std::size_t i = 0; i < street.points.size(); i += 7) street.feedback[i] = kShadowEdge;
  street.options.policy = &page_policies::picture;
  for (const Fit fit : {Fit::tight, Fit::stable}) {
    street.options.plan.fit = fit;
    std::vector<std::byte> memory(page_memory(street.options.capacity, street.points.size()));
    const PagePlan plan = street.plan(memory);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    EXPECT_EQ(plan.target_m, street.options.target_m);
    std::set<std::tuple<std::uint32_t, int, int>> pages;
    for (const Page& page : plan.pages) pages.emplace(page.level, page.column, page.row);
    EXPECT_EQ(pages.size(), plan.pages.size()) << "a page is there twice";
    // Needs are rounded up to floats.
    constexpr double kRounding = 1e-5;
    for (const glm::dvec3& point : street.points) ASSERT_LE(error_at(street, plan, point), 1.0 + kRounding);
  }
}

TEST(Pages, picture_takes_no_more_samples_than_it_has_room_for) {
  // Shadow edges at just those points that the policy takes to stand for all.
  Street street;
  street.points.clear();
  for (int i = 0; i < 90000; ++i)
    street.points.push_back({-19.0 + 0.1 * (i % 380), 0.0, -2.0 - 0.8 * (i / 380)});
  street.feedback.assign(street.points.size(), 0);
  std::size_t edges = 0;
  for (std::size_t i = 0; i < street.points.size() && edges < 39000; ++i) {
    if (static_cast<std::uint32_t>(i) * 0x9E3779B1u > 0xFFFFFFFFu / 2u) continue;
    street.feedback[i] = kShadowEdge;
    ++edges;
  }
  ASSERT_EQ(edges, 39000u);
  street.options.policy = &page_policies::picture;
  street.options.page_texels = 64;
  street.options.target_m = 1e-3;
  street.options.capacity = 60;
  std::vector<std::byte> memory(page_memory(60, street.points.size()));
  const PagePlan plan = street.plan(memory);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  for (std::size_t i = 0; i < street.points.size(); i += 500)
    EXPECT_GE(page_serving(plan, street.points[i]), 0);
}

TEST(Pages, queried_refines_by_an_octave_where_the_picture_changed) {
  Street street;
  street.options.policy = &page_policies::queried;
  street.options.plan.fit = Fit::stable;  // the same grids in every frame
  std::vector<std::byte> memory[2] = {std::vector<std::byte>(page_memory(4096, 1 << 14)),
                                      std::vector<std::byte>(page_memory(4096, 1 << 14))};
  const PagePlan first = street.plan(memory[0]);
  ASSERT_EQ(first.status, PlanStatus::ok);
  street.last = &first;
  street.feedback.assign(street.points.size(), 0);
  const PagePlan unchanged = street.plan(memory[1]);
  EXPECT_EQ(unchanged.pages.size(), first.pages.size());
  for (std::size_t i = 0; i < 500; ++i) street.feedback[i] = kShadowChanged;
  const PagePlan refined = street.plan(memory[1]);
  const auto texel = [](const PagePlan& plan, const glm::dvec3& point) {
    return plan.levels[plan.pages[static_cast<std::size_t>(page_serving(plan, point))].level].texel_world.x;
  };
  EXPECT_NEAR(texel(refined, street.points[100]), 0.5 * texel(first, street.points[100]), 1e-9);
  EXPECT_NEAR(texel(refined, street.points[3999]), texel(first, street.points[3999]), 1e-9);
}

TEST(Pages, tiled_gives_more_of_the_pool_to_tiles_with_depth_edges) {
  Street street;
  street.options.policy = &page_policies::tiled;
  street.options.capacity = 200;
  std::vector<std::byte> memory(page_memory(200, 1 << 14));
  street.feedback.assign(street.points.size(), 0);
  const PagePlan even = street.plan(memory);
  ASSERT_EQ(even.status, PlanStatus::ok);
  EXPECT_LE(even.pages.size(), 200u);
  const auto texel = [&](const PagePlan& plan, std::size_t i) {
    return plan.levels[plan.pages[static_cast<std::size_t>(page_serving(plan, street.points[i]))].level]
        .texel_world.x;
  };
  const double before = texel(even, 3900);
  for (std::size_t i = 3500; i < 4000; ++i) street.feedback[i] = kDepthEdge;
  EXPECT_LT(texel(street.plan(memory), 3900), before);
}

TEST(Pages, options_that_a_policy_has_no_use_for_change_nothing_and_are_named) {
  for (const PagePolicy* policy : all_page_policies()) {
    Street street;
    street.options.policy = policy;
    street.options.capacity = 200;
    street.feedback.assign(street.points.size(), 0);
    for (std::size_t i = 0; i < street.points.size(); i += 5) street.feedback[i] = kShadowEdge | kDepthEdge;
    std::vector<std::byte> memory(page_memory(4096, 1 << 14)), other(page_memory(4096, 1 << 14));
    const PagePlan plain = street.plan(memory);
    street.options.share = 0.6;
    street.options.reach_texels = 40.0;
    const PagePlan plan = street.plan(other);
    const auto names = [&](IgnoredOption option) {
      const std::span<const Omission> omitted = plan.omitted();
      return std::any_of(omitted.begin(), omitted.end(), [&](const Omission& o) {
        return o.kind == OmissionKind::option_ignored && o.a == static_cast<double>(option);
      });
    };
    EXPECT_EQ(names(IgnoredOption::page_share), policy->chooses) << policy->name;
    EXPECT_EQ(names(IgnoredOption::page_reach), policy->chooses) << policy->name;
    const auto same = [](const Page& a, const Page& b) {
      return a.level == b.level && a.column == b.column && a.row == b.row;
    };
    const bool equal =
        std::equal(plain.pages.begin(), plain.pages.end(), plan.pages.begin(), plan.pages.end(), same);
    EXPECT_EQ(equal && plain.target_m == plan.target_m, policy->chooses) << policy->name;
  }
}

TEST(Pages, names_find_their_policies) {
  EXPECT_FALSE(all_page_policies().empty());
  for (const PagePolicy* policy : all_page_policies()) {
    EXPECT_EQ(find_page_policy(policy->name), policy);
    EXPECT_FALSE(policy->summary.empty());
  }
  EXPECT_EQ(find_page_policy("none"), nullptr);
}

}  // namespace
}  // namespace gnomon::test
