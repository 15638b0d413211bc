// Does a map that is kept over frames serve every receiver that comes into view, with all its casters?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "gnomon/motion.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// A ray that only grazes a box, by this much of the distance, may count either way.
constexpr double kGraze = 1e-9;

/// Turns the camera by `angle` about a random axis.
void turn(Camera& camera, double angle, Random& random) {
  const glm::dvec3 axis = random.direction();
  const CameraAxes axes = camera_axes(camera);
  const auto turned = [&](const glm::dvec3& v) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1.0 - std::cos(angle)));
  };
  camera.forward = turned(axes.forward);
  camera.up = turned(axes.up);
}

/// Whether a map shows the point with every caster between it and the light.
void require_served(const Case& c, const ShadowPlan& plan, const glm::dvec3& point, bool kept) {
  const int index = map_serving(plan, point, depth_of(c.camera, point));
  const glm::dvec3 to_light = -glm::normalize(c.light);
  std::vector<std::uint32_t> list(c.casters.size());
  if (index >= 0) {
    const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
    require(map_holds(plan, map, point), "a receiver left map", map.cascade, kept ? "kept" : "planned");
    list.resize(cull_casters(map, c.casters, list));
  }
  for (std::size_t i = 0; i < c.casters.size(); ++i) {
    const double scale = glm::length(c.casters[i].min - c.camera.position) + c.camera.far_depth;
    Box box = c.casters[i];
    const glm::dvec3 inset = glm::min(glm::dvec3(kGraze * scale), 0.5 * (box.max - box.min));
    box = {box.min + inset, box.max - inset};
    const Crossing x = cross(box, point, to_light);
    if (!x.hits) continue;
    require(index >= 0, "no map for a receiver in the shadow of caster", i);
    const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
    require(std::binary_search(list.begin(), list.end(), i), "caster", i, "culled from cascade", map.cascade);
    for (const double t : {x.enter, x.leave}) {
      const glm::dvec4 clip = map.clip_from_world * glm::dvec4(point + to_light * t, 1.0);
      require(clip.w > 0.0 && std::abs(clip.z) <= clip.w, "caster", i, "beyond the depths of", map.cascade);
    }
  }
}

TEST(CadenceLaw, under_random_walks_no_visible_receiver_leaves_a_kept_map) {
  int kept_points = 0, kept_maps = 0, planned_maps = 0;
  for_all(150, [&] {
    Case c = draw_case({.max_depth_ratio = 1e3, .max_boxes = 12});
    c.options.cadence.frames = 2 + pick(7);
    c.options.cadence.largest_step = c.camera.far_depth * std::pow(10.0, between(-4.0, -1.5));
    c.options.cadence.largest_turn = chance(0.3) ? 0.0 : std::pow(10.0, between(-4.0, -1.0));
    if (chance(0.3)) c.options.split.selection = MapSelection::finest;
    RC_LOG() << c;
    Random random(static_cast<std::uint64_t>(pick(1 << 20)));
    PlanHistory history;
    std::array<ShadowMap, kMaxMaps> before{};
    for (int frame = 0; frame < 20; ++frame) {
      const ShadowPlan plan = make_plan(c.camera, DirectionalLight{c.light}, c.bounds(), c.options, &history);
      require(plan.status != PlanStatus::invalid_input, plan.invalid_field);
      std::array<bool, kMaxMaps> kept{};
      for (const ShadowMap& map : plan.maps()) {
        const auto at = static_cast<std::size_t>(map.cascade);
        kept[at] = frame > 0 && map.cascade > 0 && reuse(before[at], map).kind == ReuseKind::identical;
        ++(kept[at] ? kept_maps : planned_maps);
        before[at] = map;
      }
      for (const glm::dvec3& point : visible_points(c, random, 2, 4)) {
        const int map = map_serving(plan, point, depth_of(c.camera, point));
        const bool in_kept =
            map >= 0 && kept[static_cast<std::size_t>(plan.map[static_cast<std::size_t>(map)].cascade)];
        kept_points += in_kept ? 1 : 0;
        require_served(c, plan, point, in_kept);
      }
      c.camera.position += random.direction() * (c.options.cadence.largest_step * random.unit());
      turn(c.camera, c.options.cadence.largest_turn * random.unit(), random);
    }
  });
  EXPECT_GT(kept_points, of_all_draws(2000));
  EXPECT_GT(kept_maps, planned_maps / 2);
}

}  // namespace
}  // namespace gnomon::test
