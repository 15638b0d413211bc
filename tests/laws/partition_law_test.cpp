// Do the parts of a partition cover every visible receiver, keep its casters, and never cost more than one
// map?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr std::array kDivided = {Partition::frustum_faces, Partition::separating_plane,
                                 Partition::receiver_clusters};

Case draw_divided() {
  Case c = draw_case();
  c.options.fit = chance(0.3) ? Fit::rotated : Fit::tight;
  c.options.split.partition = kDivided[static_cast<std::size_t>(pick(3))];
  c.options.split.face_slices = 1 + pick(kMaxMaps);
  return c;
}

/// The part whose planes the point is inside, whatever its map holds.
bool inside_planes(const ShadowMap& map, const glm::dvec3& point) {
  for (int i = 0; i < map.select_plane_count; ++i) {
    const glm::dvec4& plane = map.select_planes[static_cast<std::size_t>(i)];
    if (glm::dot(glm::dvec3(plane), point) + plane.w < 0.0) return false;
  }
  return true;
}

bool told(const ShadowPlan& plan, OmissionKind kind) {
  const auto list = plan.omitted();
  return std::any_of(list.begin(), list.end(), [&](const Omission& o) { return o.kind == kind; });
}

TEST(PartitionLaw, the_first_map_whose_planes_hold_a_visible_receiver_point_shows_it) {
  int divided = 0;
  for_all(600, [&] {
    const Case c = draw_divided();
    RC_LOG() << c << to_string(c.options.split.partition) << " slices " << c.options.split.face_slices;
    const ShadowPlan plan = c.plan();
    if (plan.status != PlanStatus::ok || plan.selection == MapSelection::view_depth) return;
    ++divided;
    Random random(7);
    for (const glm::dvec3& point : visible_points(c, random, 6, 12)) {
      const auto maps = plan.maps();
      const auto first = std::find_if(maps.begin(), maps.end(),
                                      [&](const ShadowMap& map) { return inside_planes(map, point); });
      if (first == maps.end()) {
        require(told(plan, OmissionKind::part_without_caster), "held by no part", point.x, point.y, point.z);
        continue;
      }
      require(map_serving(plan, point, depth_of(c.camera, point)) == first - maps.begin(), "not shown by map",
              first - maps.begin(), "of", maps.size(), "at", point.x, point.y, point.z);
    }
  });
  EXPECT_GT(divided, of_all_draws(100));
}

TEST(PartitionLaw, a_caster_between_a_receiver_and_the_light_is_in_the_list_of_the_map_that_serves_it) {
  int shadowed = 0;
  for_all(400, [&] {
    const Case c = draw_divided();
    RC_LOG() << c << to_string(c.options.split.partition);
    const ShadowPlan plan = c.plan();
    // What is not divided is held by the laws of cascades.
    if (plan.selection == MapSelection::view_depth) return;
    Random random(11);
    std::vector<std::uint32_t> list(c.casters.size());
    for (const glm::dvec3& point : visible_points(c, random, 4, 6)) {
      const int index = map_serving(plan, point, depth_of(c.camera, point));
      std::size_t count = 0;
      if (index >= 0) count = cull_casters(plan.map[static_cast<std::size_t>(index)], c.casters, list);
      for (std::size_t k = 0; k < c.casters.size(); ++k) {
        const Crossing crossing = cross(c.casters[k], point, -plan.light_direction);
        // A caster that is only touched may be lost to rounding.
        if (!crossing.hits || !(crossing.leave > 1e-6 * c.camera.far_depth)) continue;
        if (!(crossing.leave - std::max(crossing.enter, 0.0) > 1e-6 * c.camera.far_depth)) continue;
        ++shadowed;
        const auto end = list.begin() + static_cast<std::ptrdiff_t>(count);
        require(std::find(list.begin(), end, static_cast<std::uint32_t>(k)) != end, "caster", k,
                "lost by map", index, "for", point.x, point.y, point.z);
      }
    }
  });
  EXPECT_GT(shadowed, of_all_draws(1000));
}

TEST(PartitionLaw, undivided_receivers_are_reported_and_a_stable_fit_keeps_its_cascades) {
  for_all(300, [&] {
    Case c = draw_divided();
    RC_LOG() << c << to_string(c.options.split.partition);
    const ShadowPlan plan = c.plan();
    if (plan.status == PlanStatus::nothing_visible) return;
    const bool divided = plan.selection != MapSelection::view_depth;
    require(divided != told(plan, OmissionKind::partition_without_gain), "divided without a word");
    c.options.fit = Fit::stable;
    const ShadowPlan stable = c.plan();
    require(
        stable.selection == MapSelection::view_depth && told(stable, OmissionKind::partition_in_stable_fit),
        "stable but divided");
    c.options.split.partition = Partition::view_depth;
    const ShadowPlan cascades = c.plan();
    require(cascades.map_count == stable.map_count, "maps", cascades.map_count, stable.map_count);
    for (int i = 0; i < cascades.map_count; ++i) {
      const auto index = static_cast<std::size_t>(i);
      require(cascades.map[index].clip_from_world == stable.map[index].clip_from_world, "another map", i);
    }
  });
}

