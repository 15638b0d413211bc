// Many lights over a scene with panes: a sun and point lights, drawn, and what rays leave of their light.
#include "pane_lights.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

namespace gnomon::tool {

PaneLights::PaneLights(const Light& sun, int local_lights, const TranslucentParts& parts) {
  // A weak sun, so that the others show.
  constexpr glm::vec3 kSun(0.35f), kLocal(0.6f);
  lights_.push_back({{sun}, kSun});
  const Box& box = parts.panes.instances.empty() ? parts.opaque.bounds_world : parts.panes.bounds_world;
  const glm::dvec3 extent = box.max - box.min;
  // Above the panes by a third of their height, and far enough to reach beyond them.
  constexpr double kAbove = 1.0 / 3.0, kRange = 0.75;
  const int columns = static_cast<int>(std::ceil(std::sqrt(local_lights))),
            rows = (local_lights + columns - 1) / columns;
  for (int i = 0; i < local_lights; ++i) {
    const glm::dvec3 at{(i % columns + 0.5) / columns, 1.0 + kAbove, (i / columns + 0.5) / rows};
    lights_.push_back({{PointLight{box.min + at * extent, kRange * glm::length(extent)}}, kLocal});
  }
}

void PaneLights::plan(const Camera& camera, const SceneBounds& bounds, const PlanOptions& options,
                      int map_size) {
  LightOptions pool;
  pool.most_size = static_cast<int>(std::bit_floor(static_cast<unsigned>(map_size)));
  pool.least_size = std::min(pool.least_size, pool.most_size);
  pool.pool_width = pool.pool_height = std::max(pool.pool_width, pool.most_size);
  pool.most_frames = 1;  // all maps are of this frame
  pool.plan = options;
  pool_.emplace(lights_, pool);
  const LightPlan& plan = pool_->plan(camera, bounds);
  if (plan.status == PlanStatus::invalid_input)
    throw std::runtime_error("--by lights: " + std::string(plan.invalid_field) + " is out of range");
}

render::FrameStats PaneLights::draw(render::Renderer& renderer, const Camera& camera,
                                    const render::PreparedFilter& filter, const render::FrameOptions& options,
                                    int only) const {
  std::vector<render::DrawnLight> lights = pool_->drawn();
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (only >= 0 && only != static_cast<int>(i)) lights[i].color = glm::vec3(0.0f);
  return renderer.draw({pool_->last(), lights}, camera, filter, options);
}

std::vector<glm::dvec3> PaneLights::reference(render::Renderer& plain, const Camera& camera,
                                              const render::PreparedFilter& filter,
                                              const trace::Tracer& tracer,
                                              const trace::PaneTracer& panes) const {
  std::vector<glm::dvec3> sum(static_cast<std::size_t>(camera.width) *
                              static_cast<std::size_t>(camera.height));
  render::FrameOptions options;
  options.aliasing = options.heat_map = options.cascade_tint = options.time_passes = false;
  for (std::size_t light = 0; light < lights_.size(); ++light) {
    draw(plain, camera, filter, options, static_cast<int>(light));
    const FloatImage alone = plain.light_sum();
    const trace::SurfacePoints points = trace::surface_points(tracer, camera, lights_[light].request.light,
                                                              plain.positions(), plain.normals());
    const trace::PaneReference left = trace::pane_reference(panes, points, lights_[light].request.light);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] +=
          glm::dvec3(alone.values[3 * i], alone.values[3 * i + 1], alone.values[3 * i + 2]) * left.pixels[i];
  }
  return sum;
}

}  // namespace gnomon::tool
