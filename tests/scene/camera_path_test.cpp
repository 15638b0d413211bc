// Camera flights: through their keys, without jumps, to files and back.
#include "gnomon/scene/camera_path.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "gltf_text.hpp"

namespace gnomon::test {
namespace {

constexpr double kRounding = 1e-12;  // of numbers of size 10 through three levels of interpolation

CameraPath path_of(std::vector<CameraKey> keys, bool closed = false) {
  CameraPath path;
  path.keys = std::move(keys);
  path.closed = closed;
  return path;
}

double distance(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(a - b);
}

TEST(Sight, begins_half_way_to_the_nearest_box_and_ends_behind_the_farthest) {
  const Box ground{{-5e4, 0, -5e4}, {5e4, 0, 5e4}}, crate{{-0.5, 0, -0.5}, {0.5, 1, 0.5}},
      room{{-5, 0, -5}, {5, 3, 5}};
  const auto from = [](const glm::dvec3& eye, std::vector<Box> boxes) { return sight_from(eye, boxes); };
  // Two metres over the ground: one metre, which is a power of two.
  EXPECT_EQ(from({0, 2, 5}, {ground, crate}).near_depth, 1.0);
  EXPECT_EQ(from({0, 2, 5}, {ground, crate}).far_depth, 131072.0);
  // Closer to the crate than to the ground, and inside of a room: 1e-4 of sixteen metres.
  EXPECT_EQ(from({0, 1.5, 0}, {ground, crate}).near_depth, 0.25);
  EXPECT_EQ(from({0, 1.6, 0}, {room}).far_depth, 8.0);
  EXPECT_EQ(from({0, 1.6, 0}, {room}).near_depth, std::exp2(std::floor(std::log2(8e-4))));
  // Never in front of it all, never at or behind its end, and a default where there is nothing.
  for (const glm::dvec3& eye :
       {glm::dvec3(0, 0, 0), glm::dvec3(0, 1e-12, 0), glm::dvec3(1e9, 0, 0), glm::dvec3(0, 1, 0.5)}) {
    const Sight sight = from(eye, {ground, crate});
    EXPECT_GE(sight.near_depth, 0.5e-6 * sight.far_depth);
    EXPECT_LT(sight.near_depth, sight.far_depth);
  }
  for (const std::vector<Box>& nothing : {std::vector<Box>{}, {Box{}}, {Box{{0, 0, 0}, {0, 0, 0}}}}) {
    EXPECT_EQ(from({0, 0, 0}, nothing).near_depth, Sight{}.near_depth);
    EXPECT_EQ(from({0, 0, 0}, nothing).far_depth, Sight{}.far_depth);
  }
}

TEST(CameraPath, without_keys_there_is_still_a_camera) {
  const Camera camera = CameraPath().at(0.5, 640, 480);
  EXPECT_GT(glm::length(camera.forward), 0.0);
  EXPECT_EQ(camera.width, 640);
}

TEST(CameraPath, one_key_is_a_still_camera) {
  const CameraPath path = path_of({{{1, 2, 3}, {1, 2, 0}}});
  for (const double t : {-1.0, 0.0, 0.3, 1.0, 7.0}) {
    EXPECT_EQ(path.at(t, 4, 4).position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(glm::normalize(path.at(t, 4, 4).forward), glm::dvec3(0, 0, -1));
  }
}

TEST(CameraPath, keys_that_repeat_do_not_divide_by_nothing) {
  const CameraKey key{{1, 2, 3}, {0, 0, 0}};
  for (const bool closed : {false, true}) {
    for (int i = 0; i <= 20; ++i) {
      const Camera same = path_of({key, key, key}, closed).at(i / 20.0, 4, 4);
      EXPECT_LT(distance(same.position, key.position), kRounding);
      const Camera moved = path_of({key, key, {{5, 2, 3}, {0, 0, 0}}, key}, closed).at(i / 20.0, 4, 4);
      EXPECT_TRUE(std::isfinite(glm::length(moved.position)));
      EXPECT_LT(distance(moved.position, {3, 2, 3}), 5.0) << "stays near its keys";
    }
  }
}

TEST(CameraPath, a_time_outside_the_flight_or_not_a_number_is_its_nearer_end) {
  const CameraPath path = path_of({{{0, 0, 0}, {0, 0, -1}}, {{8, 0, 0}, {8, 0, -1}}});
  EXPECT_LT(distance(path.at(-3.0, 4, 4).position, {0, 0, 0}), kRounding);
  EXPECT_LT(distance(path.at(3.0, 4, 4).position, {8, 0, 0}), kRounding);
  EXPECT_LT(distance(path.at(std::nan(""), 4, 4).position, {0, 0, 0}), kRounding);
}

TEST(CameraPath, between_two_keys_it_goes_straight_and_evenly) {
  const CameraPath path = path_of({{{0, 0, 0}, {0, 0, -1}}, {{8, 4, 0}, {8, 4, -1}}});
  EXPECT_LT(distance(path.at(0.25, 4, 4).position, {2, 1, 0}), kRounding);
  EXPECT_LT(distance(path.at(0.5, 4, 4).forward, {0, 0, -1}), kRounding);
}

TEST(CameraPath, a_target_that_meets_the_position_between_keys_still_gives_a_direction) {
  const CameraPath path = path_of({{{0, 0, 0}, {2, 0, 0}}, {{2, 0, 0}, {0, 0, 0}}});
  EXPECT_GT(glm::length(path.at(0.5, 4, 4).forward), 0.0);
}

TEST(CameraPath, keys_as_far_away_as_files_may_have_them_give_finite_cameras) {
  const CameraPath path =
      path_of({{{1e30, 0, -1e30}, {-1e30, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}, {{0, 1e30, 0}, {1e30, 0, 0}}});
  for (int i = 0; i <= 10; ++i) {
    const Camera camera = path.at(0.1 * i, 4, 4);
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(camera.position[c]) && std::isfinite(camera.forward[c])) << i;
    }
  }
}

TEST(CameraPath, passes_through_every_key_in_order) {
  const std::vector<CameraKey> keys{{{0, 0, 0}, {0, 0, -9}},
                                    {{1, 5, 0}, {4, 0, 0}},
                                    {{9, 5, 2}, {0, 3, 0}},
                                    {{9, 6, 2}, {1, 1, 1}},
                                    {{-4, 0, 7}, {0, 1, 0}}};
  for (const bool closed : {false, true}) {
    const CameraPath path = path_of(keys, closed);
    std::size_t next = 0;
    constexpr int kSteps = 200'000;
    for (int i = 0; i <= kSteps && next < keys.size(); ++i) {
      const Camera camera = path.at(static_cast<double>(i) / kSteps, 4, 4);
      const bool here = distance(camera.position, keys[next].position) < 1e-3 &&
                        distance(camera.position + camera.forward, keys[next].target) < 1e-2;
      next += here ? 1u : 0u;
    }
    EXPECT_EQ(next, keys.size()) << (closed ? "closed" : "open");
    const glm::dvec3 last = closed ? keys.front().position : keys.back().position;
    EXPECT_LT(distance(path.at(1.0, 4, 4).position, last), kRounding * 10);
  }
}

TEST(CameraPath, has_no_jump_in_place_or_speed) {
  const CameraPath path = path_of(
      {{{0, 0, 0}, {0, 0, -9}}, {{1, 5, 0}, {4, 0, 0}}, {{9, 5, 2}, {0, 3, 0}}, {{-4, 0, 7}, {0, 1, 0}}},
      true);
  constexpr int kSteps = 4000;
  glm::dvec3 before = path.at(0.0, 4, 4).position, step_before(0.0);
  double fastest = 0.0, sharpest = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const glm::dvec3 now = path.at(static_cast<double>(i) / kSteps, 4, 4).position, step = now - before;
    fastest = std::max(fastest, glm::length(step));
    if (i > 1) sharpest = std::max(sharpest, glm::length(step - step_before));
    before = now;
    step_before = step;
  }
  EXPECT_LT(fastest, 0.05);  // the loop is about 40 long
  EXPECT_LT(sharpest,
            fastest / 20);  // speed changes by little from step to step; a kink would change it by as much
}

TEST(CameraPath, makes_a_perspective_camera_of_the_requested_image) {
  CameraPath path = path_of({{{0, 0, 0}, {0, 0, -5}}});
  path.fov_y_radians = std::numbers::pi / 2.0;
  path.near_depth = 0.5;
  path.far_depth = 50.0;
  const Camera camera = path.at(0.0, 200, 100);
  EXPECT_NEAR(camera.top, 1.0, kRounding);
  EXPECT_NEAR(camera.right, 2.0, kRounding);
  EXPECT_EQ(camera.near_depth, 0.5);
  EXPECT_EQ(camera.far_depth, 50.0);
  EXPECT_EQ(camera.up, glm::dvec3(0, 1, 0));
}

TEST(CameraPath, that_looks_straight_down_has_north_at_its_top_and_up_has_it_at_its_foot) {
  for (const double height_world : {0.0, 30.0}) {
    // Files turn nodes by quaternions in single precision.
    for (const double off : {0.0, 3e-8, -3e-8}) {
      CameraPath path;
      path.height_world = height_world;
      path.keys = {{{5.0, 40.0, -7.0}, {5.0 + 40.0 * off, 0.0, -7.0 - 40.0 * off}}};
      EXPECT_NEAR(camera_axes(path.at(0.5, 96, 54)).up.z, -1.0, 1e-9);
      path.keys[0].target.y = 80.0;
      EXPECT_NEAR(camera_axes(path.at(0.5, 96, 54)).up.z, 1.0, 1e-9);
    }
  }
}

TEST(CameraPath, has_the_up_of_its_keys_at_the_top_of_the_picture) {
  const auto up_of = [](const CameraPath& path, double t) { return camera_axes(path.at(t, 96, 54)).up; };
  CameraPath path = path_of({{{0, 0, 5}, {0, 0, 0}, {-2, 2, 0}}});
  const double half = std::sqrt(0.5);
  EXPECT_LT(distance(up_of(path, 0.0), {-half, half, 0}), kRounding);
  // Half way from one to the other it has turned half of the way.
  path = path_of({{{0, 0, 5}, {0, 0, 0}}, {{0, 0, 5}, {0, 0, 0}, {-1, 0, 0}}});
  EXPECT_LT(distance(up_of(path, 0.5), {-half, half, 0}), kRounding);
  // Down, with east at its top.
  path = path_of({{{0, 5, 0}, {0, 0, 0}, {1, 0, 0}}});
  EXPECT_LT(distance(up_of(path, 0.0), {1, 0, 0}), kRounding);
  // Along the view there is still a picture.
  path = path_of({{{0, 0, 5}, {0, 0, 0}, {0, 0, 1}}});
  EXPECT_NEAR(glm::length(up_of(path, 0.0)), 1.0, kRounding);
}

TEST(CameraKey, of_an_upright_camera_has_the_world_s_up) {
  const glm::dvec3 world_up{0, 1, 0}, forward = glm::normalize(glm::dvec3(1, -2, -3));
  CameraKey key{{1, 2, 3}, glm::dvec3(1, 2, 3) + forward};
  const CameraAxes upright = camera_axes(path_of({key}).at(0.0, 4, 4));
  EXPECT_EQ(camera_key(key.position, forward, upright.up).up, world_up);
  EXPECT_EQ(camera_key(key.position, forward, upright.up + 1e-8 * upright.right).up, world_up);
  for (const glm::dvec3& up :
       {-upright.up, upright.right, glm::normalize(upright.up + 1e-3 * upright.right)}) {
    key = camera_key({1, 2, 3}, forward, up);
    EXPECT_LT(distance(camera_axes(path_of({key}).at(0.0, 4, 4)).up, up), kRounding);
  }
  // Straight down: north is upright.
  EXPECT_EQ(camera_key({0, 9, 0}, {0, -1, 0}, {0, 0, -1}).up, world_up);
  EXPECT_EQ(camera_key({0, 9, 0}, {0, -1, 0}, {1, 0, 0}).up, glm::dvec3(1, 0, 0));
}

TEST(CameraPath, with_a_height_is_orthographic) {
  CameraPath path = path_of({{{0, 0, 10}, {0, 0, 0}}});
  path.height_world = 6.0;
  const Camera camera = path.at(0.5, 200, 100);
  EXPECT_TRUE(camera.orthographic);
  EXPECT_EQ(camera.top, 3.0);
  EXPECT_EQ(camera.left, -6.0);
  // All of a scene lies before it, from wherever it looks, and once more it stays.
  const Box all{{-30, -1, -20}, {50, 8, 40}};
  path.keys = {{{0, 3, 1}, {1, 0, 0}}};
  see_all(path, {&all, 1});
  const Camera outside = path.at(0.0, 10, 10);
  const CameraAxes axes = camera_axes(outside);
  EXPECT_LT(glm::length(axes.forward - glm::normalize(glm::dvec3(1, -3, -1))), kRounding);
  EXPECT_LT(glm::length(glm::cross(outside.position - glm::dvec3(0, 3, 1), axes.forward)), 1e-10);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at((corner & 1) != 0 ? all.max.x : all.min.x, (corner & 2) != 0 ? all.max.y : all.min.y,
                        (corner & 4) != 0 ? all.max.z : all.min.z);
    const double depth = glm::dot(at - outside.position, axes.forward);
    EXPECT_GE(depth, outside.near_depth);
    EXPECT_LE(depth, outside.far_depth);
  }
  CameraPath again = path;
  see_all(again, {&all, 1});
  EXPECT_LT(glm::length(again.keys[0].position - path.keys[0].position), 1e-10);
  const WrittenFolder folder;
  save_camera_path(path, folder.path() / "plan.json");
  EXPECT_EQ(load_camera_path(folder.path() / "plan.json").height_world, 6.0);
}

