// How many points a second does the metric judge, on one core? Point by point, in batches, and as measure()
// over a plan. Counters: `checksum`, the sum of what came out, the same for a point alone and in a batch.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "gnomon/measure.hpp"

namespace {

using namespace gnomon;

/// A plain seen by a walker, one warped map, points on and above the plain.
struct Meadow {
  Camera camera =
      perspective_camera({0, 1.7, 0}, {0.3, -0.05, -1}, {0, 1, 0}, 1.0, 16.0 / 9.0, 0.1, 500.0, 1920, 1080);
  Box box{{-300, 0, -300}, {300, 20, 300}};
  SceneBounds bounds{{&box, 1}, {&box, 1}};
  std::vector<glm::dvec3> points, normals;
  std::vector<PointAliasing> out;

  Meadow() {
    constexpr std::size_t kPoints = 4096;  // with their results in the second-level cache
    std::mt19937_64 engine(7);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    const CameraAxes axes = camera_axes(camera);
    while (points.size() < kPoints) {
      const double depth = std::exp(between(std::log(1.0), std::log(300.0)));
      const glm::dvec3 p =
          camera.position +
          (axes.forward + axes.right * between(-0.9, 0.9) + axes.up * between(-0.5, 0.5)) * depth;
      if (p.y < 0.0 || p.y > 20.0) continue;
      points.push_back(p);
      normals.push_back({0.0, 1.0, 0.0});
    }
    out.resize(kPoints);
  }
  [[nodiscard]] ShadowPlan plan(int cascades, const Light& light) const {
    PlanOptions o;
    o.cascades = cascades;
    return make_plan(camera, light, bounds, o);
  }
};

const DirectionalLight kSun{{0.4, -1.0, 0.3}};

double sum_of(const std::vector<PointAliasing>& all) {
  double sum = 0.0;
  for (const PointAliasing& one : all)
    if (one.status == PointAliasing::Status::ok) sum += one.m_max;
  return sum;
}

template <typename Measure>
void judge_points(benchmark::State& state, Measure&& judge) {
  Meadow meadow;
  const ShadowPlan plan = meadow.plan(1, kSun);
  for (auto _ : state) {
    judge(meadow, plan.map[0]);
    benchmark::DoNotOptimize(meadow.out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * meadow.points.size()));
  state.counters["checksum"] = sum_of(meadow.out);
}

void one_point(benchmark::State& state) {
  judge_points(state, [](Meadow& m, const ShadowMap& map) {
    for (std::size_t i = 0; i < m.points.size(); ++i)
      m.out[i] = measure_point(map, m.camera, m.points[i], m.normals[i]);
  });
}
void one_perspective(benchmark::State& state) {
  judge_points(state, [](Meadow& m, const ShadowMap& map) {
    for (std::size_t i = 0; i < m.points.size(); ++i)
      m.out[i] = measure_perspective(map, m.camera, m.points[i]);
  });
}
void many_points(benchmark::State& state) {
  judge_points(state, [](Meadow& m, const ShadowMap& map) {
    measure_points(map, m.camera, m.points, m.normals, m.out);
  });
}
void many_perspectives(benchmark::State& state) {
  judge_points(state,
               [](Meadow& m, const ShadowMap& map) { measure_perspectives(map, m.camera, m.points, m.out); });
}

void whole_plan(benchmark::State& state) {
  const Meadow meadow;
  const ShadowPlan plan = meadow.plan(static_cast<int>(state.range(0)), kSun);
  AliasingStats stats;
  for (auto _ : state) {
    stats = measure(plan, meadow.camera, meadow.bounds);
    benchmark::DoNotOptimize(stats);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * (stats.samples + stats.outside)));
  state.counters["checksum"] = stats.p50 + stats.p95 + stats.max + stats.storage;
}

BENCHMARK(one_point)->Name("measure_point, one by one");
BENCHMARK(one_perspective)->Name("measure_perspective, one by one");
BENCHMARK(many_points)->Name("measure_points");
BENCHMARK(many_perspectives)->Name("measure_perspectives");
BENCHMARK(whole_plan)->Name("measure")->ArgName("maps")->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond);

}  // namespace
