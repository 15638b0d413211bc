// Objective::picture: where are the points that it counts, and is the warp found the best at them?
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "geometry/even_points.hpp"
#include "geometry/first_hits.hpp"
#include "gnomon/extend/body.hpp"
#include "gnomon/gnomon.hpp"

namespace gnomon::test {
namespace {

Camera street(double near_depth = 0.5) {
  return perspective_camera({0, 2, 0}, {0.1, -0.2, -1}, {0, 1, 0}, 1.0, 1.5, near_depth, 200.0, 960, 640);
}
const std::vector<Box> kStreet = {{{-150, 0, -190}, {150, 0, 20}},  // flat
                                  {{-8, 0, -40}, {-4, 9, -12}},
                                  {{4, 0, -90}, {9, 14, -30}},
                                  {}};

SeenPoints hits(const Camera& camera, const Boxes& boxes) {
  return first_hits(camera, camera_axes(camera), boxes);
}

const glm::dvec4 kSun{0, 1, 0, 0};

SeenPoints some(const Camera& camera, const std::vector<glm::dvec3>& points,
                const std::vector<glm::dvec3>& normals = {}, const glm::dvec4& light_world = kSun) {
  return some_of({.camera = camera, .points_world = points, .normals_world = normals}, camera_axes(camera),
                 light_world);
}

bool touches(const Box& box, const glm::dvec3& p) {
  constexpr double kRounding = 1e-9;
  for (int c = 0; c < 3; ++c)
    if (p[c] < box.min[c] - kRounding || p[c] > box.max[c] + kRounding) return false;
  return true;
}

TEST(SeenPoints, inside_of_a_body_are_those_on_its_sides_and_none_beyond) {
  const Polytope body = box_polytope({{-2, 0, -9}, {2, 3, -5}});
  const std::vector<glm::dvec3> points = {{0, 1, -7},      {2, 1, -7},  {2 + 1e-9, 1, -7}, {2.001, 1, -7},
                                          {0, -0.001, -7}, {0, 3, -5},  {0, 3.001, -5},    {0, 1, -4.99},
                                          {-2, 0, -9},     {-3, 5, -12}};
  std::array<glm::dvec3, SeenPoints::kMost> inside;
  ASSERT_EQ(points_inside(body, points, 1e-6, inside), 5u);
  for (std::size_t i = 0; const std::size_t kept : {0u, 1u, 2u, 5u, 8u}) EXPECT_EQ(inside[i++], points[kept]);
}

/// Of the boxes that the eye's ray to `point` meets, the one that it enters first.
const Box* first_box(const std::vector<Box>& boxes, const glm::dvec3& eye, const glm::dvec3& point) {
  constexpr int kSteps = 4000;
  for (int i = 1; i <= kSteps; ++i) {
    for (const Box& box : boxes)
      if (touches(box, eye + (point - eye) * (1.001 * i / kSteps))) return &box;
  }
  return nullptr;
}

TEST(FirstHits, lie_in_boxes_that_their_rays_meet_and_some_in_the_first) {
  const Camera camera = street();
  const SeenPoints seen = hits(camera, kStreet);
  ASSERT_GT(seen.count, 60u);
  int on_ground = 0, in_first = 0, behind = 0;
  for (const glm::dvec3& p : seen.points()) {
    const glm::dvec3 point = camera.position + p;
    const auto box =
        std::find_if(kStreet.begin(), kStreet.end(), [&](const Box& b) { return touches(b, point); });
    ASSERT_NE(box, kStreet.end());
    on_ground += box == kStreet.begin();
    ++(first_box(kStreet, camera.position, point) == &*box ? in_first : behind);
  }
  EXPECT_GT(on_ground, 10) << "a flat box is hit";
  EXPECT_GT(in_first, 15);
  EXPECT_GT(behind, 15) << "boxes are rarely all surface";
}

TEST(FirstHits, are_no_farther_than_six_boxes_whatever_lies_behind) {
  std::vector<Box> walls;
  for (int i = 0; i < 40; ++i) walls.push_back({{-500, -500, -11.0 - 2.0 * i}, {500, 500, -10.0 - 2.0 * i}});
  const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.5, 0.1, 200.0, 960, 640);
  const SeenPoints seen = hits(camera, walls);
  ASSERT_GT(seen.count, 100u);
  std::array<int, 6> in_wall{};
  for (const glm::dvec3& p : seen.points()) {
    const auto wall = static_cast<std::size_t>((-p.z - 10.0) / 2.0);
    ASSERT_LT(wall, in_wall.size());
    EXPECT_TRUE(touches(walls[wall], p));
    ++in_wall[wall];
  }
  for (const int rays : in_wall) EXPECT_GT(rays, 15);
}

TEST(FirstHits, of_a_box_round_the_eye_are_in_the_farther_half_of_each_ray) {
  const std::vector<Box> room = {{{-10, 0, -10}, {10, 6, 10}}};
  const Camera camera = street();
  const SeenPoints seen = hits(camera, room);
  ASSERT_GT(seen.count, 100u);
  int before_the_wall = 0;
  for (const glm::dvec3& p : seen.points()) {
    EXPECT_TRUE(touches(room[0], camera.position + p));
    EXPECT_FALSE(touches(room[0], camera.position + 2.001 * p));
    before_the_wall += touches(room[0], camera.position + 1.25 * p);
  }
  EXPECT_GT(before_the_wall, 40);
  EXPECT_LT(before_the_wall, 90);
}

TEST(FirstHits, do_not_depend_on_the_near_plane_before_the_boxes) {
  const SeenPoints far = hits(street(0.5), kStreet), near = hits(street(1e-5), kStreet);
  ASSERT_EQ(far.count, near.count);
  for (std::size_t i = 0; i < far.count; ++i) EXPECT_EQ(far.point[i], near.point[i]);
}

TEST(FirstHits, are_the_same_of_a_list_and_of_a_set) {
  std::vector<Box> boxes;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 at{-40.0 + 9.0 * (i % 10), 0.0, -8.0 - 5.0 * (i / 10)};
    boxes.push_back({at, at + glm::dvec3(2.0, 1.0 + i % 7, 2.0)});
  }
  std::vector<CasterBlock> blocks(CasterSet::block_count(boxes.size()));
  std::vector<std::uint32_t> indices(CasterSet::index_count(boxes.size()));
  const CasterSet set(boxes, blocks, indices);
  const SeenPoints list = hits(street(), boxes), tree = hits(street(), set);
  ASSERT_GT(list.count, 40u);
  ASSERT_EQ(list.count, tree.count);
  for (std::size_t i = 0; i < list.count; ++i) EXPECT_EQ(list.point[i], tree.point[i]);
}

