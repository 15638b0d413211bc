// What does the plan omit under local lights, and can each rule be switched off?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// A furnished room with a local light anywhere in it.
struct LitRoom {
  Camera camera;
  std::vector<Box> boxes, casters;  // walls and furniture; what of it casts
  Light light;
  PlanOptions options;
  [[nodiscard]] ShadowPlan plan() const { return make_plan(camera, light, {casters, boxes}, options); }
  [[nodiscard]] ShadowPlan plan_without(PruneRule rule) const {
    PlanOptions without = options;
    without.prune = without.prune.without(rule);
    return make_plan(camera, light, {casters, boxes}, without);
  }
};

LitRoom random_room(Random& random) {
  LitRoom room;
  const auto inside = [&] {
    return glm::dvec3(random.between(-9, 9), random.between(0.5, 5.5), random.between(-9, 9));
  };
  room.camera = perspective_camera(inside(), random.direction() - glm::dvec3(0, 0.5, 0), {0, 1, 0},
                                   random.between(0.4, 1.8), 1.5, random.between(0.05, 0.5), 60.0, 640, 427);
  room.boxes = {{{-10, -0.2, -10}, {10, 0, 10}}, {{-10, 0, -10.2}, {10, 6, -10}}};
  for (int i = 0; i < 6; ++i) {
    const glm::dvec3 at = inside() * glm::dvec3(1, 0.3, 1), half(random.between(0.05, 1.0));
    room.boxes.push_back({at - half, at + half});
  }
  room.casters.assign(room.boxes.begin() + (random.unit() < 0.5 ? 0 : 2), room.boxes.end());
  const glm::dvec3 position = inside();
  const double cone = random.between(0.1, 2.6);
  if (random.unit() < 0.4) {
    room.light = PointLight{position, random.between(3, 30)};
  } else {
    room.light = SpotLight{position, random.direction(), cone, random.between(3, 30)};
  }
  const int kernel = random.pick(3);
  room.options.filter.texels = kernel == 1 ? random.between(1, 8) : 1.0;
  room.options.filter.world = kernel == 2 ? random.between(0.001, 0.2) : 0.0;
  room.options.resolution.max_size = 256 << random.pick(5);
  return room;
}

std::int64_t texels_of(const ShadowPlan& plan) {
  std::int64_t sum = 0;
  for (const ShadowMap& map : plan.maps()) sum += std::int64_t{map.width} * map.height;
  return sum;
}

const ShadowMap* map_of(const ShadowPlan& plan, int face) {
  const auto maps = plan.maps();
  const auto found =
      std::find_if(maps.begin(), maps.end(), [&](const ShadowMap& m) { return m.cascade == face; });
  return found == maps.end() ? nullptr : &*found;
}

TEST(PruneLocalLight,
     random_local_lights_get_maps_no_larger_than_the_metric_requires_and_the_plan_states_what_that_saves) {
  Random random(1);
  int smaller = 0, whole = 0, more_maps = 0;
  std::int64_t all = 0, left = 0;
  for (int i = 0; i < 600; ++i) {
    LitRoom room = random_room(random);
    room.options.prune = PruneRules::all();
    room.options.resolution.prune_error = std::exp2(random.between(-2, 2));
    const ShadowPlan pruned = room.plan(), full = room.plan_without(PruneRule::metric_resolution);
    // A smaller map's wider border may reach a caster that the full one's did not.
    if (pruned.map_count > full.map_count) ++more_maps;
    if (pruned.map_count > full.map_count) continue;
    ASSERT_EQ(pruned.map_count, full.map_count) << i;
    std::int64_t listed = 0;
    for (const Omission& o : pruned.omitted())
      if (o.kind == OmissionKind::resolution_without_gain) listed += o.saves_texels;
    EXPECT_EQ(texels_of(full) - texels_of(pruned), listed) << i;
    for (int k = 0; k < full.map_count; ++k) {
      const ShadowMap &a = full.map[static_cast<std::size_t>(k)],
                      &b = pruned.map[static_cast<std::size_t>(k)];
      EXPECT_EQ(a.width, room.options.resolution.max_size);
      EXPECT_EQ(b.width, b.height);
      EXPECT_LE(b.width, a.width);
      (b.width < a.width ? smaller : whole) += 1;
      if (b.width == a.width) {
        EXPECT_EQ(a.clip_from_world, b.clip_from_world) << i;
        continue;
      }
      EXPECT_LE(b.m_max, room.options.resolution.prune_error) << i;
      EXPECT_EQ(a.kappa, b.kappa) << "what a map shows does not depend on its size";
      EXPECT_GE(4 * b.width, 16 * b.filter_margin_texels) << "no receiver in more than half of a side";
    }
    all += texels_of(full);
    left += texels_of(pruned);
  }
  EXPECT_LT(more_maps, 6);
  EXPECT_GT(smaller, 200);
  EXPECT_GT(whole, 200);
  RecordProperty("percent_of_texels_left", static_cast<int>(100 * left / all));
}

