// On what, and with which version of this program, something was measured.
#include "machine.hpp"

#include <stdlib.h>

#include <fstream>
#include <string>
#include <thread>

#include "build_version.hpp"
#include "gnomon/trace/tracer.hpp"

namespace gnomon::tool {
namespace {

std::string cpu_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace

report::Machine machine(const render::ContextInfo& context) {
  report::Machine m;
  m.renderer = context.renderer + ", OpenGL " + context.version;
  m.context = context.platform;
  m.software = context.software;
  m.cpu = cpu_name();
  m.cores = static_cast<int>(std::thread::hardware_concurrency());
  m.version = build_version();
  m.rays = trace::built_with_embree() ? "Embree" : "own, in double";
  return m;
}

double current_load() noexcept {
  double load = 0.0;
  return ::getloadavg(&load, 1) == 1 ? load : 0.0;
}

std::vector<std::string> vector_units() {
  std::vector<std::string> units;
#if defined(__GNUC__) && defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) units.emplace_back("avx512f");
  if (__builtin_cpu_supports("avx2")) units.emplace_back("avx2");
  units.emplace_back("sse2");
#endif
  return units;
}

const char* build_version() noexcept {
  return GNOMON_BUILD_VERSION;
}

}  // namespace gnomon::tool