TEST(FirstHits, of_rays_along_the_axes_are_hits_as_well) {
  // A middle ray straight ahead, at the height of a flat box, and past its end.
  Camera camera = street();
  camera.forward = {0, 0, -1};
  camera.orthographic = true;
  camera.left = camera.bottom = -4.0;
  camera.right = camera.top = 4.0;
  const SeenPoints seen =
      hits(camera, std::vector<Box>{{{-1, -9, -20}, {1, 9, -10}}, {{2, 2, -9}, {3, 2, -8}}});
  EXPECT_GT(seen.count, 20u);
  for (const glm::dvec3& p : seen.points()) EXPECT_LE(std::abs(p.x), 1.0);
}

TEST(FirstHits, of_nothing_are_none) {
  EXPECT_EQ(hits(street(), std::vector<Box>{}).count, 0u);
  EXPECT_EQ(hits(street(), std::vector<Box>{{{5, 5, 5}, {6, 6, 6}}}).count, 0u) << "behind the eye";
  EXPECT_EQ(some(street(), {}).count, 0u);
}

TEST(SomePoints, are_those_in_view_evenly_chosen) {
  const Camera camera = street();
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 10000; ++i) points.push_back({0.0, 0.0, -1.0 - 0.01 * i});
  const SeenPoints seen = some(camera, points);
  EXPECT_GT(seen.count, 100u);
  EXPECT_LE(seen.count, SeenPoints::kMost);
  const double infinity = std::numeric_limits<double>::infinity(), none = std::nan("");
  const std::vector<glm::dvec3> bad = {{0, 0, 5}, {0, 0, -infinity}, {none, 0, -5}, {0, 0, -500}, {0, 0, -5}};
  const SeenPoints good = some(camera, bad);
  ASSERT_EQ(good.count, 1u);
  EXPECT_EQ(good.point[0], glm::dvec3(0, 0, -5) - camera.position);
}

