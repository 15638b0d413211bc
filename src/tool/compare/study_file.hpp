// A whole study in one file: which techniques are measured on which views?
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare.hpp"

namespace gnomon::tool {

/// The options of a request, bound to it.
using OptionsOf = std::function<std::vector<Option>(CompareRequest&)>;

/// True for a word that names such a file: it ends in ".json", which no scene does.
[[nodiscard]] bool is_study_file(const std::string& word);

/// True for options that stand beside a study on the command line: where results go, and on what they are
/// measured.
[[nodiscard]] bool stands_beside_study(const std::string& option);

/// One request for each of the file's views. Its fields are options by their names without dashes, with _ in
/// place of -, and `scenes`; a view's come before those of the file. Where results go, and how, are those of
/// `line`, the command line's. Throws std::runtime_error with file and field in front.
[[nodiscard]] std::vector<CompareRequest> read_study(const std::filesystem::path& file,
                                                     const CompareRequest& line, const OptionsOf& options_of);

/// The same of a text that stands in the program; `name` stands in front of messages.
[[nodiscard]] std::vector<CompareRequest> study_from(std::string_view text, const std::string& name,
                                                     const CompareRequest& line, const OptionsOf& options_of);

}  // namespace gnomon::tool
