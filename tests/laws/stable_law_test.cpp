// Does the texel grid of a stable map stand still while the camera moves and turns?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <set>
#include <vector>

#include "gnomon/motion.hpp"
#include "gnomon/study/formulas.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// A whole texel to this: the invariant that keeps edges from crawling.
constexpr double kTexel = 1e-6;

glm::dvec2 texel_of(const ShadowMap& map, const glm::dvec3& p) {
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
  return {0.5 * map.width * clip.x / clip.w, 0.5 * map.height * clip.y / clip.w};
}
double from_whole(double v) {
  return std::abs(v - std::round(v));
}

/// A camera among boxes, with everything in reach, so that each cascade has receivers and casters.
Case draw_stable_case() {
  Case c = draw_case({.max_depth_ratio = 1e4, .max_boxes = 8});
  c.options.fit = Fit::stable;
  c.options.split.range = SplitRange::automatic;
  c.options.split.pseudo_near = 0.0;
  const double f = 4.0 * c.camera.far_depth;
  // One box, or the same in slabs: several boxes are bounded and culled one by one.
  Box rest{c.camera.position - glm::dvec3(f), c.camera.position + glm::dvec3(f)};
  // Or flat: the grid's rectangles are then narrower along the light's slope.
  if (chance(0.4)) {
    const int thin = pick(3);
    const double share = std::exp2(-between(2.0, 8.0));
    rest.min[thin] += between(0.9, 1.0) * (1.0 - share) * f;
    rest.max[thin] = rest.min[thin] + share * f;
  }
  const std::vector<Box> others = c.casters;
  c.receivers.clear();
  const int axis = pick(3);
  for (int slabs = pick(5); slabs > 0; --slabs) {
    Box slab = rest;
    slab.max[axis] = rest.min[axis] = rest.min[axis] + between(0.1, 0.6) * (rest.max[axis] - rest.min[axis]);
    c.receivers.push_back(slab);
  }
  c.receivers.push_back(rest);
  c.casters = c.receivers;
  c.casters.insert(c.casters.end(), others.begin(), others.end());
  return c;
}

/// Every map of `b` has the grid of the same cascade of `a`.
std::uint64_t require_same_grid(const Case& c, const ShadowPlan& a, const ShadowPlan& b) {
  std::uint64_t compared = 0;
  Random random(5);
  for (const ShadowMap& m : a.maps()) {
    for (const ShadowMap& n : b.maps()) {
      if (n.cascade != m.cascade) continue;
      for (int i = 0; i < 4; ++i) {
        const glm::dvec3 p = point_at(c.camera, random.between(-1, 1), random.between(-1, 1),
                                      random.between(m.depth_begin, m.depth_end));
        const glm::dvec2 moved = texel_of(n, p) - texel_of(m, p);
        require(from_whole(moved.x) <= kTexel && from_whole(moved.y) <= kTexel, "texels", moved.x, moved.y,
                "cascade", m.cascade);
        ++compared;
      }
    }
  }
  return compared;
}

TEST(StableLaw, snap_keeps_the_texel_grid_under_sub_texel_motion) {
  std::uint64_t compared = 0;
  for_all(500, [&] {
    Case c = draw_stable_case();
    const ShadowPlan before = c.plan();
    if (before.map_count == 0) return;
    const double texel = before.map[0].texel_world.x;
    RC_LOG() << c << "texel " << texel;
    Case moved = c;
    moved.camera.position += glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) * texel;
    compared += require_same_grid(c, before, moved.plan());
  });
  EXPECT_GT(compared, of_all_draws(2000));
}