TEST(CameraPathFile, saved_and_loaded_again_is_the_same_flight) {
  CameraPath path =
      path_of({{{0.1, 1e-9, 3e7}, {1.0 / 3.0, 0, 0}}, {{4, 5, 6}, {7, 8, 9}, {0.1, -3, 2}}}, true);
  path.near_depth = 0.123;
  path.far_depth = 4567.8;
  const WrittenFolder folder;
  save_camera_path(path, folder.path() / "flight.json");
  const CameraPath back = load_camera_path(folder.path() / "flight.json");
  ASSERT_EQ(back.keys.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.keys[i].position, path.keys[i].position);
    EXPECT_EQ(back.keys[i].target, path.keys[i].target);
    EXPECT_EQ(back.keys[i].up, path.keys[i].up);
  }
  EXPECT_TRUE(back.closed);
  EXPECT_EQ(back.near_depth, path.near_depth);
  EXPECT_EQ(back.far_depth, path.far_depth);
  EXPECT_NEAR(back.fov_y_radians, path.fov_y_radians, kRounding);
}

TEST(CameraPathFile, what_is_wrong_is_named_with_its_file_and_key) {
  const WrittenFolder folder;
  const std::string key = R"({"position":[0,0,0],"target":[0,0,1]})";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "JSON"},
      {"{", "file"},
      {"[]", "path"},
      {"{}", "keys"},
      {R"({"keys":[]})", "keys"},
      {R"({"keys":[{"position":[0,0,0]}]})", "keys[0]: has no target"},
      {R"({"keys":[{"position":[0,0],"target":[0,0,1]}]})", "keys[0].position"},
      {R"({"keys":[{"position":[0,0,"1"],"target":[0,0,1]}]})", "keys[0].position"},
      {R"({"keys":[{"position":[0,0,1],"target":[0,0,1]}]})", "keys[0]: target is the position"},
      {R"({"keys":[{"position":[0,0,1e31],"target":[0,0,1]}]})",
       "keys[0].position: must be three numbers up to 1e30"},
      {R"({"keys":[{"position":[0,0,1],"target":[-1e155,0,1]}]})", "keys[0].target: must be"},
      {R"({"keys":[)" + key + R"(],"near":1e307,"far":1e308})", "near: must be a number up to 1e30"},
      {R"({"keys":[{"position":[0,0,1],"target":[0,0,2],"roll":1}]})", "unknown key 'roll'"},
      {R"({"keys":[{"position":[0,0,1],"target":[0,0,2],"up":[0,0,0]}]})", "keys[0].up: must not be zero"},
      {R"({"keys":[{"position":[0,0,1],"target":[0,0,2],"up":[0,1]}]})", "keys[0].up: must be three numbers"},
      {R"({"keys":[)" + key + R"(],"fov":60})", "unknown key 'fov'"},
      {R"({"keys":[)" + key + R"(],"fov_y_deg":180})", "fov_y_deg"},
      {R"({"keys":[)" + key + R"(],"height_world":0})", "height_world: must be above 0"},
      {R"({"keys":[)" + key + R"(],"height_world":2,"fov_y_deg":60})", "height_world: is given beside fov"},
      {R"({"keys":[)" + key + R"(],"near":0})", "near"},
      {R"({"keys":[)" + key + R"(],"near":5,"far":5})", "far"},
      {R"({"keys":[)" + key + R"(],"closed":1})", "closed"},
      {R"({"keys":[)" + key + R"(],"far":1e999})", "file"},
      {std::string(1000, '['), "nested"}};
  for (const auto& [text, wanted] : cases) {
    const auto file = folder.write("flight.json", text);
    try {
      (void)load_camera_path(file);
      ADD_FAILURE() << text << " was loaded";
    } catch (const SceneError& e) {
      const std::string message = e.what();
      EXPECT_TRUE(message.starts_with(file.string() + ": ")) << message;
      EXPECT_NE(message.find(wanted), std::string::npos) << message << " for " << text;
    }
  }
  EXPECT_THROW((void)load_camera_path(folder.path() / "none.json"), SceneError);
  EXPECT_THROW(save_camera_path(path_of({}), folder.path() / "none/flight.json"), SceneError);
}

