// The registry of warps, and the error of a warp over a body.
#include "warp/registry.hpp"

#include <array>

#include "geometry/vector.hpp"

namespace gnomon {
namespace {

constexpr std::array kWarps = {
#define GNOMON_WARP(name) &warps::name,
#include "gnomon/extend/light_space.hpp"
#include "gnomon/extend/warp.hpp"
#include "gnomon/warps.def"
#undef GNOMON_WARP
};

constexpr std::array<std::string_view, 4> kObjectiveNames = {"storage", "max", "p95", "picture"};

}  // namespace

std::span<const Warp* const> all_warps() noexcept {
  return kWarps;
}

const Warp* find_warp(std::string_view name) noexcept {
  for (const Warp* warp : kWarps) {
    if (warp->name == name) return warp;
  }
  return nullptr;
}

bool is_unwarped(const Warp& warp) noexcept {
  return &warp == &warps::none;
}

bool is_searched(const Warp& warp) noexcept {
  return &warp == &warps::optimal || &warp == &warps::optimal_thorough;
}

std::string_view to_string(Objective objective) noexcept {
  return kObjectiveNames[static_cast<std::size_t>(objective)];
}

bool objective_from_name(std::string_view name, Objective& objective) noexcept {
  for (std::size_t i = 0; i < kObjectiveNames.size(); ++i) {
    if (kObjectiveNames[i] != name) continue;
    objective = static_cast<Objective>(i);
    return true;
  }
  return false;
}

LightLinear light_linear(const LightSpace& light, const glm::dvec3& slope, double offset) noexcept {
  if (!light.perspective) return {slope, offset};
  const double at_light = slope.x * light.apex.x + slope.y * light.apex.y + slope.z * light.apex.z + offset;
  return {{slope.x, slope.y, at_light}, -slope.z};
}

WarpError warp_error(const WarpInput& input, double kappa) noexcept {
  double left = 0.0, right = 0.0, w_over_z = 0.0, w2_over_z = 0.0;
  bool first = true;
  for (const WarpInput::Point& p : input.body) {
    const double w = 1.0 + kappa * (p.y - input.y_min);
    const double x = (p.x - input.centre) / w;
    const double r = w / p.depth;
    left = first ? x : min_of(left, x);
    right = first ? x : max_of(right, x);
    first = false;
    w_over_z = max_of(w_over_z, r);
    w2_over_z = max_of(w2_over_z, w * r);
  }
  const double length = input.y_max - input.y_min;
  return {(right - left) * w_over_z, length / (1.0 + kappa * length) * w2_over_z};
}

}  // namespace gnomon