TEST(StableLaw, the_grid_is_stable_under_any_motion_and_turn_of_the_camera) {
  std::uint64_t compared = 0;
  for_all(1000, [&] {
    Case c = draw_stable_case();
    RC_LOG() << c;
    const ShadowPlan before = c.plan();
    Case moved = c;
    moved.camera.position +=
        glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) * (0.5 * c.camera.far_depth);
    if (chance(0.7)) moved.camera.forward = {between(-1, 1), between(-1, 1), between(0.1, 1)};
    if (chance(0.3)) moved.camera.up = {between(-1, 1), between(0.1, 1), between(-1, 1)};
    compared += require_same_grid(c, before, moved.plan());
  });
  EXPECT_GT(compared, of_all_draws(4000));
}

// Whatever the camera looks at: no two receivers of one slice lie farther apart, so that none is left out.
TEST(StableLaw, sides_are_the_farthest_that_receivers_of_one_slice_lie_apart) {
  std::uint64_t maps = 0, narrower = 0;
  for_all(500, [&] {
    Case c = draw_stable_case();
    c.options.filter = {};
    c.options.resolution = {};
    RC_LOG() << c;
    glm::dvec3 low = c.receivers[0].min, high = c.receivers[0].max;
    for (const Box& box : c.receivers) {
      low = glm::min(low, box.min);
      high = glm::max(high, box.max);
    }
    const glm::dvec3 size = high - low;
    Random random(7);
    const ShadowPlan plan = c.plan();
    for (const ShadowMap& map : plan.maps()) {
      const double chord = longest_chord(c.camera.left, c.camera.right, c.camera.bottom, c.camera.top,
                                         c.camera.orthographic, map.depth_begin - map.overlap, map.depth_end);
      // Of the bounds' sizes and of the sides; and of a thin size, as a share of the chord.
      constexpr double kSteps = (1.0 + 1.0 / 8.0) * (1.0 + 1.0 / 512.0), kThin = 1.0 / 100.0;
      for (int i = 0; i < 2; ++i) {
        const glm::dmat4& m = map.clip_from_world;
        const glm::dvec3 axis = glm::normalize(glm::dvec3(m[0][i], m[1][i], m[2][i]));
        const double side = map.snap_key.texel[i] * (map.width - 1 - 2 * map.filter_margin_texels);
        for (int offset = 0; offset < 100; ++offset) {
          glm::dvec3 d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
          // Both ends: what lies along the axis, and what lies along the box.
          if (offset % 2 == 0) d += 4.0 * axis;
          d = glm::clamp(d * (chord / glm::length(d)), -size, size);
          require(std::abs(glm::dot(d, axis)) <= side * (1.0 + 1e-12), "receivers apart", offset, side);
        }
        const double across = glm::dot(glm::abs(axis), size);
        const glm::dvec2 other(map.snap_key.texel);
        require(side <= kThin * chord + kSteps * std::max(std::min(chord, across),
                                                          0.016 * std::max(other.x, other.y) * map.width),
                "a side beyond both bounds", side, chord, across);
        narrower += side < 0.7 * chord;
        ++maps;
      }
    }
  });
  EXPECT_GT(maps, of_all_draws(1000));
  EXPECT_GT(narrower, of_all_draws(100));
}

// Ground under a low sun: its texels are as short along the light's slope as the ground looks from the sun.
TEST(StableLaw, flat_ground_under_a_low_sun_has_short_texels) {
  const std::vector<Box> ground{{{-300, -1, -300}, {300, 0, 300}}};
  const Camera camera = perspective_camera({0, 3, 0}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.6, 0.1, 200, 640, 400);
  PlanOptions options;
  options.fit = Fit::stable;
  options.cascades = 3;
  const ShadowPlan plan = make_plan(camera, DirectionalLight{{1.0, -0.2, 0.4}}, {ground, ground}, options);
  ASSERT_EQ(plan.map_count, 3);
  const double sine = 0.2 / std::sqrt(1.0 + 0.04 + 0.16);
  for (const ShadowMap& map : plan.maps()) {
    const glm::dvec2 texel = map.snap_key.texel;
    EXPECT_LT(std::min(texel.x, texel.y), (sine + 0.35) * std::max(texel.x, texel.y)) << map.cascade;
    EXPECT_GT(std::min(texel.x, texel.y), sine * std::max(texel.x, texel.y)) << map.cascade;
  }
}

