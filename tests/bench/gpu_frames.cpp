// What do shadows cost on this card? A row of JSON for each thing measured, as soon as it is measured.
//
//     bench_gpu_frames filters [--map-sizes A,B] [--kernels A,B] [--rounds N] [--seconds N] [--scene SCENE]
//     bench_gpu_frames flight  [--frames N] [--size WxH] [--seconds N] [--scene SCENE]
//
// filters: maps, prefilter and look-up of every filter. flight: frames of the scene's default flight, four
// maps of 2048. Times are milliseconds: wall clock from an idle driver to an idle driver, and GL_TIME_ELAPSED
// of the same commands.
#include <glad/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/load.hpp"
#include "guarded.hpp"
#include "quiet.hpp"

namespace gnomon {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

struct Request {
  bool flight = false;
  std::string scene = "builtin:city";
  std::vector<int> map_sizes{1024, 2048, 4096}, kernels{3, 5, 9, 17, 33};
  int rounds = 7, frames = 600, width = 1280, height = 720;
  double seconds = 1e9;
};

std::vector<int> numbers(const char* text) {
  std::vector<int> all;
  for (char* end = nullptr; *text != '\0'; text = *end == ',' ? end + 1 : end) {
    all.push_back(static_cast<int>(std::strtol(text, &end, 10)));
    if (end == text || (*end != ',' && *end != '\0'))
      throw std::runtime_error(std::string(text) + ": wants numbers, as in 3,5");
  }
  return all;
}

Request parsed(int argc, char** argv) {
  Request request;
  const auto fail = [] {
    throw std::runtime_error(
        "usage: bench_gpu_frames filters|flight [--map-sizes A,B] [--kernels A,B] [--rounds N] [--frames N] "
        "[--size WxH] "
        "[--seconds N] [--scene SCENE]");
  };
  if (argc < 2 || argc % 2 != 0) fail();
  request.flight = std::strcmp(argv[1], "flight") == 0;
  if (!request.flight && std::strcmp(argv[1], "filters") != 0) fail();
  for (int i = 2; i < argc; i += 2) {
    const std::string name = argv[i];
    const char* const value = argv[i + 1];
    if (name == "--map-sizes")
      request.map_sizes = numbers(value);
    else if (name == "--kernels")
      request.kernels = numbers(value);
    else if (name == "--rounds")
      request.rounds = std::atoi(value);
    else if (name == "--frames")
      request.frames = std::atoi(value);
    else if (name == "--seconds")
      request.seconds = std::atof(value);
    else if (name == "--scene")
      request.scene = value;
    else if (name != "--size" || std::sscanf(value, "%dx%d", &request.width, &request.height) != 2)
      fail();
  }
  const bool sane = request.rounds > 0 && request.frames > 0 && request.width >= 16 && request.height >= 16 &&
                    request.scene.find_first_of("\"\\") == std::string::npos;
  if (!sane) fail();
  for (const int size : request.map_sizes) {
    if (size < 4 || size > 16384) fail();
  }
  return request;
}

/// One GL_TIME_ELAPSED query; begin() and end() may be called over and over.
class Timer {
 public:
  Timer() { glGenQueries(1, &query_); }
  ~Timer() { glDeleteQueries(1, &query_); }
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;
  void begin() const { glBeginQuery(GL_TIME_ELAPSED, query_); }
  void end() const { glEndQuery(GL_TIME_ELAPSED); }
  /// Waits for the commands between the two.
  [[nodiscard]] double ms() const {
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_, GL_QUERY_RESULT, &nanoseconds);
    return 1e-6 * static_cast<double>(nanoseconds);
  }

 private:
  GLuint query_ = 0;
};

/// The value that a share of the sorted values does not exceed.
double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto place = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::min(values.size(), std::max<std::size_t>(place, 1)) - 1];
}

void print_percentiles(const char* name, const std::vector<double>& values) {
  std::printf(",\"%s\":{\"min\":%.6g,\"p50\":%.6g,\"p90\":%.6g,\"p99\":%.6g,\"max\":%.6g}", name,
              percentile(values, 0.0), percentile(values, 0.5), percentile(values, 0.9),
              percentile(values, 0.99), percentile(values, 1.0));
}

void end_row() {
  std::printf("}\n");
  if (std::fflush(stdout) != 0) throw std::runtime_error("the row cannot be written: is the disk full?");
  render::check_context();
}

class Bench {
 public:
  explicit Bench(const Request& request)
      : request_(request), scene_(load_scene(request.scene)), renderer_(scene_) {
    for (const Instance& instance : scene_.instances) boxes_.push_back(instance.bounds_world);
  }

