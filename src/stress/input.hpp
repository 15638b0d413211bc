// Input of make_plan with its memory, and random scenes to strain.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "gnomon/gnomon.hpp"

namespace gnomon::stress {

inline constexpr double kPi = std::numbers::pi;

/// Everything make_plan takes.
struct Input {
  Camera camera;
  Light light;
  std::vector<Box> casters, receivers;
  PlanOptions options;
  const VisibleDepths* visible = nullptr;
  [[nodiscard]] SceneBounds bounds() const noexcept { return {casters, receivers}; }
  [[nodiscard]] ShadowPlan plan() const noexcept {
    return make_plan({camera, visible}, light, bounds(), options);
  }
};

/// A flat world of 1 km round a camera 2 m above its ground, some towers, a sun at 20 to 80 degrees: nothing
/// in it is extreme. Near 0.1, far 1000, one receiver box. `seed` turns camera and sun; 0 is a plain one.
[[nodiscard]] Input plain_input(std::uint64_t seed);

/// A unit vector across `v`, turned by `angle_radians` about it.
[[nodiscard]] glm::dvec3 across(const glm::dvec3& v, double angle_radians);

}  // namespace gnomon::stress
