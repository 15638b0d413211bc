// Does a plan from C have the same bits as one from C++? On all cases of tests/data, on random ones, along
// walks, and for everything that is done with a plan.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <numbers>

#include "draw.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "in_c.hpp"

namespace gnomon::test {
namespace {

/// The plan of a case on both sides, and its error; what differs, or "".
std::string difference_of(const Case& c, bool measured) {
  const InputInC input(c.camera, c.light, c.casters, c.receivers, c.options);
  const ShadowPlan plan = make_plan(c.camera, c.light, c.bounds(), c.options);
  PlanInC found;
  const char* field = nullptr;
  const int32_t status =
      gnomon_make_plan(&input.view, &input.light, &input.scene, &input.options, nullptr, &found.plan, &field);
  if (status != found.plan.status) return "the status that is returned";
  if ((status == GNOMON_INVALID_INPUT) != (field != nullptr)) return "invalid_field";
  if (std::string different = first_difference(plan, found.plan); !different.empty()) return different;
  if (!measured || status != GNOMON_OK) return "";
  gnomon_measure_options grid;
  gnomon_measure_options_default(&grid, sizeof grid);
  grid.columns = grid.rows = 9;
  grid.depths = 7;
  gnomon_stats stats;
  gnomon_stats_default(&stats, sizeof stats);
  if (gnomon_measure(&found.plan, &input.view, &input.scene, &grid, &stats, &field) != GNOMON_OK)
    return field;
  return first_difference(measure(plan, c.camera, c.bounds(), {9, 9, 7}), stats);
}

/// Of random cases `begin` to `end`: how many have maps.
int check_random(std::uint64_t begin, std::uint64_t end) {
  constexpr std::uint64_t kSeed = 2026;
  constexpr std::uint64_t kMeasured = 8;  // measuring takes as long as planning: of some
  int with_maps = 0;
  for (std::uint64_t number = begin; number < end; ++number) {
    const Case c = read_case(stress::draw_case(kSeed, number).dump());
    EXPECT_EQ(difference_of(c, number % kMeasured == 0), "") << "case " << number;
    with_maps += make_plan(c.camera, c.light, c.bounds(), c.options).status == PlanStatus::ok ? 1 : 0;
    if (testing::Test::HasFailure()) return with_maps;
  }
  return with_maps;
}

TEST(SameBits, cases_of_files_give_the_plans_and_errors_of_cpp) {
  int checked = 0;
  for (const char* folder : {"cases", "stress_random"}) {
    for (const auto& file :
         std::filesystem::directory_iterator(std::filesystem::path(GNOMON_TEST_DATA) / folder)) {
      EXPECT_EQ(difference_of(load_case(file.path()), true), "") << file.path();
      ++checked;
    }
  }
  EXPECT_GT(checked, 50);
}

TEST(SameBits, a_thousand_random_cases_give_the_plans_of_cpp) {
  EXPECT_GT(check_random(0, 1000), 200);
}

TEST(SameBits, ten_thousand_random_cases_give_the_plans_of_cpp) {
  EXPECT_GT(check_random(1000, 10000), 1800);
}

/// A street of boxes, and a camera in it.
struct Street {
  std::vector<Box> boxes{{{-40, -1, -200}, {40, 0, 20}}};
  std::vector<glm::dvec3> points, normals;
  Camera camera = perspective_camera({0, 3, 10}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.2, 250.0, 960, 640);
  Light sun = DirectionalLight{{0.4, -1, 0.3}};

