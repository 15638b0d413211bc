// What does a call of C cost on top of the plan of C++ that it makes? Both in one process, in turns.
//   bench_c_overhead [ROUNDS]
// Each round times some calls of one, then of the other; a row has the least time of each per call, and the
// median of the rounds' differences. Plans without maps copy nothing; the others copy their maps into the
// caller's memory.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "gnomon/c/gnomon.h"
#include "gnomon/gnomon.hpp"
#include "in_c.hpp"

namespace {

using namespace gnomon;

template <typename Call>
double nanoseconds(int calls, Call&& call) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < calls; ++i) call();
  const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
  return took.count() / calls;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

struct Row {
  const char* name;
  int calls;  // of each side in a round: some microseconds, so that few rounds are interrupted
  Camera camera;
  DirectionalLight sun;
  PlanOptions options;
  std::vector<Box> casters, receivers;
};

void run(const Row& row, int rounds) {
  const SceneBounds bounds{row.casters, row.receivers};
  const test::InputInC in(row.camera, row.sun, row.casters, row.receivers, row.options);
  test::PlanInC found;
  double sum = 0.0, least = 1e300, least_in_c = 1e300, least_copy = 1e300;
  std::vector<double> differences;
  gnomon_map copies[GNOMON_MAX_MAPS];
  for (int i = 0; i < rounds; ++i) {
    const double cpp = nanoseconds(row.calls, [&] {
      const ShadowPlan plan = make_plan(row.camera, row.sun, bounds, row.options);
      sum += plan.map_count + plan.map[0].clip_from_world[0][0];
    });
    const double c = nanoseconds(row.calls, [&] {
      gnomon_make_plan(&in.view, &in.light, &in.scene, &in.options, nullptr, &found.plan, nullptr);
      sum += found.plan.map_count + found.maps[0].clip_from_world[0];
    });
    const double copy = nanoseconds(row.calls, [&] {
      std::copy(found.maps, found.maps + found.plan.map_count, copies);
      sum += copies[0].clip_from_world[i % 16];
    });
    least = std::min(least, cpp);
    least_in_c = std::min(least_in_c, c);
    least_copy = std::min(least_copy, copy);
    differences.push_back(c - cpp);
  }
  std::printf("%-28s %4d %10.0f %10.0f %10.0f %10.0f %10.0f   %g\n", row.name, found.plan.map_count, least,
              least_in_c, least_in_c - least, median(differences), least_copy, sum);
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 2000;
  const Camera camera =
      perspective_camera({0, 3, 10}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.2, 250.0, 960, 640);
  const DirectionalLight sun{{0.4, -1, 0.3}};
  const std::vector<Box> street{{{-40, -1, -200}, {40, 0, 20}}, {{-4, 0, -30}, {4, 6, -26}}};
  const std::vector<Box> behind{{{-40, -1, 100}, {40, 0, 200}}};
  PlanOptions refused, one, four;
  refused.cascades = 0;
  one.cascades = 1;
  one.warp.warp = four.warp.warp = &warps::none;
  std::printf("%-28s %4s %10s %10s %10s %10s %10s   sum\n", "nanoseconds a call", "maps", "C++", "C", "least",
              "median", "memcpy");
  run({"refused", 64, camera, sun, refused, street, street}, rounds);
  run({"nothing visible", 64, camera, sun, one, behind, behind}, rounds);
  run({"no caster", 64, camera, sun, one, {}, street}, rounds);
  run({"one map, no warp", 8, camera, sun, one, street, street}, rounds);
  run({"four maps, no warp", 4, camera, sun, four, street, street}, rounds);
}
