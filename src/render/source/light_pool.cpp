// Many lights from frame to frame: what plan_lights keeps of them, and the plan of each light's maps.
#include "gnomon/render/light_pool.hpp"

#include <algorithm>
#include <utility>

#include "gnomon/camera.hpp"
#include "gnomon/view.hpp"

namespace gnomon::render {

std::vector<PooledLight> lights_of(const Scene& scene) {
  double largest = 0.0;
  for (const SceneLight& light : scene.lights) largest = std::max(largest, light.intensity);
  std::vector<PooledLight> lights;
  for (const SceneLight& light : scene.lights) {
    if (!(light.intensity > 0.0)) continue;
    const glm::vec3 color = light.color * static_cast<float>(light.intensity / largest);
    if (color != glm::vec3(0.0f)) lights.push_back({{light.light}, color, true, light.name});
  }
  return lights;
}

LightPool::LightPool(std::vector<PooledLight> lights, const LightOptions& options)
    : lights_(std::move(lights)),
      options_(options),
      plans_(lights_.size()),
      states_(lights_.size()),
      history_{states_, 0, {}} {
  for (const PooledLight& light : lights_) requests_.push_back(light.request);
}

const LightPlan& LightPool::plan(const View& view, const SceneBounds& bounds) {
  memory_.resize(light_memory(requests_.size(), view.points_world.size()));
  plan_ = plan_lights(view, requests_, bounds, options_, memory_, &history_);
  for (std::size_t i = 0; i < plan_.lights.size(); ++i) {
    const LightMaps& own = plan_.lights[i];
    if (!own.due) continue;
    View planned = view;
    // Later frames see these maps, too.
    if (own.frames > 1) planned = camera_round(requests_[i].light, view.camera);
    plans_[i] = make_plan(planned, requests_[i].light, bounds, light_options(options_, own));
  }
  return plan_;
}

std::vector<DrawnLight> LightPool::drawn(double exposure) const {
  std::vector<DrawnLight> drawn;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const PooledLight& light = lights_[i];
    const glm::vec3 color(exposure * glm::dvec3(light.color));
    drawn.push_back({light.request.light, &plans_[i], color, light.inverse_square});
  }
  return drawn;
}

double exposure_of(const FloatImage& light_sum) {
  constexpr double kSunlitWhite = 3.1;  // kSunColor of shaders/pass/shade/sky.glsl
  constexpr std::size_t kHundredth = 100;
  std::vector<float> lit;
  for (std::size_t i = 0; i + 2 < light_sum.values.size(); i += 3) {
    const float* rgb = &light_sum.values[i];
    const float brightest = std::max({rgb[0], rgb[1], rgb[2]});
    if (brightest > 0.0f) lit.push_back(brightest);
  }
  if (lit.empty()) return 0.0;
  const auto at = lit.end() - 1 - static_cast<std::ptrdiff_t>(lit.size() / kHundredth);
  std::nth_element(lit.begin(), at, lit.end());
  return kSunlitWhite / static_cast<double>(*at);
}

}  // namespace gnomon::render