TEST(PruneLocalLight, maps_of_a_stable_fit_a_history_or_a_budget_keep_their_size) {
  Random random(2);
  int maps = 0;
  for (int i = 0; i < 60; ++i) {
    LitRoom room = random_room(random);
    room.options.resolution.max_size = 4096;
    LitRoom stable = room;
    stable.options.fit = Fit::stable;
    PlanHistory history;
    for (const ShadowPlan& plan :
         {stable.plan(),
          make_plan(room.camera, room.light, {room.casters, room.boxes}, room.options, &history)}) {
      for (const ShadowMap& map : plan.maps()) {
        EXPECT_EQ(map.width, 4096);
        ++maps;
      }
    }
    room.options.resolution.texel_budget = 6 * 512 * 512;
    EXPECT_EQ(texels_of(room.plan()), texels_of(room.plan_without(PruneRule::metric_resolution)));
  }
  EXPECT_GT(maps, 60);
}

/// Whether the light reaches the point, if nothing is in its way.
bool reaches(const Light& light, const glm::dvec3& p) {
  if (const auto* point = std::get_if<PointLight>(&light))
    return glm::length(p - point->position) < point->range;
  const auto& spot = std::get<SpotLight>(light);
  const glm::dvec3 way = p - spot.position;
  const double cosine = glm::dot(glm::normalize(way), glm::normalize(spot.direction));
  return glm::length(way) < spot.range && cosine > std::cos(spot.outer_radians);
}

TEST(PruneLocalLight, random_local_lights_meet_the_bound_that_made_their_maps_smaller_where_it_is_measured) {
  Random random(3);
  int points = 0, above = 0;
  double largest = 0.0;
  for (int i = 0; i < 400; ++i) {
    LitRoom room = random_room(random);
    room.options.resolution.max_size = 8192;
    room.options.filter.world = 0.0;
    const ShadowPlan plan = room.plan();
    bool met = plan.map_count > 0;
    for (const ShadowMap& map : plan.maps()) met = met && map.m_s_max <= 1.0 && map.m_t_max <= 1.0;
    if (!met) continue;
    Case scene;
    scene.camera = room.camera;
    scene.receivers = room.boxes;
    for (const glm::dvec3& p : visible_points(scene, random, 8, 16)) {
      if (!reaches(room.light, p)) continue;
      const int map = map_serving(plan, p, depth_of(room.camera, p));
      if (map < 0) continue;
      const PointAliasing m = measure_perspective(plan.map[static_cast<std::size_t>(map)], room.camera, p);
      if (m.status != PointAliasing::Status::ok) continue;
      ++points;
      largest = std::max({largest, m.perspective_s, m.perspective_t});
      // The bounds are those of vertices and middles of edges; rays that fan out have theirs in between.
      const double error = std::max(m.perspective_s, m.perspective_t);
      EXPECT_LE(error, 1.5) << i;
      above += error > 1.05 ? 1 : 0;
    }
  }
  EXPECT_GT(points, 1000);
  EXPECT_LE(100 * above, points);
  EXPECT_GT(largest, 0.5) << "maps are far larger than the metric needs";
}