  Street() {
    for (int i = 0; i < 40; ++i) {
      const double x = i % 2 == 0 ? -12.0 : 8.0, z = -5.0 * i;
      boxes.push_back({{x, 0, z - 3}, {x + 4, 2.0 + i % 7, z}});
    }
    for (int i = 0; i < 3000; ++i) {
      points.push_back({-8.0 + 0.5 * (i % 31), 0.0, 5.0 - 0.05 * i});
      normals.push_back({0, 1, 0});
    }
  }
  [[nodiscard]] SceneBounds bounds() const { return {boxes, boxes}; }
};

TEST(SameBits, walks_with_a_history_give_the_plans_of_cpp) {
  Street street;
  for (const Fit fit : {Fit::tight, Fit::stable, Fit::warped_stable}) {
    PlanOptions options;
    options.fit = fit;
    PlanHistory history;
    gnomon_history* in_c_history = gnomon_history_create();
    ASSERT_NE(in_c_history, nullptr);
    for (int frame = 0; frame < 12; ++frame) {
      street.camera.position.z -= 0.7;
      const ShadowPlan plan = make_plan(street.camera, street.sun, street.bounds(), options, &history);
      const InputInC input(street.camera, street.sun, street.boxes, street.boxes, options);
      PlanInC found;
      ASSERT_EQ(gnomon_make_plan(&input.view, &input.light, &input.scene, &input.options, in_c_history,
                                 &found.plan, nullptr),
                GNOMON_OK);
      ASSERT_EQ(first_difference(plan, found.plan), "") << frame;
      gnomon_event events[GNOMON_MAX_MAPS];
      ASSERT_EQ(gnomon_history_events(in_c_history, events, GNOMON_MAX_MAPS), history.event_count);
      for (std::size_t i = 0; i < history.events().size(); ++i)
        EXPECT_EQ(events[i].density_ratio, history.event[i].density_ratio);
    }
    gnomon_history_destroy(in_c_history);
  }
}

TEST(SameBits, a_set_gives_the_plans_and_casters_of_its_boxes) {
  const Street street;
  const InputInC input(street.camera, street.sun, street.boxes, street.boxes, {});
  gnomon_caster_set* set = nullptr;
  ASSERT_EQ(gnomon_caster_set_create(input.scene.casters, input.scene.caster_count, &set, nullptr),
            GNOMON_OK);
  gnomon_scene of_set;
  gnomon_scene_default(&of_set, sizeof of_set);
  of_set.caster_set = of_set.receiver_set = set;
  PlanInC by_list, by_set;
  ASSERT_EQ(
      gnomon_make_plan(&input.view, &input.light, &input.scene, nullptr, nullptr, &by_list.plan, nullptr),
      GNOMON_OK);
  ASSERT_EQ(gnomon_make_plan(&input.view, &input.light, &of_set, nullptr, nullptr, &by_set.plan, nullptr),
            GNOMON_OK);
  ASSERT_EQ(by_list.plan.map_count, by_set.plan.map_count);
  ASSERT_EQ(std::memcmp(by_list.maps, by_set.maps, sizeof by_list.maps[0] * by_list.plan.map_count), 0);
  const ShadowPlan plan = make_plan(street.camera, street.sun, street.bounds());
  for (int i = 0; i < by_list.plan.map_count; ++i) {
    std::vector<std::uint32_t> expected(street.boxes.size()), found(street.boxes.size()),
        of_the_set(street.boxes.size());
    expected.resize(cull_casters(plan.map[static_cast<std::size_t>(i)], street.boxes, expected));
    int64_t count = 0, set_count = 0;
    ASSERT_EQ(gnomon_cull(&by_list.maps[i], input.scene.casters, input.scene.caster_count, found.data(),
                          static_cast<int64_t>(found.size()), &count, nullptr),
              GNOMON_OK);
    ASSERT_EQ(gnomon_cull_set(&by_list.maps[i], set, of_the_set.data(), static_cast<int64_t>(found.size()),
                              &set_count, nullptr),
              GNOMON_OK);
    found.resize(static_cast<std::size_t>(count));
    of_the_set.resize(static_cast<std::size_t>(set_count));
    std::sort(of_the_set.begin(), of_the_set.end());
    EXPECT_EQ(found, expected);
    EXPECT_EQ(of_the_set, expected);
    EXPECT_GT(count, 0);
  }
  gnomon_caster_set_destroy(set);
}

TEST(SameBits, points_find_their_map_and_their_error) {
  const Street street;
  const InputInC input(street.camera, street.sun, street.boxes, street.boxes, {});
  const ShadowPlan plan = make_plan(street.camera, street.sun, street.bounds());
  PlanInC found;
  gnomon_make_plan(&input.view, &input.light, &input.scene, nullptr, nullptr, &found.plan, nullptr);
  const auto* points = reinterpret_cast<const double*>(street.points.data());
  const auto* normals = reinterpret_cast<const double*>(street.normals.data());
  const auto count = static_cast<int64_t>(street.points.size());
  std::vector<double> depths;
  for (const glm::dvec3& p : street.points)
    depths.push_back(glm::dot(p - street.camera.position, camera_axes(street.camera).forward));
  std::vector<int32_t> indices(street.points.size());
  ASSERT_EQ(gnomon_select(&found.plan, points, depths.data(), count, indices.data(), nullptr), GNOMON_OK);
  int served = 0;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    EXPECT_EQ(indices[i], map_serving(plan, street.points[i], depths[i]));
    served += indices[i] >= 0 ? 1 : 0;
  }
  EXPECT_GT(served, 1000);
  std::vector<gnomon_point_error> errors(street.points.size());
  ASSERT_EQ(
      gnomon_measure_points(&found.maps[0], &input.camera, points, normals, count, errors.data(), nullptr),
      GNOMON_OK);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const PointAliasing expected =
        measure_point(plan.map[0], street.camera, street.points[i], street.normals[i]);
    EXPECT_EQ(errors[i].status, static_cast<int>(expected.status));
    EXPECT_EQ(errors[i].m_max, expected.m_max);
    EXPECT_EQ(errors[i].projection, expected.projection);
  }
}