TEST(SomePoints, omit_surfaces_turned_from_the_light) {
  const Camera camera = street();
  // Twice as much ceiling as floor, and a wall that faces the eye, one after the other.
  std::vector<glm::dvec3> points, normals;
  const auto add = [&](const glm::dvec3& from, const glm::dvec3& step, const glm::dvec3& normal) {
    for (int i = 0; i < 4000; ++i) {
      points.push_back(from + step * static_cast<double>(i));
      normals.push_back(normal);
    }
  };
  const glm::dvec3 back{0, 0, -0.01};
  add({1, 5, -5}, back, {0, -1, 0});
  add({2, 5, -5}, back, {0, -1, 0});
  add({0, 3, -60}, {0.001, 0, 0}, {0, -0.6, 0.8});
  add({0, 0, -5}, back, {0, 1, 0});
  const auto floors = [](const SeenPoints& seen) {
    return std::count_if(seen.points().begin(), seen.points().end(),
                         [](const glm::dvec3& p) { return p.y == -2.0; });
  };
  const SeenPoints any = some(camera, points), lit = some(camera, points, normals);
  EXPECT_LT(2 * floors(any), static_cast<std::ptrdiff_t>(any.count));
  EXPECT_EQ(floors(lit), static_cast<std::ptrdiff_t>(lit.count));
  EXPECT_GT(lit.count, 120u) << "as many as there is room for, of what is left";
  const auto walls = [](const SeenPoints& seen) {
    return std::count_if(seen.points().begin(), seen.points().end(),
                         [](const glm::dvec3& p) { return p.z == -60.0; });
  };
  EXPECT_GT(walls(some(camera, points, normals, glm::dvec4(0, 2, -10, 1))), 20) << "before the wall";
  EXPECT_EQ(walls(some(camera, points, normals, glm::dvec4(0, 2, -70, 1))), 0) << "behind it";
}

TEST(SomePoints, count_where_the_normal_is_turned_from_the_eye) {
  const std::vector<glm::dvec3> points = {{0, 0, -5}, {0, 0, -9}}, normals = {{0, -1, 0}, {0, 1, 0}};
  EXPECT_EQ(some(street(), points, normals).count, 2u) << "nothing is known of such a surface";
}

HeldDepths held_by(const Camera& camera, const Boxes& boxes) {
  return held_depths(camera, camera_axes(camera), boxes, camera.near_depth);
}

/// Depths of a ray's cells, and points there, in world space.
std::vector<glm::dvec3> points_of(const HeldDepths& held, const Camera& camera, std::size_t ray) {
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 step = axes.forward +
                          axes.right * (camera.left + (camera.right - camera.left) * even_x(ray)) +
                          axes.up * (camera.bottom + (camera.top - camera.bottom) * even_y(ray));
  std::vector<glm::dvec3> points;
  for (int cell = 0; cell < HeldDepths::kCells; ++cell) {
    if ((held.cells[ray] >> cell & 1) == 0) continue;
    const double log2 = held.first + held.step * (cell + HeldDepths::into_cell(ray));
    points.push_back(camera.position + step * std::exp2(log2));
  }
  return points;
}

TEST(HeldDepths, know_the_logarithm_to_a_hundredth) {
  for (double x = 1e-9; x < 1e9; x *= 1.37) EXPECT_NEAR(HeldDepths::log2_of(x), std::log2(x), 0.011) << x;
  for (int power = -40; power < 40; ++power) EXPECT_EQ(HeldDepths::log2_of(std::exp2(power)), power);
}

