// How large must the maps be for the filter to hide their texels?
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "flight.hpp"
#include "gnomon/render/perceptual.hpp"

namespace gnomon::tool::fly {
namespace {

using render::HidingMapSize;
using render::ShadowDistances;

ShadowDistances distances_of(const Options& options, const Flight& flight, const Light& light) {
  const Box& scene = flight.scene.bounds_world;
  ShadowDistances distances;
  distances.blocker_world =
      options.blocker_distance > 0.0 ? options.blocker_distance : 0.5 * (scene.max.y - scene.min.y);
  // Penumbras of a local light are narrowest at the end of its range.
  if (const auto* spot = std::get_if<SpotLight>(&light)) distances.light_world = spot->range;
  if (const auto* point = std::get_if<PointLight>(&light)) distances.light_world = point->range;
  return distances;
}

}  // namespace

int perceptual_map_size(const Options& options, const Flight& flight) {
  const Light light = default_light(options.light, flight.scene.bounds_world);
  const ShadowDistances distances = distances_of(options, flight, light);
  PlanOptions plan_options = options.plan;
  // Smaller maps are all border.
  const int least = static_cast<int>(std::ceil(4.0 * plan_options.filter.texels));
  const auto needed = [&](int frame) {
    const Camera camera = camera_of(options, flight, frame);
    return hiding_map_size(make_plan(camera, light, flight.bounds(), plan_options), camera, options.filter,
                           distances);
  };
  int size = std::max(least, kLeastMapSize);
  for (int frame = 0; frame < options.frames; ++frame) size = std::max(size, needed(frame).map_size);
  HidingMapSize widest;
  for (int frame = 0; frame < options.frames; ++frame) {
    // Plans of another size have another border, and may have another warp: asked until they agree. Each turn
    // grows the maps, so that this ends.
    HidingMapSize asked;
    for (plan_options.resolution.max_size = size; (asked = needed(frame)).map_size > size;
         plan_options.resolution.max_size = size)
      size = asked.map_size;
    if (!asked.hides) {
      throw std::runtime_error(fmt::format(
          "--resolution perceptual: frame {}: no map of up to {} texels has texels that a kernel of {:.3g} "
          "world units hides; widen the kernel, or take more cascades",
          frame, asked.map_size, asked.radius_world));
    }
    if (asked.radius_pixels > widest.radius_pixels) widest = asked;
  }
  if (!options.json)
    fmt::print("maps:     {0}x{0} texels, hidden by kernels of {1:.3g} world units, up to {2:.3g} pixels\n",
               size, widest.radius_world, widest.radius_pixels);
  return size;
}

}  // namespace gnomon::tool::fly