double measured(const AliasingStats& stats, Objective objective) {
  if (objective == Objective::storage) return stats.storage;
  return objective == Objective::max ? stats.max : stats.p95;
}

// Parts are judged at a few hundred points, and measured at others.
constexpr double kJudged = 1.15;

TEST(PartitionLaw, no_partition_makes_its_objective_worse_than_one_uniform_map_when_measured) {
  // A body that shows in a few rays of the first grid may hide its worst corner from it: only what the second
  // grid shows, too, counts against a partition.
  constexpr MeasureOptions kGrid{20, 20, 32}, kFine{100, 100, 100};
  constexpr std::uint64_t kEnough = 400;
  int divided = 0;
  for_all(600, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 1});
    const double f = c.camera.far_depth;
    const glm::dvec3 at = point_at(c.camera, between(-1, 1), between(-1, 1), f * unit());
    const glm::dvec3 half =
        f * glm::dvec3(std::exp2(between(-4, 2)), std::exp2(between(-6, 2)), std::exp2(between(-4, 2)));
    c.receivers = c.casters = {{at - half, at + half}};
    c.options.fit = Fit::tight;
    c.options.cascades = 1;
    c.options.prune = c.options.prune.without(PruneRule::metric_resolution);
    c.options.split.pseudo_near = c.options.filter.world = 0.0;
    if (c.options.warp.warp != nullptr && !c.options.warp.warp->drop_without_gain)
      c.options.warp.warp = nullptr;
    Case single = c;
    single.options.warp.warp = &warps::none;
    const AliasingStats without = measure(single.plan(), c.camera, c.bounds(), kGrid);
    if (without.samples < kEnough) return;
    for (const Partition partition : kDivided) {
      c.options.split.partition = partition;
      RC_LOG() << c << to_string(partition);
      const ShadowPlan plan = c.plan();
      if (plan.selection == MapSelection::view_depth) continue;
      ++divided;
      const auto measured_by = [&](const ShadowPlan& p, const MeasureOptions& grid) {
        return measured(measure(p, c.camera, c.bounds(), grid), c.options.warp.objective);
      };
      double after = measured_by(plan, kGrid), before = measured(without, c.options.warp.objective);
      if (!(after <= before * kJudged)) {
        after = measured_by(plan, kFine);
        before = measured_by(single.plan(), kFine);
      }
      require(after <= before * kJudged, to_string(partition), to_string(c.options.warp.objective), after,
              "with one map", before);
    }
  });
  EXPECT_GT(divided, of_all_draws(200));
}

TEST(PartitionLaw, slices_of_the_frustums_faces_make_the_objective_no_worse_when_measured) {
  constexpr MeasureOptions kGrid{40, 40, 64}, kFine{100, 100, 200};
  constexpr std::uint64_t kEnough = 400;
  int more = 0;
  double ratios = 0.0;
  for_all(300, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 1});
    const double f = c.camera.far_depth;
    const glm::dvec3 at = point_at(c.camera, between(-1, 1), between(-1, 1), f * unit());
    const glm::dvec3 half(f * std::exp2(between(-4, 2)));
    c.receivers = c.casters = {{at - half, at + half}};
    c.options.fit = Fit::tight;
    c.options.prune = c.options.prune.without(PruneRule::metric_resolution);
    c.options.split.pseudo_near = c.options.filter.world = 0.0;
    if (c.options.warp.warp != nullptr && !c.options.warp.warp->drop_without_gain)
      c.options.warp.warp = nullptr;
    c.options.split.partition = Partition::frustum_faces;
    Case whole = c;
    c.options.split.face_slices = 2 + pick(kMaxMaps - 1);
    RC_LOG() << c << "slices " << c.options.split.face_slices;
    const ShadowPlan plan = c.plan(), before = whole.plan();
    if (plan.map_count <= before.map_count) return;
    require(plan.map_count <= kMaxMaps, "maps", plan.map_count);
    const AliasingStats without = measure(before, c.camera, c.bounds(), kGrid);
    if (without.samples < kEnough) return;
    const auto measured_by = [&](const ShadowPlan& p, const MeasureOptions& grid) {
      return measured(measure(p, c.camera, c.bounds(), grid), c.options.warp.objective);
    };
    double one = measured(without, c.options.warp.objective), many = measured_by(plan, kGrid);
    if (!(many <= one * kJudged)) {
      one = measured_by(before, kFine);
      many = measured_by(plan, kFine);
    }
    require(many <= one * kJudged, to_string(c.options.warp.objective), many, "with slices, without", one);
    ++more;
    ratios += many / one;
  });
  EXPECT_GT(more, of_all_draws(60));
  // And they pay.
  EXPECT_LT(ratios, 0.8 * more);
}

}  // namespace
}  // namespace gnomon::test