// Before a camera that sees all of a small scene: what every slice's map spans is the scene.
TEST(StableLaw, cascades_are_omitted_where_the_next_ones_map_has_the_same_texels) {
  std::uint64_t compared = 0, omitted = 0;
  for_all(500, [&] {
    Case c = draw_stable_case();
    c.options.prune = default_prune_rules();
    c.options.cascades = 2 + pick(5);
    c.options.split.overlap = 0.0;
    const double f = c.camera.far_depth, size = f * std::exp2(-between(0.0, 5.0));
    const glm::dvec3 middle = point_at(c.camera, 0.0, 0.0, between(0.2, 0.9) * f);
    c.receivers = {{middle - glm::dvec3(size), middle + glm::dvec3(size)}};
    c.casters = c.receivers;
    RC_LOG() << c;
    const ShadowPlan few = c.plan();
    if (few.status != PlanStatus::ok) return;
    c.options.prune = c.options.prune.without(PruneRule::equal_cascades);
    const ShadowPlan all = c.plan();
    for (const Omission& o : few.omitted()) omitted += o.kind == OmissionKind::cascade_without_gain;
    for (const Omission& o : all.omitted())
      require(o.kind != OmissionKind::cascade_without_gain, "an omission that is switched off");
    Random random(8);
    for (const glm::dvec3& p : visible_points(c, random, 1, 8)) {
      const double depth = depth_of(c.camera, p);
      const int m = map_serving(few, p, depth), n = map_serving(all, p, depth);
      require((m < 0) == (n < 0), "served", m, n);
      if (m < 0) continue;
      const ShadowMap &one = few.map[static_cast<std::size_t>(m)],
                      &other = all.map[static_cast<std::size_t>(n)];
      require(map_holds(few, one, p), "held");
      require(one.snap_key.texel == other.snap_key.texel, "texels", one.cascade, other.cascade);
      const glm::dvec2 moved = texel_of(one, p) - texel_of(other, p);
      require(from_whole(moved.x) <= kTexel && from_whole(moved.y) <= kTexel, "grid", moved.x, moved.y);
      ++compared;
    }
  });
  EXPECT_GT(compared, of_all_draws(2000));
  EXPECT_GT(omitted, of_all_draws(200));
}

/// One who walks and jumps on flat ground, and whose head is the end of all receivers' bounds: how often maps
/// change their texels after the first ten seconds.
int changes_of_texels(double height, bool with_history) {
  PlanHistory history;
  PlanOptions options;
  options.fit = Fit::stable;
  options.cascades = 4;
  const Camera camera =
      perspective_camera({0, 3, 20}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.6, 0.1, 300, 640, 400);
  std::array<glm::dvec2, 4> last{};
  int changes = 0;
  for (int frame = 0; frame < 1200; ++frame) {
    constexpr double kPi = 3.14159265358979323846;
    const int of_jump = frame % 100;
    const double jump = of_jump < 30 ? 0.5 * height * std::sin(kPi * of_jump / 30.0) : 0.0;
    const double head = height * (1.0 + 0.03 * std::sin(0.7 * frame)) + jump;
    const double x = 60.5 * std::sin(0.05 * frame);  // to the ground's end, and a step beyond
    const std::vector<Box> boxes{{{-60, -0.1, -60}, {60, 0, 60}}, {{x - 0.4, jump, -3}, {x + 0.4, head, -2}}};
    const ShadowPlan plan = make_plan({camera}, DirectionalLight{{1.0, -0.4, 0.5}}, {boxes, boxes}, options,
                                      with_history ? &history : nullptr);
    for (const ShadowMap& map : plan.maps()) {
      glm::dvec2& before = last[static_cast<std::size_t>(map.cascade)];
      changes += frame > 600 && map.snap_key.texel != before;
      before = map.snap_key.texel;
    }
  }
  return changes;
}

