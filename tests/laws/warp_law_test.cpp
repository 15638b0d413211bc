// What every warp in the registry must do: answer with a usable strength and never make its objective worse.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <vector>

#include "gnomon/extend/body.hpp"
#include "gnomon/extend/warp.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// Rounding of a product of maxima.
constexpr double kRounding = 1e-9;

TEST(WarpLaw, the_registry_has_none_first_and_finds_every_entry_by_its_name) {
  ASSERT_FALSE(all_warps().empty());
  EXPECT_EQ(all_warps()[0], &warps::none);
  std::set<std::string_view> names;
  for (const Warp* warp : all_warps()) {
    EXPECT_TRUE(names.insert(warp->name).second) << warp->name;
    EXPECT_EQ(find_warp(warp->name), warp);
    EXPECT_FALSE(warp->summary.empty()) << warp->name;
    EXPECT_NE(warp->choose, nullptr) << warp->name;
  }
  EXPECT_EQ(find_warp("no_such_warp"), nullptr);
  EXPECT_EQ(find_warp(""), nullptr);
}

/// One large receiver that casts its own shadow: the body is what is measured, with no empty space in it.
Case draw_single_receiver() {
  Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 1});
  const double f = c.camera.far_depth;
  const glm::dvec3 at = point_at(c.camera, between(-1, 1), between(-1, 1), f * unit());
  const glm::dvec3 half =
      f * glm::dvec3(std::exp2(between(-4, 2)), std::exp2(between(-6, 2)), std::exp2(between(-4, 2)));
  c.receivers = c.casters = {{at - half, at + half}};
  c.options.fit = Fit::tight;
  c.options.cascades = 1;
  c.options.split.pseudo_near = 0.0;
  return c;
}

double measured(const AliasingStats& stats, Objective objective) {
  if (objective == Objective::storage) return stats.storage;
  return objective == Objective::max ? stats.max : stats.p95;
}

// A warp is judged at a few hundred points of the body, and LiSPSM's by weights that leave out the angle to
// the image's axis; the grid measures all of it at other points.
constexpr double kJudged = 1.15;
// By p95 at 96 points: the most that was found is 1.21 (seed 944431).
constexpr double kJudgedAtPercentile = 1.25;

TEST(WarpLaw, no_warp_that_may_be_dropped_makes_its_objective_worse_than_no_warp_when_measured) {
  // A body that shows in a few rays of the first grid may hide its worst corner from it: only what the second
  // grid shows, too, counts against a warp.
  constexpr MeasureOptions kGrid{20, 20, 32}, kFine{100, 100, 100};
  constexpr std::uint64_t kEnough = 400;
  std::uint64_t warped = 0;
  std::array<double, 3> worst{};
  for_all(700, [&] {
    Case c = draw_single_receiver();
    RC_LOG() << c;
    c.options.warp.warp = &warps::none;
    c.options.prune = kPruneNothing;  // maps of one size
    const ShadowPlan uniform = c.plan();
    const AliasingStats without = measure(uniform, c.camera, c.bounds(), kGrid);
    if (without.samples < kEnough) return;
    for (const Warp* warp : all_warps()) {
      if (!warp->drop_without_gain) continue;
      c.options.warp.warp = warp;
      const ShadowPlan plan = c.plan();
      if (plan.map_count == 0 || plan.map[0].kappa == 0.0) continue;
      ++warped;
      const auto measured_by = [&](const ShadowPlan& p, const MeasureOptions& grid) {
        return measured(measure(p, c.camera, c.bounds(), grid), c.options.warp.objective);
      };
      double after = measured_by(plan, kGrid), before = measured(without, c.options.warp.objective);
      const double judged = c.options.warp.objective == Objective::p95 ? kJudgedAtPercentile : kJudged;
      if (!(after <= before * judged)) {
        after = measured_by(plan, kFine);
        before = measured_by(uniform, kFine);
      }
      double& so_far = worst[static_cast<std::size_t>(c.options.warp.objective)];
      so_far = std::max(so_far, after / before);
      require(after <= before * judged, warp->name, to_string(c.options.warp.objective), after, "without",
              before, "kappa", plan.map[0].kappa);
    }
  });
  EXPECT_GT(warped, of_all_draws(500));
  // What the suite's own cases show at worst, by p95, which is judged at 96 points; other seeds draw others.
  constexpr double kWorstOfSuite = 1.08;
  if (!seed_is_given()) {
    for (const double ratio : worst) EXPECT_LE(ratio, kWorstOfSuite);
  }
}

TEST(WarpLaw, a_map_names_the_warp_that_was_used_and_dropped_warps_are_reported) {
  std::uint64_t kept = 0, dropped = 0;
  for_all(600, [&] {
    Case c = draw_case();
    c.options.fit = Fit::tight;
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    for (const ShadowMap& map : plan.maps()) {
      // The other way round a warp may slant the map alone, with kappa 0.
      require(map.warp != &warps::none || map.kappa == 0.0, "none with kappa", map.kappa);
      if (map.warp != &warps::none || c.options.warp.warp == &warps::none) continue;
      bool told = plan.omission_count > kMaxOmissions;
      for (const Omission& o : plan.omitted()) {
        told = told || (o.kind == OmissionKind::warp_without_gain && (o.map == map.cascade || o.map == -1));
      }
      require(told, "warp dropped from cascade", map.cascade, "without a word");
      ++dropped;
    }
    for (const ShadowMap& map : plan.maps()) kept += map.kappa > 0.0;
  });
  EXPECT_GT(kept, of_all_draws(300));
  EXPECT_GT(dropped, of_all_draws(100));
}

