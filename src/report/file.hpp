// Whole files in and out, with errors that name them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon::report {

/// Throws ReportError: one line that names the file or folder.
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why);
/// The most that read_text takes unless told otherwise: half a million rows.
inline constexpr std::uint64_t kMaxTextBytes = 1ull << 30;
/// Of a regular file of at most `max_bytes`; devices and pipes are refused without waiting for them. Throws
/// ReportError.
[[nodiscard]] std::string read_text(const std::filesystem::path& file,
                                    std::uint64_t max_bytes = kMaxTextBytes);
/// The same, of a PNG of at most 64 MiB: what rows call a picture must look like one before it is copied or
/// shown.
[[nodiscard]] std::string read_picture(const std::filesystem::path& file);
/// Empty where there is no such file. Throws ReportError where it cannot be read.
[[nodiscard]] std::string optional_text(const std::filesystem::path& file);
/// Written beside the target first, then renamed. Throws ReportError.
void write_text(const std::filesystem::path& file, const std::string& text);
/// Throws ReportError.
void make_folder(const std::filesystem::path& folder);
/// `name` below `folder`. Throws ReportError where the name, or a link on its way, leads out of it.
[[nodiscard]] std::filesystem::path inside(const std::filesystem::path& folder, const std::string& name);

}  // namespace gnomon::report