TEST(StableLaw, receivers_that_move_at_the_end_of_their_bounds_leave_the_texels_as_they_are) {
  int with = 0, without = 0;
  for (double height = 0.5; height < 4.0; height *= 1.05) {
    with += changes_of_texels(height, true);
    without += changes_of_texels(height, false);
  }
  EXPECT_GT(without, 100) << "no step is ever crossed";
  EXPECT_EQ(with, 0);
}

/// Maps of a camera that turns among towers, of which nothing that was drawn the frame before is of use.
int drawn_anew(unsigned seed, bool with_history) {
  Random random(seed);
  std::vector<Box> boxes{{{-150, -1, -150}, {150, 0, 150}}};
  for (int i = 0; i < 50; ++i) {
    const glm::dvec3 at{random.between(-120, 120), 0, random.between(-120, 120)};
    boxes.push_back(
        {at, at + glm::dvec3{random.between(1, 10), random.between(1, 40), random.between(1, 10)}});
  }
  PlanOptions options;
  options.fit = Fit::stable;
  PlanHistory history;
  std::array<ShadowMap, kMaxMaps> last;
  std::uint32_t known = 0;
  int drawn = 0;
  for (int frame = 0; frame < 300; ++frame) {
    const double turn = 0.01 * frame;
    const Camera camera = perspective_camera({10, 3, 20}, {-std::sin(turn), -0.1, std::cos(turn)}, {0, 1, 0},
                                             1.0, 16.0 / 9.0, 0.1, 250, 1920, 1080);
    const ShadowPlan plan = make_plan(camera, DirectionalLight{{0.4, -0.5, 0.3}}, {boxes, boxes}, options,
                                      with_history ? &history : nullptr);
    for (const ShadowMap& map : plan.maps()) {
      const auto at = static_cast<std::size_t>(map.cascade);
      drawn += (known >> at & 1u) != 0 && reuse(last[at], map).kind == ReuseKind::none;
      known |= 1u << at;
      last[at] = map;
    }
  }
  return drawn;
}

TEST(StableLaw, maps_under_a_turning_camera_keep_their_depths) {
  int with = 0, without = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    with += drawn_anew(seed, true);
    without += drawn_anew(seed, false);
  }
  EXPECT_GT(without, 200) << "of about 6000";
  EXPECT_LT(3 * with, without);
}

TEST(StableLaw, equal_snap_keys_mean_the_same_matrix_to_the_last_bit) {
  std::uint64_t equal = 0;
  for_all(1000, [&] {
    Case c = draw_stable_case();
    const ShadowPlan before = c.plan();
    if (before.map_count == 0) return;
    RC_LOG() << c;
    Case moved = c;
    moved.camera.position += glm::dvec3(unit(), unit(), unit()) * (0.3 * before.map[0].texel_world.x);
    const ShadowPlan after = moved.plan();
    for (const ShadowMap& m : before.maps()) {
      for (const ShadowMap& n : after.maps()) {
        if (n.cascade != m.cascade || !(n.snap_key == m.snap_key)) continue;
        ++equal;
        require(m.clip_from_world == n.clip_from_world, "matrices of equal keys differ", m.cascade);
      }
    }
  });
  EXPECT_GT(equal, of_all_draws(300));
}

Light local_light_in_view(const Case& c) {
  const glm::dvec3 at = point_at(c.camera, between(-1, 1), between(-1, 1),
                                 between(c.camera.near_depth, 0.2 * c.camera.far_depth)) -
                        c.light * between(0.01, 0.2) * c.camera.far_depth;
  const double range = between(0.05, 2.0) * c.camera.far_depth;
  if (chance(0.5)) return PointLight{at, range};
  return SpotLight{at, c.light, between(0.05, 3.0), range};
}