TEST(HeldDepths, are_in_boxes_of_any_number_on_a_ray) {
  std::vector<Box> walls;
  for (int i = 0; i < 8; ++i) walls.push_back({{-900, -900, -14.0 - 9.0 * i}, {900, 900, -10.0 - 9.0 * i}});
  const Camera camera = perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 1.5, 8.0, 200.0, 960, 640);
  const HeldDepths held = held_by(camera, walls);
  std::array<int, 8> in_wall{};
  for (std::size_t ray = 0; ray < HeldDepths::kRays; ++ray) {
    for (const glm::dvec3& p : points_of(held, camera, ray)) {
      const double behind = -p.z - 10.0, into = std::fmod(behind, 9.0);
      constexpr double kApproximate = 0.01;
      EXPECT_TRUE(into <= 4.0 + kApproximate * -p.z || into >= 9.0 - kApproximate * -p.z) << p.z;
      ++in_wall[static_cast<std::size_t>(behind / 9.0 + 0.2)];
    }
  }
  // On each of 112 rays as many of 64 cells as the wall takes of the range, but for 0.011 octaves at both
  // ends.
  constexpr double kRange = 4.64, kOff = 112.0 * 2.0 * 0.011 * 64.0 / kRange;
  for (std::size_t i = 0; i < in_wall.size(); ++i) {
    const double nearest = 10.0 + 9.0 * static_cast<double>(i);
    const double cells = 64.0 * std::log((nearest + 4.0) / nearest) / std::log(200.0 / 8.0);
    EXPECT_NEAR(in_wall[i], 112.0 * cells, kOff) << i;
  }
}

TEST(HeldDepths, of_a_flat_box_are_one_on_each_ray_that_meets_it) {
  const Camera camera = street();
  const HeldDepths held = held_by(camera, std::vector<Box>{{{-900, 0, -900}, {900, 0, 900}}});
  int rays = 0;
  for (std::size_t ray = 0; ray < HeldDepths::kRays; ++ray) {
    const std::vector<glm::dvec3> points = points_of(held, camera, ray);
    ASSERT_LE(points.size(), 1u);
    if (points.empty()) continue;
    ++rays;
    // In the cell before the ground: cells are 400^(1/64) long.
    const double height = points[0].y / camera.position.y;
    EXPECT_GT(height, -0.01);
    EXPECT_LT(height, 0.11);
  }
  EXPECT_GT(rays, 70);
  EXPECT_LT(rays, 112);
}

TEST(HeldDepths, are_the_same_of_a_list_and_of_a_set_in_any_order) {
  std::vector<Box> boxes;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 at{-40.0 + 9.0 * (i % 10), 0.0, -8.0 - 5.0 * (i / 10)};
    boxes.push_back({at, at + glm::dvec3(2.0, 0.1 * (i % 7), i % 3 == 0 ? 30.0 : 0.2)});
  }
  std::vector<CasterBlock> blocks(CasterSet::block_count(boxes.size()));
  std::vector<std::uint32_t> indices(CasterSet::index_count(boxes.size()));
  const CasterSet set(boxes, blocks, indices);
  const HeldDepths list = held_by(street(), boxes), tree = held_by(street(), set);
  std::reverse(boxes.begin(), boxes.end());
  const HeldDepths reversed = held_by(street(), boxes);
  EXPECT_GT(std::count_if(list.cells.begin(), list.cells.end(), [](std::uint64_t c) { return c != 0; }), 15);
  EXPECT_EQ(list.cells, tree.cells);
  EXPECT_EQ(list.cells, reversed.cells);
}

TEST(HeldDepths, between_depths_that_are_nearly_one_are_finite) {
  const HeldDepths held(5.0, std::nextafter(5.0, 6.0));
  EXPECT_GT(held.step, 0.0);
  const HeldDepths::Range range = held.between(0, 1.0, 9.0);
  EXPECT_EQ(range.bits(), ~std::uint64_t{0});
}

/// Points on the street and on the walls beside it.
std::vector<glm::dvec3> points_of_street() {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 60; ++i) points.push_back({-3.0 + i % 7, 0.0, -9.0 - 1.2 * i});
  for (int i = 0; i < 30; ++i) points.push_back({4.0, 0.4 * (i % 20), -31.0 - 1.5 * i});
  return points;
}

