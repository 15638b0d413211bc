// Which objective serves the edges of shadows that a picture shows? For every view: the mean error across an
// edge at pixels whose exact shadow differs from a neighbour's, by rays against the scene's triangles. Views
// are three frames of each scene's flight, a low and a high sun, and three near planes: the flight's, half
// and a thousandth of the nearest surface's depth. Nothing is drawn.
//
//   bench_picture_views [--light sun|spot|point] [--one-box | --whole] [--list] SCENE...
//
// --one-box: receivers and casters are one box round the scene. --whole: boxes of instances, not of parts.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/measure.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/coarse_view.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/scene/shadow_boxes.hpp"
#include "gnomon/trace/tracer.hpp"

namespace {

using gnomon::Camera;
using gnomon::Light;
using gnomon::Objective;
using gnomon::ShadowPlan;

constexpr int kWidth = 240, kHeight = 135;
/// Views with fewer edge pixels say nothing.
constexpr std::size_t kFewestEdges = 60;
/// What a point counts that no map holds, and the most that any counts.
constexpr double kLost = 16.0;
/// Pixels from one point that a plan is given to the next.
constexpr std::size_t kPointStride = 9;

struct Surface {
  bool faces_light = false, lit = false;
  glm::dvec3 position, normal;
};

struct Options {
  gnomon::LightKind kind = gnomon::LightKind::sun;
  bool one_box = false, whole = false, list = false;
};

struct LoadedScene {
  gnomon::Scene scene;
  gnomon::ShadowBoxes boxes;
  std::vector<gnomon::Box> coarser;  ///< where they are asked for
  [[nodiscard]] gnomon::SceneBounds bounds() const {
    return coarser.empty() ? boxes.bounds() : gnomon::SceneBounds{coarser, coarser};
  }
};

struct SeenView {
  std::string name;
  const LoadedScene* scene;
  Camera camera;
  Light light;
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<glm::dvec3> points;                        // that face the light
  std::vector<std::pair<glm::dvec3, glm::dvec3>> edges;  // positions and normals
};

/// The ray from a surface to the light; `t` from 0 to 1 or, to a sun, without end. False where none arrives.
bool ray_to_light(const Light& light, const Surface& surface, gnomon::trace::Ray& ray) {
  ray.origin = surface.position;
  if (const auto* sun = std::get_if<gnomon::DirectionalLight>(&light)) {
    ray.direction = -glm::normalize(sun->direction);
  } else {
    const auto* spot = std::get_if<gnomon::SpotLight>(&light);
    const auto* point = std::get_if<gnomon::PointLight>(&light);
    ray.direction = (spot != nullptr ? spot->position : point->position) - surface.position;
    ray.end = 1.0 - 1e-9;
    if (glm::length(ray.direction) > (spot != nullptr ? spot->range : point->range)) return false;
    if (spot != nullptr && glm::dot(glm::normalize(-ray.direction), glm::normalize(spot->direction)) <
                               std::cos(spot->outer_radians))
      return false;
  }
  constexpr double kGrazing = 0.02;
  return glm::dot(surface.normal, ray.direction) > kGrazing * glm::length(ray.direction);
}

std::vector<Surface> trace(const gnomon::trace::Tracer& tracer, SeenView& view) {
  const Camera& c = view.camera;
  const gnomon::CameraAxes axes = gnomon::camera_axes(c);
  const double off = std::max(4.0 * tracer.error_world(), 1e-9);
  std::vector<Surface> pixels(static_cast<std::size_t>(kWidth * kHeight));
  for (int i = 0; i < kWidth * kHeight; ++i) {
    gnomon::trace::Ray eye;
    eye.origin = c.position;
    eye.direction = axes.forward + axes.right * (c.left + (c.right - c.left) * (i % kWidth + 0.5) / kWidth) +
                    axes.up * (c.top + (c.bottom - c.top) * (i / kWidth + 0.5) / kHeight);
    eye.begin = c.near_depth;
    eye.end = c.far_depth;
    const gnomon::trace::Hit hit = tracer.first_hit(eye);
    if (hit.triangle == gnomon::trace::kNoTriangle) continue;
    Surface& s = pixels[static_cast<std::size_t>(i)];
    view.nearest = std::min(view.nearest, hit.t);
    s.position = eye.origin + eye.direction * hit.t;
    s.normal = glm::dot(hit.normal, eye.direction) > 0.0 ? -hit.normal : hit.normal;
    gnomon::trace::Ray to_light;
    to_light.except = hit.triangle;
    s.faces_light = ray_to_light(view.light, s, to_light);
    if (!s.faces_light) continue;
    to_light.begin = off / glm::length(to_light.direction);
    std::uint8_t blocked = 0;
    tracer.occluded({&to_light, 1}, {&blocked, 1});
    s.lit = blocked == 0;
  }
  return pixels;
}

/// Fills in what the view's surfaces are.
void see(const gnomon::trace::Tracer& tracer, SeenView& view) {
  const std::vector<Surface> pixels = trace(tracer, view);
  const auto differs = [&](const Surface& s, int x, int y) {
    if (x < 0 || y < 0 || x >= kWidth || y >= kHeight) return false;
    const Surface& other = pixels[static_cast<std::size_t>(y * kWidth + x)];
    return other.faces_light && other.lit != s.lit && glm::dot(other.normal, s.normal) > 0.5;
  };
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Surface& s = pixels[static_cast<std::size_t>(y * kWidth + x)];
      if (!s.faces_light) continue;
      view.points.push_back(s.position);
      if (differs(s, x + 1, y) || differs(s, x, y + 1) || differs(s, x - 1, y) || differs(s, x, y - 1))
        view.edges.emplace_back(s.position, s.normal);
    }
  }
}