  void filters() {
    const Camera camera = path_.at(0.5, request_.width, request_.height);
    for (const int size : request_.map_sizes) {
      for (const int kernel : request_.kernels) {
        for (const render::Filter* filter : render::all_filters()) {
          const bool first = kernel == request_.kernels.front();
          if (!filter->info.has_kernel && !first) continue;
          std::string text(filter->info.name);
          if (filter->info.has_kernel) text += ":radius=" + std::to_string(0.5 * (kernel - 1));
          const render::ParsedFilter parsed = render::parse_filter(text);
          if (!parsed.error.empty()) continue;
          if (late()) return;
          filter_row(parsed.settings, filter->info.has_kernel ? kernel : 1, size, camera);
        }
      }
    }
  }

  void flight() {
    PlanOptions options;
    options.resolution.max_size = 2048;
    options.cascades = 4;
    const render::FilterSettings settings = render::default_settings(render::filters::pcf);
    render::set_margin(settings, options);
    const render::PreparedFilter filter = renderer_.prepare(settings);
    std::vector<double> wall, timer, planned;
    for (int frame = 0; frame < request_.frames && !late(); ++frame) {
      const Camera camera = path_.at((frame + 0.5) / request_.frames, request_.width, request_.height);
      const Clock::time_point begin = Clock::now();
      const ShadowPlan plan = make_plan(camera, sun_, {boxes_, boxes_}, options);
      const double plan_ms = ms_since(begin);
      timer_.begin();
      draw(plan, camera, filter);
      timer_.end();
      glFinish();
      const double frame_ms = ms_since(begin);
      if (frame == 0) continue;  // shaders are compiled and images allocated
      wall.push_back(frame_ms);
      timer.push_back(timer_.ms());
      planned.push_back(plan_ms);
    }
    if (wall.empty()) return;
    std::printf("{\"part\":\"flight\",\"scene\":\"%s\",\"frames\":%zu,\"width\":%d,\"height\":%d",
                request_.scene.c_str(), wall.size(), request_.width, request_.height);
    print_percentiles("wall_ms", wall);
    print_percentiles("timer_ms", timer);
    print_percentiles("plan_ms", planned);
    end_row();
  }

 private:
  [[nodiscard]] bool late() const { return ms_since(begin_) > 1e3 * request_.seconds; }

  void draw(const ShadowPlan& plan, const Camera& camera, const render::PreparedFilter& filter,
            bool whole = false) {
    render::FrameOptions frame = quiet();
    frame.time_passes = false;
    if (whole) frame.prune = prune_rules_of(PruneSource::this_frame);
    renderer_.draw(plan, camera, filter, frame);
  }

  void filter_row(const render::FilterSettings& settings, int kernel, int size, const Camera& camera) {
    PlanOptions options;
    options.resolution.max_size = size;
    options.cascades = 1;
    options.prune = kPruneNothing;
    options.warp.warp = &warps::none;
    render::set_margin(settings, options);
    const ShadowPlan plan = make_plan(camera, sun_, {boxes_, boxes_}, options);
    const render::PreparedFilter filter = renderer_.prepare(settings);
    std::vector<double> wall, timer;
    for (int round = -1; round < request_.rounds; ++round) {
      glFinish();
      const Clock::time_point begin = Clock::now();
      timer_.begin();
      draw(plan, camera, filter, true);
      timer_.end();
      glFinish();
      const double ms = ms_since(begin);
      if (round < 0) continue;  // images are allocated
      wall.push_back(ms);
      timer.push_back(timer_.ms());
    }
    std::printf(
        "{\"part\":\"filters\",\"filter\":\"%s\",\"kernel\":%d,\"map_size\":%d,\"width\":%d,\"height\":%d",
        std::string(settings.filter->info.name).c_str(), kernel, size, request_.width, request_.height);
    print_percentiles("wall_ms", wall);
    print_percentiles("timer_ms", timer);
    end_row();
  }

  const Request& request_;
  const Clock::time_point begin_ = Clock::now();
  Scene scene_;
  std::vector<Box> boxes_;
  Light sun_ = default_light({}, scene_.bounds_world);
  CameraPath path_ = default_path(scene_);
  render::Renderer renderer_;
  Timer timer_;
};

int run(int argc, char** argv) {
  const Request request = parsed(argc, argv);
  const auto context = render::create_context(render::ContextKind::automatic);
  Bench bench(request);
  request.flight ? bench.flight() : bench.filters();
  return 0;
}

}  // namespace
}  // namespace gnomon

int main(int argc, char** argv) {
  return gnomon::guarded("bench_gpu_frames", gnomon::run, argc, argv);
}
