// Cases for tests: the project's own files, and a small one to change.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gnomon::test {

using nlohmann::json;

/// The files of tests/data/cases, sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> case_files();

/// A plain case that plans ok: a viewer before a 20 x 20 floor with one caster on it.
[[nodiscard]] json base_case();

/// The base case with one value set ("/camera/near") or, for a null `value`, removed.
[[nodiscard]] json base_case_with(const std::string& pointer, const json& value);

}  // namespace gnomon::test
