// What is a coarse depth pass on the CPU worth, where no depth buffer of an earlier frame is there? The range
// of view depths that it finds, its time, and the error m of cascades planned with it, beside the depths that
// a frame drawn before and read back shows, and beside none.
//
//     bench_coarse_depths [--frames N] [--size WxH] [--triangles N] [SCENE...]
//
// Exit code 1 where a pixel shows a depth that the coarse pass does not hold.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/report/errors.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/coarse_view.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "guarded.hpp"
#include "median.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

struct Request {
  std::vector<std::string> scenes;
  int frames = 5, width = 640, height = 360;
  std::uint64_t triangles = 20'000;
};

Request parsed(int argc, char** argv) {
  Request request;
  const auto fail = [] {
    throw std::runtime_error(
        "usage: bench_coarse_depths [--frames N] [--size WxH] [--triangles N] [SCENE...]");
  };
  for (int i = 1; i < argc; ++i) {
    if (std::strncmp(argv[i], "--", 2) != 0) {
      request.scenes.emplace_back(argv[i]);
      continue;
    }
    if (i + 1 == argc) fail();
    const char* const value = argv[i + 1];
    if (std::strcmp(argv[i], "--frames") == 0) {
      request.frames = std::atoi(value);
    } else if (std::strcmp(argv[i], "--triangles") == 0) {
      request.triangles = std::strtoull(value, nullptr, 10);
    } else if (std::strcmp(argv[i], "--size") != 0 ||
               std::sscanf(value, "%dx%d", &request.width, &request.height) != 2) {
      fail();
    }
    ++i;
  }
  if (request.frames < 1 || request.width < 16 || request.height < 16) fail();
  if (request.scenes.empty()) {
    for (const BuiltinScene& scene : builtin_scenes())
      request.scenes.push_back("builtin:" + std::string(scene.name));
  }
  return request;
}

/// CPU time of all threads since `begin`: other programs do not count, and software OpenGL does.
double ms_since(std::clock_t begin) {
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

bool holds(const VisibleDepths& depths, double depth) {
  return depth >= depths.min && depth <= depths.max &&
         depths.count[static_cast<std::size_t>(depth_bin(depth))] > 0;
}

/// Medians over the frames are printed.
struct Figures {
  std::vector<double> coarse_ms, read_ms, m_none, m_coarse, m_read, near_share, far_share;
  std::size_t outside = 0, pixels = 0;
};

class Scenery {
 public:
  Scenery(const Request& request, const std::string& name)
      : request_(request),
        scene_(load_scene(name)),
        renderer_(scene_),
        filter_(renderer_.prepare(render::filters::hard)),
        light_(default_light({}, scene_.bounds_world)) {
    for (const Instance& instance : scene_.instances) boxes_.push_back(instance.bounds_world);
  }
  [[nodiscard]] Figures measure() {
    Figures figures;
    const CameraPath path = default_path(scene_);
    for (int frame = 0; frame < request_.frames; ++frame)
      measure(path.at((frame + 0.5) / request_.frames, request_.width, request_.height), figures);
    return figures;
  }

 private:
  void measure(const Camera& camera, Figures& figures) {
    VisibleDepths coarse;
    double least = 1e300;
    for (int round = 0; round < 5; ++round) {
      const std::clock_t begin = std::clock();
      coarse = view_.depths(scene_, camera, request_.triangles);
      least = std::min(least, ms_since(begin));
    }
    figures.coarse_ms.push_back(least);
    VisibleDepths read;
    FloatImage positions;
    least = 1e300;
    for (int round = 0; round < 3; ++round) {
      const std::clock_t begin = std::clock();
      renderer_.draw(ShadowPlan{}, camera, filter_, quiet());
      positions = renderer_.positions();
      read = {};
      for (std::size_t i = 3; i < positions.values.size(); i += 4)
        read.add(static_cast<double>(positions.values[i]));
      least = std::min(least, ms_since(begin));
    }
    figures.read_ms.push_back(least);
    for (std::size_t i = 3; i < positions.values.size(); i += 4) {
      const double depth = positions.values[i];
      if (!(depth > 0.0)) continue;
      ++figures.pixels;
      figures.outside += holds(coarse, depth) ? 0 : 1;
    }
    if (read.empty()) return;
    figures.near_share.push_back(coarse.min / read.min);
    figures.far_share.push_back(coarse.max / read.max);
    figures.m_none.push_back(m_of(camera, nullptr));
    figures.m_coarse.push_back(m_of(camera, &coarse));
    figures.m_read.push_back(m_of(camera, &read));
  }
  [[nodiscard]] double m_of(const Camera& camera, const VisibleDepths* depths) {
    PlanOptions options;
    options.cascades = 4;
    options.resolution.max_size = 1024;
    options.prune = options.prune.without(PruneRule::metric_resolution);
    render::set_margin(filter_.settings, options);
    render::FrameOptions frame = quiet();
    frame.aliasing = true;
    renderer_.draw(make_plan({camera, depths}, light_, {boxes_, boxes_}, options), camera, filter_, frame);
    std::vector<float> m;
    const FloatImage image = renderer_.aliasing();
    for (std::size_t i = 0; i + 3 < image.values.size(); i += 4)
      m.push_back(image.values[i + 3] < 0.0f ? 0.0f : image.values[i]);
    return report::pixel_aliasing(m).p95;
  }

  const Request& request_;
  Scene scene_;
  render::Renderer renderer_;
  render::PreparedFilter filter_;
  Light light_;
  std::vector<Box> boxes_;
  CoarseView view_;
};

int run(const Request& request) {
  const auto context = render::create_context(render::ContextKind::automatic);
  std::printf("%s, %dx%d, %d frames, %llu triangles at most\n\n", context->info().description().c_str(),
              request.width, request.height, request.frames,
              static_cast<unsigned long long>(request.triangles));
  std::printf(
      "| scene | pixels | not held | near | far | coarse, CPU ms | drawn and read, CPU ms "
      "| m p95: none | coarse | read |\n|--|--|--|--|--|--|--|--|--|--|\n");
  std::size_t outside = 0;
  for (const std::string& name : request.scenes) {
    const Figures f = Scenery(request, name).measure();
    outside += f.outside;
    if (f.m_none.empty()) continue;
    std::printf("| %s | %zu | %zu | %.3f | %.3f | %.2f | %.1f | %.3f | %.3f | %.3f |\n", name.c_str(),
                f.pixels, f.outside, median(f.near_share), median(f.far_share), median(f.coarse_ms),
                median(f.read_ms), median(f.m_none), median(f.m_coarse), median(f.m_read));
    (void)std::fflush(stdout);
  }
  return outside == 0 ? 0 : 1;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  const auto run = [](int count, char** words) { return gnomon::run(gnomon::parsed(count, words)); };
  return gnomon::guarded("bench_coarse_depths", run, argc, argv);
}