/// The mean over edge pixels of a texel's extent across an edge of any direction, pixels.
double edge_error(const ShadowPlan& plan, const SeenView& view) {
  const gnomon::CameraAxes axes = gnomon::camera_axes(view.camera);
  double sum = 0.0;
  for (const auto& [position, normal] : view.edges) {
    const int map =
        gnomon::map_serving(plan, position, glm::dot(axes.forward, position - view.camera.position));
    double m = kLost;
    if (map >= 0) {
      const gnomon::PointAliasing at =
          gnomon::measure_point(plan.maps()[static_cast<std::size_t>(map)], view.camera, position, normal);
      if (at.status == gnomon::PointAliasing::Status::ok)
        m = std::min(kLost, std::sqrt(0.5 * (at.m_max * at.m_max + at.m_min * at.m_min)));
    }
    sum += m;
  }
  return sum / static_cast<double>(view.edges.size());
}

enum class Given : std::uint8_t { nothing, points, edges, coarse_depths };

struct Setting {
  const char* name;
  const gnomon::Warp* warp;
  Objective objective;
  Given given = Given::nothing;
  gnomon::SplitScheme scheme = gnomon::SplitScheme::automatic;
  bool budget = false;  ///< as many texels, shared by a budget
  [[nodiscard]] bool candidate() const { return objective != Objective::picture; }
};

