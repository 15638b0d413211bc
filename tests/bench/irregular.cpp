// Exact shadows by lists of pixels: misclassified pixels against rays, lengths of lists, and time, beside one
// comparison with the nearest texel.
//
//     bench_irregular [--size WxH] [--maps N] [--map-size N] [--pictures FOLDER] [SCENE...]   all built-in
//     scenes where none is named
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "gnomon/render/context.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/trace/reference.hpp"
#include "guarded.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

struct Request {
  int width = 480, height = 270, map_size = 1024, cascades = 0;  ///< cascades 0: one map, and four
  std::string pictures;
  std::vector<std::string> scenes;
};

render::FrameOptions uncached() {
  render::FrameOptions options = quiet();
  options.prune = prune_rules_of(PruneSource::this_frame);
  return options;
}

/// One frame of a scene with what is true of it.
struct Frame {
  Scene scene;
  std::vector<Box> boxes;
  Light light;
  Camera camera;
  render::Renderer renderer;
  std::vector<trace::Verdict> truth;
  std::size_t decided = 0, undecided = 0;

  Frame(const std::string& name, LightKind kind, const Request& request)
      : scene(load_scene(name, {})),
        camera(default_path(scene).at(0.5, request.width, request.height)),
        renderer(scene) {
    for (const Instance& instance : scene.instances) boxes.push_back(instance.bounds_world);
    light = default_light({.kind = kind}, scene.bounds_world);
    renderer.draw(ShadowPlan{}, camera, renderer.prepare(render::filters::hard), uncached());
    const trace::Tracer tracer(scene);
    truth = trace::hard_reference(
                tracer,
                trace::surface_points(tracer, camera, light, renderer.positions(), renderer.normals()), light)
                .pixels;
    for (const trace::Verdict verdict : truth) {
      decided += verdict == trace::Verdict::lit || verdict == trace::Verdict::shadow;
      undecided += verdict == trace::Verdict::undecided;
    }
  }
  [[nodiscard]] bool is_wrong(std::size_t pixel, const FloatImage& mask) const {
    const trace::Verdict verdict = truth[pixel];
    if (verdict != trace::Verdict::lit && verdict != trace::Verdict::shadow) return false;
    return (mask.values[2 * pixel] > 0.5f) != (verdict == trace::Verdict::lit);
  }
  [[nodiscard]] std::size_t wrong(const FloatImage& mask) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) count += is_wrong(i, mask);
    return count;
  }
};

double milliseconds(const render::FrameStats& stats) {
  return stats.milliseconds[static_cast<std::size_t>(render::Pass::shadow_maps)] +
         stats.milliseconds[static_cast<std::size_t>(render::Pass::mask)];
}

/// Median time of five frames after one that warms up.
double timed(Frame& frame, const ShadowPlan& plan, const render::PreparedFilter& filter) {
  std::vector<double> times;
  for (int i = 0; i < 6; ++i) {
    const render::FrameStats stats = frame.renderer.draw(plan, frame.camera, filter, uncached());
    if (i > 0) times.push_back(milliseconds(stats));
  }
  std::nth_element(times.begin(), times.begin() + 2, times.end());
  return times[2];
}

/// The mask in grey, misclassified pixels in orange (false light) and blue (false shadow), undecided ones in
/// violet.
void save(const std::filesystem::path& file, const Frame& frame, const FloatImage& mask) {
  Image image{"mask", mask.width, mask.height, {}};
  for (std::size_t i = 0; i < frame.truth.size(); ++i) {
    const bool lit = mask.values[2 * i] > 0.5f;
    render::Color color{lit ? render::Color{240, 240, 240} : render::Color{60, 60, 60}};
    if (frame.truth[i] == trace::Verdict::undecided) color = {160, 60, 160};
    if (frame.is_wrong(i, mask)) color = lit ? render::Color{255, 140, 0} : render::Color{30, 110, 230};
    for (const std::uint8_t channel : {color.r, color.g, color.b}) image.rgba.push_back(channel);
    image.rgba.push_back(255);
  }
  write_png(image, file);
}

