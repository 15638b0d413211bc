// What does drawing all maps of a plan in one pass save? Maps drawn one pass each and in one layered pass, in
// turns on one machine, over frames of the scenes' default flights. Every bit of every depth is compared.
//
//     bench_single_pass [--scenes A,B] [--frames N] [--rounds N] [--size WxH] [--map-sizes A,B]
//
// Time is that of culling, draw lists and maps (Pass::shadow_maps): of each frame the least of its rounds.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/probe.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "guarded.hpp"
#include "median.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

using render::FrameStats;
using render::MapPasses;

struct Request {
  std::vector<std::string> scenes;
  std::vector<int> map_sizes{256, 1024};
  int frames = 3, rounds = 7, width = 320, height = 180;
};

std::vector<std::string> split(const char* text) {
  std::vector<std::string> parts(1);
  for (; *text != '\0'; ++text) {
    if (*text == ',')
      parts.emplace_back();
    else
      parts.back() += *text;
  }
  return parts;
}

Request parsed(int argc, char** argv) {
  Request request;
  const auto fail = [] {
    throw std::runtime_error(
        "usage: bench_single_pass [--scenes A,B] [--frames N] [--rounds N] [--size WxH] [--map-sizes A,B]");
  };
  for (int i = 1; i < argc; i += 2) {
    if (i + 1 == argc) fail();
    const char* const value = argv[i + 1];
    if (std::strcmp(argv[i], "--scenes") == 0) {
      request.scenes = split(value);
    } else if (std::strcmp(argv[i], "--map-sizes") == 0) {
      request.map_sizes.clear();
      for (const std::string& size : split(value)) request.map_sizes.push_back(std::atoi(size.c_str()));
    } else if (std::strcmp(argv[i], "--frames") == 0) {
      request.frames = std::atoi(value);
    } else if (std::strcmp(argv[i], "--rounds") == 0) {
      request.rounds = std::atoi(value);
    } else if (std::strcmp(argv[i], "--size") == 0) {
      if (std::sscanf(value, "%dx%d", &request.width, &request.height) != 2) fail();
    } else {
      fail();
    }
  }
  if (request.frames < 1 || request.rounds < 1 || request.width < 16 || request.height < 16) fail();
  for (const int size : request.map_sizes) {
    if (size < 4 || size > 8192) fail();
  }
  if (request.scenes.empty()) {
    for (const BuiltinScene& scene : builtin_scenes())
      request.scenes.push_back("builtin:" + std::string(scene.name));
  }
  return request;
}

struct Layout {
  const char* name;
  LightKind light;
  int cascades;
};
constexpr std::array kLayouts = {
    Layout{"sun, 2 maps", LightKind::sun, 2}, Layout{"sun, 4 maps", LightKind::sun, 4},
    Layout{"sun, 8 maps", LightKind::sun, 8}, Layout{"point light", LightKind::point, 1}};

struct Sums {
  double each_ms = 0.0, layered_ms = 0.0, triangles = 0.0, draws_each = 0.0, draws_layered = 0.0, maps = 0.0;
  std::vector<double> ratios;
  std::size_t differing = 0;
  int chosen = 0;  ///< frames that `automatic` draws in one pass
};

FrameStats draw(render::Renderer& renderer, const ShadowPlan& plan, const Camera& camera,
                const render::PreparedFilter& filter, MapPasses passes) {
  render::FrameOptions options = quiet();
  options.map_passes = passes;
  options.prune = prune_rules_of(PruneSource::this_frame);  // every frame draws all maps whole
  return renderer.draw(plan, camera, filter, options);
}

std::vector<std::vector<float>> depths(const render::Renderer& renderer, const ShadowPlan& plan) {
  std::vector<std::vector<float>> all;
  for (int i = 0; i < plan.map_count; ++i) all.push_back(renderer.depth_map(i).values);
  return all;
}