// The last bits followed the eye: nothing that was drawn could be kept.
TEST(StableLaw, a_local_light_keeps_its_matrices_and_its_place_to_the_last_bit_under_any_motion) {
  std::uint64_t equal = 0, reused = 0, other_depths = 0;
  for_all(1000, [&] {
    Case c = draw_stable_case();
    const Light light = local_light_in_view(c);
    if (chance(0.4)) c.options.filter.world = 0.01 * between(0.0, 1.0) * c.camera.far_depth;
    const ShadowPlan before = make_plan(c.camera, light, c.bounds(), c.options);
    RC_LOG() << c;
    Case moved = c;
    moved.camera.position += glm::dvec3(unit(), unit(), unit()) * (between(0.0, 0.02) * c.camera.far_depth);
    const ShadowPlan after = make_plan(moved.camera, light, c.bounds(), c.options);
    for (const ShadowMap& m : before.maps()) {
      for (const ShadowMap& n : after.maps()) {
        if (n.cascade != m.cascade) continue;
        require(m.light_world == n.light_world, "the light moves", m.cascade);
        if (!(n.snap_key == m.snap_key)) {
          ++other_depths;
          continue;
        }
        ++equal;
        require(m.clip_from_world == n.clip_from_world, "matrices of equal keys differ", m.cascade);
        reused += reuse(m, n).kind == ReuseKind::identical;
      }
    }
  });
  EXPECT_GT(equal, of_all_draws(300));
  EXPECT_EQ(reused, equal);
  EXPECT_LT(other_depths, equal);
}

TEST(StableLaw, a_kernel_in_world_units_leaves_a_local_light_its_texels_within_an_octave_of_distance) {
  // A lamp along a floor: the nearest floor in view is as far from it as the eye has walked.
  const std::vector<Box> floor{{{0, -1, -20}, {60, 0, 20}}}, casters{{{5, 0, -4}, {50, 3, 4}}};
  PlanOptions options;
  options.fit = Fit::stable;
  options.filter.world = 0.2;
  std::set<double> sizes;
  int maps = 0;
  for (int step = 0; step < 400; ++step) {
    const Camera camera =
        perspective_camera({6.0 + 0.05 * step, 6, 0}, {0.3, -1, 0}, {0, 1, 0}, 0.6, 1.6, 0.1, 100, 640, 400);
    const SpotLight lamp{{0, 2, 0}, {1, -0.1, 0}, 0.7, 80.0};
    const ShadowPlan plan = make_plan(camera, lamp, {floor, casters}, options);
    for (const ShadowMap& map : plan.maps()) {
      sizes.insert(map.snap_key.texel.x);
      ++maps;
    }
  }
  EXPECT_GT(maps, 300);
  EXPECT_GE(sizes.size(), 2u) << "the border follows the distance";
  EXPECT_LE(sizes.size(), 4u);
}

TEST(StableLaw, a_stable_map_is_never_warped_and_reports_an_ignored_warp) {
  std::uint64_t maps = 0, asked = 0;
  for_all(200, [&] {
    Case c = draw_stable_case();
    const ShadowPlan plan = c.plan();
    for (const ShadowMap& map : plan.maps()) {
      require(map.warp == &warps::none && map.kappa == 0.0, map.warp->name, map.kappa);
      // Texels of one size over the whole map.
      for (int i = 0; i < 2; ++i) {
        const double side = map.snap_key.texel[i];
        require(std::abs(map.texel_world[i] - side) <= 1e-9 * side, "texels", map.texel_world[i], side);
        require(std::abs(map.texel_world_max[i] - side) <= 1e-9 * side, "largest", map.texel_world_max[i]);
      }
      ++maps;
    }
    if (plan.status != PlanStatus::ok || c.options.warp.warp == nullptr ||
        c.options.warp.warp == &warps::none)
      return;
    bool told = false;
    for (const Omission& o : plan.omitted()) told = told || o.kind == OmissionKind::warp_in_stable_fit;
    require(told, "warp left out without a word");
    ++asked;
  });
  EXPECT_GT(maps, of_all_draws(400));
  EXPECT_GT(asked, of_all_draws(50));
}

}  // namespace
}  // namespace gnomon::test
