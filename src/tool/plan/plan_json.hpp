// A shadow plan as JSON: the output format of `gnomon plan`.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "gnomon/casefile/casefile.hpp"

namespace gnomon::tool {

/// Keeps the keys in the order they are written.
using Json = nlohmann::ordered_json;

/// Numbers read back exactly. What is infinite (the error where no map holds a visible point) is null; throws
/// std::logic_error for NaN, which no plan may hold.
[[nodiscard]] Json plan_json(const ShadowPlan& plan, const Case& input);

/// The error of one logarithmic perspective map for this case; null where there is none (a light with a
/// position, nothing in view).
[[nodiscard]] Json log_perspective_json(const Case& input);

/// On several lines, indented; lists of numbers stay on one line, so that a matrix looks like one.
[[nodiscard]] std::string pretty_text(const Json& value);

}  // namespace gnomon::tool
