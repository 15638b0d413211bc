// How long does a plan take by the number of boxes, given as a list and as a CasterSet? And measuring it?
// A city on a plain two kilometres wide, as casters and receivers, seen by a walker down to 500 m. Counters:
// `checksum`, the sum of the maps' matrices, is the same for both; `maps`.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace {

using namespace gnomon;

struct City {
  std::vector<Box> boxes;
  std::vector<CasterBlock> blocks;
  std::vector<std::uint32_t> indices;
  CasterSet set;
  Camera camera =
      perspective_camera({0, 1.7, 0}, {0.3, -0.05, -1}, {0, 1, 0}, 1.0, 16.0 / 9.0, 0.1, 500.0, 1920, 1080);

  explicit City(std::size_t count) {
    std::mt19937_64 engine(7);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    boxes.push_back({{-1000, -1, -1000}, {1000, 0, 1000}});
    while (boxes.size() < count) {
      // Few boxes stand where they are seen.
      const double reach = count < 1000 ? 200 : 1000;
      const glm::dvec3 foot{between(-reach, reach), 0.0, between(-reach, reach)};
      const glm::dvec3 half{between(0.2, 4.0), between(0.2, 10.0), between(0.2, 4.0)};
      boxes.push_back({foot - half * glm::dvec3(1, 0, 1), foot + half});
    }
    blocks.resize(CasterSet::block_count(count));
    indices.resize(CasterSet::index_count(count));
    set = CasterSet(boxes, blocks, indices);
  }
  [[nodiscard]] SceneBounds bounds(bool as_set) const {
    return as_set ? SceneBounds{set, set} : SceneBounds{boxes, boxes};
  }
};

City& city(std::int64_t count) {
  static std::map<std::int64_t, City> cities;
  return cities.try_emplace(count, static_cast<std::size_t>(count)).first->second;
}

double checksum(const ShadowPlan& plan) {
  double sum = 0.0;
  for (const ShadowMap& map : plan.maps()) {
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 4; ++k) sum += map.clip_from_world[i][k];
    }
  }
  return sum;
}

const Light kSun = DirectionalLight{{0.4, -1.0, 0.3}};
const Light kStreetLight = SpotLight{{5, 9, -12}, {0.1, -1, -0.4}, 0.7, 40.0};

struct Run {
  const char* name;
  const Light* light;
  int cascades;
  const Warp* warp;
};

void plan_city(benchmark::State& state, const Run& run, bool as_set) {
  const City& c = city(state.range(0));
  PlanOptions options;
  options.cascades = run.cascades;
  options.warp.warp = run.warp;
  ShadowPlan plan;
  for (auto _ : state) {
    plan = make_plan(c.camera, *run.light, c.bounds(as_set), options);
    benchmark::DoNotOptimize(plan);
  }
  state.counters["maps"] = plan.map_count;
  state.counters["checksum"] = checksum(plan);
}

void measure_city(benchmark::State& state, bool as_set) {
  const City& c = city(state.range(0));
  const ShadowPlan plan = make_plan(c.camera, kSun, c.bounds(true), {});
  AliasingStats stats;
  for (auto _ : state) stats = measure(plan, c.camera, c.bounds(as_set));
  state.counters["samples"] = static_cast<double>(stats.samples);
  state.counters["checksum"] = stats.mean;
}

// List and set in turn at each size: what else the machine does meets both.
[[maybe_unused]] const bool registered = [] {
  static const Run kRuns[] = {{"one_map", &kSun, 1, &warps::none},
                              {"four_maps", &kSun, 4, &warps::none},
                              {"four_optimal_maps", &kSun, 4, &warps::optimal},
                              {"spot_light", &kStreetLight, 1, &warps::none}};
  for (const std::int64_t count : {1, 2, 8, 10, 64, 100, 1'000, 10'000, 100'000, 1'000'000}) {
    for (const bool as_set : {false, true}) {
      const char* form = as_set ? "/set" : "/list";
      for (const Run& run : kRuns) {
        benchmark::RegisterBenchmark((run.name + std::string(form)).c_str(),
                                     [&run, as_set](benchmark::State& s) { plan_city(s, run, as_set); })
            ->Arg(count)
            ->ArgName("boxes")
            ->Unit(benchmark::kMicrosecond);
      }
      benchmark::RegisterBenchmark(("measure" + std::string(form)).c_str(),
                                   [as_set](benchmark::State& s) { measure_city(s, as_set); })
          ->Arg(count)
          ->ArgName("boxes")
          ->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
