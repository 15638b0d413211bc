// Does a spot or point light's plan show every receiver it lights, and every caster before it, wherever the
// light stands?
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <vector>

#include "support/finite.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// Rounding of positions through two matrices, relative to the map's half width.
constexpr double kRim = 1e-6;
// A map may begin at light_near_share of the farthest receiver, along the axis of a face; with room for
// rounding.
constexpr double kNearRoom = 1.1;
// A ray that only grazes a box, a cone or a range by this share may count either way.
constexpr double kGraze = 1e-9;

/// Half angle from which a spot has the faces of a cube: its tangent is the root of five.
const double kWidestSingle = std::atan(std::sqrt(5.0));

struct LightCase {
  Case scene;
  Light light;
  glm::dvec3 position, direction;
  double range = 1.0, outer = std::numbers::pi;
  bool spot = false;
  /// Smallest cosine between a ray and the axis of a map that holds it.
  [[nodiscard]] double least_cosine() const {
    if (spot && outer < kWidestSingle) return std::cos(outer);
    // In the corners; a wider one leaves the faces' overlap.
    return scene.options.split.partition == Partition::tetrahedron ? 0.33 : 0.57;
  }
  [[nodiscard]] ShadowPlan plan() const {
    return make_plan(scene.camera, light, scene.bounds(), scene.options);
  }
  /// Distance round the light in which nothing need be shown.
  [[nodiscard]] double too_near() const {
    double farthest = 0.0;
    for (const Box& box : scene.receivers) {
      const glm::dvec3 corner = glm::max(glm::abs(box.min - position), glm::abs(box.max - position));
      farthest = std::max(farthest, glm::length(corner));
    }
    return kNearRoom * scene.options.light_near_share * std::min(range, farthest);
  }
};

std::ostream& operator<<(std::ostream& out, const LightCase& c) {
  return out << c.scene << (c.spot ? "spot " : "point ") << "at (" << c.position.x << ", " << c.position.y
             << ", " << c.position.z << ") along (" << c.direction.x << ", " << c.direction.y << ", "
             << c.direction.z << ") half angle " << c.outer << " range " << c.range << '\n';
}

glm::dvec3 draw_position(const Case& c, Random& random) {
  const glm::dvec3 forward = camera_axes(c.camera).forward;
  const double f = c.camera.far_depth;
  switch (pick(6)) {
    case 0:  // on the eye
      return c.camera.position;
    case 1:  // behind it
      return c.camera.position - forward * (f * random.between(0.0, 1.0));
    case 2:  // inside a caster
      return 0.5 * (c.casters.front().min + c.casters.front().max);
    case 3:  // in view
      return point_at(c.camera, random.between(-1, 1), random.between(-1, 1),
                      c.camera.near_depth + (f - c.camera.near_depth) * std::pow(random.unit(), 3.0));
    case 4:  // over a receiver
      return 0.5 * (c.receivers.front().min + c.receivers.front().max) + random.direction() * (f * 0.1);
    default:
      return c.camera.position + random.direction() * (f * random.between(0.0, 3.0));
  }
}

LightCase draw_light_case() {
  LightCase c;
  CaseLimits limits;
  limits.max_boxes = 12;
  c.scene = draw_case(limits);
  c.scene.options.resolution.max_size = std::max(c.scene.options.resolution.max_size, 128);
  Random random(static_cast<std::uint64_t>(pick(1 << 30)));
  c.position = draw_position(c.scene, random);
  const Box& target =
      c.scene.receivers[static_cast<std::size_t>(pick(static_cast<int>(c.scene.receivers.size())))];
  const glm::dvec3 to_target = 0.5 * (target.min + target.max) - c.position;
  c.range = chance(0.7) ? glm::length(to_target) * random.between(0.8, 4.0) + 0.01 * c.scene.camera.far_depth
                        : c.scene.camera.far_depth * random.between(0.01, 4.0);
  c.direction = random.unit() < 0.3 || glm::length(to_target) == 0.0 ? random.direction() : to_target;
  if (random.unit() < 0.1 && c.position != c.scene.camera.position)
    c.direction = c.scene.camera.position - c.position;  // straight at the eye
  for (int i = 0; i < 4; ++i) {                          // something before a receiver
    const Box& r =
        c.scene.receivers[static_cast<std::size_t>(random.pick(static_cast<int>(c.scene.receivers.size())))];
    const glm::dvec3 to = 0.5 * (r.min + r.max) - c.position;
    const glm::dvec3 at = c.position + to * random.between(0.2, 0.95);
    const glm::dvec3 half(glm::length(to) * random.between(0.001, 0.1));
    c.scene.casters.push_back({at - half, at + half});
  }
  if (chance(0.3)) c.scene.options.light_near_share = std::exp2(between(-10.0, -1.0));
  c.spot = chance(0.6);
  if (c.spot) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    c.outer = (chance(0.7) ? between(0.5, 65.9) : between(65.9, 179.9)) * kDegree;
    c.light = SpotLight{c.position, c.direction, c.outer, c.range};
  } else {
    c.light = PointLight{c.position, c.range};
  }
  return c;
}