TEST(SameBits, what_is_made_of_a_plan_is_that_of_cpp) {
  const Street street;
  PlanOptions options;
  options.fit = Fit::stable;
  options.clip_space = kVulkan;
  const InputInC input(street.camera, street.sun, street.boxes, street.boxes, options);
  const ShadowPlan plan = make_plan(street.camera, street.sun, street.bounds(), options);
  PlanInC found;
  gnomon_make_plan(&input.view, &input.light, &input.scene, &input.options, nullptr, &found.plan, nullptr);
  ASSERT_EQ(first_difference(plan, found.plan), "");

  const ShaderBlock expected = shader_block(plan, {2048, 1024, 1.5});
  float block[GNOMON_SHADER_BLOCK_FLOATS];
  ASSERT_EQ(gnomon_shader_block(&found.plan, 2048, 1024, 1.5, block, nullptr), GNOMON_OK);
  EXPECT_EQ(std::memcmp(block, &expected, sizeof expected), 0);

  const double origin[3] = {1.5, 2.5, -3.5};
  gnomon_map moved;
  gnomon_map_default(&moved, sizeof moved);
  ASSERT_EQ(gnomon_rebased(&found.maps[0], origin, &moved, nullptr), GNOMON_OK);
  EXPECT_EQ(first_difference(rebased(plan.map[0], {1.5, 2.5, -3.5}), moved), "");

  Camera next = street.camera;
  next.position.x += 1.0;
  const ShadowPlan later = make_plan(next, street.sun, street.bounds(), options);
  const InputInC next_input(next, street.sun, street.boxes, street.boxes, options);
  PlanInC next_found;
  gnomon_make_plan(&next_input.view, &next_input.light, &next_input.scene, &next_input.options, nullptr,
                   &next_found.plan, nullptr);
  const MapReuse kept = reuse(plan.map[0], later.map[0], kVulkan);
  gnomon_reuse in_c_reuse;
  ASSERT_EQ(
      gnomon_compare(&found.maps[0], &next_found.maps[0], &input.options.clip_space, &in_c_reuse, nullptr),
      GNOMON_OK);
  EXPECT_EQ(in_c_reuse.kind, GNOMON_REUSE_SCROLLED);
  EXPECT_EQ(in_c_reuse.kind, static_cast<int>(kept.kind));
  EXPECT_EQ(in_c_reuse.shift_x, kept.shift_x);
  EXPECT_EQ(in_c_reuse.shift_y, kept.shift_y);
  EXPECT_EQ(in_c_reuse.strip_count, kept.strip_count);
  EXPECT_EQ(in_c_reuse.kept.width, kept.kept.width);
  EXPECT_EQ(in_c_reuse.strip[0].height, kept.strip[0].height);

  double planes[20];
  ASSERT_EQ(gnomon_rectangle_planes(&found.maps[0], &in_c_reuse.strip[0], &input.options.clip_space, planes,
                                    nullptr),
            GNOMON_OK);
  const auto expected_planes = rectangle_planes(plan.map[0], kept.strip[0], kVulkan);
  for (std::size_t i = 0; i < 5; ++i) {
    for (int k = 0; k < 4; ++k) EXPECT_EQ(planes[4 * i + static_cast<std::size_t>(k)], expected_planes[i][k]);
  }
  double texture[16];
  ASSERT_EQ(gnomon_texture_from_clip(&input.options.clip_space, texture), GNOMON_OK);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(texture[i], texture_from_clip(kVulkan)[i / 4][i % 4]);
  for (std::size_t i = 0; i < plan.omitted().size(); ++i) {
    gnomon_text text;
    gnomon_describe(&found.omissions[i], &text);
    EXPECT_STREQ(text.what, describe(plan.omission[i]).what.data());
    EXPECT_STREQ(text.why, describe(plan.omission[i]).why.data());
  }
}

