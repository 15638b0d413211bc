// Do maps leave the room that they promise: depths padded, the largest texel the largest, casters that touch
// kept, those beside the receivers culled?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "gnomon/extend/body.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

/// A block on the ground before the camera and a plate above it, under a light straight from above: which
/// heights the map must show is plain.
struct Stack {
  Case c;
  double size = 1.0, low = 0.0, high = 0.0, near = 0.0, far = 0.0;
  void set_boxes() {
    c.receivers = {{{-size, low, far}, {size, low + 0.5 * size, near}}};
    c.casters = {c.receivers[0], {{-size, high - 0.1 * size, far}, {size, high, near}}};
  }
};
Stack draw_stack() {
  Stack s;
  Case& c = s.c;
  const double size = std::exp2(between(-10.0, 10.0));
  c.camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.0, size, 40.0 * size, 512, 512);
  c.light = {0, -1, 0};
  s.low = -size * between(0.1, 1.0);
  s.high = size * between(2.0, 9.0);
  s.near = -size * between(15.0, 20.0);
  s.far = s.near - size * between(0.5, 9.0);
  s.size = size;
  s.set_boxes();
  c.options.cascades = 1;
  c.options.warp.warp = &warps::none;
  return s;
}

TEST(RoomLaw, nearest_and_farthest_depths_are_off_both_planes_by_more_than_a_float_rounds) {
  // The padding that every fit promises, of what is shown, on either side.
  constexpr double kPadding = 1.0 / 1024.0, kRounding = 1e-6;
  std::uint64_t judged = 0;
  for_all(600, [&] {
    Stack s = draw_stack();
    const Fit fits[] = {Fit::tight, Fit::rotated, Fit::stable, Fit::warped_stable};
    s.c.options.fit = fits[pick(4)];
    if (s.c.options.fit == Fit::stable) {
      // Depths in whole steps leave room by luck: none where both ends lie just inside of a step.
      const ShadowMap first = s.c.plan().map[0];
      const glm::dvec2 texel = first.snap_key.texel;
      const double side = std::max(texel.x, texel.y) * (first.width - 1 - 2 * first.filter_margin_texels);
      const double step = side / 16.0;
      s.low = -step * (1.0 - 1e-6);
      s.high = step * (1 + pick(3)) * (1.0 - 1e-6);
      s.set_boxes();
    }
    RC_LOG() << s.c;
    const ShadowPlan plan = s.c.plan();
    require(plan.map_count == 1, "maps", plan.map_count);
    const ShadowMap& map = plan.map[0];
    const Box& r = s.c.receivers[0];
    const auto depth = [&](double y) {
      const glm::dvec4 clip = map.clip_from_world * glm::dvec4(r.min.x, y, 0.5 * (r.min.z + r.max.z), 1.0);
      return 0.5 * (clip.z / clip.w + 1.0) * map.depth_range_world;
    };
    const double room = kPadding * (s.high - s.low) * (1.0 - kRounding);
    require(depth(s.high) >= room, "the highest caster is", depth(s.high), "behind the near plane, not", room,
            to_string(s.c.options.fit));
    require(map.depth_range_world - depth(s.low) >= room, "the lowest receiver is",
            map.depth_range_world - depth(s.low), "before the far plane, not", room,
            to_string(s.c.options.fit));
    ++judged;
  });
  EXPECT_EQ(judged, 600u);
}

/// Area of a texel across the light, by the map's own derivatives.
double texel_area(const ShadowMap& map, const glm::dvec3& travel, const glm::dvec3& p) {
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
  glm::dvec3 row[2];
  for (int axis = 0; axis < 2; ++axis) {
    for (int column = 0; column < 3; ++column)
      row[axis][column] =
          (map.clip_from_world[column][axis] - clip[axis] / clip.w * map.clip_from_world[column].w) / clip.w *
          0.5 * (axis == 0 ? map.width : map.height);
  }
  return 1.0 / std::abs(glm::dot(glm::cross(row[0], row[1]), travel));
}

TEST(RoomLaw, no_texel_of_a_body_has_a_larger_area_than_the_largest_is_said_to_have) {
  // Rounding of a Jacobian, and of positions up to 1e5 near planes away.
  constexpr double kRounding = 1e-6;
  std::uint64_t judged = 0, larger_than_the_centre = 0;
  for_all(600, [&] {
    const Case c = draw_case();
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    Random random(29);
    for (const glm::dvec3& p : visible_points(c, random, 4, 6)) {
      const ShadowMap* map = map_for(plan, depth_of(c.camera, p));
      if (map == nullptr) continue;
      const double area = texel_area(*map, plan.light_direction, p);
      const double largest = map->texel_world_max.x * map->texel_world_max.y;
      require(area <= largest * (1.0 + kRounding), "area", area, "largest", largest, "cascade", map->cascade,
              map->warp->name, "kappa", map->kappa);
      ++judged;
      larger_than_the_centre += area > 1.01 * map->texel_world.x * map->texel_world.y;
    }
  });
  EXPECT_GT(judged, of_all_draws(5000));
  EXPECT_GT(larger_than_the_centre, of_all_draws(500));
}

