// Many lights over a scene with panes: a sun and point lights, drawn, and what rays leave of their light.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "gnomon/render/light_pool.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/translucent.hpp"
#include "gnomon/trace/transmittance.hpp"

namespace gnomon::tool {

class PaneLights {
 public:
  /// `sun` and so many point lights, evenly over the panes, or over the scene where there are none.
  PaneLights(const Light& sun, int local_lights, const TranslucentParts& parts);

  /// Plans all lights with maps for the hard filter, of at most so many texels along each side. Throws
  /// std::runtime_error where an option is out of range.
  void plan(const Camera& camera, const SceneBounds& bounds, const PlanOptions& options, int map_size);
  /// Draws all lights, or one alone. `filter`: prepared for Source::lights.
  render::FrameStats draw(render::Renderer& renderer, const Camera& camera,
                          const render::PreparedFilter& filter, const render::FrameOptions& options,
                          int only = -1) const;
  /// By pixel, the light of all that `plain`, a renderer without panes, draws, times what rays leave of each.
  [[nodiscard]] std::vector<glm::dvec3> reference(render::Renderer& plain, const Camera& camera,
                                                  const render::PreparedFilter& filter,
                                                  const trace::Tracer& tracer,
                                                  const trace::PaneTracer& panes) const;

 private:
  std::vector<render::PooledLight> lights_;
  std::optional<render::LightPool> pool_;
};

}  // namespace gnomon::tool