TEST(SameBits, cameras_of_angles_and_matrices_are_those_of_cpp) {
  const Street street;
  gnomon_camera camera;
  gnomon_camera_default(&camera, sizeof camera);
  const gnomon_camera expected = in_c(street.camera);
  std::memcpy(camera.position, expected.position, sizeof camera.position);
  std::memcpy(camera.forward, expected.forward, sizeof camera.forward);
  ASSERT_EQ(gnomon_perspective(&camera, 1.0, 1.5, 0.2, 250.0, 960, 640, nullptr), GNOMON_OK);
  EXPECT_EQ(std::memcmp(&camera, &expected, sizeof camera), 0);
  const glm::dmat4 view = view_from_world(street.camera), clip = clip_from_view(street.camera);
  gnomon_camera of_matrices;
  gnomon_camera_default(&of_matrices, sizeof of_matrices);
  const char* why = "";
  ASSERT_EQ(gnomon_camera_from(&view[0][0], &clip[0][0], nullptr, 960, 640, &of_matrices, &why, nullptr),
            GNOMON_OK);
  EXPECT_EQ(why, nullptr);
  const gnomon_camera in_cpp = in_c(camera_from(view, clip, kOpenGl, 960, 640).camera);
  EXPECT_EQ(std::memcmp(&of_matrices, &in_cpp, sizeof in_cpp), 0);
  // A mirrored projection has its reason.
  glm::dmat4 mirrored = clip;
  mirrored[0][0] = -mirrored[0][0];
  const char* field = nullptr;
  EXPECT_EQ(gnomon_camera_from(&view[0][0], &mirrored[0][0], nullptr, 960, 640, &of_matrices, &why, &field),
            GNOMON_INVALID_INPUT);
  EXPECT_STREQ(why, std::string(to_string(CameraError::mirrored)).c_str());
  EXPECT_STREQ(field, "clip_from_view, clip_space");
}

TEST(SameBits, foreign_matrices_have_the_error_of_the_plan_that_they_are_of) {
  const Street street;
  PlanOptions options;
  options.clip_space = kVulkan;
  const ShadowPlan plan = make_plan(street.camera, street.sun, street.bounds(), options);
  const InputInC input(street.camera, street.sun, street.boxes, street.boxes, options);
  gnomon_map maps[GNOMON_MAX_MAPS];
  gnomon_plan foreign;
  gnomon_plan_default(&foreign, sizeof foreign);
  foreign.maps = maps;
  foreign.map_size = sizeof maps[0];
  foreign.map_room = foreign.map_count = plan.map_count;
  foreign.status = GNOMON_OK;
  foreign.clip_space = input.options.clip_space;
  foreign.selection = gnomon_find(GNOMON_SELECTIONS, "view_depth");
  for (std::size_t i = 0; i < plan.maps().size(); ++i) {
    gnomon_map_default(&maps[i], sizeof maps[i]);
    std::memcpy(maps[i].clip_from_world, &plan.map[i].clip_from_world[0][0], sizeof maps[i].clip_from_world);
    maps[i].width = plan.map[i].width;
    maps[i].height = plan.map[i].height;
    maps[i].depth_begin = plan.map[i].depth_begin;
    maps[i].depth_end = plan.map[i].depth_end;
  }
  gnomon_stats stats;
  gnomon_stats_default(&stats, sizeof stats);
  ASSERT_EQ(gnomon_measure(&foreign, &input.view, &input.scene, nullptr, &stats, nullptr), GNOMON_OK);
  const AliasingStats expected = measure(plan, street.camera, street.bounds());
  EXPECT_EQ(stats.samples, static_cast<int64_t>(expected.samples));
  // The light comes from the matrix in place of the record: the same up to rounding.
  constexpr double kRounding = 1e-9;
  EXPECT_NEAR(stats.mean, expected.mean, kRounding * expected.mean);
  EXPECT_NEAR(stats.p95, expected.p95, kRounding * expected.p95);
  EXPECT_GT(stats.p95, 0.0);
}

TEST(SameBits, two_eyes_share_the_maps_of_plan_views) {
  const Street street;
  const Camera left = street.camera;
  Camera right = left;
  right.position.x += 0.064;
  const std::array<Camera, 2> eyes{left, right};
  const ShadowPlan plan = plan_views(eyes, street.sun, street.bounds());
  const InputInC input(left, street.sun, street.boxes, street.boxes, {});
  const gnomon_camera a = in_c(left), b = in_c(right);
  const gnomon_camera* const cameras[] = {&a, &b};
  PlanInC found;
  ASSERT_EQ(gnomon_plan_views(cameras, 2, &input.light, &input.scene, nullptr, &found.plan, nullptr),
            GNOMON_OK);
  EXPECT_EQ(first_difference(plan, found.plan), "");
}

