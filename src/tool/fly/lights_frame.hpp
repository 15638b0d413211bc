// All lights of a scene's file over one flight: what each frame plans and draws, and what is left out.
#pragma once

#include <string>

#include "all_lights.hpp"
#include "flight.hpp"
#include "gnomon/render/renderer.hpp"
#include "report.hpp"

namespace gnomon::tool::fly {

/// Why the options cannot draw all lights of a file, a line that begins with the option; empty: they can.
[[nodiscard]] std::string all_lights_refusal(const Options& options);
/// Halves the maps until memory takes the pool of all lights, and says so. A context must be current. Throws
/// std::runtime_error where not even the least fit.
void fit_pool_to_memory(Options& options);

/// The lights of one flight.
class AllLights {
 public:
  /// Throws as file_lights() does.
  explicit AllLights(const Scene& scene) : lights_(file_lights(scene)) {}
  /// Plans a frame and draws nothing. Throws std::runtime_error where the plan refuses a light.
  void check(const Options& options, const Flight& flight, const Camera& camera) const;
  /// Draws a frame, and lowers the exposure of all frames to what it needs. Ahead of the flight, for some of
  /// its frames.
  void expose(const Options& options, const Flight& flight, const Camera& camera, render::Renderer& renderer,
              const render::PreparedFilter& filter);
  /// Draws a frame; the picture is the renderer's. `filter`: prepared for Source::lights.
  [[nodiscard]] FrameRow draw(const Options& options, const Flight& flight, const Camera& camera,
                              render::Renderer& renderer, const render::PreparedFilter& filter) const;
  /// Over all frames: a light is in view where one of them shows it.
  [[nodiscard]] LightsDrawn drawn(const std::vector<FrameRow>& rows) const;

 private:
  FileLights lights_;
  double exposure_ = 0.0;  ///< 0: no frame had light
};

}  // namespace gnomon::tool::fly