void expect_orbit_holds(const Box& bounds) {
  Scene scene;
  scene.bounds_world = bounds;
  const CameraPath path = default_path(scene);
  EXPECT_TRUE(path.closed);
  EXPECT_GT(path.near_depth, 0.0);
  EXPECT_GT(path.far_depth, path.near_depth);
  const Box seen = bounds.empty() ? Box{glm::dvec3(0.0), glm::dvec3(0.0)} : bounds;
  for (int i = 0; i <= 64; ++i) {
    const Camera camera = path.at(i / 64.0, 100, 100);
    const CameraAxes axes = camera_axes(camera);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p((corner & 1) != 0 ? seen.max.x : seen.min.x,
                         (corner & 2) != 0 ? seen.max.y : seen.min.y,
                         (corner & 4) != 0 ? seen.max.z : seen.min.z);
      const glm::dvec3 to = p - camera.position;
      const double depth = glm::dot(to, axes.forward);
      ASSERT_GT(depth, camera.near_depth);
      ASSERT_LT(depth, camera.far_depth);
      ASSERT_LT(std::abs(glm::dot(to, axes.right)), camera.right * depth);
      ASSERT_LT(std::abs(glm::dot(to, axes.up)), camera.top * depth);
    }
  }
}

TEST(DefaultPath, an_orbit_shows_all_of_any_bounds) {
  expect_orbit_holds({{-1, 0, -3}, {4, 2, 5}});
  expect_orbit_holds({{-1e-6, 0, -1e-6}, {1e-6, 1e-6, 1e-6}});
  expect_orbit_holds({{1e7, 0, 0}, {1e7 + 2000, 300, 2000}});
  expect_orbit_holds({{-5, 0, -5}, {5, 0, 5}});
}