TEST(PruneLocalLight, faces_without_receivers_or_casters_get_maps_only_where_the_rules_are_off) {
  Random random(4);
  int more[2] = {};
  for (int i = 0; i < 200; ++i) {
    const LitRoom room = random_room(random);
    const ShadowPlan pruned = room.plan();
    const PruneRule rules[] = {PruneRule::empty_faces, PruneRule::casterless_faces};
    for (int k = 0; k < 2; ++k) {
      const ShadowPlan full = room.plan_without(rules[k]);
      more[k] += full.map_count - pruned.map_count;
      const OmissionKind kind =
          k == 0 ? OmissionKind::face_without_receiver : OmissionKind::face_without_caster;
      for (const Omission& o : full.omitted()) {
        // The face behind a narrow cone is dark, whatever is in it.
        const bool dark = std::holds_alternative<SpotLight>(room.light) && o.map == 4;
        EXPECT_TRUE(o.kind != kind || dark) << i;
      }
      for (const ShadowMap& map : pruned.maps()) {
        const ShadowMap* same = map_of(full, map.cascade);
        ASSERT_NE(same, nullptr) << i;
        EXPECT_EQ(same->clip_from_world, map.clip_from_world) << i;
      }
      for (const ShadowMap& map : full.maps()) {
        EXPECT_TRUE(std::isfinite(map.m_s_max + map.m_t_max + map.storage + map.depth_range_world)) << i;
        for (int c = 0; c < 4; ++c)
          for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(map.clip_from_world[c][r])) << i;
      }
    }
  }
  EXPECT_GT(more[0], 50);
  EXPECT_GT(more[1], 20);
}

TEST(PruneLocalLight, depths_are_pulled_to_what_is_there_only_where_the_rule_is_on) {
  Random random(5);
  int looser = 0, maps = 0;
  for (int i = 0; i < 300; ++i) {
    LitRoom room = random_room(random);
    if (i % 3 == 0) room.light = DirectionalLight{random.direction() - glm::dvec3(0, 2, 0)};
    if (i % 2 == 0) room.options.fit = Fit::stable;
    const ShadowPlan pruned = room.plan(), full = room.plan_without(PruneRule::light_depths);
    ASSERT_EQ(pruned.map_count, full.map_count) << i;
    for (int k = 0; k < full.map_count; ++k) {
      const ShadowMap &a = full.map[static_cast<std::size_t>(k)],
                      &b = pruned.map[static_cast<std::size_t>(k)];
      ++maps;
      looser += a.depth_range_world > b.depth_range_world * 1.01 ? 1 : 0;
      EXPECT_GE(a.depth_range_world, b.depth_range_world * (1.0 - 1e-9)) << i;
      // The same texels: only depths differ.
      for (int column = 0; column < 4; ++column)
        for (const int row : {0, 1, 3})
          EXPECT_EQ(a.clip_from_world[column][row], b.clip_from_world[column][row]) << i;
    }
  }
  EXPECT_GT(maps, 200);
  EXPECT_GT(looser, maps / 4);
}

/// A box round the light says nothing of how near its surfaces are. Floats tell depths apart that lie within
/// a thousandth of the range; over an eight-thousandth, walls of real rooms have acne.
TEST(PruneLocalLight, a_room_in_one_box_with_its_light_has_depths_over_a_thousandth_of_its_range) {
  LitRoom room;
  room.camera = perspective_camera({1, 1.5, 2}, {0, -0.1, -1}, {0, 1, 0}, 1.2, 1.5, 0.05, 60.0, 640, 427);
  room.boxes = room.casters = {{{-5, 0, -4}, {5, 3, 4}}};
  const glm::dvec3 place{0.3, 2.0, -0.4};
  room.light = SpotLight{place, {0.1, -0.3, -1.0}, 1.0, 30.0};
  EXPECT_EQ(room.options.light_near_share, 1.0 / 1024.0);
  // Linear depths allow less.
  for (const double share : {room.options.light_near_share, 0x1p-17, 0x1p-6}) {
    room.options.light_near_share = share;
    const ShadowPlan plan = room.plan();
    ASSERT_EQ(plan.status, PlanStatus::ok);
    ASSERT_EQ(plan.map_count, 1);
    EXPECT_TRUE(std::any_of(plan.omitted().begin(), plan.omitted().end(),
                            [](const Omission& o) { return o.kind == OmissionKind::depth_near_light; }));
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.1, -0.3, -1.0));
    double nearest = 100.0, farthest = 0.0;
    for (double away = 1e-6; away < 100.0; away *= 1.01) {
      const glm::dvec4 clip = plan.map[0].clip_from_world * glm::dvec4(place + axis * away, 1.0);
      if (!(clip.w > 0.0 && std::abs(clip.z) <= clip.w)) continue;
      nearest = std::min(nearest, away);
      farthest = std::max(farthest, away);
    }
    EXPECT_GT(nearest, farthest * share * 0.5);
    EXPECT_LT(nearest, farthest * share * 5.0);
  }
}

}  // namespace
}  // namespace gnomon::test