/// A frustum's profile in the light frame: four corners of the slice [n, f] in the plane of view and light,
/// each with its left and right edge.
std::vector<WarpInput::Point> profile(double n, double f, double tan_half, double gamma) {
  std::vector<WarpInput::Point> points;
  for (const double z : {n, f}) {
    for (const double side : {-1.0, 1.0}) {
      const double y = z * (std::sin(gamma) + side * tan_half * std::cos(gamma));
      const double height = z * (-std::cos(gamma) + side * tan_half * std::sin(gamma));
      points.push_back({-0.5 * z, y, height, z});
      points.push_back({0.5 * z, y, height, z});
    }
  }
  return points;
}

TEST(WarpLaw, every_warp_returns_a_finite_strength_that_is_not_negative_for_any_body) {
  for_all(3000, [&] {
    std::vector<WarpInput::Point> body;
    const double scale = std::exp2(between(-60.0, 60.0));
    const int count = 1 + pick(20);
    for (int i = 0; i < count; ++i) {
      const double depth = std::exp2(between(-20.0, 20.0));
      body.push_back({between(-1, 1) * scale * depth, chance(0.2) ? 0.0 : between(-1, 1) * scale * depth,
                      between(-1, 1) * scale * depth, scale * depth});
    }
    WarpInput in{};
    in.body = body;
    in.y_min = in.y_max = body[0].y;
    in.depth_begin = in.depth_end = body[0].depth;
    for (const WarpInput::Point& p : body) {
      in.y_min = std::min(in.y_min, p.y);
      in.y_max = std::max(in.y_max, p.y);
      in.depth_begin = std::min(in.depth_begin, p.depth);
      in.depth_end = std::max(in.depth_end, p.depth);
    }
    const double gamma = chance(0.2) ? 0.0 : between(0.0, 3.141592653589793);
    in.sin_gamma = std::abs(std::sin(gamma));
    in.cos_gamma = std::cos(gamma);
    in.tan_half_fov = between(1e-3, 10.0);
    in.orthographic = chance(0.1);
    in.objective = static_cast<Objective>(pick(3));
    // A body that is its own bounding box: what a search over faces and edges walks on.
    Box box;
    for (const WarpInput::Point& p : body) box.extend({p.x, p.y, p.z});
    const Polytope polytope = box_polytope(box);
    in.polytope = &polytope;
    in.view = {{1, 0, 0},
               {0, std::abs(in.cos_gamma), in.sin_gamma},
               {0, in.sin_gamma, -in.cos_gamma},
               -1.0,
               1.0,
               -1.0,
               1.0,
               2.0 / 640,
               2.0 / 480};
    for (const Warp* warp : all_warps()) {
      const double kappa = warp->choose(in).kappa;
      require(kappa >= 0.0 && std::isfinite(kappa), warp->name, "kappa", kappa);
      require(!in.orthographic || kappa == 0.0, warp->name, "warps an orthographic camera");
      if (kappa == 0.0) continue;
      const WarpError error = warp_error(in, kappa);
      require(std::isfinite(error.m_s) && std::isfinite(error.m_t), warp->name, "error", error.m_s,
              error.m_t);
    }
  });
}

TEST(WarpLaw, the_vertex_bound_is_reached_by_no_inner_point_of_the_body) {
  for_all(500, [&] {
    const double n = std::exp2(between(-3.0, 3.0)), f = n * (1.0 + std::exp2(between(-3.0, 12.0)));
    const auto corners = profile(n, f, between(0.05, 2.0), between(0.01, 3.13));
    WarpInput in{};
    in.body = corners;
    in.y_min = in.y_max = corners[0].y;
    for (const WarpInput::Point& p : corners) {
      in.y_min = std::min(in.y_min, p.y);
      in.y_max = std::max(in.y_max, p.y);
    }
    const double length = in.y_max - in.y_min;
    const double kappa = std::exp2(between(-10.0, 10.0)) / length;
    const WarpError bound = warp_error(in, kappa);
    double left = 1e300, right = -1e300, across = 0.0, along = 0.0;
    for (int i = 0; i < 100; ++i) {
      double x = 0.0, y = 0.0, z = 0.0, total = 0.0;
      for (const WarpInput::Point& p : corners) {
        const double weight = unit();
        x += weight * p.x;
        y += weight * p.y;
        z += weight * p.depth;
        total += weight;
      }
      if (!(total > 0.0)) continue;
      x /= total, y /= total, z /= total;
      const double w = 1.0 + kappa * (y - in.y_min);
      left = std::min(left, x / w);
      right = std::max(right, x / w);
      across = std::max(across, w / z);
      along = std::max(along, w * w / z);
    }
    require((right - left) * across <= bound.m_s * (1.0 + kRounding), "m_s inside", (right - left) * across,
            "bound", bound.m_s);
    require(along * length / (1.0 + kappa * length) <= bound.m_t * (1.0 + kRounding), "m_t inside",
            along * length / (1.0 + kappa * length), "bound", bound.m_t);
  });
}

}  // namespace
}  // namespace gnomon::test
