// One part of the receivers of parallel light, with a map of its own, and what several parts cost together.
#pragma once

#include <array>

#include "gnomon/plan.hpp"
#include "plan/cascades.hpp"

namespace gnomon {

/// Dividing must gain this much, or it would come and go with the last bits of the input.
inline constexpr double kLeastGain = 1e-3;

struct Part {
  Polytope body;
  std::array<Plane, kMaxSelectPlanes> plane;  // relative to the camera
  int plane_count = 0;
  int index = 0;
  LightFrame frame;
  const Warp* warp;
  double begin, end;       // view depths
  double objective = 0.0;  // of its map alone
};

struct Parts {
  std::array<Part, kMaxMaps> part;
  int count = 0;
  double objective = 0.0;
  bool no_place = false;   // a plane was looked for, and none has both maps equally dense
  bool most_maps = false;  // more slices of faces would lower the objective, and there is no map for them
  int fewest_slices = 0;   // that a face has which could be divided further
};

[[nodiscard]] MapRequest request_of(const Part& part) noexcept;
/// Cuts the part's depths to its body's.
void narrow_depths(const PlanContext& c, Part& part) noexcept;
/// Adds what of `body` is inside the part's planes, where anything is.
void add_part(const PlanContext& c, const Polytope& body, Part part, Parts& parts) noexcept;

}  // namespace gnomon