/// The same case with a point light whose maps are those of a tetrahedron.
LightCase draw_tetrahedron_case() {
  LightCase c = draw_light_case();
  c.spot = false;
  c.light = PointLight{c.position, c.range};
  c.scene.options.split.partition = Partition::tetrahedron;
  return c;
}

/// Whether the light reaches the point, clear of every border.
bool lit(const LightCase& c, const glm::dvec3& p) {
  const glm::dvec3 q = p - c.position;
  const double r = glm::length(q);
  if (!(r < c.range * (1.0 - kGraze))) return false;
  const double cosine = c.spot ? glm::dot(q, c.direction) / (r * glm::length(c.direction)) : 1.0;
  if (c.spot && !(std::acos(std::clamp(cosine, -1.0, 1.0)) < c.outer * (1.0 - 1e-7))) return false;
  const bool single = c.spot && c.outer < kWidestSingle;
  return r * (single ? cosine : c.least_cosine()) > c.too_near();
}

/// Points of a grid over image and depths that the single receiver and the light hold. A map shows more than
/// the cone that it was fitted to, and what is dark there counts for no warp.
std::vector<glm::dvec3> lit_points(const LightCase& c, const MeasureOptions& grid) {
  const Camera& camera = c.scene.camera;
  const Box& receiver = c.scene.receivers.front();
  std::vector<glm::dvec3> points;
  const auto middle = [](int i, int count) { return (i + 0.5) / count; };
  for (int k = 0; k < grid.depths; ++k) {
    const double depth =
        camera.near_depth * std::pow(camera.far_depth / camera.near_depth, middle(k, grid.depths));
    for (int i = 0; i < grid.columns * grid.rows; ++i) {
      const double x = 2.0 * middle(i % grid.columns, grid.columns) - 1.0;
      const double y = 2.0 * middle(i / grid.columns, grid.rows) - 1.0;
      const glm::dvec3 p = point_at(camera, x, y, depth);
      const bool inside =
          glm::all(glm::greaterThanEqual(p, receiver.min)) && glm::all(glm::lessThanEqual(p, receiver.max));
      if (inside && lit(c, p)) points.push_back(p);
    }
  }
  return points;
}

/// Smallest distance along the axis of any map at which casters must be shown, as a share of the way.
double shown_from(const LightCase& c, double length) {
  return c.too_near() / (c.least_cosine() * length);
}

struct Blocker {
  std::uint32_t index;
  double enter, leave;  // from the light (0) to the point (1), within what must be shown
};
std::vector<Blocker> blockers(const LightCase& c, const glm::dvec3& p) {
  std::vector<Blocker> found;
  const glm::dvec3 way = p - c.position;
  const double from = shown_from(c, glm::length(way));
  for (std::size_t i = 0; i < c.scene.casters.size(); ++i) {
    const Box& box = c.scene.casters[i];
    const double scale = glm::length(box.min - c.position) +
                         glm::length(c.position - c.scene.camera.position) + c.scene.camera.far_depth;
    const glm::dvec3 inset = glm::min(glm::dvec3(kGraze * scale), 0.5 * (box.max - box.min));
    const Crossing x = cross({box.min + inset, box.max - inset}, c.position, way);
    const double enter = std::max(x.enter, from), leave = std::min(x.leave, 1.0 - 1e-6);
    if (x.hits && enter < leave) found.push_back({static_cast<std::uint32_t>(i), enter, leave});
  }
  return found;
}

