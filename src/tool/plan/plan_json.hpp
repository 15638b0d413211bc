// A shadow plan as JSON: the output format of `gnomon plan`.
#pragma once

#include <glm/mat4x4.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "gnomon/casefile/casefile.hpp"

namespace gnomon::tool {

/// Keeps the keys in the order they are written.
using Json = nlohmann::ordered_json;

/// Numbers read back exactly. What is infinite (the error where no map holds a visible point) is null; throws
/// std::logic_error for NaN, which no plan may hold.
[[nodiscard]] Json plan_json(const ShadowPlan& plan, const Case& input);

// Parts of it that other plans print as well.
[[nodiscard]] Json number(double value);
[[nodiscard]] Json rows_of(const glm::dmat4& matrix);
[[nodiscard]] Json omitted_json(std::span<const Omission> omitted);
[[nodiscard]] const char* reason_of(PlanStatus status);

/// The error of one logarithmic perspective map for this case; null where there is none (a light with a
/// position, nothing in view).
[[nodiscard]] Json log_perspective_json(const Case& input);

/// On several lines, indented; lists of numbers stay on one line, so that a matrix looks like one.
[[nodiscard]] std::string pretty_text(const Json& value);

}  // namespace gnomon::tool
