// Do visible depths keep cascades off what is not seen, and off nothing that is?
#include "gnomon/view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "gnomon/measure.hpp"
#include "gnomon/plan.hpp"
#include "support/near.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Ratio of a bin's end to its begin.
const double kBin = std::exp2(1.0 / kDepthBinsPerDoubling);

std::uint64_t pixels(const VisibleDepths& depths) {
  return std::accumulate(depths.count.begin(), depths.count.end(), std::uint64_t{0});
}

/// A plain seen from above its middle, from 1 to 1000 units away.
struct Plain {
  Camera camera = perspective_camera({0, 2, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.0, 1.0, 1000.0, 512, 512);
  std::vector<Box> casters = {{{-600, 0, -1000}, {600, 3, -1}}};
  std::vector<Box> receivers = {{{-600, -1, -1000}, {600, 2, -1}}};
  PlanOptions options;
  const VisibleDepths* visible = nullptr;
  [[nodiscard]] ShadowPlan plan() const {
    return make_plan({camera, visible}, DirectionalLight{{0.3, -1, 0.2}}, {casters, receivers}, options);
  }
};

VisibleDepths near_and_far() {
  VisibleDepths depths;
  for (const double depth : {2.0, 3.0, 5.0, 400.0, 500.0}) depths.add(depth);
  return depths;
}

TEST(VisibleDepths, sky_and_what_is_no_depth_counts_nothing) {
  VisibleDepths depths;
  const std::array<float, 5> sky = {0.0f, -1.0f, std::numeric_limits<float>::infinity(),
                                    -std::numeric_limits<float>::infinity(),
                                    std::numeric_limits<float>::quiet_NaN()};
  depths.add(sky);
  EXPECT_TRUE(depths.empty());
  EXPECT_EQ(pixels(depths), 0u);
  for (const auto& [low, high] :
       {std::pair{0.0, 1.0}, {2.0, 1.0}, {1.0, kInfinity}, {kNan, 1.0}, {1.0, kNan}})
    EXPECT_TRUE(visible_between(low, high).empty()) << low << ' ' << high;
}

TEST(VisibleDepths, one_pixel_is_one_bin_and_both_extremes) {
  VisibleDepths depths;
  depths.add(4.0);
  EXPECT_EQ(depths.min, 4.0);
  EXPECT_EQ(depths.max, 4.0);
  EXPECT_EQ(pixels(depths), 1u);
  EXPECT_EQ(depths.count[static_cast<std::size_t>(depth_bin(4.0))], 1u);
}

TEST(VisibleDepths, bins_double_every_eighth_and_their_ends_hold_everything) {
  EXPECT_EQ(depth_bin(2.0) - depth_bin(1.0), kDepthBinsPerDoubling);
  EXPECT_EQ(depth_bin_begin(depth_bin(1.0)), 1.0);
  EXPECT_EQ(depth_bin(1e-300), 0);
  EXPECT_EQ(depth_bin(1e300), kDepthBins - 1);
  for_all(1000, [] {
    const double depth = std::exp(between(std::log(1e-6), std::log(1e7)));
    const int bin = depth_bin(depth);
    // A depth on a border may round to either side.
    constexpr double kRounding = 1e-12;
    require(depth >= depth_bin_begin(bin) * (1.0 - kRounding), depth, bin);
    require(depth <= depth_bin_begin(bin + 1) * (1.0 + kRounding), depth, bin);
  });
}

TEST(VisibleDepths, cascades_cover_the_visible_range_and_its_safety) {
  Plain plain;
  const VisibleDepths depths = visible_between(10.0, 100.0);
  plain.visible = &depths;
  const ShadowPlan plan = plain.plan();
  ASSERT_EQ(plan.map_count, 4);
  // Ends of the range are exact.
  constexpr double kRounding = 1e-12;
  EXPECT_CLOSE(plan.map[0].depth_begin, 10.0 * (1.0 - kDepthSafety), kRounding);
  EXPECT_CLOSE(plan.map[3].depth_end, 100.0 * (1.0 + kDepthSafety), kRounding);
  EXPECT_TRUE(std::any_of(plan.omitted().begin(), plan.omitted().end(), [](const Omission& o) {
    return o.kind == OmissionKind::depth_not_visible && o.b > 900.0;
  }));
}

TEST(VisibleDepths, without_gaps_slices_have_equal_ratios) {
  Plain plain;
  const VisibleDepths depths = visible_between(10.0, 160.0);
  plain.visible = &depths;
  const ShadowPlan plan = plain.plan();
  ASSERT_EQ(plan.map_count, 4);
  const double ratio = plan.map[0].depth_end / plan.map[0].depth_begin;
  // The search stops within 2^-24 of the logarithm.
  constexpr double kSearch = 1e-5;
  for (const ShadowMap& map : plan.maps()) EXPECT_CLOSE(map.depth_end / map.depth_begin, ratio, kSearch);
}

TEST(VisibleDepths, cascades_step_over_a_gap) {
  Plain plain;
  const VisibleDepths depths = near_and_far();
  plain.visible = &depths;
  plain.options.cascades = 2;
  const ShadowPlan plan = plain.plan();
  ASSERT_EQ(plan.map_count, 2);
  EXPECT_LT(plan.map[0].depth_end, 5.0 * kBin * kBin);
  EXPECT_GT(plan.map[1].depth_begin, 400.0 / (kBin * kBin));
  for (const double depth : {2.0, 3.0, 5.0, 400.0, 500.0})
    EXPECT_GE(map_serving(plan, {0, 2, -depth}, depth), 0) << depth;
  EXPECT_EQ(map_serving(plan, {0, 2, -50}, 50.0), -1);
  Plain blind;
  blind.options.cascades = 2;
  const ShadowPlan all = blind.plan();
  // Slices of a factor 3 and 1.4 instead of two of 31: near texels are several times as small.
  EXPECT_LT(2.0 * plan.map[0].m_s_max, all.map[0].m_s_max);
}

TEST(VisibleDepths, slices_round_a_gap_are_as_short_as_their_number_allows) {
  Plain plain;
  VisibleDepths depths = visible_between(2.0, 4.0);
  const VisibleDepths far = visible_between(100.0, 200.0);
  for (std::size_t bin = 0; bin < depths.count.size(); ++bin) depths.count[bin] += far.count[bin];
  depths.max = far.max;
  plain.visible = &depths;
  plain.options.cascades = 4;
  plain.options.split.scheme = SplitScheme::logarithmic;
  const ShadowPlan plan = plain.plan();
  ASSERT_EQ(plan.map_count, 4);
  // Two slices over each octave, with its safety at both ends; the last of each may be shorter.
  const double octave = 2.0 * kBin * (1.0 + kDepthSafety) / (1.0 - kDepthSafety);
  for (const ShadowMap& map : plan.maps())
    EXPECT_LE(map.depth_end / map.depth_begin, std::sqrt(octave) * 1.001);
}

TEST(VisibleDepths, one_visible_pixel_gets_one_map_or_more_and_no_map_twice) {
  Plain plain;
  VisibleDepths depths;
  depths.add(20.0);
  plain.visible = &depths;
  for (const SplitScheme scheme : {SplitScheme::automatic, SplitScheme::uniform, SplitScheme::optimal}) {
    plain.options.split.scheme = scheme;
    const ShadowPlan plan = plain.plan();
    ASSERT_EQ(plan.status, PlanStatus::ok) << to_string(scheme);
    EXPECT_GE(map_serving(plan, {0, 2, -20}, 20.0), 0) << to_string(scheme);
    for (int i = 1; i < plan.map_count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      EXPECT_GE(plan.map[at].depth_begin, plan.map[at - 1].depth_end) << to_string(scheme);
    }
  }
}

TEST(VisibleDepths, a_single_visible_depth_gets_a_single_map) {
  for (const SplitScheme scheme : {SplitScheme::automatic, SplitScheme::uniform, SplitScheme::optimal}) {
    Plain plain;
    VisibleDepths depths;
    depths.add(20.0);
    depths.add(20.0);
    plain.visible = &depths;
    plain.options.split.scheme = scheme;
    const ShadowPlan plan = plain.plan();
    ASSERT_EQ(plan.map_count, 1) << to_string(scheme);
    EXPECT_LT(plan.map[0].depth_begin, 20.0);
    EXPECT_GT(plan.map[0].depth_end, 20.0);
    EXPECT_EQ(
        std::count_if(plan.omitted().begin(), plan.omitted().end(),
                      [](const Omission& o) { return o.kind == OmissionKind::cascade_without_receiver; }),
        3);
  }
}

TEST(VisibleDepths, nothing_visible_or_a_requested_whole_range_changes_nothing) {
  Plain plain;
  const ShadowPlan before = plain.plan();
  const VisibleDepths none;
  plain.visible = &none;
  EXPECT_EQ(plain.plan().map[3].depth_end, before.map[3].depth_end);
  const VisibleDepths some = near_and_far();
  plain.visible = &some;
  plain.options.split.range = SplitRange::camera;
  EXPECT_EQ(plain.plan().map[3].depth_end, plain.camera.far_depth);
}

TEST(VisibleDepths, every_visible_receiver_is_served_under_every_scheme) {
  constexpr SplitScheme kSchemes[] = {SplitScheme::automatic,   SplitScheme::uniform,
                                      SplitScheme::practical,   SplitScheme::logarithmic,
                                      SplitScheme::pseudo_near, SplitScheme::optimal};
  for_all(300, [&] {
    CaseLimits limits;
    limits.orthographic = false;
    limits.max_boxes = 8;
    Case c = draw_case(limits);
    c.visible = nullptr;
    c.options.split.range = SplitRange::receivers;
    c.options.split.scheme = kSchemes[static_cast<std::size_t>(pick(6))];
    Random random(static_cast<std::uint64_t>(pick(1 << 20)));
    const std::vector<glm::dvec3> points = visible_points(c, random, 3, 2);
    VisibleDepths depths;
    for (const glm::dvec3& point : points) depths.add(depth_of(c.camera, point));
    c.visible = &depths;
    const ShadowPlan plan = c.plan();
    if (plan.status != PlanStatus::ok) return;
    for (const glm::dvec3& point : points) {
      // Rounding takes corners of the frustum out of it.
      const double depth = std::clamp(depth_of(c.camera, point), c.camera.near_depth, c.camera.far_depth);
      bool served = map_serving(plan, point, depth) >= 0;
      // A cascade that nothing can shadow is served by no map.
      for (const Omission& o : plan.omitted()) {
        served = served || (o.kind == OmissionKind::cascade_without_caster && depth >= o.a && depth <= o.b);
      }
      require(served, "depth", depth, "of", depths.min, depths.max, to_string(c.options.split.scheme));
    }
  });
}

TEST(DepthTracker, an_empty_frame_changes_nothing) {
  DepthTracker tracker;
  tracker.update({});
  EXPECT_TRUE(tracker.depths().empty());
  tracker.update(visible_between(1.0, 10.0));
  const VisibleDepths before = tracker.depths();
  tracker.update({});
  EXPECT_EQ(tracker.depths().min, before.min);
  EXPECT_EQ(tracker.depths().count, before.count);
}

TEST(DepthTracker, forgets_the_frames_at_a_cut_and_keeps_its_pace) {
  DepthTracker tracker;
  tracker.frames_per_bin = 7;
  tracker.hold_frames = 3;
  tracker.update(visible_between(1.0, 10.0));
  ASSERT_FALSE(tracker.depths().empty());
  tracker.clear();
  EXPECT_TRUE(tracker.depths().empty());
  EXPECT_EQ(tracker.frames_per_bin, 7);
  EXPECT_EQ(tracker.hold_frames, 3);
}

TEST(DepthTracker, what_comes_into_view_counts_at_once) {
  DepthTracker tracker;
  tracker.update(visible_between(10.0, 20.0));
  tracker.update(visible_between(1.0, 500.0));
  EXPECT_LE(tracker.depths().min, 1.0);
  EXPECT_GE(tracker.depths().max, 500.0);
}

TEST(DepthTracker, what_leaves_the_view_is_given_up_by_a_bin_every_few_frames) {
  DepthTracker tracker;
  tracker.update(visible_between(10.0, 160.0));
  double last = tracker.depths().max;
  int moved = 0, frames = 0;
  // Four doublings less; a bin of room stays on either side.
  while (tracker.depths().max > 10.0 * kBin * kBin * kBin && frames < 1000) {
    tracker.update(visible_between(10.0, 10.0));
    ++frames;
    const double now = tracker.depths().max;
    if (now == last) continue;
    ++moved;
    EXPECT_CLOSE(last / now, kBin, 1e-12);
    last = now;
  }
  EXPECT_NEAR(frames, moved * tracker.frames_per_bin, tracker.frames_per_bin);
  EXPECT_GT(moved, 3 * kDepthBinsPerDoubling);
}

TEST(DepthTracker, a_depth_that_swings_about_a_border_moves_no_edge) {
  DepthTracker tracker;
  const double border = depth_bin_begin(depth_bin(64.0));
  tracker.update(visible_between(1.0, border * 1.01));
  const double edge = tracker.depths().max;
  for (int frame = 0; frame < 500; ++frame) {
    // A long stay on each side, so that patience alone would not do.
    tracker.update(visible_between(1.0, border * (frame / 50 % 2 == 0 ? 0.99 : 1.01)));
    EXPECT_EQ(tracker.depths().max, edge) << frame;
  }
}

TEST(DepthTracker, a_gap_opens_only_after_it_was_held) {
  DepthTracker tracker;
  tracker.update(visible_between(1.0, 100.0));
  VisibleDepths frame = visible_between(1.0, 2.0);
  frame.add(100.0);
  const auto middle = static_cast<std::size_t>(depth_bin(12.0));
  for (int i = 0; i < tracker.hold_frames; ++i) {
    EXPECT_GT(tracker.depths().count[middle], 0u) << i;
    tracker.update(frame);
  }
  EXPECT_EQ(tracker.depths().count[middle], 0u);
  // And closes at once.
  tracker.update(visible_between(1.0, 100.0));
  EXPECT_GT(tracker.depths().count[middle], 0u);
}

TEST(DepthTracker, a_first_frame_keeps_its_gaps) {
  DepthTracker tracker;
  tracker.update(near_and_far());
  EXPECT_EQ(tracker.depths().count[static_cast<std::size_t>(depth_bin(50.0))], 0u);
  EXPECT_GT(tracker.depths().count[static_cast<std::size_t>(depth_bin(400.0))], 0u);
}

}  // namespace
}  // namespace gnomon::test