std::vector<Setting> settings(int maps) {
  using gnomon::SplitScheme;
  namespace warps = gnomon::warps;
  std::vector<Setting> all = {{"storage", &warps::optimal, Objective::storage},
                              {"storage, points", &warps::optimal, Objective::storage, Given::points},
                              {"max", &warps::optimal, Objective::max},
                              {"p95", &warps::optimal, Objective::p95},
                              {"p95, points", &warps::optimal, Objective::p95, Given::points},
                              {"lispsm", &warps::lispsm, Objective::storage},
                              {"none", &warps::none, Objective::storage},
                              {"none, points", &warps::none, Objective::storage, Given::points}};
  if (maps > 1) {
    for (const Setting& split : std::initializer_list<Setting>{
             {"uniform", &warps::none, Objective::storage, Given::nothing, SplitScheme::uniform},
             {"practical", &warps::optimal, Objective::storage, Given::nothing, SplitScheme::practical},
             {"optimal splits", &warps::optimal, Objective::storage, Given::nothing, SplitScheme::optimal}})
      all.push_back(split);
  }
  for (const Setting& picture : std::initializer_list<Setting>{
           {"picture", &warps::optimal, Objective::picture},
           {"picture, budget", &warps::optimal, Objective::picture, Given::nothing,
            gnomon::SplitScheme::automatic, true},
           {"points, budget", &warps::optimal, Objective::picture, Given::points,
            gnomon::SplitScheme::automatic, true},
           {"picture, coarse", &warps::optimal, Objective::picture, Given::coarse_depths},
           {"picture, points", &warps::optimal, Objective::picture, Given::points},
           {"picture, edges", &warps::optimal, Objective::picture, Given::edges}})
    all.push_back(picture);
  return all;
}

/// A setting's plan of a view, and the least time of a few.
ShadowPlan plan_of(const Setting& setting, int maps, const SeenView& seen, double& microseconds) {
  gnomon::PlanOptions options;
  options.cascades = maps;
  options.resolution.max_size = maps == 1 ? 1024 : 512;
  if (setting.budget)
    options.resolution.texel_budget =
        std::int64_t{maps} * options.resolution.max_size * options.resolution.max_size;
  options.warp.warp = setting.warp;
  options.warp.objective = setting.objective;
  options.split.scheme = setting.scheme;
  gnomon::View view = seen.camera;
  std::vector<glm::dvec3> points;
  if (setting.given == Given::points) {
    for (std::size_t i = 0; i < seen.points.size(); i += kPointStride) points.push_back(seen.points[i]);
  } else if (setting.given == Given::edges) {
    for (const auto& edge : seen.edges) points.push_back(edge.first);
  }
  view.points_world = points;
  gnomon::VisibleDepths depths;
  if (setting.given == Given::coarse_depths) {
    depths = gnomon::CoarseView().depths(seen.scene->scene, seen.camera);
    view.depths = &depths;
  }
  ShadowPlan plan;
  microseconds = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    plan = gnomon::make_plan(view, seen.light, seen.scene->bounds(), options);
    const auto end = std::chrono::steady_clock::now();
    microseconds = std::min(microseconds, std::chrono::duration<double, std::micro>(end - begin).count());
  }
  return plan;
}

void add_views(const std::string& name, const LoadedScene& scene, const Options& options,
               std::vector<SeenView>& views) {
  const gnomon::trace::Tracer tracer(scene.scene);
  const gnomon::CameraPath path = gnomon::default_path(scene.scene);
  for (int frame = 0; frame < 3; ++frame) {
    for (const double elevation_deg : {20.0, 50.0}) {
      SeenView view;
      view.scene = &scene;
      view.camera = path.at((frame + 0.5) / 3.0, kWidth, kHeight);
      view.light = gnomon::default_light({options.kind, elevation_deg, 60.0}, scene.scene.bounds_world);
      see(tracer, view);
      if (view.edges.size() < kFewestEdges) continue;
      const std::string place = name + " frame " + std::to_string(frame) + " sun " +
                                std::to_string(static_cast<int>(elevation_deg));
      for (const double share : {0.0, 0.5, 0.001}) {
        SeenView one = view;
        if (share > 0.0) one.camera.near_depth = share * view.nearest;
        one.name = place + (share == 0.0 ? "" : share == 0.5 ? " near half" : " near thousandth");
        views.push_back(std::move(one));
      }
    }
  }
}