void hold_lit_receivers(LightCase (*draw)(), std::uint64_t least_held) {
  std::uint64_t held = 0, unmapped = 0, planned = 0;
  for_all(2500, [&] {
    const LightCase c = draw();
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
    if (plan.status == PlanStatus::ok) ++planned;
    Random random(7);
    for (const glm::dvec3& p : visible_points(c.scene, random, 6, 8)) {
      if (!lit(c, p)) continue;
      const int index = map_serving(plan, p, depth_of(c.scene.camera, p));
      if (index < 0) {
        ++unmapped;
        const auto before = blockers(c, p);
        require(before.empty(), "no map at (", p.x, p.y, p.z, ") but caster",
                before.empty() ? 0u : before.front().index, "status", to_string(plan.status));
        continue;
      }
      ++held;
      const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
      const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
      const double inner = 1.0 - 2.0 * c.scene.options.filter.texels / map.width;
      // map_holds leaves this much of the depths to rounding.
      constexpr double kDepthSlack = 1.0 + 2.1e-5;
      require(clip.w > 0.0 && std::abs(clip.x) <= (inner + 0.5 / map.width + kRim) * clip.w &&
                  std::abs(clip.y) <= (inner + 0.5 / map.width + kRim) * clip.w &&
                  std::abs(clip.z) <= clip.w * kDepthSlack,
              "outside its map");
    }
  });
  EXPECT_GT(held, least_held);
  EXPECT_GT(unmapped, of_all_draws(100));
  EXPECT_GT(planned, of_all_draws(800));
}
TEST(PositionalLaw, a_lit_receiver_in_view_is_held_by_a_map_or_nothing_stands_before_it) {
  hold_lit_receivers(draw_light_case, 10000);
}
TEST(PositionalLaw, a_lit_receiver_in_view_is_held_by_a_face_of_a_tetrahedron_or_nothing_stands_before_it) {
  hold_lit_receivers(draw_tetrahedron_case, 10000);
}

TEST(PositionalLaw, a_lit_receiver_in_view_is_held_by_the_single_map_of_its_spot) {
  std::uint64_t held = 0;
  for_all(1500, [&] {
    LightCase c = draw_light_case();
    if (!c.spot || c.outer > kWidestSingle) return;
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    if (plan.status == PlanStatus::no_caster) return;
    Random random(5);
    for (const glm::dvec3& p : visible_points(c.scene, random, 6, 8)) {
      if (!lit(c, p)) continue;
      require(map_serving(plan, p, 0.0) == 0, "not held: (", p.x, p.y, p.z, ")");
      ++held;
    }
  });
  EXPECT_GT(held, of_all_draws(3000));
}

void draw_casters_of_lit_receivers(LightCase (*draw)()) {
  std::uint64_t shadows = 0;
  for_all(2500, [&] {
    const LightCase c = draw();
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    std::vector<std::vector<std::uint32_t>> lists;
    for (const ShadowMap& map : plan.maps()) {
      std::vector<std::uint32_t> list(c.scene.casters.size());
      list.resize(cull_casters(map, c.scene.casters, list));
      require(!list.empty(), "a map without casters: face", map.cascade);
      lists.push_back(list);
    }
    Random random(11);
    for (const glm::dvec3& p : visible_points(c.scene, random, 6, 6)) {
      if (!lit(c, p)) continue;
      const int index = map_serving(plan, p, 0.0);
      if (index < 0) continue;
      const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
      const auto& list = lists[static_cast<std::size_t>(index)];
      for (const Blocker& blocker : blockers(c, p)) {
        ++shadows;
        require(std::binary_search(list.begin(), list.end(), blocker.index), "caster", blocker.index,
                "culled from face", map.cascade, map.warp->name);
        for (const double t : {blocker.enter, blocker.leave}) {
          const glm::dvec4 clip = map.clip_from_world * glm::dvec4(c.position + (p - c.position) * t, 1.0);
          require(clip.w > 0.0, "caster", blocker.index, "behind the map: w", clip.w);
          require(std::abs(clip.z) <= clip.w * (1.0 + 1e-9), "caster", blocker.index, "at depth",
                  clip.z / clip.w, "face", map.cascade, map.warp->name, "share of the way", t);
        }
      }
    }
  });
  EXPECT_GT(shadows, of_all_draws(3000));
}
TEST(PositionalLaw, every_caster_before_a_lit_receiver_is_drawn_within_the_depths_of_its_map) {
  draw_casters_of_lit_receivers(draw_light_case);
}
TEST(PositionalLaw, every_caster_before_a_lit_receiver_is_drawn_in_its_face_of_a_tetrahedron) {
  draw_casters_of_lit_receivers(draw_tetrahedron_case);
}

