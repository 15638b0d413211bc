// Output that can fail, on standard output or in files: a plan that did not arrive must not look like
// success.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::tool {

/// Writes `text` and a newline. Throws std::runtime_error where the reader is gone or the disk is full.
void print_line(std::string_view text);
/// Hands everything written so far to the system; throws like print_line().
void flush_output();

/// Throws std::runtime_error where the folder that `option` names is not there and cannot be made, or takes
/// no files. Makes nothing.
void check_folder(const std::string& option, const std::filesystem::path& folder);
/// Throws std::runtime_error where the file that `option` names lies in no such folder, is a folder, or is
/// one of `kept`, under whatever name; empty names count as none.
void check_file(const std::string& option, const std::filesystem::path& file,
                const std::vector<std::filesystem::path>& kept = {});
/// Makes the folder that `option` names, and those above it. Throws std::runtime_error.
void make_folder(const std::string& option, const std::filesystem::path& folder);
/// The file as a whole, or as it was before. Throws std::runtime_error.
void write_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace gnomon::tool
