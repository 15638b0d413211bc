// Makes a case that fails as small as it can be and still fail.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

namespace gnomon::stress {

/// The smallest case found that `fails` (which is called at most `most_tries` times, and first with `value`
/// itself taken as failing): without boxes, objects and options that do not matter, and with round numbers.
[[nodiscard]] nlohmann::ordered_json shrink_case(
    const nlohmann::ordered_json& value, const std::function<bool(const nlohmann::ordered_json&)>& fails,
    int most_tries = 1500);

}  // namespace gnomon::stress
