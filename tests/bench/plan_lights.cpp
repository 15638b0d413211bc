// The cost of a plan of many lights, and the gain of its sizes over other rules.
//
//     bench_plan_lights            both
//     bench_plan_lights --seconds  the times alone
//
// Times stand beside one make_plan per light in the same run. Errors are measured at what the camera sees:
// the mean of m over the lit points of a grid of first hits, summed over the lights by their share of the
// picture.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "allocations.hpp"
#include "gnomon/gnomon.hpp"
#include "median.hpp"
#include "support/seeded_input.hpp"

namespace gnomon {
namespace {

using test::SeededNumbers;
using Clock = std::chrono::steady_clock;

/// A town: a ground, blocks on it, lights between them, a sun, and a camera.
struct Town {
  const char* name;
  std::vector<Box> boxes;
  std::vector<CasterBlock> blocks;
  std::vector<std::uint32_t> indices;
  CasterSet set;
  std::vector<LightRequest> lights;
  Camera camera;

  /// `extent`: half the side of the ground, world units.
  Town(const char* title, std::uint64_t seed, double extent, int block_count, int light_count, double eye)
      : name(title) {
    SeededNumbers random(seed);
    boxes.push_back({{-extent, -1, -extent}, {extent, 0, extent}});
    for (int i = 0; i < block_count; ++i) {
      const glm::dvec3 at{random.between(-extent, extent), 0.0, random.between(-extent, extent)};
      boxes.push_back(
          {at, at + glm::dvec3(random.between(1, 5), random.between(1, 10), random.between(1, 5))});
    }
    blocks.resize(CasterSet::block_count(boxes.size()));
    indices.resize(CasterSet::index_count(boxes.size()));
    set = CasterSet(boxes, blocks, indices);
    for (int i = 0; i < light_count; ++i) {
      const glm::dvec3 at{random.between(-extent, extent), random.between(2, 9),
                          random.between(-extent, extent)};
      if (i % 2 == 0) {
        lights.push_back({PointLight{at, random.between(4, 20)}});
      } else {
        const glm::dvec3 down{random.between(-1, 1), -1.0, random.between(-1, 1)};
        lights.push_back({SpotLight{at, down, random.between(0.3, 0.9), random.between(8, 25)}});
      }
    }
    lights.push_back({DirectionalLight{{0.3, -1.0, 0.2}}});
    camera = perspective_camera({0, eye, 0.8 * extent}, {0.1, -0.1, -1}, {0, 1, 0}, 1.0, 16.0 / 9.0, 0.1,
                                4.0 * extent, 1920, 1080);
  }
  Town(const Town&) = delete;
  Town& operator=(const Town&) = delete;