/// A box that touches a corner of another and lies outside of it otherwise.
Box touching(const Box& box, int corner, double size) {
  Box other;
  for (int axis = 0; axis < 3; ++axis) {
    const bool high = (corner >> axis & 1) != 0;
    other.min[axis] = high ? box.max[axis] : box.min[axis] - size;
    other.max[axis] = high ? box.max[axis] + size : box.min[axis];
  }
  return other;
}

TEST(RoomLaw, a_caster_that_touches_a_visible_receiver_is_drawn_however_far_from_the_origin) {
  std::uint64_t judged = 0;
  for_all(600, [&] {
    const glm::dvec3 away =
        glm::dvec3(between(-1, 1), between(-1, 1), between(-1, 1)) * std::exp2(between(0.0, 36.0));
    Case c;
    c.camera = perspective_camera(away, {0.1, -0.2, -1}, {0, 1, 0}, 1.0, 1.3, 0.5, 400.0, 640, 480);
    c.light = {between(-1, 1), between(-1.0, -0.1), between(-1, 1)};
    const glm::dvec3 at = away + glm::dvec3(between(-3, 3), between(-5, 0), between(-40, -20));
    c.receivers = {{at, at + glm::dvec3(between(0.5, 3), between(0.5, 3), between(0.5, 3))}};
    c.options.cascades = 1;
    c.options.warp.warp = &warps::none;
    c.options.filter.texels = 0.0;
    for (int corner = 0; corner < 8; ++corner) c.casters.push_back(touching(c.receivers[0], corner, 1.0));
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    require(plan.map_count == 1, "maps", plan.map_count, to_string(plan.status));
    std::vector<std::uint32_t> list(c.casters.size());
    list.resize(cull_casters(plan.map[0], c.casters, list));
    require(list.size() == c.casters.size(), "of 8 casters that touch, kept", list.size(), "at", away.x,
            away.y, away.z);
    ++judged;
  });
  EXPECT_EQ(judged, 600u);
}

/// Whether the line from `q` along `step`, t >= 0, meets what the camera sees of the box between two depths,
/// all of it grown by `room`.
bool meets_body(const Case& c, const Box& box, double begin, double end, const glm::dvec3& q,
                const glm::dvec3& step, double room) {
  const Polytope slice = frustum_slice(c.camera, camera_axes(c.camera), begin, end);
  double enter = 0.0, leave = 1e300;
  const auto keep = [&](const glm::dvec3& normal, double offset) {
    const double at = glm::dot(normal, q) + offset + room, slope = glm::dot(normal, step);
    if (slope > 0.0)
      enter = std::max(enter, -at / slope);
    else if (slope < 0.0)
      leave = std::min(leave, -at / slope);
    else if (at < 0.0)
      leave = -1.0;
  };
  for (int f = 0; f < slice.face_count; ++f) {
    const Plane& plane = slice.plane[static_cast<std::size_t>(f)];
    keep(plane.normal, plane.offset - glm::dot(plane.normal, c.camera.position));
  }
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    keep(normal, -box.min[axis]);
    keep(-normal, box.max[axis]);
  }
  return enter <= leave;
}

