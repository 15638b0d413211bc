// Do the lists of lights miss no light of any pixel, and are they short?
#include "gnomon/lights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

struct Memory {
  std::vector<std::uint32_t> begin, lights;
  std::vector<ClusterEntry> work;
  Memory(const Camera& camera, const ClusterOptions& options, std::size_t entries)
      : begin(cluster_count(camera, options) + 1), lights(entries), work(entries) {}
  [[nodiscard]] ClusterMemory spans() { return {begin, lights, work}; }
};

bool lights_point(const Light& light, const glm::dvec3& point) {
  if (std::holds_alternative<DirectionalLight>(light)) return true;
  if (const auto* point_light = std::get_if<PointLight>(&light))
    return glm::distance(point_light->position, point) < point_light->range;
  const SpotLight spot = *std::get_if<SpotLight>(&light);
  const glm::dvec3 offset = point - spot.position;
  return glm::length(offset) < spot.range &&
         glm::dot(glm::normalize(offset), glm::normalize(spot.direction)) > std::cos(spot.outer_radians);
}

std::span<const std::uint32_t> list_of(const LightClusters& clusters, std::size_t cluster) {
  return clusters.lights.subspan(clusters.begin[cluster],
                                 clusters.begin[cluster + 1] - clusters.begin[cluster]);
}

Light draw_light(const Camera& camera, Random& random) {
  const double far_depth = std::min(camera.far_depth, 1e6);
  const double depth = camera.near_depth + (far_depth - camera.near_depth) * std::pow(random.unit(), 3.0);
  const double extent = camera.orthographic ? camera.top - camera.bottom : depth;
  const glm::dvec3 at = point_at(camera, random.between(-1.2, 1.2), random.between(-1.2, 1.2), depth) +
                        random.direction() * extent * random.between(0.0, 0.3);
  const double range = extent * std::exp2(random.between(-4.0, 1.0));
  if (random.unit() < 0.5) return PointLight{at, range};
  return SpotLight{at, random.direction(), random.between(0.05, 3.0), range};
}

TEST(LightClusters, no_list_misses_a_light_that_lights_its_pixel) {
  int lit = 0, coarse = 0;
  for_all(300, [&] {
    CaseLimits limits;
    limits.max_boxes = 1;
    Case input = draw_case(limits);
    Camera& camera = input.camera;
    camera.width = 1 + pick(900);
    camera.height = 1 + pick(700);
    Random random(static_cast<std::uint64_t>(pick(1 << 20)));
    std::vector<Light> lights;
    for (int i = 0, count = 1 + pick(60); i < count; ++i) lights.push_back(draw_light(camera, random));
    if (chance(0.3)) lights.front() = DirectionalLight{input.light};
    const ClusterOptions options{1 + pick(64), 1 + pick(40)};
    // Too small for all lists now and then.
    Memory memory(camera, options, chance(0.3) ? lights.size() : lights.size() * 4096);
    const LightClusters clusters = cluster_lights(camera, lights, options, memory.spans());
    require(clusters.status == PlanStatus::ok, "refused", clusters.invalid_field);
    coarse += clusters.tile_pixels > options.tile_pixels;
    require(clusters.begin.front() == 0 && clusters.begin.back() == clusters.lights.size(),
            "ends of the lists");
    for (std::size_t i = 0; i + 1 < clusters.begin.size(); ++i) {
      const auto list = list_of(clusters, i);
      require(std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end(), "order", i);
    }
    for (int i = 0; i < 400; ++i) {
      const double x = random.between(-1.0, 1.0), y = random.between(-1.0, 1.0);
      const double depth = camera.near_depth + (std::min(camera.far_depth, 1e6) - camera.near_depth) *
                                                   std::pow(random.unit(), 4.0);
      const glm::dvec3 point = point_at(camera, x, y, depth);
      const auto pixel = [](double at, int size) {
        return std::min(static_cast<int>((0.5 * at + 0.5) * size), size - 1);
      };
      const std::size_t cluster =
          cluster_at(clusters, pixel(x, camera.width), pixel(y, camera.height), depth_of(camera, point));
      const auto list = list_of(clusters, cluster);
      for (std::uint32_t k = 0; k < lights.size(); ++k) {
        if (!lights_point(lights[k], point)) continue;
        ++lit;
        require(std::binary_search(list.begin(), list.end(), k), "missing", k, "at depth", depth);
      }
    }
  });
  EXPECT_GT(lit, 10000);
  EXPECT_GT(coarse, 20);
}

/// A camera at the origin that looks along -z.
Camera straight(int width = 640, int height = 480) {
  return perspective_camera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0, 4.0 / 3.0, 0.1, 100.0, width, height);
}

