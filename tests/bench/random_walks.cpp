// How good are the maps of a moving camera that a history holds back? Random walks over a floor with blocks
// on it: the objective of the plan with a history over that of one without, and how often a map jumps.
//   bench_random_walks [WALKS [FRAMES [WARP]]]      40 walks of 240 frames by `optimal`, if nothing is said
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace {

using namespace gnomon;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    constexpr double kUnit = 0x1p-53;
    return low + (high - low) * (static_cast<double>(engine_() >> 11U) * kUnit);
  }

 private:
  std::mt19937_64 engine_;
};

struct Walk {
  std::vector<Box> boxes;
  glm::dvec3 light, start, velocity;
  double turn, pitch;  // radians per frame, radians
  [[nodiscard]] SceneBounds bounds() const { return {boxes, boxes}; }
  [[nodiscard]] Camera camera(int frame) const {
    const double heading = turn * frame;
    const glm::dvec3 ahead{std::sin(heading), 0.0, -std::cos(heading)};
    const glm::dvec3 sideways{std::cos(heading), 0.0, std::sin(heading)};
    const glm::dvec3 moved = ahead * velocity.z + sideways * velocity.x + glm::dvec3(0.0, velocity.y, 0.0);
    const glm::dvec3 forward = ahead * std::cos(pitch) + glm::dvec3(0.0, std::sin(pitch), 0.0);
    return perspective_camera(start + moved * static_cast<double>(frame), forward, {0.0, 1.0, 0.0}, 1.0, 1.6,
                              0.5, 200.0, 640, 400);
  }
};

Walk draw_walk(Random& random) {
  Walk w;
  w.boxes.push_back({{-600.0, -1.0, -600.0}, {600.0, 0.0, 600.0}});
  for (int i = 0; i < 40; ++i) {
    const double x = random.between(-80.0, 80.0), z = random.between(-80.0, 80.0);
    const double width = random.between(0.5, 6.0), height = random.between(0.5, 15.0);
    w.boxes.push_back({{x, 0.0, z}, {x + width, height, z + 3.0}});
  }
  const double towards_x = random.between(-1.0, 1.0), down = random.between(0.2, 1.0);
  w.light = {towards_x, -down, random.between(-1.0, 1.0)};
  const double x = random.between(-20.0, 20.0), eye = random.between(1.5, 6.0);
  w.start = {x, eye, random.between(-20.0, 20.0)};
  constexpr double kSpeed = 0.08;  // 5 units a second at 60 frames
  const double aside = random.between(-kSpeed, kSpeed), up = random.between(-0.2, 0.2) * kSpeed;
  w.velocity = {aside, up, random.between(-kSpeed, kSpeed)};
  w.turn = random.between(-0.01, 0.01);  // up to 34 degrees a second
  w.pitch = random.between(-0.4, 0.1);
  return w;
}

double error_of(const ShadowPlan& plan, const Camera& camera, const Walk& walk, Objective objective) {
  const AliasingStats error = measure(plan, camera, walk.bounds());
  if (objective == Objective::storage) return error.storage;
  return objective == Objective::max ? error.max : error.p95;
}

struct Row {
  double log_ratio = 0.0;
  int measured = 0, events = 0;
  double frames = 0.0;  // of all cascades, each after the first
};

void add_walk(const Walk& walk, const PlanOptions& options, int frames, Row& row) {
  constexpr int kMeasureEvery = 20;  // frames
  PlanHistory history;
  for (int frame = 0; frame < frames; ++frame) {
    const Camera camera = walk.camera(frame);
    const ShadowPlan plan = make_plan(camera, DirectionalLight{walk.light}, walk.bounds(), options, history);
    if (frame > 0) {
      row.events += history.event_count;
      row.frames += options.cascades;
    }
    if (frame % kMeasureEvery != kMeasureEvery - 1 || plan.map_count == 0) continue;
    const ShadowPlan cold = make_plan(camera, DirectionalLight{walk.light}, walk.bounds(), options);
    const double ratio = error_of(plan, camera, walk, options.warp.objective) /
                         error_of(cold, camera, walk, options.warp.objective);
    if (!std::isfinite(ratio) || !(ratio > 0.0)) continue;
    row.log_ratio += std::log(ratio);
    ++row.measured;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int walks = argc > 1 ? std::atoi(argv[1]) : 40, frames = argc > 2 ? std::atoi(argv[2]) : 240;
  const Warp* const warp = argc > 3 ? find_warp(argv[3]) : &warps::optimal;
  if (walks < 1 || frames < 2 || warp == nullptr) {
    std::fprintf(stderr, "bench_random_walks: expected WALKS >= 1, FRAMES >= 2 and the name of a warp\n");
    return 2;
  }
  std::printf("%d walks of %d frames, %s: objective over that without history, every 20th frame\n", walks,
              frames, argc > 3 ? argv[3] : "optimal");
  std::printf("maps splits       objective    ratio    events per cascade and frame\n");
  for (const Objective objective : {Objective::storage, Objective::max, Objective::p95}) {
    for (const auto& [maps, optimal] : {std::pair{1, false}, std::pair{4, false}, std::pair{4, true}}) {
      PlanOptions options;
      options.cascades = maps;
      options.warp.warp = warp;
      options.warp.objective = objective;
      options.split.scheme = optimal ? SplitScheme::optimal : SplitScheme::logarithmic;
      Row row;
      Random random(7);
      for (int i = 0; i < walks; ++i) add_walk(draw_walk(random), options, frames, row);
      std::printf("%4d %-12s %-9s %8.3f    %6.4f\n", maps, optimal ? "optimal" : "logarithmic",
                  std::string(to_string(objective)).c_str(), std::exp(row.log_ratio / row.measured),
                  row.events / row.frames);
    }
  }
  return 0;
}