/// A cuboid whose sides face out, or in.
void add_cuboid(Scene& scene, const Box& box, bool inwards = false) {
  const auto first_vertex = static_cast<std::uint32_t>(scene.positions.size());
  const auto first_index = static_cast<std::uint32_t>(scene.indices.size());
  for (int i = 0; i < 8; ++i)
    scene.positions.emplace_back((i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
                                 (i & 4) ? box.max.z : box.min.z);
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& side : kSides) {
    for (const std::size_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
      scene.indices.push_back(first_vertex + side[corner]);
    if (inwards)
      for (const std::size_t triangle : {6u, 3u})
        std::swap(scene.indices[scene.indices.size() - triangle],
                  scene.indices[scene.indices.size() - triangle + 1]);
  }
  Primitive primitive;
  primitive.first_index = first_index;
  primitive.index_count = static_cast<std::uint32_t>(scene.indices.size()) - first_index;
  scene.primitives.push_back(primitive);
  Instance instance;
  instance.primitive = static_cast<std::uint32_t>(scene.primitives.size() - 1);
  instance.bounds_world = box;
  scene.instances.push_back(instance);
  scene.bounds_world.extend(box);
}

TEST(DefaultPath, an_orbit_is_about_what_stands_on_a_ground_and_under_a_sky) {
  const Box house{{-6, 0, -4}, {6, 8, 4}}, ground{{-1000, -1, -1000}, {1000, 0, 1000}},
      sky{{-5000, -5000, -5000}, {5000, 5000, 5000}};
  Scene alone;
  add_cuboid(alone, house);
  Scene outside = alone, town = alone, shell;
  add_cuboid(outside, ground);
  add_cuboid(outside, sky, true);
  const CameraPath near_house = default_path(alone), path = default_path(outside);
  ASSERT_EQ(path.keys.size(), near_house.keys.size());
  for (std::size_t i = 0; i < path.keys.size(); ++i)
    EXPECT_LT(glm::length(path.keys[i].position - near_house.keys[i].position), 1e-9);
  // The ground below the eye and the sky are seen, too.
  EXPECT_LT(path.near_depth, path.keys[0].position.y);
  EXPECT_GT(path.far_depth, 8000.0);
  // A ground that is no larger than what stands on it, a room, a sky that faces out, and one thing beside its
  // own screws are what a scene is about.
  add_cuboid(town, {{-6.8, -0.1, -6.8}, {6.8, 0, 6.8}});
  EXPECT_GT(glm::length(default_path(town).keys[0].position),
            1.01 * glm::length(near_house.keys[0].position));
  add_cuboid(shell, {{-0.1, 0, -0.1}, {0.1, 0.2, 0.1}});
  add_cuboid(shell, house);
  EXPECT_GT(glm::length(default_path(shell).keys[0].position),
            0.9 * glm::length(near_house.keys[0].position));
}

// From 500 km on, a scene of 57 m was a speck, and its near plane lay behind it.
TEST(DefaultPath, an_orbit_is_the_same_however_far_the_scene_lies_from_the_origin) {
  Scene scene;
  scene.bounds_world = {{-20, -1, -18}, {20, 6, 20}};
  const CameraPath here = default_path(scene);
  for (const double far : {1e3, 1e5, 6378137.0, 1e8}) {
    const glm::dvec3 moved(far, -0.3 * far, 0.7 * far);
    scene.bounds_world = {glm::dvec3(-20, -1, -18) + moved, glm::dvec3(20, 6, 20) + moved};
    const CameraPath there = default_path(scene);
    const double rounding = 1e-13 * (far + 100.0);  // of some sums of coordinates
    ASSERT_EQ(there.keys.size(), here.keys.size());
    EXPECT_NEAR(there.near_depth, here.near_depth, rounding);
    EXPECT_NEAR(there.far_depth, here.far_depth, rounding);
    for (std::size_t i = 0; i < here.keys.size(); ++i) {
      EXPECT_LE(glm::length(there.keys[i].position - moved - here.keys[i].position), rounding) << far;
      EXPECT_LE(glm::length(there.keys[i].target - moved - here.keys[i].target), rounding) << far;
    }
  }
}

TEST(DefaultPath, an_orbit_comes_as_near_as_the_image_is_wide) {
  // A long low box: what a square view must hold of it fills little of a wide one.
  Scene scene;
  scene.bounds_world = {{-5, 0, -1}, {5, 2, 1}};
  constexpr double kAspect = 16.0 / 9.0;
  for (const double aspect : {1.0, kAspect, 1.0 / kAspect}) {
    const CameraPath path = default_path(scene, aspect);
    double least = 1.0;  // of the picture's sides, the larger share that the box takes
    for (int i = 0; i < 32; ++i) {
      const Camera camera = path.at(i / 32.0, static_cast<int>(std::lround(900 * aspect)), 900);
      const glm::dvec3 forward = glm::normalize(camera.forward);
      const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)),
                       up = glm::cross(right, forward);
      double share = 0.0;
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at =
            glm::dvec3((corner & 1) != 0 ? 5 : -5, (corner & 2) != 0 ? 2 : 0, (corner & 4) != 0 ? 1 : -1) -
            camera.position;
        const double depth = glm::dot(forward, at);
        share = std::max({share, std::abs(glm::dot(right, at)) / (depth * camera.right),
                          std::abs(glm::dot(up, at)) / (depth * camera.top)});
      }
      EXPECT_LE(share, 1.0) << aspect << " at " << i;
      least = std::min(least, share);
    }
    EXPECT_GT(least, 0.7) << aspect;
  }
}

TEST(DefaultPath, an_orbit_about_a_point_or_nothing_is_still_a_flight) {
  expect_orbit_holds({});
  expect_orbit_holds({{0, 0, 0}, {0, 0, 0}});
  expect_orbit_holds({{3, 4, 5}, {3, 4, 5}});
  expect_orbit_holds({{1e9, 1e9, 1e9}, {1e9, 1e9, 1e9}});
}

}  // namespace
}  // namespace gnomon::test