std::size_t entries_of(const Camera& camera, const Light& light, const ClusterOptions& options = {}) {
  Memory memory(camera, options, 1 << 16);
  const std::vector<Light> lights{light};
  const LightClusters clusters = cluster_lights(camera, lights, options, memory.spans());
  EXPECT_EQ(clusters.status, PlanStatus::ok);
  return clusters.lights.size();
}

TEST(LightClusters, lights_that_reach_nothing_in_view_are_in_no_list) {
  const Camera camera = straight();
  EXPECT_EQ(entries_of(camera, PointLight{{0, 0, 20}, 10.0}), 0u) << "behind the eye";
  EXPECT_EQ(entries_of(camera, PointLight{{0, 0, -150}, 20.0}), 0u) << "beyond the far plane";
  EXPECT_EQ(entries_of(camera, PointLight{{200, 0, -50}, 20.0}), 0u) << "beside the view";
  EXPECT_EQ(entries_of(camera, PointLight{{0, 0, -10}, 0.0}), 0u) << "no range";
  EXPECT_EQ(entries_of(camera, PointLight{{0, 0, -10}, -1.0}), 0u) << "less than none";
  EXPECT_EQ(entries_of(camera, SpotLight{{0, 0, 5}, {0, 0, 1}, 0.5, 50.0}), 0u) << "turned away";
  const std::size_t all = cluster_count(camera, {});
  EXPECT_EQ(entries_of(camera, DirectionalLight{}), all);
  EXPECT_EQ(entries_of(camera, PointLight{{0, 0, 0}, 200.0}), all)
      << "the eye within a light of all that it sees";
  const std::vector<Light> lights{PointLight{{0, 0, 0.5}, 2.0}};
  Memory memory(camera, {}, 1 << 16);
  const LightClusters within = cluster_lights(camera, lights, {}, memory.spans());
  EXPECT_EQ(list_of(within, cluster_at(within, 320, 240, 1.0)).size(), 1u) << "the eye within a small light";
  EXPECT_EQ(list_of(within, cluster_at(within, 320, 240, 5.0)).size(), 0u) << "beyond all local lights";
}

TEST(LightClusters, a_small_light_is_in_few_lists_and_a_cone_in_fewer_than_its_sphere) {
  const Camera camera = straight();
  EXPECT_LE(entries_of(camera, PointLight{{0, 0, -20}, 0.5}), 60u);
  const std::size_t sphere = entries_of(camera, PointLight{{0, 0, -20}, 8.0});
  EXPECT_LT(entries_of(camera, SpotLight{{0, 0, -20}, {0, -1, 0}, 0.3, 8.0}), sphere / 3);
}

TEST(LightClusters, lists_without_room_become_those_of_larger_clusters) {
  const Camera camera = straight();
  std::vector<Light> lights(300, PointLight{{0, 0, -20}, 90.0});
  Memory memory(camera, {}, lights.size());
  const LightClusters one = cluster_lights(camera, lights, {}, memory.spans());
  ASSERT_EQ(one.status, PlanStatus::ok);
  EXPECT_EQ(one.columns * one.rows * one.slices, 1);
  std::vector<std::uint32_t> all(lights.size());
  std::iota(all.begin(), all.end(), 0u);
  EXPECT_TRUE(std::equal(all.begin(), all.end(), one.lights.begin(), one.lights.end()));
}

TEST(LightClusters, broken_input_comes_back_as_a_status) {
  const Camera camera = straight();
  const auto field = [&](const std::vector<Light>& lights, const ClusterOptions& options = {},
                         std::size_t room = 8, Camera seen = straight()) {
    Memory memory(camera, {}, room);
    return cluster_lights(seen, lights, options, memory.spans()).invalid_field;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field({}), "");
  EXPECT_EQ(field({PointLight{{0, kNan, 0}, 1.0}}), "light");
  EXPECT_EQ(field({PointLight{{0, 0, 0}, std::numeric_limits<double>::infinity()}}), "light");
  EXPECT_EQ(field({SpotLight{{0, 0, 0}, {0, 0, 0}, 0.5, 1.0}}), "light");
  EXPECT_EQ(field({}, {0, 24}), "clusters.tile_pixels");
  EXPECT_EQ(field({}, {32, 0}), "clusters.depth_slices");
  EXPECT_EQ(field({}, {32, kMaxDepthSlices + 1}), "clusters.depth_slices");
  EXPECT_EQ(field(std::vector<Light>(9, PointLight{}), {}), "memory.lights");
  Camera wide = camera;
  wide.width = 1 << 20;
  EXPECT_EQ(field({}, {}, 8, wide), "camera.width, camera.height");
  EXPECT_EQ(cluster_count(wide, {}), 0u);
  std::vector<std::uint32_t> none;
  std::vector<ClusterEntry> work;
  EXPECT_EQ(cluster_lights(camera, {}, {}, {none, none, work}).invalid_field, "memory.begin");
}

}  // namespace
}  // namespace gnomon::test
