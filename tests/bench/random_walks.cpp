// How good are the maps of a moving camera that a history holds back? Random walks over a floor with blocks
// on it: the objective of the plan with a history over that of one without, and how often a map jumps.
//   bench_random_walks [WALKS [FRAMES [WARP]]]      40 walks of 240 frames by `optimal`, if nothing is said
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "support/walk.hpp"

namespace {

using namespace gnomon;

using test::Walk;

struct Row {
  double log_ratio = 0.0;
  int measured = 0, events = 0;
  double frames = 0.0;  // of all cascades, each after the first
};

void add_walk(const Walk& walk, int frames, Row& row) {
  constexpr int kMeasureEvery = 20;  // frames
  PlanHistory history;
  for (int frame = 0; frame < frames; ++frame) {
    const Camera camera = walk.camera(frame);
    const ShadowPlan plan =
        make_plan(camera, DirectionalLight{walk.light}, walk.bounds(), walk.options, &history);
    if (frame > 0) {
      row.events += history.event_count;
      row.frames += walk.options.cascades;
    }
    if (frame % kMeasureEvery != kMeasureEvery - 1 || plan.map_count == 0) continue;
    const ShadowPlan cold = make_plan(camera, DirectionalLight{walk.light}, walk.bounds(), walk.options);
    const double ratio = walk.error_of(plan, camera) / walk.error_of(cold, camera);
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
      Row row;
      Random random(7);
      for (int i = 0; i < walks; ++i) {
        Walk walk;
        walk.boxes = test::floor_with_blocks(random);
        test::draw_course(walk, [&](double low, double high) { return random.between(low, high); });
        walk.options.cascades = maps;
        walk.options.warp.warp = warp;
        walk.options.warp.objective = objective;
        walk.options.split.scheme = optimal ? SplitScheme::optimal : SplitScheme::logarithmic;
        add_walk(walk, frames, row);
      }
      std::printf("%4d %-12s %-9s %8.3f    %6.4f\n", maps, optimal ? "optimal" : "logarithmic",
                  std::string(to_string(objective)).c_str(), std::exp(row.log_ratio / row.measured),
                  row.events / row.frames);
    }
  }
  return 0;
}