TEST(PositionalLaw, a_caster_that_only_the_filter_kernel_reaches_is_drawn_too) {
  std::uint64_t shadows = 0;
  for_all(1500, [&] {
    LightCase c = draw_light_case();
    if (c.scene.options.filter.texels < 1.0) c.scene.options.filter.texels = 1.0 + pick(4);
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    Random random(17);
    for (const glm::dvec3& p : visible_points(c.scene, random, 4, 4)) {
      const int index = lit(c, p) ? map_serving(plan, p, 0.0) : -1;
      if (index < 0) continue;
      const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
      const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
      const double reach = 2.0 * (c.scene.options.filter.texels - 0.25) / map.width;
      const glm::dvec2 tap{clip.x / clip.w + random.between(-reach, reach),
                           clip.y / clip.w + random.between(-reach, reach)};
      // The ray through the tap, up to the depth that its texel is compared with: farther off it may be
      // beyond the map's far plane. But no farther from the light than the receiver: equal depths of a warped
      // map slant, at times to infinity and beyond, and what lies behind all receivers shadows none.
      const glm::dmat4 world_from_clip = glm::inverse(map.clip_from_world);
      const auto away = [&](double depth) {
        const glm::dvec4 at = world_from_clip * glm::dvec4(tap, depth, 1.0);
        return glm::dvec3(at) / at.w - c.position;
      };
      const glm::dvec3 ray = glm::normalize(away(-1.0));
      const double compared = glm::dot(away(clip.z / clip.w), ray), receiver = glm::length(p - c.position);
      const glm::dvec3 way =
          ray * ((compared > 0.0 ? std::min(compared, receiver) : receiver) * (1.0 - 1e-6));
      std::vector<std::uint32_t> list(c.scene.casters.size());
      list.resize(cull_casters(map, c.scene.casters, list));
      for (const Blocker& blocker : blockers(c, c.position + way)) {
        ++shadows;
        require(std::binary_search(list.begin(), list.end(), blocker.index), "caster", blocker.index,
                "culled from face", map.cascade, map.warp->name, "kappa", map.kappa);
      }
    }
  });
  EXPECT_GT(shadows, of_all_draws(1000));
}

TEST(PositionalLaw, no_kernel_in_world_units_reads_outside_its_map) {
  // Rounding of a position in the map, in texels.
  constexpr double kTexel = 1e-3;
  std::uint64_t judged = 0, wide = 0;
  for_all(1500, [&] {
    LightCase c = draw_light_case();
    c.scene.options.filter.texels = 0.0;
    c.scene.options.filter.world = c.range * std::pow(10.0, between(-5.0, -1.0));
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    Random random(19);
    for (const glm::dvec3& p : visible_points(c.scene, random, 4, 6)) {
      const int index = lit(c, p) ? map_serving(plan, p, 0.0) : -1;
      if (index < 0) continue;
      const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
      // A margin of a quarter is as wide as it gets: the kernel is too wide for the map.
      if (4 * map.filter_margin_texels >= map.width) continue;
      const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
      const glm::dvec3 travel = glm::normalize(p - c.position);
      for (int axis = 0; axis < 2; ++axis) {
        const double ndc = clip[axis] / clip.w;
        // In the quarter texel beyond the margin that map_holds leaves to rounding, a kernel may, too.
        if (std::abs(ndc) > 1.0 - 2.0 * map.filter_margin_texels / map.width) continue;
        glm::dvec3 gradient;
        for (int column = 0; column < 3; ++column)
          gradient[column] =
              (map.clip_from_world[column][axis] - ndc * map.clip_from_world[column].w) / clip.w;
        const glm::dvec3 across = gradient - travel * glm::dot(gradient, travel);
        const double texels = 0.5 * map.width * glm::length(across) * c.scene.options.filter.world;
        const double room = 0.5 * map.width * (1.0 - std::abs(ndc));
        require(texels <= room + kTexel, "a kernel of", texels, "texels has room for", room, "margin",
                map.filter_margin_texels, "face", map.cascade, map.warp->name);
      }
      wide += map.filter_margin_texels > 2;
      ++judged;
    }
  });
  EXPECT_GT(judged, of_all_draws(1000));
  EXPECT_GT(wide, of_all_draws(100));
}