void measure(render::Renderer& renderer, const ShadowPlan& plan, const Camera& camera, int rounds,
             Sums& sums) {
  const render::PreparedFilter filter = renderer.prepare(render::filters::hard);
  FrameStats stats = draw(renderer, plan, camera, filter, MapPasses::each);
  const auto before = depths(renderer, plan);
  for (int i = 0; i < stats.map_count; ++i) {
    sums.triangles += static_cast<double>(stats.map[static_cast<std::size_t>(i)].triangles);
    sums.draws_each += stats.map[static_cast<std::size_t>(i)].draws;
  }
  sums.maps += stats.map_count;
  stats = draw(renderer, plan, camera, filter, MapPasses::layered);
  sums.draws_layered += stats.layered_draws;
  const auto after = depths(renderer, plan);
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t k = 0; k < before[i].size(); ++k) sums.differing += before[i][k] == after[i][k] ? 0 : 1;
  }
  sums.chosen += draw(renderer, plan, camera, filter, MapPasses::automatic).layered_maps > 0 ? 1 : 0;
  std::array<double, 2> least{1e300, 1e300};
  for (int round = 0; round < rounds; ++round) {
    for (int turn = 0; turn < 2; ++turn) {
      const int side = (round + turn) % 2;
      const double ms = draw(renderer, plan, camera, filter, side == 0 ? MapPasses::each : MapPasses::layered)
                            .ms(render::Pass::shadow_maps);
      least[static_cast<std::size_t>(side)] = std::min(least[static_cast<std::size_t>(side)], ms);
    }
  }
  sums.each_ms += least[0];
  sums.layered_ms += least[1];
  sums.ratios.push_back(least[1] / least[0]);
}

void measure_scene(const Request& request, const std::string& name) {
  const Scene scene = load_scene(name);
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
  render::Renderer renderer(scene);
  const CameraPath path = default_path(scene);
  for (const Layout& layout : kLayouts) {
    LightPlacement placement;
    placement.kind = layout.light;
    const Light light = default_light(placement, scene.bounds_world);
    for (const int size : request.map_sizes) {
      PlanOptions options;
      options.resolution.max_size = size;
      options.cascades = layout.cascades;
      render::set_margin(render::default_settings(render::filters::hard), options);
      Sums sums;
      for (int frame = 0; frame < request.frames; ++frame) {
        const Camera camera = path.at((frame + 0.5) / request.frames, request.width, request.height);
        const ShadowPlan plan = make_plan(camera, light, {boxes, boxes}, options);
        if (plan.map_count > 1) measure(renderer, plan, camera, request.rounds, sums);
      }
      const double frames = static_cast<double>(sums.ratios.size());
      if (sums.ratios.empty()) continue;
      std::printf("| %s | %s | %d | %.1f | %.1f | %.0f -> %.0f | %.2f | %.2f | %.2f | %d of %zu | %zu |\n",
                  name.c_str(), layout.name, size, sums.maps / frames, 1e-3 * sums.triangles / frames,
                  sums.draws_each / frames, sums.draws_layered / frames, sums.each_ms / frames,
                  sums.layered_ms / frames, median(sums.ratios), sums.chosen, sums.ratios.size(),
                  sums.differing);
      (void)std::fflush(stdout);
    }
  }
}

int run(const Request& request) {
  const auto context = render::create_context(render::ContextKind::automatic);
  const std::string extension = render::layer_extension();
  if (extension.empty()) throw std::runtime_error("the driver does not write gl_Layer in vertex shaders");
  std::printf("%s, %s, %dx%d, %d frames, %d rounds\n\n", context->info().description().c_str(),
              extension.c_str(), request.width, request.height, request.frames, request.rounds);
  std::printf(
      "| scene | light | map size | maps | k triangles | draw commands | each, ms | layered, ms | ratio | "
      "automatic layers | texels that differ |\n|--|--|--|--|--|--|--|--|--|--|--|\n");
  for (const std::string& name : request.scenes) measure_scene(request, name);
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  const auto run = [](int count, char** words) { return gnomon::run(gnomon::parsed(count, words)); };
  return gnomon::guarded("bench_single_pass", run, argc, argv);
}