TEST(SameBits, pages_are_those_of_cpp) {
  const Street street;
  PageOptions options;
  options.plan.fit = Fit::stable;
  options.capacity = 512;
  std::vector<std::byte> memory(page_memory(options.capacity, street.points.size()));
  const View view{.camera = street.camera, .points_world = street.points, .normals_world = street.normals};
  const PagePlan plan = plan_pages(view, street.sun, street.bounds(), options, memory);
  ASSERT_EQ(plan.status, PlanStatus::ok);

  InputInC input(street.camera, street.sun, street.boxes, street.boxes, options.plan);
  input.view.points = reinterpret_cast<const double*>(street.points.data());
  input.view.normals = reinterpret_cast<const double*>(street.normals.data());
  input.view.point_count = static_cast<int64_t>(street.points.size());
  gnomon_page_options in_c_options;
  gnomon_page_options_default(&in_c_options, sizeof in_c_options);
  in_c_options.plan = &input.options;
  in_c_options.capacity = options.capacity;
  const int64_t bytes = gnomon_page_memory(options.capacity, input.view.point_count);
  std::vector<std::byte> in_c_memory(static_cast<std::size_t>(bytes));
  gnomon_page_plan found;
  gnomon_page_plan_default(&found, sizeof found);
  ASSERT_EQ(gnomon_plan_pages(&input.view, &input.light, &input.scene, &in_c_options, nullptr,
                              in_c_memory.data(), bytes, &found, nullptr),
            GNOMON_OK);
  ASSERT_EQ(found.page_count, static_cast<int64_t>(plan.pages.size()));
  ASSERT_EQ(found.table_count, static_cast<int64_t>(plan.table.size()));
  EXPECT_EQ(std::memcmp(found.pages, plan.pages.data(), plan.pages.size_bytes()), 0);
  EXPECT_EQ(std::memcmp(found.table, plan.table.data(), plan.table.size_bytes()), 0);
  ASSERT_EQ(found.level_count, static_cast<int32_t>(plan.levels.size()));
  gnomon_map map;
  gnomon_map_default(&map, sizeof map);
  for (std::size_t i = 0; i < plan.levels.size(); ++i) {
    ASSERT_EQ(gnomon_page_level(&found, static_cast<int32_t>(i), &map, nullptr), GNOMON_OK);
    EXPECT_EQ(first_difference(plan.levels[i], map), "");
  }
  ASSERT_EQ(gnomon_page_map(&found, 3, &map, nullptr), GNOMON_OK);
  EXPECT_EQ(first_difference(page_map(plan, plan.pages[3]), map), "");
  std::vector<int32_t> indices(street.points.size());
  ASSERT_EQ(gnomon_page_select(&found, input.view.points, input.view.point_count, indices.data(), nullptr),
            GNOMON_OK);
  for (std::size_t i = 0; i < indices.size(); ++i)
    EXPECT_EQ(indices[i], page_serving(plan, street.points[i]));
  gnomon_stats stats;
  gnomon_stats_default(&stats, sizeof stats);
  ASSERT_EQ(gnomon_measure_pages(&found, &input.view, &input.scene, nullptr, &stats, nullptr, nullptr),
            GNOMON_OK);
  EXPECT_EQ(first_difference(measure(plan, view, street.bounds()).m, stats), "");

  // A pool draws all pages once, and then only those that a moved caster touches.
  std::vector<gnomon_page_slot> slots(512);
  std::vector<std::uint32_t> table(static_cast<std::size_t>(gnomon_page_table_size(512)));
  std::vector<gnomon_kept_page> kept(static_cast<std::size_t>(found.page_count));
  int64_t drawn = 0;
  const double moved[6] = {-12, 0, -30, -8, 4, -25};
  ASSERT_EQ(
      gnomon_keep_pages(&found, nullptr, 0, slots.data(), 512, table.data(), kept.data(), &drawn, nullptr),
      GNOMON_OK);
  EXPECT_EQ(drawn, found.page_count);
  ASSERT_EQ(
      gnomon_keep_pages(&found, nullptr, 0, slots.data(), 512, table.data(), kept.data(), &drawn, nullptr),
      GNOMON_OK);
  EXPECT_EQ(drawn, 0);
  ASSERT_EQ(
      gnomon_keep_pages(&found, moved, 1, slots.data(), 512, table.data(), kept.data(), &drawn, nullptr),
      GNOMON_OK);
  EXPECT_GT(drawn, 0);
  EXPECT_LT(drawn, found.page_count);
}