void have_sound_numbers(LightCase (*draw)()) {
  for_all(2500, [&] {
    const LightCase c = draw();
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    require(plan.selection != MapSelection::view_depth, "selection");
    require(std::abs(glm::length(plan.light_direction) - 1.0) < 1e-9, "direction");
    for (const ShadowMap& map : plan.maps()) {
      require(all_finite(map.clip_from_world), "clip_from_world");
      require(all_finite(map.clip_from_camera_relative), "clip_from_camera_relative");
      require(glm::dvec3(map.light_world) == c.position ||
                  glm::length(glm::dvec3(map.light_world) - c.position) <=
                      1e-12 * glm::length(c.position) + 1e-12 * c.scene.camera.far_depth,
              "light");
      require(map.light_world.w == 1.0 && map.warp != nullptr, "light or warp");
      require(map.kappa >= 0.0 && std::isfinite(map.kappa), "kappa", map.kappa);
      require(map.depth_begin <= map.depth_end, "depths");
      require(map.depth_range_world > 0.0 && std::isfinite(map.depth_range_world), "depth range");
      require(map.texel_world.x > 0.0 && map.texel_world.y > 0.0 &&
                  map.texel_world_max.x >= map.texel_world.x && map.texel_world_max.y >= map.texel_world.y &&
                  std::isfinite(map.texel_world_max.x + map.texel_world_max.y),
              "texel", map.texel_world.x, map.texel_world.y, map.texel_world_max.x, map.texel_world_max.y);
      require(map.m_s_max > 0.0 && map.m_t_max > 0.0 && std::isfinite(map.storage), "storage", map.storage);
      // At least the cone through the light.
      require(map.cull_plane_count >= 4 && map.cull_plane_count <= kMaxCullPlanes, "planes");
      for (int i = 0; i < map.cull_plane_count; ++i) {
        const glm::dvec4& plane = map.cull_planes[static_cast<std::size_t>(i)];
        require(std::abs(glm::length(glm::dvec3(plane)) - 1.0) < 1e-9 && std::isfinite(plane.w), "plane", i);
      }
      require(map.snap_key.valid == (c.scene.options.fit == Fit::stable), "snap key");
    }
  });
}
TEST(PositionalLaw, every_number_of_a_map_is_finite_and_of_its_sign) {
  have_sound_numbers(draw_light_case);
}
TEST(PositionalLaw, every_number_of_a_tetrahedrons_map_is_finite_and_of_its_sign) {
  have_sound_numbers(draw_tetrahedron_case);
}

