// JSON text from outside into a value, or one line that says what is wrong with it and where.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace gnomon {

/// Throws CaseError for text that is too long, nested too deep, no JSON, or names a key twice in one object.
[[nodiscard]] nlohmann::json parse_json(std::string_view text);

}  // namespace gnomon