TEST(RoomLaw, a_grain_beside_the_shaft_of_light_over_the_receivers_is_culled) {
  std::uint64_t culled = 0, kept = 0;
  for_all(400, [&] {
    Case c = draw_case({.light_along_view = false, .max_depth_ratio = 1e3, .max_boxes = 1});
    c.receivers.resize(1);
    c.casters = c.receivers;
    c.options.fit = Fit::tight;
    c.options.filter.texels = 0.0;
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    const glm::dvec3 travel = plan.light_direction;
    Random random(31);
    for (const ShadowMap& map : plan.maps()) {
      const double reach =
          map.depth_range_world + map.texel_world.x * map.width + map.texel_world.y * map.height;
      // Far above the slack of a touching caster, which is relative to the farthest position.
      const double room = 1e-6 * reach + 1e-9 * (glm::length(c.camera.position) + c.camera.far_depth);
      for (const glm::dvec3& p : visible_points(c, random, 2, 6)) {
        const glm::dvec3 q = p + random.direction() * (reach * random.between(0.0, 1.0)) -
                             travel * (reach * random.between(-0.3, 1.0));
        const Box grain{q, q};
        const bool drawn = cull_casters(map, {&grain, 1}, {}) == 1;
        const bool inside = meets_body(c, c.receivers[0], map.depth_begin, map.depth_end, q, travel, 0.0);
        const bool near = meets_body(c, c.receivers[0], map.depth_begin, map.depth_end, q, travel, room);
        require(drawn || !inside, "a grain in the shaft is culled: cascade", map.cascade);
        // A shaft grown by its faces is sharper at its edges than one grown by planes along them: only what
        // is clear of both says anything.
        const bool clear =
            !meets_body(c, c.receivers[0], map.depth_begin, map.depth_end, q, travel, 0.02 * reach);
        require(!drawn || near || !clear, "a grain beside the shaft is kept: cascade", map.cascade, "at", q.x,
                q.y, q.z);
        culled += !drawn;
        kept += drawn;
      }
    }
  });
  EXPECT_GT(culled, of_all_draws(1000));
  EXPECT_GT(kept, of_all_draws(300));
}

/// Texels per area across the light, by differences.
double density(const ShadowMap& map, const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& p,
               double step) {
  const auto texel = [&](const glm::dvec3& q) {
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(q, 1.0);
    return glm::dvec2(clip.x * map.width, clip.y * map.height) * (0.5 / clip.w);
  };
  const glm::dvec2 a = texel(p + x * step) - texel(p - x * step),
                   b = texel(p + y * step) - texel(p - y * step);
  return std::abs(a.x * b.y - a.y * b.x);
}

TEST(RoomLaw, at_the_separating_plane_both_maps_are_as_dense) {
  constexpr double kEqual = 1.05;
  std::uint64_t divided = 0;
  double worst = 0.0;
  for_all(2500, [&] {
    Case c = draw_case({.orthographic = false, .max_depth_ratio = 1e4, .max_boxes = 1});
    const double f = c.camera.far_depth;
    c.receivers = c.casters = {{c.camera.position - glm::dvec3(2.0 * f, 0.3 * f, 2.0 * f),
                                c.camera.position + glm::dvec3(2.0 * f, -0.01 * f, 2.0 * f)}};
    c.options.fit = Fit::tight;
    c.options.cascades = 1;
    c.options.split.scheme = SplitScheme::logarithmic;
    c.options.split.range = SplitRange::receivers;
    c.options.split.pseudo_near = 0.0;
    c.options.filter = {};
    c.options.warp.warp = &warps::lispsm;
    c.options.prune = kPruneNothing;
    c.options.split.partition = Partition::separating_plane;
    RC_LOG() << c;
    const ShadowPlan parts = c.plan();
    if (parts.selection == MapSelection::view_depth || parts.map_count != 2 || !(parts.map[0].kappa > 0.0))
      return;
    Polytope body = frustum_slice(c.camera, camera_axes(c.camera), parts.map[0].depth_begin,
                                  std::max(parts.map[0].depth_end, parts.map[1].depth_end));
    clip(body, Box{c.receivers[0].min - c.camera.position, c.receivers[0].max - c.camera.position});
    const glm::dvec4 plane = parts.map[0].select_planes[0];
    const double offset = plane.w + glm::dot(glm::dvec3(plane), c.camera.position);
    clip(body, Plane{glm::dvec3(plane), offset});
    const glm::dvec3 light = glm::normalize(c.light), x = any_across(light), y = glm::cross(light, x);
    for (const Polytope::Vertex& v : body.vertices()) {
      const double reach = glm::length(v.position);
      if (!(std::abs(glm::dot(glm::dvec3(plane), v.position) + offset) <= 1e-9 * reach)) continue;
      const glm::dvec3 p = v.position + c.camera.position;
      const double step = 1e-5 * reach;
      const double ratio = density(parts.map[0], x, y, p, step) / density(parts.map[1], x, y, p, step);
      worst = std::max(worst, std::max(ratio, 1.0 / ratio));
      require(ratio <= kEqual && ratio >= 1.0 / kEqual, "the first map's texels are", ratio,
              "times as dense at the plane");
    }
    ++divided;
  });
  EXPECT_GT(divided, 5u);
  std::printf("divided %llu, worst ratio of densities at the plane %.4f\n",
              static_cast<unsigned long long>(divided), worst);
}

}  // namespace
}  // namespace gnomon::test