void print_table(int maps, const std::vector<SeenView>& views, bool list) {
  const std::vector<Setting> all = settings(maps);
  std::vector<std::vector<double>> error(views.size());
  std::vector<double> microseconds(all.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (std::size_t s = 0; s < all.size(); ++s) {
      double one = 0.0;
      error[v].push_back(edge_error(plan_of(all[s], maps, views[v], one), views[v]));
      microseconds[s] += one / static_cast<double>(views.size());
    }
  }
  std::printf("\n%d of %d^2, %zu views\n", maps, maps == 1 ? 1024 : 512, views.size());
  std::printf("%-16s %8s %9s %6s %6s %9s %6s %9s %6s %9s\n", "setting", "mean", "geo mean", "worst", "best",
              "mean loss", "worst", "to alike", "worst", "us");
  /// Loss to the best of the candidates, or of those that are given as much; -100 %: there are none.
  struct Loss {
    double sum = 0.0, worst = 0.0;
    void add(double lost) {
      sum += lost;
      worst = std::max(worst, lost);
    }
  };
  for (std::size_t s = 0; s < all.size(); ++s) {
    double mean = 0.0, logarithm = 0.0, worst = 0.0, best = 1e9;
    Loss loss, alike;
    for (std::size_t v = 0; v < views.size(); ++v) {
      double least = std::numeric_limits<double>::infinity(), least_alike = least;
      for (std::size_t other = 0; other < all.size(); ++other) {
        if (!all[other].candidate()) continue;
        least = std::min(least, error[v][other]);
        if (all[other].given == all[s].given) least_alike = std::min(least_alike, error[v][other]);
      }
      const double ratio = error[v][s] / error[v][0];
      mean += error[v][s];
      logarithm += std::log(ratio);
      worst = std::max(worst, ratio);
      best = std::min(best, ratio);
      loss.add(error[v][s] / least - 1.0);
      alike.add(error[v][s] / least_alike - 1.0);
    }
    const auto count = static_cast<double>(views.size());
    std::printf("%-16s %8.3f %9.3f %6.2f %6.2f %8.1f%% %5.0f%% %8.1f%% %5.0f%% %9.1f\n", all[s].name,
                mean / count, std::exp(logarithm / count), worst, best, 100.0 * loss.sum / count,
                100.0 * loss.worst, 100.0 * alike.sum / count, 100.0 * alike.worst, microseconds[s]);
  }
  if (!list) return;
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::printf("%-44s", views[v].name.c_str());
    for (const double e : error[v]) std::printf(" %6.3f", e);
    std::printf("\n");
  }
}

int run(int argc, char** argv) {
  Options options;
  std::vector<std::string> names;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--one-box") {
      options.one_box = true;
    } else if (word == "--whole") {
      options.whole = true;
    } else if (word == "--list") {
      options.list = true;
    } else if (word == "--light" && i + 1 < argc) {
      if (!gnomon::light_kind_from_name(argv[++i], options.kind)) {
        std::fprintf(stderr, "bench_picture_views: --light %s: wants sun, spot or point\n", argv[i]);
        return 2;
      }
    } else {
      names.emplace_back(word);
    }
  }
  if (names.empty()) {
    std::fprintf(stderr, "bench_picture_views: no scene: give builtin:NAME or glTF files\n");
    return 2;
  }
  std::vector<std::unique_ptr<LoadedScene>> scenes;
  std::vector<SeenView> views;
  for (const std::string& name : names) {
    auto& scene = *scenes.emplace_back(std::make_unique<LoadedScene>());
    scene.scene = gnomon::load_scene(name);
    scene.boxes = gnomon::ShadowBoxes(scene.scene);
    if (options.whole) scene.coarser = scene.boxes.all();
    if (options.one_box) scene.coarser = {scene.scene.bounds_world};
    add_views(name, scene, options, views);
  }
  if (views.empty()) {
    std::fprintf(stderr, "bench_picture_views: no view shows %zu edge pixels\n", kFewestEdges);
    return 2;
  }
  std::printf(
      "Error across shadow edges, pixels; ratios to the objective storage; loss to the best setting by "
      "another objective than picture.\n");
  for (const int maps : {1, 2, 3, 4}) {
    if (maps == 1 || options.kind == gnomon::LightKind::sun) print_table(maps, views, options.list);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_picture_views: %s\n", error.what());
    return 2;
  }
}
