// What does drawing neighbouring pages together save? Each page of a plan by itself, and in runs, by turns in
// one process.
//
//     bench_page_runs [--rounds N] [--frames N] [--page-size TEXELS] [SCENE...]
//
// SCENE: a built-in scene or a glTF file; without one all built-in scenes. Time is that of culling, draw
// lists and pages (Pass::shadow_maps), nothing kept: of each frame of the flight the least of its rounds.
// Texels differ where the matrix of a block rounds a silhouette to its other side.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string>
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

constexpr int kWidth = 480, kHeight = 270, kStride = 3;

std::vector<glm::dvec3> visible_points(const render::Renderer& renderer, const Camera& camera) {
  const FloatImage at = renderer.positions();
  std::vector<glm::dvec3> points;
  for (int y = 0; y < kHeight; y += kStride) {
    for (int x = 0; x < kWidth; x += kStride) {
      const auto i = 4 * static_cast<std::size_t>(y * kWidth + x);
      if (!(at.values[i + 3] > 0.0f)) continue;
      points.push_back(camera.position + glm::dvec3(at.values[i], at.values[i + 1], at.values[i + 2]));
    }
  }
  return points;
}

struct Sums {
  double pages = 0.0, frames = 0.0, each_triangles = 0.0, runs_triangles = 0.0, each_ms = 0.0, runs_ms = 0.0;
  std::vector<double> ratios, cpu_ratios;
  double texels = 0.0, differing = 0.0;
};

render::FrameStats draw(render::Renderer& renderer, const PagePlan& plan, const Camera& camera,
                        const render::PreparedFilter& filter, render::MapPasses passes) {
  render::FrameOptions options = quiet();
  options.map_passes = passes;
  options.prune = options.prune.without(PruneRule::held_maps);
  return renderer.draw(plan, camera, filter, options);
}

void measure(render::Renderer& renderer, const PagePlan& plan, const Camera& camera, int rounds, Sums& sums) {
  using render::MapPasses;
  const render::PreparedFilter hard = renderer.prepare(render::filters::hard, render::Source::pages);
  const auto texels = [&](MapPasses passes, double& triangles) {
    const render::FrameStats stats = draw(renderer, plan, camera, hard, passes);
    triangles += static_cast<double>(stats.map[0].triangles);
    std::vector<float> all;
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      const std::vector<float> of_page = renderer.page_depths(i).values;
      all.insert(all.end(), of_page.begin(), of_page.end());
    }
    return all;
  };
  const std::vector<float> each = texels(MapPasses::each, sums.each_triangles),
                           runs = texels(MapPasses::automatic, sums.runs_triangles);
  constexpr float kRounding = 1e-5f;
  for (std::size_t i = 0; i < each.size(); ++i)
    sums.differing += std::abs(each[i] - runs[i]) > kRounding ? 1.0 : 0.0;
  sums.texels += static_cast<double>(each.size());
  sums.pages += static_cast<double>(plan.pages.size());
  sums.frames += 1.0;
  // CPU time of whole frames, less that of one that draws no page.
  std::array<double, 3> cpu{1e300, 1e300, 1e300};
  std::array<double, 2> least{1e300, 1e300};
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t turn = 0; turn < 3; ++turn) {
      const std::size_t side = (static_cast<std::size_t>(round) + turn) % 3;
      const std::clock_t begin = std::clock();
      const double ms = draw(renderer, side == 2 ? PagePlan{} : plan, camera, hard,
                             side == 0 ? MapPasses::each : MapPasses::automatic)
                            .ms(render::Pass::shadow_maps);
      cpu[side] = std::min(cpu[side], 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
      if (side < 2) least[side] = std::min(least[side], ms);
    }
  }
  sums.each_ms += least[0];
  sums.runs_ms += least[1];
  sums.ratios.push_back(least[1] / least[0]);
  sums.cpu_ratios.push_back((cpu[1] - cpu[2]) / (cpu[0] - cpu[2]));
}

void measure_scene(const std::string& name, int frames, int rounds, int page_texels) {
  const Scene scene = name.find('.') == std::string::npos ? load_builtin(name) : load_gltf(name);
  const CameraPath path = default_path(scene);
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
  const Light light = default_light({}, scene.bounds_world);
  render::Renderer renderer(scene);
  std::vector<std::byte> memory(page_memory(1 << 13, std::size_t{kWidth} * kHeight));
  for (const PagePolicy* policy : {&page_policies::resolution, &page_policies::clipmap}) {
    PageOptions pages;
    pages.plan.fit = Fit::stable;
    render::set_margin(render::default_settings(render::filters::hard), pages.plan);
    pages.policy = policy;
    pages.page_texels = page_texels;
    pages.capacity = 1024;
    pages.fallback = true;
    Sums sums;
    for (int frame = 0; frame < frames; ++frame) {
      const Camera camera = path.at((frame + 0.5) / frames, kWidth, kHeight);
      renderer.draw(ShadowPlan{}, camera, renderer.prepare(render::filters::hard), quiet());
      const std::vector<glm::dvec3> points = visible_points(renderer, camera);
      const PagePlan plan =
          plan_pages({.camera = camera, .points_world = points}, light, {boxes, boxes}, pages, memory);
      if (plan.status == PlanStatus::ok) measure(renderer, plan, camera, rounds, sums);
    }
    if (sums.ratios.empty()) continue;
    std::printf("| %s | %s | %.0f | %.0f -> %.0f | %.1f | %.1f | %.2f | %.2f | %.0f |\n",
                std::filesystem::path(name).stem().c_str(), std::string(policy->name).c_str(),
                sums.pages / sums.frames, 1e-3 * sums.each_triangles / sums.frames,
                1e-3 * sums.runs_triangles / sums.frames, sums.each_ms / sums.frames,
                sums.runs_ms / sums.frames, median(sums.ratios), median(sums.cpu_ratios),
                1e6 * sums.differing / sums.texels);
    (void)std::fflush(stdout);
  }
}

int run_all(int argc, char** argv) {
  int rounds = 7, frames = 3, page_texels = 64;
  std::vector<std::string> scenes;
  for (int i = 1; i < argc; ++i) {
    int* const number = std::strcmp(argv[i], "--rounds") == 0      ? &rounds
                        : std::strcmp(argv[i], "--frames") == 0    ? &frames
                        : std::strcmp(argv[i], "--page-size") == 0 ? &page_texels
                                                                   : nullptr;
    if (number == nullptr) {
      scenes.emplace_back(argv[i]);
      continue;
    }
    *number = i + 1 < argc ? std::atoi(argv[++i]) : 0;
    if (*number < 1) {
      std::fprintf(stderr, "bench_page_runs: an option wants a number of at least 1\n");
      return 2;
    }
  }
  if (page_texels != 64 && page_texels != 128 && page_texels != 256) {
    std::fprintf(stderr, "bench_page_runs: --page-size %d: expected 64, 128 or 256\n", page_texels);
    return 2;
  }
  if (scenes.empty()) {
    for (const BuiltinScene& scene : builtin_scenes()) scenes.emplace_back(scene.name);
  }
  const auto context = render::create_context();
  std::printf(
      "| scene | policy | pages | k triangles | each, ms | runs, ms | ratio | ratio of CPU time "
      "| texels that differ, of a million |\n|--|--|--|--|--|--|--|--|--|\n");
  for (const std::string& name : scenes) measure_scene(name, frames, rounds, page_texels);
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::guarded("bench_page_runs", gnomon::run_all, argc, argv);
}
