// Filters at their limits: depth ranges, kernels, exponents and map sizes at which numbers run out.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "filter_harness.hpp"
#include "rows.hpp"

namespace gnomon::stress {

/// One thing that is driven to its limits.
struct FilterStrain {
  std::string_view name, label;
  std::vector<double> values;
  std::vector<std::string> filters;  ///< as parse_filter reads them
  /// What is asked at a value.
  struct Trial {
    render::FilterSettings settings;
    render::TestMap map;
    std::vector<render::Question> questions;
  };
  Trial (*at)(const std::string& filter, double value) = nullptr;
};
[[nodiscard]] std::span<const FilterStrain> filter_strains();

/// The shader against the reference in double without any rounding. Needs a current context.
[[nodiscard]] std::vector<FilterRow> sweep_filters(const FilterStrain& strain,
                                                   const std::function<void()>& step = {});

}  // namespace gnomon::stress
