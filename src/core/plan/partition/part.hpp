// A part of the receivers, and how its map is weighed: what every way to divide them shares.
#pragma once

#include <array>
#include <limits>

#include "geometry/body.hpp"
#include "gnomon/plan.hpp"
#include "plan/cascades.hpp"

namespace gnomon::partition {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Dividing must gain this much, or it would come and go with the last bits of the input.
constexpr double kLeastGain = 1e-3;

/// A part, without its body: bodies are long, and are cut anew where they are needed.
struct Part {
  std::array<Plane, kMaxSelectPlanes> plane;  // relative to the camera
  int plane_count = 0;
  int index = 0;
  LightFrame frame;
  const Warp* warp;
  double begin, end;       // view depths
  double objective = 0.0;  // of its map alone
};

/// What the maps of some parts come to.
struct PartsSum {
  int count = 0;
  double objective = 0.0;
};

struct Parts {
  std::array<Part, kMaxMaps> part;
  PartsSum sum;             // of the parts, so many of which are used
  bool no_balance = false;  // a plane was looked for, and none has both maps equally dense
  bool most_maps = false;   // more slices of faces would lower the objective, and there is no map for them
  int fewest_slices = 0;    // that a face has which could be divided further
};

/// What is asked of the map of `body`, the part's.
MapRequest request_of(const Part& part, const Polytope& body) noexcept;

/// What of `body` is inside the part's planes.
Polytope inside_of(const PlanContext& c, const Polytope& body, const Part& part) noexcept;

/// Cuts the part's depths to those of `body`.
void narrow_depths(const PlanContext& c, const Polytope& body, Part& part) noexcept;

/// Adds the part to what all of them come to, with the objective of its map, where anything of `body` is
/// inside its planes; false where nothing is. This and others are out of line: together they would take more
/// stack than any of them.
[[gnu::noinline]] bool weigh_part(const PlanContext& c, const Polytope& body, Part& part,
                                  PartsSum& sum) noexcept;

/// Adds what of `body` is inside the part's planes, where anything is.
bool add_part(const PlanContext& c, const Polytope& body, Part part, Parts& parts) noexcept;

/// Divides the body, whose view depths lie in [begin, end], among the faces that the light enters a
/// perspective camera's frustum by, or leaves it by, whichever set has the lower objective, and each side
/// face into at most SplitOptions::face_slices.
[[gnu::noinline]] void frustum_faces(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                                     double begin, double end, Parts& parts) noexcept;

/// Divides the body, whose view depths lie in [begin, end], into at most PlanOptions::cascades clusters; one
/// where no division lowers the objective of unwarped maps.
[[gnu::noinline]] void receiver_clusters(const PlanContext& c, const ParallelScene& scene,
                                         const Polytope& body, double begin, double end,
                                         Parts& parts) noexcept;

/// The part before the plane where warping ends, and the one behind; none where nothing is warped.
[[gnu::noinline]] void separated_parts(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                                       double begin, double end, Parts& parts) noexcept;

}  // namespace gnomon::partition