  [[nodiscard]] SceneBounds bounds() const { return {set, set}; }
  /// Where rays through the middles of a grid of parts of the image first hit a box.
  [[nodiscard]] std::vector<glm::dvec3> first_hits(int columns, int rows) const {
    std::vector<glm::dvec3> hits;
    const CameraAxes axes = camera_axes(camera);
    for (int i = 0; i < columns * rows; ++i) {
      const double x = camera.left + (camera.right - camera.left) * (i % columns + 0.5) / columns;
      const double y = camera.bottom + (camera.top - camera.bottom) * (i / columns + 0.5) / rows;
      const glm::dvec3 ray = axes.forward + axes.right * x + axes.up * y;
      double nearest = camera.far_depth;
      for (const Box& box : boxes) {
        double begin = camera.near_depth, end = nearest;
        for (int axis = 0; axis < 3; ++axis) {
          const double a = (box.min[axis] - camera.position[axis]) / ray[axis];
          const double b = (box.max[axis] - camera.position[axis]) / ray[axis];
          begin = std::max(begin, std::min(a, b));
          end = std::min(end, std::max(a, b));
        }
        if (begin <= end) nearest = begin;
      }
      if (nearest < camera.far_depth) hits.push_back(camera.position + ray * nearest);
    }
    return hits;
  }
};

double microseconds(Clock::time_point from) {
  return std::chrono::duration<double, std::micro>(Clock::now() - from).count();
}

struct Cost {
  double best, middle;
  std::uint64_t allocations;
};
template <typename Work>
Cost cost_of(int repeats, Work&& work) {
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(repeats));
  work();
  const std::uint64_t before = tool::allocation_count();
  for (int i = 0; i < repeats; ++i) {
    const Clock::time_point from = Clock::now();
    work();
    times.push_back(microseconds(from));
  }
  const std::uint64_t allocated = tool::allocation_count() - before;
  return {*std::min_element(times.begin(), times.end()), median(times), allocated};
}
void print(const char* name, const Cost& cost, double beside) {
  std::printf("  %-44s best %8.0f us, median %8.0f us, %llu allocations", name, cost.best, cost.middle,
              static_cast<unsigned long long>(cost.allocations));
  if (beside > 0.0) std::printf(", 1 / %.1f of the plans", beside / cost.best);
  std::printf("\n");
}

void print_times(const Town& town) {
  std::vector<std::byte> memory(light_memory(town.lights.size(), 4096));
  const std::vector<glm::dvec3> points = town.first_hits(40, 25);
  PlanOptions unwarped;
  unwarped.warp.warp = &warps::none;
  std::printf("%s: %zu lights, %zu boxes, %zu visible points\n", town.name, town.lights.size(),
              town.boxes.size(), points.size());
  int maps = 0;
  const auto plan_each = [&](const PlanOptions& options) {
    for (const LightRequest& request : town.lights)
      maps += make_plan(town.camera, request.light, town.bounds(), options).map_count;
  };
  const Cost plain = cost_of(15, [&] { plan_each(unwarped); });
  print("one make_plan per light, no warp", plain, 0.0);
  print("one make_plan per light, default options", cost_of(15, [&] { plan_each({}); }), 0.0);
  double sum = 0.0;
  const auto plan = [&](const SceneBounds& bounds, std::span<const glm::dvec3> seen, LightHistory* history) {
    const LightPlan all =
        plan_lights({.camera = town.camera, .points_world = seen}, town.lights, bounds, {}, memory, history);
    sum += all.error;
    return all;
  };
  print("plan_lights, boxes in a set", cost_of(101, [&] { plan(town.bounds(), {}, nullptr); }), plain.best);
  print("plan_lights, boxes in a list",
        cost_of(101,
                [&] {
                  plan({town.boxes, town.boxes}, {}, nullptr);
                }),
        plain.best);
  print("plan_lights, set and visible points", cost_of(101, [&] { plan(town.bounds(), points, nullptr); }),
        plain.best);
  std::vector<LightState> states(town.lights.size());
  LightHistory history{states, 0, {}};
  print("plan_lights, set and history", cost_of(101, [&] { plan(town.bounds(), {}, &history); }), plain.best);
  double due = 0.0, texels = 0.0, all_texels = 0.0, mapped = 0.0;
  constexpr int kFrames = 64;
  for (int i = 0; i < kFrames; ++i) {
    const LightPlan frame = plan(town.bounds(), {}, &history);
    due += frame.due;
    texels += static_cast<double>(frame.due_texels);
    all_texels += static_cast<double>(frame.texels);
    mapped += frame.mapped;
  }
  std::printf("  due in a frame: %.1f of %.1f lights, %.0f %% of the texels (checksum %.6g, %d)\n",
              due / kFrames, mapped / kFrames, 100.0 * texels / all_texels, sum, maps);
}

constexpr int kMaxSize = 2048;

/// Measured needs of one light's maps.
struct Measured {
  double weight;  // share of the picture times texels for a mean m of 1
  int maps;
  double coverage;  // radius of its range in the image, in image heights
};
double error_at(const std::vector<Measured>& lights, const std::vector<int>& sizes) {
  double sum = 0.0;
  for (std::size_t i = 0; i < lights.size(); ++i) sum += lights[i].weight / (sizes[i] - 2.0);
  return sum;
}
double texels_at(const std::vector<Measured>& lights, const std::vector<int>& sizes) {
  double sum = 0.0;
  for (std::size_t i = 0; i < lights.size(); ++i) sum += double(sizes[i]) * sizes[i] * lights[i].maps;
  return sum;
}
/// The largest sizes `size(light, factor)` that fit.
template <typename Size>
std::vector<int> largest_that_fit(const std::vector<Measured>& lights, double budget, Size&& size) {
  std::vector<int> sizes(lights.size());
  const auto at = [&](double factor) {
    for (std::size_t i = 0; i < lights.size(); ++i) sizes[i] = size(lights[i], factor);
    return texels_at(lights, sizes) <= budget;
  };
  double fits = 1e-6, too_large = 1e9;
  for (int i = 0; i < 100; ++i) {
    const double middle = std::sqrt(fits * too_large);
    (at(middle) ? fits : too_large) = middle;
  }
  at(fits);
  return sizes;
}

double range_of(const Light& light) {
  if (const auto* spot = std::get_if<SpotLight>(&light)) return spot->range;
  const auto* point = std::get_if<PointLight>(&light);
  return point != nullptr ? point->range : std::numeric_limits<double>::infinity();
}
glm::dvec3 position_of(const Light& light) {
  if (const auto* spot = std::get_if<SpotLight>(&light)) return spot->position;
  const auto* point = std::get_if<PointLight>(&light);
  return point != nullptr ? point->position : glm::dvec3(0.0);
}
bool in_range(const Light& light, const glm::dvec3& p) {
  const glm::dvec3 offset = p - position_of(light);
  if (!(glm::length(offset) <= range_of(light))) return false;
  const auto* spot = std::get_if<SpotLight>(&light);
  return spot == nullptr || glm::dot(offset, glm::normalize(spot->direction)) >=
                                std::cos(spot->outer_radians) * glm::length(offset);
}

std::vector<Measured> measured(const Town& town, const LightPlan& plan, const std::vector<glm::dvec3>& hits) {
  std::vector<Measured> lights;
  std::vector<glm::dvec3> lit;
  for (std::size_t i = 0; i < town.lights.size(); ++i) {
    if (plan.lights[i].map_count == 0) continue;
    const Light& light = town.lights[i].light;
    lit.clear();
    for (const glm::dvec3& hit : hits) {
      if (std::holds_alternative<DirectionalLight>(light) || in_range(light, hit)) lit.push_back(hit);
    }
    PlanOptions options;
    options.resolution.max_size = 256;
    options.warp.warp = &warps::none;
    const bool follows = plan.lights[i].frames == 1;
    const ShadowPlan own =
        make_plan(follows ? town.camera : camera_round(light, town.camera), light, town.bounds(), options);
    const AliasingStats stats = measure(own, {.camera = town.camera, .points_world = lit}, {});
    const double share = static_cast<double>(stats.samples) / static_cast<double>(hits.size());
    const double distance = glm::distance(position_of(light), town.camera.position);
    const double coverage = range_of(light) < distance ? range_of(light) / distance : 1.0;
    lights.push_back({stats.samples > 0 && std::isfinite(stats.mean) ? share * stats.mean * 254.0 : 0.0,
                      plan.lights[i].map_count, coverage});
  }
  return lights;
}

int rounded(double side, bool powers) {
  const double size = std::clamp(side, 64.0, 1.0 * kMaxSize);
  return powers ? 1 << static_cast<int>(std::floor(std::log2(size) + 1e-9))
                : static_cast<int>(size / 16.0) * 16;
}

void print_quality(const Town& town) {
  const std::vector<glm::dvec3> hits = town.first_hits(192, 108), some = town.first_hits(40, 25);
  std::vector<std::byte> memory(light_memory(town.lights.size(), some.size())), other = memory;
  std::printf(
      "%s: error measured at %zu points, over that of sizes by visible points\n  %-10s %8s %8s %8s %8s %8s "
      "%8s\n",
      town.name, hits.size(), "budget", "points", "boxes", "equal", "equal 16", "cover", "cover 16");
  for (const int pool : {2048, 4096, 8192}) {
    LightOptions options;
    options.pool_width = options.pool_height = pool;
    options.most_size = kMaxSize;
    const LightPlan by_points = plan_lights({.camera = town.camera, .points_world = some}, town.lights,
                                            town.bounds(), options, memory);
    const LightPlan by_boxes = plan_lights(town.camera, town.lights, town.bounds(), options, other);
    if (by_points.status != PlanStatus::ok) continue;
    // Places of maps, and so texels, are those of the first plan.
    const std::vector<Measured> lights = measured(town, by_points, hits);
    std::vector<int> points, boxes;
    for (std::size_t i = 0; i < town.lights.size(); ++i) {
      if (by_points.lights[i].map_count == 0) continue;
      points.push_back(by_points.lights[i].size);
      boxes.push_back(by_boxes.lights[i].size);
    }
    const double budget = static_cast<double>(pool) * pool, best = error_at(lights, points);
    const auto error = [&](bool powers, bool coverage) {
      return error_at(lights, largest_that_fit(lights, budget, [&](const Measured& light, double factor) {
                        return rounded(factor * (coverage ? light.coverage : 1.0), powers);
                      }));
    };
    std::printf("  %5d^2     %8.3f %8.2f %8.2f %8.2f %8.2f %8.2f\n", pool, best,
                error_at(lights, boxes) / best, error(true, false) / best, error(false, false) / best,
                error(true, true) / best, error(false, true) / best);
  }
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  const bool seconds = argc > 1 && std::strcmp(argv[1], "--seconds") == 0;
  const gnomon::Town town("town", 1, 100.0, 200, 256, 6.0), hall("hall", 2, 30.0, 60, 64, 2.0),
      plain("plain", 3, 300.0, 800, 256, 20.0);
  for (const gnomon::Town* scene : {&town, &hall, &plain}) gnomon::print_times(*scene);
  if (seconds) return 0;
  for (const gnomon::Town* scene : {&town, &hall, &plain}) gnomon::print_quality(*scene);
  return 0;
}
