// How still do the texels stand while the camera flies? Drift of the grid and jumps of texel density from
// frame to frame, for every fit, over the flights of the built-in scenes: the drift table of the README.
// Drift is counted to the nearest whole texel: a grid that moved by a whole number of texels shows the same
// edges, and one that moves at random drifts by 0.38 in the mean. m: screen pixels per texel, geometric mean
// over frames.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"

namespace {

using gnomon::Camera;
using gnomon::ShadowMap;
using gnomon::ShadowPlan;

constexpr int kWidth = 960, kHeight = 540;
constexpr int kMeasuredEvery = 20;                                   // frames, for the error
constexpr int kPointsAcross = 12, kPointsDown = 8, kPointsDeep = 6;  // sampled of every frame's view

struct Technique {
  const char* name;
  gnomon::Fit fit;
  const gnomon::Warp* warp;
  bool history;
};
const std::array kTechniques = {
    Technique{"tight, no warp", gnomon::Fit::tight, &gnomon::warps::none, false},
    Technique{"tight, no warp, history", gnomon::Fit::tight, &gnomon::warps::none, true},
    Technique{"stable", gnomon::Fit::stable, &gnomon::warps::none, false},
    Technique{"warped", gnomon::Fit::tight, nullptr, false},
    Technique{"warped, history", gnomon::Fit::tight, nullptr, true},
    Technique{"warped-stable", gnomon::Fit::warped_stable, nullptr, true},
};

/// What a technique did over a flight.
struct Tally {
  std::vector<double> drift;  // texels per frame and point, of the grid
  std::int64_t pairs = 0, moved = 0, jumps = 0, unlisted = 0;
  double worst_unlisted = 1.0;
  std::int64_t maps = 0, events = 0;
  double log_p95 = 0.0;
  int measured = 0;
};

glm::dvec2 texel_of(const ShadowMap& map, const glm::dvec3& p) {
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
  return {0.5 * map.width * clip.x / clip.w, 0.5 * map.height * clip.y / clip.w};
}

/// Texels per world area across the light.
double density(const ShadowMap& map, const ShadowPlan& plan, const glm::dvec3& p) {
  const glm::dmat4& m = map.clip_from_world;
  const glm::dvec4 clip = m * glm::dvec4(p, 1.0);
  std::array<glm::dvec3, 2> gradient;
  for (int axis = 0; axis < 2; ++axis) {
    for (int column = 0; column < 3; ++column)
      gradient[static_cast<std::size_t>(axis)][column] =
          (m[column][axis] - clip[axis] / clip.w * m[column].w) / clip.w;
  }
  return std::abs(glm::dot(glm::cross(gradient[0], gradient[1]), plan.light_direction)) * 0.25 * map.width *
         map.height;
}

std::vector<glm::dvec3> points_in_view(const Camera& camera, const std::vector<gnomon::Box>& boxes) {
  std::vector<glm::dvec3> points;
  const gnomon::CameraAxes axes = gnomon::camera_axes(camera);
  for (int k = 0; k < kPointsDeep; ++k) {
    const double depth =
        camera.near_depth * std::pow(camera.far_depth / camera.near_depth, (k + 0.5) / kPointsDeep);
    for (int j = 0; j < kPointsDown; ++j) {
      for (int i = 0; i < kPointsAcross; ++i) {
        const double x = camera.left + (camera.right - camera.left) * (i + 0.5) / kPointsAcross;
        const double y = camera.bottom + (camera.top - camera.bottom) * (j + 0.5) / kPointsDown;
        const glm::dvec3 p = camera.position + (axes.forward + axes.right * x + axes.up * y) * depth;
        const bool held = std::any_of(boxes.begin(), boxes.end(), [&](const gnomon::Box& b) {
          return p.x >= b.min.x && p.x <= b.max.x && p.y >= b.min.y && p.y <= b.max.y && p.z >= b.min.z &&
                 p.z <= b.max.z;
        });
        if (held) points.push_back(p);
      }
    }
  }
  return points;
}

const ShadowMap* serving(const ShadowPlan& plan, const Camera& camera, const glm::dvec3& p) {
  const double depth = glm::dot(gnomon::camera_axes(camera).forward, p - camera.position);
  const int index = gnomon::map_serving(plan, p, depth);
  if (index < 0) return nullptr;
  const ShadowMap& map = plan.map[static_cast<std::size_t>(index)];
  return gnomon::map_holds(plan, map, p) ? &map : nullptr;
}

/// Texels that the grid moved by under a point of the world, to the nearest whole texel: what crawls.
double grid_drift(const ShadowMap& before, const ShadowMap& now, const glm::dvec3& p) {
  const glm::dvec2 step = texel_of(now, p) - texel_of(before, p);
  const double x = step.x - std::round(step.x), y = step.y - std::round(step.y);
  return std::sqrt(x * x + y * y);
}

void compare(Tally& tally, const ShadowPlan& before, const Camera& camera_before, const ShadowPlan& now,
             const Camera& camera_now, const std::vector<glm::dvec3>& points,
             const gnomon::PlanHistory& history) {
  constexpr double kStill = 1e-4;  // texels
  for (const glm::dvec3& p : points) {
    const ShadowMap* a = serving(before, camera_before, p);
    const ShadowMap* b = serving(now, camera_now, p);
    if (a == nullptr || b == nullptr || a->cascade != b->cascade) continue;
    const double drift = grid_drift(*a, *b, p);
    const double ratio = density(*b, now, p) / density(*a, before, p);
    const double step = std::max(ratio, 1.0 / ratio);
    ++tally.pairs;
    tally.moved += drift > kStill;
    tally.drift.push_back(drift);
    if (step <= 1.0 + gnomon::kDensityStep) continue;
    ++tally.jumps;
    const auto events = history.events();
    const bool listed = std::any_of(events.begin(), events.end(),
                                    [&](const gnomon::PlanEvent& e) { return e.map == b->cascade; });
    if (listed) continue;
    ++tally.unlisted;
    tally.worst_unlisted = std::max(tally.worst_unlisted, step);
  }
}

void fly(const gnomon::Scene& scene, int frames, int cascades, std::vector<Tally>& tallies) {
  std::vector<gnomon::Box> boxes;
  for (const auto& instance : scene.instances) boxes.push_back(instance.bounds_world);
  const gnomon::SceneBounds bounds{boxes, boxes};
  const gnomon::CameraPath path = gnomon::default_path(scene);
  const gnomon::Light light = gnomon::DirectionalLight{{-0.4, -1.0, -0.3}};
  struct Frame {
    gnomon::PlanHistory history;
    ShadowPlan before, now;
  };
  std::vector<Frame> state(kTechniques.size());
  Camera camera_before;
  for (int frame = 0; frame < frames; ++frame) {
    const Camera camera = path.at(static_cast<double>(frame) / frames, kWidth, kHeight);
    const std::vector<glm::dvec3> points = points_in_view(camera, boxes);
    for (std::size_t t = 0; t < kTechniques.size(); ++t) {
      Frame& f = state[t];
      Tally& tally = tallies[t];
      gnomon::PlanOptions options;
      options.prune = gnomon::kPruneNothing.with(gnomon::PruneRule::light_depths);  // maps of one size
      options.cascades = cascades;
      options.fit = kTechniques[t].fit;
      options.warp.warp = kTechniques[t].warp;
      f.before = f.now;
      f.now = kTechniques[t].history ? make_plan(camera, light, bounds, options, &f.history)
                                     : make_plan(camera, light, bounds, options);
      tally.maps += f.now.map_count;
      tally.events += frame > 0 ? f.history.event_count : 0;
      if (frame > 0) compare(tally, f.before, camera_before, f.now, camera, points, f.history);
      if (frame % kMeasuredEvery == 0) {
        tally.log_p95 += std::log(measure(f.now, camera, bounds).p95);
        ++tally.measured;
      }
    }
    camera_before = camera;
  }
}

double quantile(std::vector<double>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void add(Tally& all, const Tally& part) {
  all.drift.insert(all.drift.end(), part.drift.begin(), part.drift.end());
  all.pairs += part.pairs;
  all.moved += part.moved;
  all.jumps += part.jumps;
  all.unlisted += part.unlisted;
  all.worst_unlisted = std::max(all.worst_unlisted, part.worst_unlisted);
  all.maps += part.maps;
  all.events += part.events;
  all.log_p95 += part.log_p95;
  all.measured += part.measured;
}

void print(const std::string& title, std::vector<Tally>& tallies) {
  std::printf("\n%s\n", title.c_str());
  std::printf("%-26s %11s %9s %11s %11s %9s %11s %9s %17s\n", "fit", "mean drift", "median", "grid moved",
              "jumps > 5%", "unlisted", "worst unl.", "m p95", "events of maps");
  for (std::size_t t = 0; t < kTechniques.size(); ++t) {
    Tally& tally = tallies[t];
    double sum = 0.0;
    for (const double d : tally.drift) sum += d;
    const double pairs = std::max<double>(1.0, static_cast<double>(tally.pairs));
    std::printf("%-26s %11.4f %9.4f %10.1f%% %10.3f%% %9lld %11.3f %9.3f %8lld %8lld\n", kTechniques[t].name,
                sum / pairs, quantile(tally.drift, 0.5), 100.0 * static_cast<double>(tally.moved) / pairs,
                100.0 * static_cast<double>(tally.jumps) / pairs, static_cast<long long>(tally.unlisted),
                tally.worst_unlisted, std::exp(tally.log_p95 / tally.measured),
                static_cast<long long>(tally.events), static_cast<long long>(tally.maps));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(2, std::atoi(argv[1])) : 600;
  for (const int cascades : {1, 4}) {
    const std::string of = ", " + std::to_string(cascades) + (cascades == 1 ? " map, " : " maps, ") +
                           std::to_string(frames) + " frames of the default flight";
    std::vector<Tally> all(kTechniques.size());
    for (const gnomon::BuiltinScene& builtin : gnomon::builtin_scenes()) {
      std::vector<Tally> tallies(kTechniques.size());
      fly(gnomon::load_builtin(builtin.name), frames, cascades, tallies);
      print(std::string(builtin.name) + of, tallies);
      for (std::size_t t = 0; t < kTechniques.size(); ++t) add(all[t], tallies[t]);
    }
    print("all scenes" + of, all);
  }
  return 0;
}
