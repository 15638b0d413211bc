// What does a plan with a history cost, against one that starts afresh? The cases in tests/data/cases, their
// cameras walking and looking round; both plans of a frame side by side, so that a slow spell of the machine
// hits both.
//   bench_warm_start [FRAMES]
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>

#include "case_table.hpp"

namespace {

using namespace gnomon;

/// The case's camera after so many frames: a step a frame, and a head that turns to both sides.
Camera walking(const Camera& start, int frame) {
  constexpr double kStep = 0.08;                    // 5 units a second at 60 frames
  constexpr double kPeriod = 300.0, kWidest = 0.4;  // frames, radians: up to half a degree a frame
  constexpr double kPi = 3.141592653589793;
  const CameraAxes axes = camera_axes(start);
  const double turn = kWidest * std::sin(2.0 * kPi * frame / kPeriod);
  Camera camera = start;
  camera.position += axes.right * (kStep * frame);
  camera.forward = axes.forward * std::cos(turn) + axes.right * std::sin(turn);
  return camera;
}

struct Row {
  const Warp* warp;
  Objective objective;
  int cascades;
  SplitScheme split;
  std::vector<double> cold, warm;  // nanoseconds of one plan
};

std::vector<Row> rows() {
  std::vector<Row> result;
  constexpr Objective kObjectives[] = {Objective::storage, Objective::max, Objective::p95};
  for (const int cascades : {1, 4}) {
    result.push_back({&warps::none, Objective::storage, cascades, SplitScheme::logarithmic, {}, {}});
    for (const Objective objective : kObjectives)
      result.push_back({&warps::optimal, objective, cascades, SplitScheme::logarithmic, {}, {}});
  }
  for (const Objective objective : kObjectives)
    result.push_back({&warps::optimal, objective, 4, SplitScheme::optimal, {}, {}});
  return result;
}

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// The time that `act` takes, in nanoseconds.
template <typename Act>
double timed(Act&& act) {
  const auto begin = std::chrono::steady_clock::now();
  act();
  const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
  return spent.count();
}

std::uint64_t walk(const NamedCase& c, int frames, Row& row) {
  PlanOptions options;
  options.cascades = row.cascades;
  options.warp.warp = row.warp;
  options.warp.objective = row.objective;
  options.split.scheme = row.split;
  PlanHistory history;
  ShadowPlan plan;
  std::uint64_t checksum = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const Camera camera = walking(c.camera, frame);
    row.cold.push_back(timed([&] { plan = make_plan(camera, c.light, c.bounds(), options); }));
    if (plan.map_count > 0) checksum += bits_of(plan.map[0].clip_from_world[0][0]);
    row.warm.push_back(timed([&] { plan = make_plan(camera, c.light, c.bounds(), options, &history); }));
    if (plan.map_count > 0) checksum += bits_of(plan.map[0].clip_from_world[0][0]);
  }
  return checksum;
}

/// Of the fastest 99 %: the rest met another program.
double mean(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.resize(values.size() - values.size() / 100);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(2, std::atoi(argv[1])) : 600;
  const std::vector<NamedCase> cases = load_cases();
  std::vector<Row> table = rows();
  std::uint64_t checksum = 0;
  for (const NamedCase& c : cases) {
    for (Row& row : table) checksum += walk(c, frames, row);
  }
  std::printf("%d frames of each of %zu cases; ns of a plan\n", frames, cases.size());
  std::printf("%4s %-36s %10s %10s %10s %10s %10s %10s\n", "maps", "warp", "cold mean", "median",
              "history mean", "median", "mean ratio", "median r.");
  for (const Row& row : table) {
    const std::string name =
        std::string(row.warp->name) +
        (row.warp == &warps::none ? "" : " by " + std::string(to_string(row.objective))) +
        (row.split == SplitScheme::optimal ? ", optimal splits" : "");
    const double cold = median(row.cold), warm = median(row.warm);
    std::printf("%4d %-36s %10.0f %10.0f %12.0f %10.0f %10.2f %10.2f\n", row.cascades, name.c_str(),
                mean(row.cold), cold, mean(row.warm), warm, mean(row.warm) / mean(row.cold), warm / cold);
  }
  std::printf("checksum %016llx\n", static_cast<unsigned long long>(checksum));
  return 0;
}
