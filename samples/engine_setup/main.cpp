// How does an engine get its shadow maps from gnomon? Its own camera, light and object bounds in, matrices
// and draw lists out. Links gnomon::core alone; nothing here knows a graphics API.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <gnomon/gnomon.hpp>
#include <vector>

namespace {

// An object of the engine's scene.
struct Object {
  const char* name;
  gnomon::Box bounds;
  bool throws_shadow;
};

constexpr std::array<Object, 5> kObjects{{
    {"ground", {{-200, -1, -200}, {200, 0, 200}}, false},
    {"house", {{-6, 0, -40}, {6, 9, -28}}, true},
    {"tower", {{30, 0, -90}, {38, 45, -82}}, true},
    {"tree behind the viewer", {{-4, 0, 20}, {0, 14, 24}}, true},
    {"distant rock", {{-180, 0, 150}, {-170, 5, 160}}, true},
}};

// The renderer's side: one depth pass. The matrix takes points relative to the camera position, so that float
// is enough however far from the origin the camera stands.
void draw_shadow_map(const gnomon::ShadowMap& map, const std::vector<gnomon::Box>& casters,
                     const std::vector<const char*>& names) {
  std::printf("map %d: %d x %d texels, view depths %.1f to %.1f, warp %.*s\n", map.cascade, map.width,
              map.height, map.depth_begin, map.depth_end, static_cast<int>(map.warp->name.size()),
              map.warp->name.data());
  for (int row = 0; row < 4; ++row) {
    const auto& m = map.clip_from_camera_relative;  // GLM: m[column][row]
    std::printf("  [%10.6f %10.6f %10.6f %10.6f]\n", m[0][row], m[1][row], m[2][row], m[3][row]);
  }
  std::printf("  bias: %.4f constant, %.4f per tangent of the slope (world units)\n", map.bias_world.constant,
              map.bias_world.slope);
  std::vector<std::uint32_t> drawn(casters.size());
  drawn.resize(gnomon::cull_casters(map, casters, drawn));
  for (const std::uint32_t index : drawn) std::printf("  draw: %s\n", names[index]);
}

// Time of one plan: the median of many, microseconds.
template <typename Plan>
double cost_microseconds(const Plan& plan) {
  using Clock = std::chrono::steady_clock;
  std::array<double, 201> cost{};
  for (double& each : cost) {
    const Clock::time_point begin = Clock::now();
    plan();
    each = std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
  }
  std::nth_element(cost.begin(), cost.begin() + cost.size() / 2, cost.end());
  return cost[cost.size() / 2];
}

}  // namespace

int main() {
  const double aspect = 16.0 / 9.0;
  const gnomon::Camera camera = gnomon::perspective_camera({0, 1.8, 10}, {0, -0.05, -1}, {0, 1, 0}, 1.05,
                                                           aspect, 0.1, 300.0, 1920, 1080);
  const gnomon::DirectionalLight sun{{0.3, -0.6, -0.8}};

  std::vector<gnomon::Box> receivers, casters;
  std::vector<const char*> caster_names;
  for (const Object& object : kObjects) {
    receivers.push_back(object.bounds);
    if (!object.throws_shadow) continue;
    casters.push_back(object.bounds);
    caster_names.push_back(object.name);
  }

  gnomon::PlanOptions options;
  options.cascades = 3;
  options.resolution.max_size = 2048;
  options.clip_space = gnomon::kVulkan;  // the default is OpenGL's

  const gnomon::ShadowPlan plan = gnomon::make_plan(camera, sun, {casters, receivers}, options);
  if (plan.status == gnomon::PlanStatus::invalid_input) {
    std::fprintf(stderr, "engine_setup: %.*s is not usable\n", static_cast<int>(plan.invalid_field.size()),
                 plan.invalid_field.data());
    return 2;
  }
  for (const gnomon::ShadowMap& map : plan.maps()) draw_shadow_map(map, casters, caster_names);

  std::puts("omitted:");
  for (const gnomon::Omission& omission : plan.omitted()) {
    const gnomon::OmissionText text = gnomon::describe(omission);
    std::printf("  %s: %s\n", text.what.data(), text.why.data());
  }
  const gnomon::AliasingStats stats = gnomon::measure(plan, camera, {casters, receivers});
  std::printf("pixels per texel: %.2f at the median, %.2f at 95 %%, %.2f at worst\n", stats.p50, stats.p95,
              stats.max);
  std::printf("one plan costs %.0f microseconds\n", cost_microseconds([&] {
                (void)gnomon::make_plan(camera, sun, {casters, receivers}, options);
              }));
  // Also where there is nothing to draw: then everything in view is lit.
  return std::isfinite(stats.p50) ? 0 : 1;
}