/// The mean of what Objective::picture counts, by the metric's own texels at each point.
double mean_error(const ShadowPlan& plan, const Camera& camera, const std::vector<glm::dvec3>& points) {
  double sum = 0.0;
  for (const glm::dvec3& point : points) {
    const PointAliasing at = measure_perspective(plan.map[0], camera, point);
    sum += std::sqrt(0.5 * (at.m_max * at.m_max + at.m_min * at.m_min));
  }
  return sum / static_cast<double>(points.size());
}

TEST(PictureObjective, finds_the_warp_that_is_best_at_the_points) {
  const std::vector<glm::dvec3> points = points_of_street();
  double gained = 0.0;
  int views = 0;
  for (const double near_depth : {1e-4, 0.01, 1.0}) {
    for (const glm::dvec3 light :
         {glm::dvec3(0.3, -1, -0.4), glm::dvec3(-1, -0.6, 0.3), glm::dvec3(0.2, -1, 0.9)}) {
      View view{street(near_depth)};
      view.points_world = points;
      const auto error = [&](const Warp* warp, Objective objective) {
        PlanOptions options;
        options.cascades = 1;
        options.warp.warp = warp;
        options.warp.objective = objective;
        const ShadowPlan plan = make_plan(view, DirectionalLight{light}, {kStreet, kStreet}, options);
        return plan.map_count == 1 ? mean_error(plan, view.camera, points) : std::nan("");
      };
      const double found = error(&warps::optimal, Objective::picture);
      // Others judged by it as well, so that each is taken only where it gains.
      for (const Warp* warp : all_warps()) {
        const double most = warp == &warps::optimal_thorough ? 1.03 : 1.005;
        EXPECT_LE(found, most * error(warp, Objective::picture)) << warp->name << " near " << near_depth;
      }
      gained += std::log(error(&warps::optimal, Objective::storage) / found);
      ++views;
    }
  }
  EXPECT_GT(std::exp(gained / views), 1.3)
      << "what the volume's objective loses before a near plane in empty air";
}

/// How many of the maps show one of the points.
int maps_with_points(const ShadowPlan& plan, const Camera& camera, const std::vector<glm::dvec3>& points) {
  int maps = 0;
  for (const ShadowMap& map : plan.maps()) {
    maps += std::any_of(points.begin(), points.end(), [&](const glm::dvec3& p) {
      const double depth = glm::dot(p - camera.position, camera_axes(camera).forward);
      return depth >= map.depth_begin && depth < map.depth_end;
    });
  }
  return maps;
}

/// With four maps, by default but for `objective` and `scheme`.
ShadowPlan street_plan(const View& view, Objective objective, SplitScheme scheme = SplitScheme::automatic) {
  PlanOptions options;
  options.split.scheme = scheme;
  options.warp.objective = objective;
  return make_plan(view, DirectionalLight{{0.3, -1, -0.4}}, {kStreet, kStreet}, options);
}

TEST(PictureObjective, splits_follow_the_points) {
  View view{street(1e-4)};
  const std::vector<glm::dvec3> points = points_of_street();
  view.points_world = points;
  const ShadowPlan by_volume = street_plan(view, Objective::storage),
                   by_points = street_plan(view, Objective::picture),
                   logarithmic = street_plan(view, Objective::picture, SplitScheme::logarithmic);
  ASSERT_EQ(by_points.map_count, 4);
  EXPECT_LT(maps_with_points(by_volume, view.camera, points), 4);
  EXPECT_EQ(maps_with_points(by_points, view.camera, points), 4);
  EXPECT_EQ(logarithmic.map[0].depth_end, by_volume.map[0].depth_end) << "as asked for";
  // Errors at the points are less than of splits by their range.
  const auto error = [&](const ShadowPlan& plan) {
    double sum = 0.0;
    for (const glm::dvec3& p : points) {
      const double depth = glm::dot(p - view.camera.position, camera_axes(view.camera).forward);
      const int map = map_serving(plan, p, depth);
      EXPECT_GE(map, 0);
      if (map >= 0) sum += measure_perspective(plan.map[static_cast<std::size_t>(map)], view.camera, p).m_max;
    }
    return sum / static_cast<double>(points.size());
  };
  EXPECT_LT(error(by_points), 0.95 * error(logarithmic));
}

