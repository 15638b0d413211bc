// Random and extreme input of make_plan from a number alone: the same bits for every compiler and C library.
#pragma once

#include <cstdint>
#include <vector>

#include "gnomon/gnomon.hpp"

namespace gnomon::test {

/// SplitMix64 (Steele, Lea, Flood 2014): one number of state, any seed serves.
class SeededNumbers {
 public:
  explicit SeededNumbers(std::uint64_t seed) : state_(seed) {}
  [[nodiscard]] std::uint64_t bits();
  [[nodiscard]] double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  [[nodiscard]] double between(double low, double high) { return low + (high - low) * unit(); }
  /// 2 to a power between these.
  [[nodiscard]] double power_of_two(double low, double high);
  /// One of 0 ... count - 1.
  [[nodiscard]] int pick(int count) { return static_cast<int>(unit() * count); }
  [[nodiscard]] bool chance(double share) { return unit() < share; }
  [[nodiscard]] glm::dvec3 vector() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

 private:
  std::uint64_t state_;
};

/// Input of make_plan with its memory. Not to be copied: the options refer to it.
struct SeededInput {
  Camera camera;
  Light light;
  std::vector<Box> casters, receivers;
  VisibleDepths depths;
  const VisibleDepths* visible = nullptr;  // the depths, or none
  PlanOptions options;

  SeededInput() = default;
  SeededInput(const SeededInput&) = delete;
  SeededInput& operator=(const SeededInput&) = delete;
  [[nodiscard]] SceneBounds bounds() const { return {casters, receivers}; }
  [[nodiscard]] ShadowPlan plan() const { return make_plan({camera, visible}, light, bounds(), options); }
};

/// How far a case may go.
enum class Extremes : std::uint8_t {
  ordinary,  ///< what scenes are like: ratios up to 1e5, every option
  stiff,  ///< everything make_plan accepts: depth ratios to 1e11, fields of view from 0.01 to 179.9 degrees,
          ///< lights along the view to 1e-300, units of 1e-9 to 1e9, flat, single-point and empty scenes
};

/// The plans of a hash: every third one by Objective::picture, which laws over volumes do not draw.
inline void choose_picture(int plan, SeededInput& input) {
  if (plan % 3 == 2) input.options.warp.objective = Objective::picture;
}
/// Fills `input` with case number `seed`: any light, camera, fit, split, partition, warp and objective.
void seed_input(std::uint64_t seed, Extremes extremes, SeededInput& input);

}  // namespace gnomon::test