TEST(SameBits, plans_of_many_lights_are_those_of_cpp) {
  const Street street;
  std::vector<LightRequest> requests{{.light = street.sun}};
  for (int i = 0; i < 9; ++i) {
    if (i % 2 == 0) {
      requests.push_back({.light = PointLight{{-6.0 + i, 3, -4.0 * i}, 15.0}, .weight = 1.0 + i});
    } else {
      requests.push_back({.light = SpotLight{{-6.0 + i, 6, -4.0 * i}, {0.1, -1, -0.2}, 0.6, 20.0}});
    }
  }
  LightOptions options;
  options.plan.cascades = 2;
  options.texel_budget = 3 << 20;
  std::vector<LightState> states(requests.size());
  LightHistory history;
  history.lights = states;
  std::vector<std::byte> memory(light_memory(requests.size(), 0));

  const InputInC input(street.camera, street.sun, street.boxes, street.boxes, options.plan);
  gnomon_light_options in_c_options;
  gnomon_light_options_default(&in_c_options, sizeof in_c_options);
  in_c_options.plan = &input.options;
  in_c_options.texel_budget = options.texel_budget;
  std::vector<gnomon_light> lights;
  for (const LightRequest& request : requests) lights.push_back(in_c(request.light));
  std::vector<gnomon_light_request> in_c_requests(requests.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    gnomon_light_request_default(&in_c_requests[i], sizeof in_c_requests[i]);
    in_c_requests[i].light = &lights[i];
    in_c_requests[i].weight = requests[i].weight;
  }
  const auto count = static_cast<int64_t>(requests.size());
  const int64_t bytes = gnomon_light_memory(count, 0);
  std::vector<std::byte> in_c_memory(static_cast<std::size_t>(bytes));
  std::vector<gnomon_light_maps> maps(requests.size());
  gnomon_light_history* in_c_history = gnomon_light_history_create(count);
  ASSERT_NE(in_c_history, nullptr);
  for (int frame = 0; frame < 4; ++frame) {
    const LightPlan plan = plan_lights(street.camera, requests, street.bounds(), options, memory, &history);
    gnomon_light_plan found;
    gnomon_light_plan_default(&found, sizeof found);
    found.lights = maps.data();
    found.light_size = sizeof maps[0];
    found.light_room = count;
    ASSERT_EQ(
        gnomon_plan_lights(&input.view, in_c_requests.data(), sizeof in_c_requests[0], count, &input.scene,
                           &in_c_options, in_c_history, in_c_memory.data(), bytes, &found, nullptr),
        GNOMON_OK);
    ASSERT_EQ(found.light_count, count);
    EXPECT_EQ(found.error, plan.error);
    EXPECT_EQ(found.texels, plan.texels);
    EXPECT_EQ(found.due, plan.due);
    EXPECT_GT(found.mapped, 3);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      EXPECT_EQ(maps[i].outcome, static_cast<int>(plan.lights[i].outcome));
      EXPECT_EQ(maps[i].texels, plan.lights[i].size);
      EXPECT_EQ(maps[i].m, plan.lights[i].m);
      EXPECT_EQ(maps[i].due, plan.lights[i].due ? 1 : 0);
      for (std::size_t k = 0; k < kMaxMaps; ++k) EXPECT_EQ(maps[i].place[k].x, plan.lights[i].place[k].x);
      gnomon_plan_options of_light;
      gnomon_plan_options_default(&of_light, sizeof of_light);
      ASSERT_EQ(gnomon_light_plan_options(&in_c_options, &maps[i], &of_light, nullptr), GNOMON_OK);
      const gnomon_plan_options expected = in_c(light_options(options, plan.lights[i]));
      EXPECT_EQ(std::memcmp(&of_light, &expected, sizeof expected), 0);
    }
  }
  gnomon_camera round;
  gnomon_camera_default(&round, sizeof round);
  ASSERT_EQ(gnomon_camera_round(&lights[1], &input.camera, &round, nullptr), GNOMON_OK);
  const gnomon_camera expected = in_c(camera_round(requests[1].light, street.camera));
  EXPECT_EQ(std::memcmp(&round, &expected, sizeof round), 0);
  gnomon_light_history_destroy(in_c_history);
}

}  // namespace
}  // namespace gnomon::test
