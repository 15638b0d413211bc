// How do fly and view plan all lights of a scene's file at once, and which of them are left out?
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "gnomon/lights.hpp"
#include "gnomon/render/light_pool.hpp"

namespace gnomon::tool {

/// The lights of a file that are planned together.
struct FileLights {
  std::vector<render::PooledLight> lights;  ///< those that shine, at most kMaxLights
  std::size_t of_file = 0;                  ///< all of them
  std::size_t dark = 0;                     ///< of them, without intensity or colour
};
/// Throws std::runtime_error where none shines.
[[nodiscard]] FileLights file_lights(const Scene& scene);

/// What became of the lights of a file. The others add up to `of_file`.
struct LightsDrawn {
  std::size_t of_file = 0;
  std::size_t drawn = 0;         ///< they light a surface in view
  std::size_t out_of_view = 0;   ///< they light none
  std::size_t dark = 0;          ///< as FileLights has it
  std::size_t beyond_limit = 0;  ///< after the first kMaxLights that shine
};
/// By light of `lights`, 1 where it lights a surface in view.
[[nodiscard]] std::vector<char> lights_in_view(const LightPlan& plan);
[[nodiscard]] LightsDrawn lights_drawn(const FileLights& lights, std::span<const char> in_view);
/// One line.
[[nodiscard]] std::string to_string(const LightsDrawn& lights);

/// The pool has the texels that the maps of one sun would have by these options, in maps up to their size.
/// All maps are of the frame that is planned.
[[nodiscard]] LightOptions pool_options(const PlanOptions& plan);
/// What the plan refuses, and of which light; empty where it refuses nothing.
[[nodiscard]] std::string refused_light(const LightPlan& plan,
                                        const std::vector<render::PooledLight>& lights);

}  // namespace gnomon::tool
