// What does an eye see of some pieces of a scene? By points spread over their surfaces: a fixed cost, and
// right to a few percent.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/camera.hpp"
#include "view_subject.hpp"

namespace gnomon::detail {

struct SurfaceSample {
  glm::dvec3 at{0.0};      ///< relative to an origin
  glm::dvec3 normal{0.0};  ///< unit
  bool two_sided = false;
  std::uint32_t piece = 0;  ///< index among the pieces
};

/// Points spread by area, at most `count`, the same in every run.
[[nodiscard]] std::vector<SurfaceSample> surface_samples(const Scene& scene, const std::vector<Piece>& pieces,
                                                         const glm::dvec3& origin, int count);

/// The share of a picture that shows the surfaces.
[[nodiscard]] double covered_share(const std::vector<SurfaceSample>& samples, const Camera& camera);

/// What lies around a place, by direction.
struct Surroundings {
  static constexpr int kTurns = 24;  ///< parts of the horizon; part 0 begins at +Z, and turns towards +X
  double enclosed = 0.0;     ///< share of the directions from 20 degrees below the horizon up that meet a
                             ///< surface from its front
  double behind = 0.0;       ///< share that meet one from behind
  double nearest = 0.0;      ///< distance to any surface, world units
  double free[kTurns] = {};  ///< level distance to the nearest surface in each part, world units
};
[[nodiscard]] Surroundings surroundings(const std::vector<SurfaceSample>& samples, const glm::dvec3& at);

}  // namespace gnomon::detail
