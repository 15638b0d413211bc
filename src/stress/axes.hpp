// The axes along which a plan gets stiff, and what happens along them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "judge.hpp"

namespace gnomon::stress {

/// One quantity that is driven to its limits while everything else stays plain.
struct Axis {
  std::string_view name, label;
  bool logarithmic = true;
  /// About so many values, ascending, with the ones that matter most among them.
  std::vector<double> (*values)(int samples) = nullptr;
  /// Puts a plain input at this value. `turn` in [0, 1): where to, of what the axis leaves open.
  void (*apply)(double value, double turn, Input& input) = nullptr;
};
[[nodiscard]] std::span<const Axis> all_axes() noexcept;
/// nullptr where there is none of that name.
[[nodiscard]] const Axis* find_axis(std::string_view name) noexcept;

/// How a plan is asked for at each value.
struct Variant {
  std::string_view name;
  void (*apply)(PlanOptions& options) = nullptr;
};
[[nodiscard]] std::span<const Variant> all_variants() noexcept;

struct SweepOptions {
  int samples = 40;  ///< values per axis
  int scenes = 3;    ///< per value: a plain one and random ones
  std::uint64_t seed = 1;
};
/// All rows of an axis: per value, one of each variant. `step` is called after each value.
[[nodiscard]] std::vector<AxisRow> sweep(const Axis& axis, const SweepOptions& options,
                                         const std::function<void()>& step = {});

}  // namespace gnomon::stress