void compare(Frame& frame, const std::string& label, const Request& request, const char* warp, int cascades) {
  PlanOptions options;
  options.resolution.max_size = request.map_size;
  options.prune = options.prune.without(PruneRule::metric_resolution);
  options.cascades = cascades;
  options.warp.warp = find_warp(warp);
  render::set_margin(render::default_settings(render::filters::hard), options);
  const ShadowPlan plan = make_plan(frame.camera, frame.light, {frame.boxes, frame.boxes}, options);
  const double hard_ms = timed(frame, plan, frame.renderer.prepare(render::filters::hard));
  const std::size_t hard_wrong = frame.wrong(frame.renderer.mask());
  const render::PreparedFilter exact =
      frame.renderer.prepare(render::filters::hard, render::Source::irregular());
  const double irregular_ms = timed(frame, plan, exact);
  const FloatImage mask = frame.renderer.mask();
  std::vector<std::uint32_t> lengths = frame.renderer.list_lengths();
  std::sort(lengths.begin(), lengths.end());
  double listed = 0.0;
  for (const std::uint32_t length : lengths) listed += length;
  const auto at = [&lengths](double share) {
    return lengths.empty()
               ? 0u
               : lengths[static_cast<std::size_t>(share * static_cast<double>(lengths.size() - 1))];
  };
  std::printf(
      "%-22s %-8s %d %9zu %9zu %7zu %8.3f %9.0f %8.2f %5u %6u %8.1f %8.1f %6.1f\n", label.c_str(), warp,
      plan.map_count, frame.wrong(mask), frame.decided, frame.undecided,
      100.0 * static_cast<double>(hard_wrong) / static_cast<double>(std::max<std::size_t>(frame.decided, 1)),
      listed, lengths.empty() ? 0.0 : listed / static_cast<double>(lengths.size()), at(0.99), at(1.0),
      irregular_ms, hard_ms, irregular_ms / hard_ms);
  std::fflush(stdout);
  if (request.pictures.empty()) return;
  std::string stem = label + "_" + warp + "_" + std::to_string(cascades);
  std::replace(stem.begin(), stem.end(), ' ', '_');
  save(std::filesystem::path(request.pictures) / (stem + "_mask.png"), frame, mask);
  write_png(frame.renderer.image(), std::filesystem::path(request.pictures) / (stem + ".png"));
}

Request parsed(int argc, char** argv) {
  Request request;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string value = i + 1 < argc ? argv[i + 1] : "";
    if (word == "--size") {
      if (std::sscanf(value.c_str(), "%dx%d", &request.width, &request.height) != 2) std::exit(2);
    } else if (word == "--maps") {
      request.cascades = std::atoi(value.c_str());
    } else if (word == "--map-size") {
      request.map_size = std::atoi(value.c_str());
    } else if (word == "--pictures") {
      request.pictures = value;
    } else {
      request.scenes.push_back(word);
      continue;
    }
    ++i;
  }
  if (request.scenes.empty()) {
    for (const BuiltinScene& scene : builtin_scenes())
      request.scenes.push_back("builtin:" + std::string(scene.name));
  }
  return request;
}

int run(const Request& request) {
  if (!request.pictures.empty()) std::filesystem::create_directories(request.pictures);
  const auto context = render::create_context();
  std::printf("%-22s %-8s %s %9s %9s %7s %8s %9s %8s %5s %6s %8s %8s %6s\n", "scene, light", "warp", "n",
              "wrong", "decided", "undec.", "hard, %", "listed", "mean", "99 %", "most", "ms", "hard ms",
              "ratio");
  for (const std::string& scene : request.scenes) {
    for (const LightKind kind : {LightKind::sun, LightKind::spot, LightKind::point}) {
      Frame frame(scene, kind, request);
      const std::filesystem::path path(scene);
      const std::string name =
          scene.starts_with("builtin:") ? scene.substr(8) : path.parent_path().filename().string();
      const std::string label = name + " " + std::string(to_string(kind));
      for (const int cascades : {1, 4}) {
        if (request.cascades != 0 && request.cascades != cascades) continue;
        if (kind != LightKind::sun && cascades != 1) continue;
        for (const char* warp : {"none", "optimal"}) compare(frame, label, request, warp, cascades);
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  const auto run = [](int count, char** words) { return gnomon::run(gnomon::parsed(count, words)); };
  return gnomon::guarded("bench_irregular", run, argc, argv);
}
