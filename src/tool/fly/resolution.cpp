// How large must the maps be for the filter to hide their texels?
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "flight.hpp"
#include "gnomon/render/perceptual.hpp"
#include "scene_rays.hpp"

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

/// What one warp takes.
struct Needed {
  int size = 0;            ///< texels along a side, at most the given size
  HidingMapSize widest;    ///< of the frame whose kernels are widest on the screen
  int bounded_frame = -1;  ///< the first frame whose texels even the given size shows; -1: none
};

class Judge {
 public:
  Judge(const Options& options, const Flight& flight, const SceneRays& rays)
      : options_(options),
        flight_(flight),
        light_(light_of(options, flight.scene)),
        distances_(distances_of(options, flight, light_)) {
    for (int frame = 0; frame < options.frames; ++frame) {
      cameras_.push_back(camera_of(options, flight, frame));
      points_.push_back(rays.points(cameras_.back(), light_));
    }
  }

  [[nodiscard]] Needed size_with(const Warp* warp) const {
    PlanOptions plan_options = options_.plan;
    plan_options.warp.warp = warp;
    const int given = plan_options.resolution.max_size;
    // Smaller maps are all border.
    const int least = static_cast<int>(std::ceil(4.0 * plan_options.filter.texels));
    Needed needed;
    needed.size = std::min(std::max(least, kLeastMapSize), given);
    for (int frame = 0; frame < options_.frames; ++frame)
      needed.size = std::max(needed.size, std::min(asked(frame, plan_options).map_size, given));
    for (int frame = 0; frame < options_.frames; ++frame) {
      // Plans of another size have another border, and may have another warp: asked until they agree. Each
      // turn grows the maps, so that this ends.
      HidingMapSize answer;
      plan_options.resolution.max_size = needed.size;
      while ((answer = asked(frame, plan_options)).map_size > needed.size && needed.size < given) {
        needed.size = std::min(answer.map_size, given);
        plan_options.resolution.max_size = needed.size;
      }
      if (answer.map_size > given && needed.bounded_frame < 0) needed.bounded_frame = frame;
      if (answer.radius_pixels > needed.widest.radius_pixels) needed.widest = answer;
    }
    return needed;
  }

 private:
  /// Throws where the kernel hides nothing.
  [[nodiscard]] HidingMapSize asked(int frame, const PlanOptions& plan_options) const {
    const auto at = static_cast<std::size_t>(frame);
    const ShadowPlan plan = make_plan(cameras_[at], light_, flight_.bounds(), plan_options);
    const HidingMapSize answer =
        points_[at].empty() ? hiding_map_size(plan, cameras_[at], options_.filter, distances_)
                            : hiding_map_size(plan, cameras_[at], options_.filter, distances_, points_[at]);
    // Narrower than a pixel, a kernel hides nothing: what it would want is maps of one texel a pixel.
    if (answer.radius_pixels >= 1.0) return answer;
    throw std::runtime_error(
        fmt::format("--resolution perceptual: frame {}: a kernel of {:.3g} world units is {:.3g} pixels wide "
                    "where it is widest, and hides no texel; widen the kernel",
                    frame, answer.radius_world, answer.radius_pixels));
  }

  const Options& options_;
  const Flight& flight_;
  Light light_;
  ShadowDistances distances_;
  std::vector<Camera> cameras_;
  std::vector<std::vector<glm::dvec3>> points_;
};

}  // namespace

void choose_perceptual_maps(Options& options, const Flight& flight) {
  const SceneRays rays(flight.scene);
  const Judge judge(options, flight, rays);
  const int given = options.plan.resolution.max_size;
  Needed needed = judge.size_with(options.plan.warp.warp);
  bool dropped = false;
  if (options.plan.warp.warp != &warps::none) {
    // A warp makes texels small where the view is near, and longer elsewhere.
    const Needed unwarped = judge.size_with(&warps::none);
    dropped = unwarped.size < needed.size || (needed.bounded_frame >= 0 && unwarped.bounded_frame < 0);
    if (dropped) {
      needed = unwarped;
      options.plan.warp.warp = &warps::none;
    }
  }
  options.plan.resolution.max_size = needed.size;
  if (options.json) return;
  fmt::print("maps:     {0}x{0} texels{1}, hidden by kernels of {2:.3g} world units, up to {3:.3g} pixels\n",
             needed.size, dropped ? " without the warp" : "", needed.widest.radius_world,
             needed.widest.radius_pixels);
  if (needed.bounded_frame >= 0)
    fmt::print("          --map-size {} is too small to hide all texels, first in frame {}\n", given,
               needed.bounded_frame);
}

}  // namespace gnomon::tool::fly