TEST(PositionalLaw, a_warp_never_makes_its_map_need_more_storage) {
  std::uint64_t warped = 0, compared = 0, between_samples = 0;
  for_all(1500, [&] {
    LightCase c = draw_light_case();
    if (c.scene.camera.orthographic) return;
    // Of several receivers the body is their common box, and the measure sees only part of that.
    c.scene.receivers = {c.scene.receivers.back()};
    c.scene.options.fit = Fit::tight;
    // Nearer points are measured and do not count for the choice.
    c.scene.options.split.pseudo_near = 0.0;
    c.scene.options.prune = c.scene.options.prune.without(PruneRule::metric_resolution);
    c.scene.options.warp.objective = Objective::storage;
    c.scene.options.warp.warp = chance(0.5) ? nullptr : &warps::lispsm;
    RC_LOG() << c;
    const ShadowPlan with = c.plan();
    c.scene.options.warp.warp = &warps::none;
    const ShadowPlan without = c.plan();
    for (const ShadowMap& a : with.maps()) {
      if (a.kappa > 0.0) ++warped;
      for (const ShadowMap& b : without.maps()) {
        if (a.cascade != b.cascade) continue;
        // The warp is chosen by samples of the exact error, and measured at others.
        constexpr double kSampled = 1.25, kFew = 3.0;  // among tens of thousands of cases some lie between
        constexpr std::uint64_t kEnough = 100;
        if (with.map_count > 1 || without.map_count > 1) continue;
        const std::vector<glm::dvec3> points = lit_points(c, {24, 24, 32});
        const AliasingStats m = measure(with, {.camera = c.scene.camera, .points_world = points}, {});
        const AliasingStats n = measure(without, {.camera = c.scene.camera, .points_world = points}, {});
        if (m.samples < kEnough || m.samples != n.samples) continue;
        ++compared;
        double after = m.storage, before = n.storage;
        // Few rays of the grid may miss the worst corner of the map without a warp.
        if (!(after <= before * kSampled)) {
          const std::vector<glm::dvec3> fine = lit_points(c, {100, 100, 100});
          after = measure(with, {.camera = c.scene.camera, .points_world = fine}, {}).storage;
          before = measure(without, {.camera = c.scene.camera, .points_world = fine}, {}).storage;
        }
        between_samples += after <= before * kSampled ? 0 : 1;
        require(after <= before * kFew, "face", a.cascade, "storage", after, "above", before);
      }
    }
  });
  EXPECT_GT(warped, of_all_draws(500));
  EXPECT_GT(compared, of_all_draws(50));
  EXPECT_LE(between_samples, 1 + compared / 200);
}

TEST(PositionalLaw, a_measured_warp_is_not_above_the_unwarped_map_by_more_than_sampling) {
  // The search sees the body's vertices and edges, the measure a grid of pixels inside. The worst texel of a
  // light inside the body lies where the eye's rays meet the light's, off all of them. The most that was
  // found, 1.25, is a wide view of a narrow spot at the box (seed 932768).
  constexpr double kSampling = 1.3;
  std::uint64_t compared = 0;
  for_all(1000, [&] {
    LightCase c = draw_light_case();
    if (c.scene.camera.orthographic) return;
    // Of several receivers the body is their common box, and the measure sees only part of that.
    c.scene.receivers = {c.scene.receivers.back()};
    c.scene.options.fit = Fit::tight;
    c.scene.options.prune = c.scene.options.prune.without(PruneRule::metric_resolution);
    c.scene.options.warp.objective = Objective::max;
    c.scene.options.split.pseudo_near = 0.0;
    c.scene.options.warp.warp = nullptr;
    RC_LOG() << c;
    const ShadowPlan with = c.plan();
    c.scene.options.warp.warp = &warps::none;
    const ShadowPlan without = c.plan();
    for (int i = 0; i < with.map_count; ++i) {
      if (with.map_count > 1 || without.map_count > 1) continue;
      const std::vector<glm::dvec3> points = lit_points(c, {16, 16, 32});
      const AliasingStats a = measure(with, {.camera = c.scene.camera, .points_world = points}, {});
      const AliasingStats b = measure(without, {.camera = c.scene.camera, .points_world = points}, {});
      if (a.samples < 50 || a.samples != b.samples) continue;
      ++compared;
      double after = a.max, before = b.max;
      // A body that shows in a few rays of the grid may hide its worst corner from it, and with that what the
      // map without a warp loses there: only what a dense grid shows counts against a warp.
      if (!(after <= before * kSampling)) {
        const std::vector<glm::dvec3> fine = lit_points(c, {200, 200, 200});
        after = measure(with, {.camera = c.scene.camera, .points_world = fine}, {}).max;
        before = measure(without, {.camera = c.scene.camera, .points_world = fine}, {}).max;
      }
      require(after <= before * kSampling, "map", i, "max", after, "above", before, "samples", a.samples);
    }
  });
  EXPECT_GT(compared, of_all_draws(20));
}

}  // namespace
}  // namespace gnomon::test
