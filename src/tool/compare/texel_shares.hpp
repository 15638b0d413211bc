// How do the local lights of a view share texels?
#pragma once

#include <cstddef>
#include <vector>

#include "gnomon/lights.hpp"
#include "sweep.hpp"

namespace gnomon::tool {

class TexelShares {
 public:
  TexelShares() = default;
  explicit TexelShares(const std::vector<Light>& lights);
  [[nodiscard]] const Light& light(std::size_t index) const { return requests_.at(index).light; }
  /// Options of one light's plan where plan_lights distributes as many texels as equal maps of the entry's
  /// size take in the pool; sizes are powers of two. Throws std::runtime_error where plan_lights refuses.
  [[nodiscard]] PlanOptions options_of(std::size_t index, const gnomon::View& view, const SceneBounds& bounds,
                                       const SweepEntry& entry) const;

 private:
  std::vector<LightRequest> requests_;
  mutable std::vector<std::byte> memory_;  ///< scratch
};

}  // namespace gnomon::tool
