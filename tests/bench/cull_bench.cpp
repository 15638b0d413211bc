// How long does it take to find the casters of four maps among very many boxes, one by one and by the tree?
// View 0: a walker who sees a street's length, most boxes beside it. View 1: a drone that sees half of the
// city. Counters: `drawn`, casters listed for all maps together; `checksum`, the sum of their indices, the
// same for both.
#include <benchmark/benchmark.h>

#include <map>
#include <random>
#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/plan.hpp"

namespace {

using namespace gnomon;

/// A city of boxes on a plain two kilometres wide, seen by a walker, four maps down to 500 m.
struct City {
  std::vector<Box> boxes;
  std::vector<CasterBlock> blocks;
  std::vector<std::uint32_t> indices, list;
  CasterSet set;
  ShadowPlan plan;

  City(std::size_t count, bool drone) {
    std::mt19937_64 engine(7);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 foot{between(-1000, 1000), 0.0, between(-1000, 1000)};
      const glm::dvec3 half{between(0.2, 4.0), between(0.2, 10.0), between(0.2, 4.0)};
      boxes.push_back({foot - half * glm::dvec3(1, 0, 1), foot + half});
    }
    const glm::dvec3 eye = drone ? glm::dvec3(0, 400, 900) : glm::dvec3(0, 1.7, 0);
    const glm::dvec3 forward = drone ? glm::dvec3(0, -0.5, -1) : glm::dvec3(0.3, -0.05, -1);
    const double far_depth = drone ? 2500.0 : 500.0;
    const Camera camera =
        perspective_camera(eye, forward, {0, 1, 0}, 1.0, 16.0 / 9.0, 0.1, far_depth, 1920, 1080);
    const Box ground{{-1000, -1, -1000}, {1000, 0, 1000}};
    plan = make_plan(camera, DirectionalLight{{0.4, -1.0, 0.3}}, {boxes, {&ground, 1}});
    blocks.resize(CasterSet::block_count(count));
    indices.resize(CasterSet::index_count(count));
    list.resize(count);
    set = CasterSet(boxes, blocks, indices);
  }
};

City& city(const benchmark::State& state) {
  static std::map<std::pair<std::int64_t, std::int64_t>, City> cities;
  return cities
      .try_emplace({state.range(0), state.range(1)}, static_cast<std::size_t>(state.range(0)),
                   state.range(1) == 1)
      .first->second;
}

template <typename Cull>
void cull_all(benchmark::State& state, Cull&& cull) {
  City& c = city(state);
  std::size_t drawn = 0;
  for (auto _ : state) {
    drawn = 0;
    for (const ShadowMap& map : c.plan.maps()) drawn += cull(c, map);
    benchmark::DoNotOptimize(c.list.data());
    benchmark::ClobberMemory();
  }
  double checksum = 0.0;
  for (const ShadowMap& map : c.plan.maps()) {
    const std::size_t count = cull(c, map);
    for (std::size_t i = 0; i < count; ++i) checksum += c.list[i];
  }
  state.counters["maps"] = c.plan.map_count;
  state.counters["drawn"] = static_cast<double>(drawn);
  state.counters["checksum"] = checksum;
}

void cull_linear(benchmark::State& state) {
  cull_all(state, [](City& c, const ShadowMap& map) { return cull_casters(map, c.boxes, c.list); });
}
void cull_set(benchmark::State& state) {
  cull_all(state, [](City& c, const ShadowMap& map) { return c.set.cull(map, c.list); });
}
void build_set(benchmark::State& state) {
  City& c = city(state);
  for (auto _ : state) {
    c.set = CasterSet(c.boxes, c.blocks, c.indices);
    benchmark::ClobberMemory();
  }
  state.counters["checksum"] = static_cast<double>(c.set.cull(c.plan.map[0], c.list));
}
void refit_set(benchmark::State& state) {
  City& c = city(state);
  for (auto _ : state) {
    c.set.refit(c.boxes);
    benchmark::ClobberMemory();
  }
  state.counters["checksum"] = static_cast<double>(c.set.cull(c.plan.map[0], c.list));
}

// Linear and set in turn at each size: what else the machine does meets both.
[[maybe_unused]] const bool registered = [] {
  for (const std::int64_t count : {1'000, 10'000, 100'000, 1'000'000}) {
    for (const std::int64_t view : {0, 1}) {
      for (const auto& [name, run] :
           {std::pair{"cull_casters", &cull_linear}, std::pair{"CasterSet::cull", &cull_set}}) {
        benchmark::RegisterBenchmark(name, run)
            ->Args({count, view})
            ->ArgNames({"boxes", "view"})
            ->Unit(benchmark::kMillisecond);
      }
    }
    for (const auto& [name, run] :
         {std::pair{"CasterSet::CasterSet", &build_set}, std::pair{"CasterSet::refit", &refit_set}}) {
      benchmark::RegisterBenchmark(name, run)
          ->Args({count, 0})
          ->ArgNames({"boxes", "view"})
          ->Unit(benchmark::kMillisecond);
    }
  }
  return true;
}();

}  // namespace
