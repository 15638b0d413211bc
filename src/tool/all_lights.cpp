// How do fly and view plan all lights of a scene's file at once, and which of them are left out?
#include "all_lights.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "gnomon/casefile/casefile.hpp"

namespace gnomon::tool {

FileLights file_lights(const Scene& scene) {
  FileLights result{render::lights_of(scene), scene.lights.size(), 0};
  std::vector<render::PooledLight>& lights = result.lights;
  result.dark = result.of_file - lights.size();
  if (result.of_file == 0) throw std::runtime_error("--scene-light all: the file has no light");
  if (lights.empty())
    throw std::runtime_error(
        fmt::format("--scene-light all: the file's {} lights have no intensity or colour", result.of_file));
  if (lights.size() > kMaxLights) lights.resize(kMaxLights);
  return result;
}

std::vector<char> lights_in_view(const LightPlan& plan) {
  std::vector<char> in_view;
  for (const LightMaps& maps : plan.lights)
    in_view.push_back(maps.outcome != LightOutcome::without_receiver ? 1 : 0);
  return in_view;
}

LightsDrawn lights_drawn(const FileLights& lights, std::span<const char> in_view) {
  LightsDrawn result{.of_file = lights.of_file, .dark = lights.dark};
  result.drawn = static_cast<std::size_t>(std::count(in_view.begin(), in_view.end(), 1));
  result.out_of_view = lights.lights.size() - result.drawn;
  result.beyond_limit = lights.of_file - lights.dark - lights.lights.size();
  return result;
}

std::string to_string(const LightsDrawn& lights) {
  std::string text = fmt::format("{} of {} drawn", lights.drawn, lights.of_file);
  const auto add = [&text](std::size_t count, const std::string& why) {
    if (count > 0) text += fmt::format(", {} {}", count, why);
  };
  add(lights.dark, "without intensity or colour");
  add(lights.out_of_view, "without a surface in view");
  add(lights.beyond_limit, fmt::format("beyond the first {}", kMaxLights));
  return text;
}

LightOptions pool_options(const PlanOptions& plan) {
  LightOptions pool;
  pool.plan = plan;
  pool.most_size = static_cast<int>(std::bit_floor(static_cast<unsigned>(plan.resolution.max_size)));
  pool.least_size = std::min(pool.least_size, pool.most_size);
  pool.pool_width = pool.pool_height =
      pool.most_size * static_cast<int>(std::ceil(std::sqrt(1.0 * plan.cascades)));
  pool.texel_budget = std::int64_t{plan.cascades} * pool.most_size * pool.most_size;
  pool.most_frames = 1;  // all maps are of this frame
  return pool;
}

std::string refused_light(const LightPlan& plan, const std::vector<render::PooledLight>& lights) {
  if (plan.status != PlanStatus::invalid_input) return {};
  const auto light = static_cast<std::size_t>(plan.invalid_light);
  return (light < lights.size() ? lights[light].name + ": " : "") + invalid_input_text(plan.invalid_field);
}

}  // namespace gnomon::tool
