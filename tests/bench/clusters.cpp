// What receiver clusters are worth beside as many cascades: on islands of receivers, and on ground that is
// everywhere. Ratios of measured storage, geometric means over random scenes, and the time of a plan.
//   bench_clusters [SCENES]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "gnomon/gnomon.hpp"
#include "median.hpp"

namespace {

using gnomon::Box;

struct Scene {
  gnomon::Camera camera;
  gnomon::DirectionalLight sun;
  std::vector<Box> boxes;
};

constexpr double kFar = 400.0;

/// `islands`: boxes that stand apart; 0: one ground.
Scene draw(gnomon::Random& random, int islands) {
  const auto between = [&random](double low, double high) { return random.between(low, high); };
  Scene scene;
  gnomon::Camera& camera = scene.camera;
  camera.position = {0.0, between(3.0, 20.0), 0.0};
  camera.forward = {0.0, between(-0.3, 0.0), 1.0};
  camera.near_depth = 0.5;
  camera.far_depth = kFar;
  camera.right = 0.7;
  camera.left = -0.7;
  camera.top = 0.4;
  camera.bottom = -0.4;
  camera.width = 1280;
  camera.height = 720;
  const double height = between(0.3, 1.4), side = between(-3.1, 3.1);
  scene.sun.direction = {std::cos(height) * std::sin(side), -std::sin(height),
                         std::cos(height) * std::cos(side)};
  if (islands == 0) scene.boxes.push_back({{-1e3, -1.0, -1e3}, {1e3, 0.0, 1e3}});
  for (int i = 0; i < islands; ++i) {
    const double z = between(10.0, kFar), x = between(-0.7, 0.7) * z, half = between(2.0, 20.0);
    scene.boxes.push_back({{x - half, -1.0, z - half}, {x + half, between(0.0, 10.0), z + half}});
  }
  return scene;
}

struct Measured {
  double storage = 0.0, us = 0.0;
};

Measured measured(const Scene& scene, const gnomon::PlanOptions& options) {
  using Clock = std::chrono::steady_clock;
  const gnomon::SceneBounds bounds{scene.boxes, scene.boxes};
  std::vector<double> us;
  gnomon::ShadowPlan plan;
  for (int i = 0; i < 5; ++i) {
    const auto begin = Clock::now();
    plan = make_plan(scene.camera, scene.sun, bounds, options);
    us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  if (plan.status != gnomon::PlanStatus::ok) return {};
  constexpr gnomon::MeasureOptions kFine{48, 48, 1024};
  return {measure(plan, scene.camera, bounds, kFine).storage, gnomon::median(us)};
}

void print_row(const char* what, int least, int most, int cascades, const gnomon::Warp& warp, int scenes) {
  gnomon::Random random(static_cast<std::uint64_t>(1 + most * 100 + cascades));
  double logs = 0.0, worst = 0.0;
  int counted = 0;
  std::vector<double> by_depth_us, clusters_us;
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = draw(random, least + random.pick(most - least));
    gnomon::PlanOptions options;
    options.prune = gnomon::kPruneNothing.with(gnomon::PruneRule::light_depths);  // maps of one size
    options.warp.warp = &warp;
    options.cascades = cascades;
    const Measured by_depth = measured(scene, options);
    options.split.partition = gnomon::Partition::receiver_clusters;
    const Measured clusters = measured(scene, options);
    if (!(by_depth.storage > 0.0) || !(clusters.storage > 0.0)) continue;
    const double ratio = clusters.storage / by_depth.storage;
    logs += std::log(ratio);
    worst = std::max(worst, ratio);
    ++counted;
    by_depth_us.push_back(by_depth.us);
    clusters_us.push_back(clusters.us);
  }
  if (counted == 0) return;
  std::printf("| %s | %d | %s | %.2f | %.2f | %.0f | %.0f |\n", what, cascades,
              std::string(warp.name).c_str(), std::exp(logs / counted), worst, gnomon::median(by_depth_us),
              gnomon::median(clusters_us));
}

}  // namespace

int main(int count, char** words) {
  const int scenes = count > 1 ? std::max(std::atoi(words[1]), 1) : 200;
  std::printf("| receivers | maps | warp | storage over cascades | worst | cascades, us | clusters, us |\n");
  std::printf("|--|--|--|--|--|--|--|\n");
  for (const gnomon::Warp* warp : {&gnomon::warps::none, &gnomon::warps::optimal}) {
    for (const int cascades : {2, 4, 8}) {
      print_row("2 to 4 islands", 2, 5, cascades, *warp, scenes);
      print_row("5 to 20 islands", 5, 21, cascades, *warp, scenes);
      print_row("ground", 0, 0, cascades, *warp, scenes);
    }
  }
  return 0;
}
