// What changes from frame to frame, atlases and clusters of lights: the same from C as from C++, and refusals
// by name.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "gnomon/study/engine_bias.hpp"
#include "in_c.hpp"

namespace gnomon::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Scene {
  std::vector<Box> boxes{{{-40, -1, -200}, {40, 0, 20}}, {{-4, 0, -30}, {4, 6, -26}}};
  Camera camera = perspective_camera({0, 3, 10}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.2, 250.0, 960, 640);
  DirectionalLight sun{{0.4, -1, 0.3}};
  PlanOptions options;
  PlanInC found;

  /// The plan on both sides.
  ShadowPlan plan() {
    const InputInC in(camera, sun, boxes, boxes, options);
    EXPECT_EQ(gnomon_make_plan(&in.view, &in.light, &in.scene, &in.options, nullptr, &found.plan, nullptr),
              GNOMON_OK);
    return make_plan(camera, sun, {boxes, boxes}, options);
  }
};

TEST(FramesInC, grids_are_jittered_as_in_cpp) {
  Scene scene;
  scene.options.fit = Fit::stable;
  scene.options.clip_space = kVulkan;
  for (std::uint32_t frame = 0; frame < GNOMON_JITTER_FRAMES; ++frame) {
    const ShadowPlan plan = scene.plan();
    double offset[2];
    ASSERT_EQ(gnomon_jitter_texels(frame, offset), GNOMON_OK);
    EXPECT_EQ(glm::dvec2(offset[0], offset[1]), jitter_texels(frame));
    ASSERT_EQ(gnomon_jitter(&scene.found.plan, offset, nullptr), GNOMON_OK);
    ASSERT_EQ(first_difference(jittered(plan, jitter_texels(frame)), scene.found.plan), "") << frame;
  }
  const char* field = nullptr;
  const double broken[2] = {0.0, kNan};
  EXPECT_EQ(gnomon_jitter_texels(0, nullptr), GNOMON_INVALID_INPUT);
  EXPECT_EQ(gnomon_jitter(&scene.found.plan, broken, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "offset");
  EXPECT_EQ(gnomon_jitter(nullptr, broken, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "plan");
}

TEST(FramesInC, depths_are_followed_as_in_cpp) {
  std::mt19937_64 random(1);
  DepthTracker tracker;
  tracker.hold_frames = 5;
  gnomon_depth_tracker* in_c_tracker = gnomon_depth_tracker_create(4, 5);
  ASSERT_NE(in_c_tracker, nullptr);
  int seen = 0;
  for (int frame = 0; frame < 200; ++frame) {
    std::vector<float> depths(random() % 4);
    for (float& depth : depths) depth = 0.5f + 0.01f * static_cast<float>(random() % 10000);
    VisibleDepths visible;
    visible.add(depths);
    tracker.update(visible);
    gnomon_visible_depths now;
    gnomon_visible_depths_clear(&now);
    ASSERT_EQ(gnomon_visible_depths_add(&now, depths.data(), static_cast<int64_t>(depths.size()), nullptr),
              GNOMON_OK);
    ASSERT_EQ(gnomon_depth_tracker_update(in_c_tracker, &now, &now, nullptr), GNOMON_OK);
    ASSERT_EQ(std::memcmp(&now, &tracker.depths(), sizeof now), 0) << frame;
    seen += tracker.depths().empty() ? 0 : 1;
    if (frame == 100) {
      tracker.clear();
      tracker.hold_frames = 5;
      gnomon_depth_tracker_clear(in_c_tracker);
    }
  }
  EXPECT_GT(seen, 100);
  const char* field = nullptr;
  gnomon_visible_depths depths;
  EXPECT_EQ(gnomon_depth_tracker_update(nullptr, &depths, &depths, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "tracker");
  EXPECT_EQ(gnomon_depth_tracker_update(in_c_tracker, nullptr, &depths, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "frame");
  EXPECT_EQ(gnomon_depth_tracker_update(in_c_tracker, &depths, nullptr, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "depths");
  EXPECT_EQ(gnomon_depth_tracker_create(0, 30), nullptr);
  EXPECT_EQ(gnomon_depth_tracker_create(4, 65536), nullptr);
  gnomon_depth_tracker_destroy(in_c_tracker);
  gnomon_depth_tracker_destroy(nullptr);
  gnomon_depth_tracker_clear(nullptr);
}

TEST(FramesInC, a_sun_is_held_as_in_cpp) {
  const Scene scene;
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 100; ++i) points.push_back({-8.0 + 0.5 * (i % 31), 0.0, -0.5 * i});
  InputInC in(scene.camera, scene.sun, scene.boxes, scene.boxes, {});
  in.view.points = &points[0].x;
  in.view.point_count = static_cast<int64_t>(points.size());
  const View view{.camera = scene.camera, .points_world = points};
  const Box box{{-40, -1, -200}, {40, 6, 20}};
  glm::dvec3 held(0.0);
  int turns = 0, holds = 0;
  for (int frame = 0; frame < 50; ++frame) {
    const glm::dvec3 sun(0.4 + 1e-4 * frame, -1.0, 0.3);
    const HeldSun expected = hold_sun(view, held, sun, box);
    gnomon_held_sun found;
    ASSERT_EQ(gnomon_hold_sun(&in.view, &held.x, &sun.x, &box.min.x, 0.25, 0.05, &found, nullptr), GNOMON_OK);
    EXPECT_EQ(glm::dvec3(found.direction[0], found.direction[1], found.direction[2]), expected.direction);
    EXPECT_EQ(found.error_pixels, expected.error_pixels);
    EXPECT_EQ(found.turned_pixels, expected.turned_pixels);
    EXPECT_EQ(found.points_capped, static_cast<int64_t>(expected.points_capped));
    (expected.direction == held ? holds : turns) += 1;
    held = expected.direction;
  }
  EXPECT_GT(turns, 1);
  EXPECT_GT(holds, 1);

  const glm::dvec3 sun = scene.sun.direction, none(0.0), broken(0.0, kNan, 0.0);
  const char* field = nullptr;
  gnomon_held_sun found;
  const auto refuses = [&](int32_t status, const char* expected) {
    EXPECT_EQ(status, GNOMON_INVALID_INPUT);
    EXPECT_STREQ(field, expected);
  };
  refuses(gnomon_hold_sun(nullptr, &sun.x, &sun.x, &box.min.x, 0.25, 0.05, &found, &field), "view");
  refuses(gnomon_hold_sun(&in.view, &broken.x, &sun.x, &box.min.x, 0.25, 0.05, &found, &field), "held");
  refuses(gnomon_hold_sun(&in.view, &sun.x, &none.x, &box.min.x, 0.25, 0.05, &found, &field), "sun");
  refuses(gnomon_hold_sun(&in.view, &sun.x, nullptr, &box.min.x, 0.25, 0.05, &found, &field), "sun");
  refuses(gnomon_hold_sun(&in.view, &sun.x, &sun.x, nullptr, 0.25, 0.05, &found, &field), "casters");
  refuses(gnomon_hold_sun(&in.view, &sun.x, &sun.x, &box.min.x, -1.0, 0.05, &found, &field), "most_pixels");
  refuses(gnomon_hold_sun(&in.view, &sun.x, &sun.x, &box.min.x, 0.25, kNan, &found, &field),
          "least_light_sine");
  refuses(gnomon_hold_sun(&in.view, &sun.x, &sun.x, &box.min.x, 0.25, 0.05, nullptr, &field), "result");
}

void expect_same(const gnomon_atlas& found, const Atlas& expected) {
  EXPECT_EQ(found.width, expected.width);
  EXPECT_EQ(found.height, expected.height);
  EXPECT_EQ(found.count, expected.count);
  EXPECT_EQ(found.efficiency, expected.efficiency);
  for (std::size_t i = 0; i < expected.place.size(); ++i) {
    EXPECT_EQ(found.place[i].x, expected.place[i].x);
    EXPECT_EQ(found.place[i].y, expected.place[i].y);
    EXPECT_EQ(found.place[i].width, expected.place[i].width);
    EXPECT_EQ(found.place[i].height, expected.place[i].height);
  }
}

TEST(FramesInC, maps_lie_in_an_atlas_as_in_cpp) {
  Scene scene;
  scene.options.resolution.texel_budget = 1 << 20;
  const ShadowPlan plan = scene.plan();
  const gnomon_clip_space space = in_c(kVulkan);
  gnomon_atlas found;
  ASSERT_EQ(gnomon_pack_atlas(&scene.found.plan, 0, 0, &found, nullptr), GNOMON_OK);
  expect_same(found, pack_atlas(plan));
  ASSERT_GT(found.count, 1);
  for (int32_t map = 0; map < found.count; ++map) {
    double matrix[16];
    ASSERT_EQ(gnomon_atlas_from_clip(&found, &space, map, matrix, nullptr), GNOMON_OK);
    const glm::dmat4 expected = atlas_from_clip(pack_atlas(plan), kVulkan, map);
    EXPECT_EQ(std::memcmp(matrix, &expected[0][0], sizeof matrix), 0);
  }
  gnomon_atlas fixed;
  ASSERT_EQ(gnomon_pack_atlas(&scene.found.plan, 4096, 2048, &fixed, nullptr), GNOMON_OK);
  expect_same(fixed, pack_atlas(plan, 4096, 2048));
  ASSERT_EQ(gnomon_pack_atlas(&scene.found.plan, 8, 8, &fixed, nullptr), GNOMON_OK);
  EXPECT_EQ(fixed.count, 0);

  const char* field = nullptr;
  double matrix[16];
  const auto refuses = [&](int32_t status, const char* expected) {
    EXPECT_EQ(status, GNOMON_INVALID_INPUT);
    EXPECT_STREQ(field, expected);
  };
  refuses(gnomon_pack_atlas(nullptr, 0, 0, &found, &field), "plan");
  refuses(gnomon_pack_atlas(&scene.found.plan, -1, 0, &found, &field), "width");
  refuses(gnomon_pack_atlas(&scene.found.plan, 64, 0, &found, &field), "height");
  refuses(gnomon_pack_atlas(&scene.found.plan, 0, 0, nullptr, &field), "atlas");
  refuses(gnomon_atlas_from_clip(nullptr, nullptr, 0, matrix, &field), "atlas");
  refuses(gnomon_atlas_from_clip(&found, nullptr, found.count, matrix, &field), "map");
  refuses(gnomon_atlas_from_clip(&found, nullptr, -1, matrix, &field), "map");
  refuses(gnomon_atlas_from_clip(&found, nullptr, 0, nullptr, &field), "atlas_from_clip");
  found.place[0].x = std::numeric_limits<int32_t>::max();
  refuses(gnomon_atlas_from_clip(&found, nullptr, 0, matrix, &field), "atlas.place");
}

TEST(FramesInC, biases_are_translated_as_in_cpp) {
  Scene scene;
  scene.options.bias.slope_texels = 0.75;
  const ShadowPlan plan = scene.plan();
  gnomon_plan* const in_c_plan = &scene.found.plan;
  gnomon_engine_bias found;
  int translated = 0;
  for (int32_t map = 0; map < in_c_plan->map_count; ++map) {
    for (const BiasWay way : {BiasWay::rasterizer, BiasWay::normal_offset}) {
      for (const double radius : {0.0, 1.5}) {
        const EngineBias expected =
            engine_bias(plan.map[static_cast<std::size_t>(map)], plan.bias, way, radius);
        ASSERT_EQ(
            gnomon_translate_bias(in_c_plan, map, static_cast<int32_t>(way), radius, 16, &found, nullptr),
            GNOMON_OK);
        EXPECT_EQ(found.depth, expected.depth);
        EXPECT_EQ(found.slope_factor, expected.slope_factor);
        EXPECT_EQ(found.normal_world, expected.normal_world);
        EXPECT_EQ(found.units, rasterizer_units(expected.depth, 16));
        translated += found.units > 0.0 && found.slope_factor + found.normal_world > 0.0 ? 1 : 0;
      }
    }
  }
  EXPECT_GE(translated, 8);
  const char* field = nullptr;
  const auto refuses = [&](int32_t map, int32_t way, double radius, int32_t bits, const char* expected) {
    found = {-7.0, -7.0, -7.0, -7.0};
    EXPECT_EQ(gnomon_translate_bias(in_c_plan, map, way, radius, bits, &found, &field), GNOMON_INVALID_INPUT);
    EXPECT_STREQ(field, expected);
    EXPECT_EQ(found.depth, -7.0);
  };
  refuses(-1, 0, 0.0, 0, "map");
  refuses(in_c_plan->map_count, 0, 0.0, 0, "map");
  refuses(0, 2, 0.0, 0, "way");
  refuses(0, 0, -1.0, 0, "kernel_radius_texels");
  refuses(0, 0, kNan, 0, "kernel_radius_texels");
  refuses(0, 0, 0.0, 33, "depth_bits");
  scene.found.maps[0].depth_range_world = 1e-300;
  refuses(0, 0, 0.0, 0, "map.depth_range_world");
  scene.found.maps[0].bias_constant = kNan;
  refuses(0, 0, 0.0, 0, "map.bias_constant");
  scene.found.maps[1].texel_world_max[1] = kNan;
  refuses(1, 0, 0.0, 0, "map.texel_world_max");
  in_c_plan->bias_slope_texels = kNan;
  refuses(1, 0, 0.0, 0, "plan.bias_slope_texels");
  EXPECT_EQ(gnomon_translate_bias(in_c_plan, 0, 0, 0.0, 0, nullptr, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "bias");
  EXPECT_EQ(gnomon_translate_bias(nullptr, 0, 0, 0.0, 0, &found, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "plan");
}

/// Suns, spots and points before the camera, in C++ and in C.
struct Lights {
  std::vector<Light> in_cpp;
  std::vector<gnomon_light> in_c_lights;

  explicit Lights(int count) {
    std::mt19937_64 random(3);
    const auto number = [&](double low, double high) {
      return low + (high - low) * 1e-4 * static_cast<double>(random() % 10000);
    };
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 place(number(-30, 30), number(0, 6), number(-120, 5));
      if (i % 16 == 0)
        in_cpp.emplace_back(DirectionalLight{{0.4, -1, 0.3}});
      else if (i % 2 == 0)
        in_cpp.emplace_back(SpotLight{place, {number(-1, 1), -1.0, 0.1}, 0.5, number(1, 20)});
      else
        in_cpp.emplace_back(PointLight{place, number(1, 20)});
      in_c_lights.push_back(in_c(in_cpp.back()));
    }
  }
};

TEST(FramesInC, lights_are_listed_in_clusters_as_in_cpp) {
  const Scene scene;
  const Lights lights(200);
  const gnomon_camera camera = in_c(scene.camera);
  const auto count = static_cast<int64_t>(lights.in_c_lights.size());
  const int64_t clusters = gnomon_cluster_count(&camera, 64, 48);
  ASSERT_EQ(clusters, static_cast<int64_t>(cluster_count(scene.camera, {})));
  // Room for all, and for so few that clusters are widened.
  for (const int64_t room : {int64_t{1000000}, count}) {
    std::vector<std::uint32_t> begin(static_cast<std::size_t>(clusters) + 1),
        list(static_cast<std::size_t>(room));
    std::vector<ClusterEntry> work(list.size());
    const LightClusters expected = cluster_lights(scene.camera, lights.in_cpp, {}, {begin, list, work});
    ASSERT_EQ(expected.status, PlanStatus::ok);
    const ClustersInC listed(camera, lights.in_c_lights, room);
    ASSERT_EQ(listed.status, GNOMON_OK);
    const gnomon_light_clusters& found = listed.found;
    EXPECT_EQ(found.columns, expected.columns);
    EXPECT_EQ(found.rows, expected.rows);
    EXPECT_EQ(found.slices, expected.slices);
    EXPECT_EQ(found.tile_pixels, expected.tile_pixels);
    EXPECT_EQ(found.depth_scale, expected.depth_scale);
    EXPECT_EQ(found.depth_offset, expected.depth_offset);
    EXPECT_EQ(found.orthographic, 0);
    ASSERT_EQ(found.light_count, static_cast<int64_t>(expected.lights.size()));
    EXPECT_EQ(listed.begin, begin);
    EXPECT_EQ(std::memcmp(listed.list.data(), expected.lights.data(), expected.lights.size_bytes()), 0);
    EXPECT_EQ(found.tile_pixels > 64, room == count);
  }
}

TEST(FramesInC, clusters_name_what_they_refuse) {
  const Scene scene;
  Lights lights(4);
  gnomon_camera camera = in_c(scene.camera);
  std::uint32_t begin[2], list[8];
  alignas(16) std::byte memory[2048];
  const auto refuses = [&](const char* expected, auto change, int64_t count = 4,
                           int64_t bytes = sizeof memory) {
    gnomon_light_clusters found;
    gnomon_light_clusters_default(&found, sizeof found);
    found.begin = begin;
    found.lights = list;
    found.begin_room = 2;
    found.light_room = 8;
    change(found);
    const char* field = nullptr;
    EXPECT_EQ(gnomon_cluster_lights(&camera, lights.in_c_lights.data(), sizeof(gnomon_light), count, memory,
                                    bytes, &found, &field),
              GNOMON_INVALID_INPUT)
        << expected;
    EXPECT_STREQ(field, expected);
  };
  const auto nothing = [](gnomon_light_clusters&) {};
  refuses("light_clusters.size", [](gnomon_light_clusters& c) { c.size = 3; });
  refuses("light_clusters.begin", [](gnomon_light_clusters& c) { c.begin = nullptr; });
  refuses("light_clusters.begin_room", [](gnomon_light_clusters& c) { c.begin_room = 1; });
  refuses("light_clusters.lights", [](gnomon_light_clusters& c) { c.lights = nullptr; });
  refuses("light_clusters.light_room", [](gnomon_light_clusters& c) { c.light_room = 3; });
  refuses("light_clusters.tile_pixels", [](gnomon_light_clusters& c) { c.tile_pixels = 0; });
  refuses("light_clusters.depth_slices", [](gnomon_light_clusters& c) { c.depth_slices = 257; });
  refuses("count", nothing, -1);
  refuses("bytes", nothing, 4, 64);
  lights.in_c_lights[1].kind = 7;
  refuses("light.kind", nothing);
  lights.in_c_lights[1] = in_c(lights.in_cpp[1]);
  lights.in_c_lights[1].range = kNan;
  refuses("lights", nothing);
  camera.near_depth = -1;
  refuses("light_clusters.size", [](gnomon_light_clusters& c) { c.size = 3; });
  EXPECT_EQ(gnomon_cluster_count(nullptr, 64, 48), 0);
  EXPECT_EQ(gnomon_cluster_memory(-1, 0), 0);
}

TEST(FramesInC, the_pool_of_lights_is_an_atlas_as_in_cpp) {
  const Scene scene;
  const Lights lights(6);
  const InputInC in(scene.camera, scene.sun, scene.boxes, scene.boxes, {});
  std::vector<gnomon_light_request> requests(6);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    gnomon_light_request_default(&requests[i], sizeof requests[i]);
    requests[i].light = &lights.in_c_lights[i];
  }
  std::vector<gnomon_light_maps> maps(6);
  gnomon_light_plan plan;
  gnomon_light_plan_default(&plan, sizeof plan);
  plan.lights = maps.data();
  plan.light_size = sizeof maps[0];
  plan.light_room = 6;
  std::vector<std::byte> memory(static_cast<std::size_t>(gnomon_light_memory(6, 0)));
  ASSERT_EQ(gnomon_plan_lights(&in.view, requests.data(), sizeof requests[0], 6, &in.scene, nullptr, nullptr,
                               memory.data(), static_cast<int64_t>(memory.size()), &plan, nullptr),
            GNOMON_OK);
  int with_maps = 0;
  for (int64_t i = 0; i < 6; ++i) {
    gnomon_atlas atlas;
    ASSERT_EQ(gnomon_light_atlas(&plan, i, &atlas, nullptr), GNOMON_OK);
    const gnomon_light_maps& of_light = maps[static_cast<std::size_t>(i)];
    EXPECT_EQ(atlas.count, of_light.map_count);
    if (atlas.count == 0) continue;
    ++with_maps;
    EXPECT_EQ(atlas.width, plan.pool_width);
    EXPECT_EQ(std::memcmp(atlas.place, of_light.place, sizeof atlas.place), 0);
    double matrix[16];
    EXPECT_EQ(gnomon_atlas_from_clip(&atlas, nullptr, 0, matrix, nullptr), GNOMON_OK);
  }
  EXPECT_GT(with_maps, 1);
  const char* field = nullptr;
  gnomon_atlas atlas;
  EXPECT_EQ(gnomon_light_atlas(&plan, 6, &atlas, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "light");
  EXPECT_EQ(gnomon_light_atlas(nullptr, 0, &atlas, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "light_plan");
  EXPECT_EQ(gnomon_light_atlas(&plan, 0, nullptr, &field), GNOMON_INVALID_INPUT);
  EXPECT_STREQ(field, "atlas");
}

}  // namespace
}  // namespace gnomon::test
