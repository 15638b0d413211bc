// What lists of lights by clusters save in the look-up of many lights, and how long the lists are.
//
//     bench_many_lights [SCENE] [ROUNDS] [WIDTHxHEIGHT] [LIGHTS]
//
// Without them builtin:hangar, 9 rounds, 480x270, and 24, 64 and 256 lights. ROUNDS 0: lists alone, without a
// look-up.
// Each round draws a frame in every way, one after the other, so that all meet the same load.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "guarded.hpp"
#include "median.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

constexpr ClusterOptions kAll{1 << 16, 1};

/// As samples/many_lights places them, with a faint moon.
std::vector<LightRequest> place_lights(const Scene& scene, int count) {
  std::vector<LightRequest> lights{{DirectionalLight{{0.4, -1.0, 0.3}}, 0.1}};
  for (const Light& light : local_lights(count, scene.bounds_world)) lights.push_back({light});
  return lights;
}

/// The lights of a frame, planned once.
struct Lights {
  std::vector<LightRequest> requests;
  std::vector<ShadowPlan> plans;
  std::vector<std::byte> memory;
  std::vector<LightMaps> maps;  ///< those of the plan, none of them due
  LightPlan plan;
  std::vector<render::DrawnLight> drawn;

  Lights(std::vector<LightRequest> all, const Camera& camera, const std::vector<Box>& boxes,
         const PlanOptions& options)
      : requests(std::move(all)), plans(requests.size()), memory(light_memory(requests.size(), 0)) {
    LightOptions pool;
    pool.plan = options;
    plan = plan_lights(camera, requests, {boxes, boxes}, pool, memory);
    maps.assign(plan.lights.begin(), plan.lights.end());
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (plan.lights[i].map_count > 0)
        plans[i] = make_plan(camera, requests[i].light, {boxes, boxes}, light_options(pool, plan.lights[i]));
      drawn.push_back({requests[i].light, &plans[i], glm::vec3(0.3f)});
      maps[i].due = false;  // the look-up alone is of interest
    }
    plan.lights = maps;
  }
  /// Those that the renderer lists.
  [[nodiscard]] std::vector<Light> listed() const {
    std::vector<Light> lights;
    for (std::size_t i = 0; i < requests.size(); ++i)
      if (plan.lights[i].outcome != LightOutcome::without_receiver) lights.push_back(requests[i].light);
    return lights;
  }
};

struct Lists {
  std::vector<std::uint32_t> begin, lights = std::vector<std::uint32_t>(1 << 22);
  std::vector<ClusterEntry> work = std::vector<ClusterEntry>(1 << 22);
  [[nodiscard]] LightClusters make(const Camera& camera, const std::vector<Light>& of,
                                   const ClusterOptions& options) {
    begin.resize(cluster_count(camera, options) + 1);
    return cluster_lights(camera, of, options, {begin, lights, work});
  }
};

/// Mean length of the list that a surface's pixel reads.
double mean_length(const LightClusters& clusters, const FloatImage& positions, const FloatImage& normals) {
  double sum = 0.0, pixels = 0.0;
  for (int y = 0; y < positions.height; ++y) {
    for (int x = 0; x < positions.width; ++x) {
      const std::size_t i = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(positions.width) +
                                 static_cast<std::size_t>(x));
      if (!(normals.values[i + 3] > 0.0f)) continue;
      const std::size_t at = cluster_at(clusters, x, positions.height - 1 - y, positions.values[i + 3]);
      sum += clusters.begin[at + 1] - clusters.begin[at];
      pixels += 1.0;
    }
  }
  return pixels > 0.0 ? sum / pixels : 0.0;
}

double list_ms(const Camera& camera, const std::vector<Light>& lights, const ClusterOptions& options,
               Lists& lists) {
  std::vector<double> times;
  for (int i = 0; i < 21; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    static_cast<void>(lists.make(camera, lights, options));
    times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  return *std::min_element(times.begin(), times.end());
}

void measure(render::Renderer& renderer, const Scene& scene, const std::vector<Box>& boxes,
             const Camera& camera, int count, int rounds) {
  const render::FilterSettings pcf = render::default_settings(render::filters::pcf);
  PlanOptions options;
  render::set_margin(pcf, options);
  const Lights lights(place_lights(scene, count), camera, boxes, options);
  const std::vector<Light> listed = lights.listed();
  struct Way {
    const char* name;
    ClusterOptions options;
    std::vector<double> ms{};
  };
  std::vector<Way> ways{{"a pass each", {0, 1}},        {"all in one pass", kAll},
                        {"32 px, 24 slices", {32, 24}}, {"16 px, 24", {16, 24}},
                        {"64 px, 24", {64, 24}},        {"32 px, 12", {32, 12}},
                        {"32 px, 48", {32, 48}},        {"64 px, 48", {64, 48}},
                        {"128 px, 24", {128, 24}},      {"32 px, 1 (tiles)", {32, 1}}};
  const render::PreparedFilter filter = renderer.prepare(pcf, render::Source::lights);
  render::FrameOptions frame = quiet();
  for (int round = rounds > 0 ? -1 : 0; round < rounds; ++round) {  // the first one warms up
    for (Way& way : ways) {
      frame.light_clusters = way.options;
      const double ms =
          renderer.draw({lights.plan, lights.drawn}, camera, filter, frame).ms(render::Pass::mask);
      if (round >= 0) way.ms.push_back(ms);
    }
  }
  Camera large = camera;
  large.width = 1920;
  large.height = 1080;
  const auto surfaces = [&](const Camera& of) {
    renderer.draw(ShadowPlan{}, of, renderer.prepare(render::filters::hard), quiet());
    return std::pair(renderer.positions(), renderer.normals());
  };
  const auto seen = surfaces(camera), seen_large = surfaces(large);
  Lists lists;
  for (const Way& way : ways) {
    std::printf("%6d %6zu  %-18s", count, listed.size(), way.name);
    if (rounds > 0) std::printf(" %8.1f ms  %5.2f", median(way.ms), median(way.ms) / median(ways[0].ms));
    if (way.options.tile_pixels > 0) {
      std::printf("  %6.2f lights a pixel  lists %.3f ms",
                  mean_length(lists.make(camera, listed, way.options), seen.first, seen.second),
                  list_ms(camera, listed, way.options, lists));
      std::printf(", at 1920 x 1080 %6.2f and %.3f ms",
                  mean_length(lists.make(large, listed, way.options), seen_large.first, seen_large.second),
                  list_ms(large, listed, way.options, lists));
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

int run_all(int argc, char** argv) {
  const auto context = render::create_context(render::ContextKind::automatic);
  const Scene scene = load_scene(argc > 1 ? argv[1] : "builtin:hangar");
  const int rounds = argc > 2 ? std::max(std::atoi(argv[2]), 0) : 9;
  int width = 480, height = 270;
  if (argc > 3 && (std::sscanf(argv[3], "%dx%d", &width, &height) != 2 || width < 16 || height < 16)) {
    std::fprintf(stderr, "bench_many_lights: %s: expected WIDTHxHEIGHT, at least 16x16\n", argv[3]);
    return 2;
  }
  const Camera camera = default_path(scene).at(0.3, width, height);
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
  render::Renderer renderer(scene);
  std::printf("lights listed  way                      mask   of a pass each\n");
  const std::vector<int> counts =
      argc > 4 ? std::vector<int>{std::clamp(std::atoi(argv[4]), 1, 4095)} : std::vector<int>{24, 64, 256};
  for (const int count : counts) measure(renderer, scene, boxes, camera, count, rounds);
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::guarded("bench_many_lights", gnomon::run_all, argc, argv);
}
