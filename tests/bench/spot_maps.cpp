// What does it gain that a spot under a budget of texels has one map or a cube's faces by what the view
// shows?
//
//     bench_spot_maps [VIEWS [SCENE...]]       60 views of each built-in scene where nothing is said
//
// Seeded views along each scene's flight, and in each a spot of 40 to 75 degrees to each side that lights
// what is seen. The angle alone decides with a history, whose first frame has nothing to be steady for. Both
// plans are drawn with filter `hard` and compared with exact rays, where the choice differs.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "gnomon/gnomon.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/reference.hpp"
#include "guarded.hpp"
#include "median.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

constexpr int kWidth = 480, kHeight = 270, kPointStep = 32;
constexpr double kDegree = std::numbers::pi / 180.0;

glm::dvec3 any_direction(Random& random) {
  return {random.between(-1.0, 1.0), random.between(-1.0, 0.3), random.between(-1.0, 1.0)};
}

template <class Work>
double milliseconds(Work&& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// Sums over the views of a scene where the choices differ.
struct Sums {
  int views = 0, others = 0, better = 0, worse = 0;
  double wrong_by_view = 0.0, wrong_by_angle = 0.0, pixels = 0.0;
  std::vector<double> times{};  ///< of a plan by the view, over one by the angle
};

class Views {
 public:
  explicit Views(const std::string& name)
      : scene_(load_scene(name)), path_(default_path(scene_)), tracer_(scene_), renderer_(scene_) {
    for (const Instance& instance : scene_.instances) boxes_.push_back(instance.bounds_world);
    render::set_margin(render::default_settings(render::filters::hard), options_);
    options_.resolution.texel_budget = 1 << 20;
  }

  void add(Random& random, Sums& sums) {
    const Camera camera = path_.at(random.unit(), kWidth, kHeight);
    const render::PreparedFilter hard = renderer_.prepare(render::filters::hard);
    renderer_.draw(ShadowPlan{}, camera, hard, quiet());
    const FloatImage positions = renderer_.positions(), normals = renderer_.normals();
    std::vector<glm::dvec3> seen;
    for (int y = kPointStep / 2; y < kHeight; y += kPointStep) {
      for (int x = kPointStep / 2; x < kWidth; x += kPointStep) {
        const std::size_t i = 4 * (static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x));
        if (!(normals.values[i + 3] > 0.0f)) continue;
        seen.push_back(camera.position +
                       glm::dvec3(positions.values[i], positions.values[i + 1], positions.values[i + 2]));
      }
    }
    if (seen.empty()) return;
    const glm::dvec3 target = seen[static_cast<std::size_t>(random.pick(static_cast<int>(seen.size())))];
    const double diagonal = glm::length(scene_.bounds_world.max - scene_.bounds_world.min);
    const double distance = diagonal * std::exp(random.between(std::log(0.01), std::log(0.2)));
    const glm::dvec3 towards = glm::normalize(any_direction(random));
    const SpotLight spot{target - towards * distance, towards + 0.5 * any_direction(random),
                         random.between(40.0, 75.0) * kDegree, distance * random.between(1.5, 6.0)};
    const View view{.camera = camera, .points_world = seen};
    ShadowPlan by_view;
    const auto plan_by_view = [&] { by_view = make_plan(view, spot, {boxes_, boxes_}, options_); };
    ShadowPlan by_angle;
    const auto plan_by_angle = [&] {
      PlanHistory first;
      by_angle = make_plan(view, spot, {boxes_, boxes_}, options_, &first);
    };
    // By turns, so that both meet the same load.
    double view_ms = 1e9, angle_ms = 1e9;
    for (int i = 0; i < 5; ++i) {
      view_ms = std::min(view_ms, milliseconds(plan_by_view));
      angle_ms = std::min(angle_ms, milliseconds(plan_by_angle));
    }
    if (by_view.status != PlanStatus::ok || by_angle.status != PlanStatus::ok) return;
    ++sums.views;
    sums.times.push_back(view_ms / angle_ms);
    const bool differs = by_view.map_count != by_angle.map_count ||
                         by_view.map[0].clip_from_world != by_angle.map[0].clip_from_world;
    if (!differs) return;
    ++sums.others;
    const std::vector<trace::Verdict> truth =
        trace::hard_reference(tracer_, trace::surface_points(tracer_, camera, spot, positions, normals), spot)
            .pixels;
    const auto wrong = [&](const ShadowPlan& plan) {
      renderer_.draw(plan, camera, hard, quiet());
      const FloatImage mask = renderer_.mask();
      double count = 0.0;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        if (truth[i] == trace::Verdict::lit || truth[i] == trace::Verdict::shadow)
          count += (mask.values[2 * i] > 0.5f) != (truth[i] == trace::Verdict::lit) ? 1.0 : 0.0;
      }
      return count;
    };
    const double by_view_wrong = wrong(by_view), by_angle_wrong = wrong(by_angle);
    sums.wrong_by_view += by_view_wrong;
    sums.wrong_by_angle += by_angle_wrong;
    sums.better += by_view_wrong < by_angle_wrong ? 1 : 0;
    sums.worse += by_view_wrong > by_angle_wrong ? 1 : 0;
    for (const trace::Verdict verdict : truth)
      sums.pixels += verdict == trace::Verdict::lit || verdict == trace::Verdict::shadow ? 1.0 : 0.0;
  }

 private:
  Scene scene_;
  CameraPath path_;
  trace::Tracer tracer_;
  render::Renderer renderer_;
  std::vector<Box> boxes_;
  PlanOptions options_;
};

int run_all(int argc, char** argv) {
  const int count = argc > 1 ? std::clamp(std::atoi(argv[1]), 1, 10000) : 60;
  std::vector<std::string> scenes(argv + std::min(argc, 2), argv + argc);
  if (scenes.empty())
    scenes = {"builtin:city", "builtin:fence", "builtin:hangar", "builtin:terrain", "builtin:trees"};
  const auto context = render::create_context(render::ContextKind::automatic);
  std::printf("%-24s %6s %7s %7s %6s %12s %12s %12s %8s\n", "scene", "views", "differ", "better", "worse",
              "by angle, %", "by view, %", "time, median", "longest");
  for (const std::string& name : scenes) {
    Views views(name);
    Random random(7);
    Sums sums;
    for (int i = 0; i < count; ++i) views.add(random, sums);
    const double percent = 100.0 / std::max(sums.pixels, 1.0);
    if (sums.times.empty()) sums.times.push_back(0.0);
    std::printf("%-24s %6d %7d %7d %6d %12.3f %12.3f %12.2f %8.2f\n",
                name.substr(std::max<std::size_t>(name.size(), 24) - 24).c_str(), sums.views, sums.others,
                sums.better, sums.worse, percent * sums.wrong_by_angle, percent * sums.wrong_by_view,
                median(sums.times), *std::max_element(sums.times.begin(), sums.times.end()));
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::guarded("bench_spot_maps", gnomon::run_all, argc, argv);
}