TEST(PictureObjective, splits_without_points_lie_where_the_boxes_are) {
  const View tiny{street(1e-4)}, usual{street(0.5)};
  const ShadowPlan a = street_plan(tiny, Objective::picture), b = street_plan(usual, Objective::picture);
  ASSERT_EQ(a.map_count, 4);
  ASSERT_EQ(b.map_count, 4);
  // The near plane stands before air, and does not count: not even where the ground begins behind the eye.
  for (std::size_t i = 0; i + 1 < 4; ++i) EXPECT_NEAR(a.map[i].depth_end / b.map[i].depth_end, 1.0, 1e-9);
  EXPECT_GT(a.map[0].depth_end, 4.0);
}

TEST(PictureObjective, goes_by_storage_where_no_one_view_is_counted) {
  const auto same = [](const ShadowPlan& a, const ShadowPlan& b) {
    if (a.map_count != b.map_count || a.map_count == 0) return false;
    for (std::size_t i = 0; i < a.maps().size(); ++i)
      if (a.map[i].clip_from_world != b.map[i].clip_from_world) return false;
    return true;
  };
  const std::vector<Camera> eyes = {street(), street()};
  PlanOptions picture, storage;
  storage.warp.objective = Objective::storage;
  const DirectionalLight sun{{0.3, -1, -0.4}};
  const SceneBounds bounds{kStreet, kStreet};
  EXPECT_TRUE(same(plan_views(eyes, sun, bounds, picture), plan_views(eyes, sun, bounds, storage)));
  for (PlanOptions* options : {&picture, &storage}) options->split.partition = Partition::frustum_faces;
  EXPECT_TRUE(same(make_plan(street(), sun, bounds, picture), make_plan(street(), sun, bounds, storage)));
  for (PlanOptions* options : {&picture, &storage}) {
    options->split.partition = Partition::view_depth;
    options->fit = Fit::stable;
  }
  EXPECT_TRUE(same(make_plan(street(), sun, bounds, picture), make_plan(street(), sun, bounds, storage)));
  EXPECT_FALSE(same(make_plan(street(), sun, bounds), make_plan(street(), sun, bounds, [] {
                      PlanOptions options;
                      options.warp.objective = Objective::storage;
                      return options;
                    }())));
}

TEST(PictureObjective, takes_what_it_can_get) {
  // Orthographic, without points, with a history, under local lights, with parts: a plan, and bounded error.
  PlanOptions options;
  options.warp.objective = Objective::picture;
  options.cascades = 3;
  Camera flat = street();
  flat.orthographic = true;
  flat.left = flat.bottom = -20.0;
  flat.right = flat.top = 20.0;
  PlanHistory history;
  const SpotLight spot{{2, 20, -20}, {0.0, -1.0, -0.1}, 0.8, 80.0};
  const PointLight point{{2, 9, -20}, 80.0};
  EXPECT_EQ(make_plan(flat, DirectionalLight{{0.3, -1, -0.4}}, {kStreet, kStreet}, options).status,
            PlanStatus::ok);
  for (int frame = 0; frame < 3; ++frame) {
    const ShadowPlan plan =
        make_plan(street(), DirectionalLight{{0.3, -1, -0.4}}, {kStreet, kStreet}, options, &history);
    EXPECT_EQ(plan.status, PlanStatus::ok);
  }
  EXPECT_EQ(make_plan(street(), spot, {kStreet, kStreet}, options).status, PlanStatus::ok);
  EXPECT_EQ(make_plan(street(), point, {kStreet, kStreet}, options).status, PlanStatus::ok);
  options.split.partition = Partition::frustum_faces;
  EXPECT_EQ(make_plan(street(), DirectionalLight{{0.3, -1, -0.4}}, {kStreet, kStreet}, options).status,
            PlanStatus::ok);
}

}  // namespace
}  // namespace gnomon::test
