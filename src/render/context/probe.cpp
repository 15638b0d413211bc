// What the current context's driver can do, and whether its clock can be believed.
#include "gnomon/render/probe.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "context/backend.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/render/error.hpp"

namespace gnomon::render {
namespace {

using Clock = std::chrono::steady_clock;

struct Times {
  double timer_ms, wall_ms;
};

/// Clears layers until the work takes long enough for the clock's own cost not to matter.
Times timed_clears(const Framebuffer& fbo, int count) {
  GLuint query = 0;
  glGenQueries(1, &query);
  glFinish();
  const Clock::time_point begin = Clock::now();
  glBeginQuery(GL_TIME_ELAPSED, query);
  for (int i = 0; i < count; ++i) {
    const std::array<float, 4> color{static_cast<float>(i), 0.0f, 0.0f, 1.0f};
    glClearNamedFramebufferfv(fbo.name(), GL_COLOR, 0, color.data());
  }
  glEndQuery(GL_TIME_ELAPSED);
  glFinish();
  const double wall = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
  glDeleteQueries(1, &query);
  return {static_cast<double>(nanoseconds) * 1e-6, wall};
}

void judge_timers(Probe& probe) {
  GLint bits = 0;
  glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
  if (bits == 0) {
    probe.timers_why = "the driver counts no time";
    return;
  }
  constexpr int kSide = 2048;
  const Texture target = make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(target.name(), 1, GL_RGBA32F, kSide, kSide);
  const Framebuffer fbo = make_framebuffer();
  glNamedFramebufferTexture(fbo.name(), GL_COLOR_ATTACHMENT0, target.name(), 0);
  (void)timed_clears(fbo, 1);  // what is allocated on first use
  constexpr double kLongEnoughMs = 20.0;
  Times times{};
  for (int count = 4; count <= 4096; count *= 4) {
    times = timed_clears(fbo, count);
    if (times.wall_ms >= kLongEnoughMs) break;
  }
  probe.timer_ms = times.timer_ms;
  probe.wall_ms = times.wall_ms;
  // The wall clock holds the start and the wait besides: a fifth is far more than either takes.
  constexpr double kLeast = 0.8, kMost = 1.02;
  const double ratio = times.timer_ms / times.wall_ms;
  probe.timers_trusted = ratio >= kLeast && ratio <= kMost;
  std::array<char, 128> text;
  std::snprintf(text.data(), text.size(), "the timer says %.2f ms where the wall clock says %.2f ms",
                times.timer_ms, times.wall_ms);
  probe.timers_why = text.data();
}

/// Of the machine; 0 where it does not say.
double free_memory_bytes() {
  std::ifstream table("/proc/meminfo");
  for (std::string line; std::getline(table, line);) {
    constexpr std::string_view kKey = "MemAvailable:";
    constexpr double kKibi = 1024.0;
    if (line.rfind(kKey, 0) == 0) return kKibi * std::strtod(line.c_str() + kKey.size(), nullptr);
  }
  return 0.0;
}

bool draws_in_memory() {
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return renderer != nullptr && is_software(renderer);
}

/// Of earlier calls. A context that is lost answers with an error every time.
void forget_errors() {
  constexpr int kMaxErrors = 64;
  for (int i = 0; i < kMaxErrors && glGetError() != GL_NO_ERROR; ++i) {
  }
}

}  // namespace

std::string layer_extension() {
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  std::string found;
  for (GLint i = 0; i < count; ++i) {
    const auto* text = reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
    if (text == nullptr) continue;
    const std::string_view name = text;
    if (name == "GL_ARB_shader_viewport_layer_array") return std::string(name);
    if (name == "GL_AMD_vertex_shader_layer") found = name;
  }
  return found;
}

bool memory_takes_maps(int map_size, int maps, double bytes_per_texel) {
  // A software driver takes what it is asked for, and the machine ends the program that has taken too much.
  const double bytes = bytes_per_texel * maps * map_size * map_size, free = free_memory_bytes();
  if (draws_in_memory() && free > 0.0 && bytes > 0.9 * free) return false;
  forget_errors();
  constexpr double kTexelBytes = 4.0;  // of GL_DEPTH_COMPONENT32F
  std::vector<Texture> taken;
  for (double left = bytes_per_texel; left > 0.0; left -= kTexelBytes) {
    taken.push_back(make_texture(GL_TEXTURE_2D_ARRAY));
    glTextureStorage3D(taken.back().name(), 1, GL_DEPTH_COMPONENT32F, map_size, map_size, maps);
    if (glGetError() == GL_NO_ERROR) continue;
    check_context();
    return false;
  }
  return true;
}

FittingMaps largest_maps(int map_size, int maps, double bytes_per_texel, double limit_mib) {
  constexpr double kMebi = 1024.0 * 1024.0;
  constexpr int kLeastMap = 16;
  FittingMaps fitting;
  for (int size = map_size; size >= std::min(map_size, kLeastMap); size /= 2) {
    const double mebibytes = bytes_per_texel * maps * size * size / kMebi;
    const bool within = limit_mib <= 0.0 || mebibytes <= limit_mib;
    if (within && memory_takes_maps(size, maps, bytes_per_texel)) {
      fitting.size = size;
      fitting.mebibytes = mebibytes;
      return fitting;
    }
    if (!fitting.why.empty()) continue;
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "above the limit of %g MiB", limit_mib);
    fitting.why = within ? "out of memory" : text.data();
  }
  return fitting;
}

Probe probe_driver() {
  Probe probe;
  constexpr std::array<std::pair<const char*, GLenum>, 6> kLimits{
      {{"texture side", GL_MAX_TEXTURE_SIZE},
       {"array layers", GL_MAX_ARRAY_TEXTURE_LAYERS},
       {"draw buffers", GL_MAX_DRAW_BUFFERS},
       {"image units", GL_MAX_TEXTURE_IMAGE_UNITS},
       {"uniform block bytes", GL_MAX_UNIFORM_BLOCK_SIZE},
       {"samples", GL_MAX_SAMPLES}}};
  for (const auto& [name, parameter] : kLimits) {
    GLint64 value = 0;
    glGetInteger64v(parameter, &value);
    probe.limits.push_back({name, value});
  }
  judge_timers(probe);
  probe.layers = layer_extension();
  return probe;
}

}  // namespace gnomon::render
