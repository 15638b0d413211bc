// Whole files in and out, with errors that name them.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::report {

/// Throws ReportError.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);
/// Written beside the target first, then renamed. Throws ReportError.
void write_text(const std::filesystem::path& file, const std::string& text);
/// Throws ReportError.
void make_folder(const std::filesystem::path& folder);
/// `name` below `folder`. Throws ReportError where the name leads out of it.
[[nodiscard]] std::filesystem::path inside(const std::filesystem::path& folder, const std::string& name);

}  // namespace gnomon::report
