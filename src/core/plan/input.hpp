// The contract at the API's edge.
#pragma once

#include <string_view>

#include "gnomon/plan.hpp"

namespace gnomon {

/// Name of the first input that breaks the contract of make_plan; empty where all is well.
[[nodiscard]] std::string_view first_invalid_field(const View& view, const Light& light,
                                                   const SceneBounds& bounds,
                                                   const PlanOptions& options) noexcept;

/// Name of the first list of `view` that holds a broken point or normal; empty where all is well.
[[nodiscard]] std::string_view first_invalid_points(const View& view) noexcept;

}  // namespace gnomon
