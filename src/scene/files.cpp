// Which bytes may a scene read? Its own file and regular files in its own folder; nothing else, by any
// spelling.
#include "files.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "base/bounded_file.hpp"
#include "refusal.hpp"

namespace gnomon::detail {

namespace fs = std::filesystem;

namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// A percent sign that starts no escape stands for itself, as browsers read it.
std::string percent_decode(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
      out.push_back(static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
      i += 2;
    } else {
      out.push_back(text[i]);
    }
  }
  return out;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

Bytes base64_decode(std::string_view text) {
  Bytes out;
  out.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=' || std::isspace(static_cast<unsigned char>(c)) != 0) continue;
    const int digit = base64_digit(c);
    if (digit < 0) throw std::runtime_error("data URI holds a character that is not base64");
    bits = (bits << 6) | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held >= 8) {
      held -= 8;
      out.push_back(static_cast<std::uint8_t>((bits >> held) & 0xffu));
    }
  }
  return out;
}

Bytes decode_data_uri(std::string_view uri) {
  const auto comma = uri.find(',');
  if (comma == std::string_view::npos) throw std::runtime_error("data URI without a comma");
  const std::string_view head = uri.substr(0, comma), body = uri.substr(comma + 1);
  constexpr std::string_view kBase64 = ";base64";
  const bool base64 = head.size() >= kBase64.size() && head.substr(head.size() - kBase64.size()) == kBase64;
  const std::string decoded = body.find('%') == std::string_view::npos ? std::string() : percent_decode(body);
  const std::string_view plain = decoded.empty() ? body : std::string_view(decoded);
  return base64 ? base64_decode(plain) : Bytes(plain.begin(), plain.end());
}

bool has_scheme(std::string_view uri) {
  const auto colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
  });
}

// Throws where the path is not one that can only lead downwards.
fs::path checked_relative_path(std::string_view uri) {
  if (has_scheme(uri)) throw std::runtime_error("URI scheme is not supported: " + std::string(uri));
  std::string text = percent_decode(uri);
  if (text.empty()) throw std::runtime_error("URI is empty");
  if (text.find('\0') != std::string::npos) throw std::runtime_error("URI holds a zero byte");
  // Windows exporters write backslashes; reading them as separators before the checks also closes that way
  // out.
  std::replace(text.begin(), text.end(), '\\', '/');
  const fs::path path(text);
  if (path.is_absolute() || has_scheme(text)) throw std::runtime_error("URI is an absolute path: " + text);
  for (const fs::path& part : path) {
    if (part == "..") throw std::runtime_error("URI leads out of the scene's folder: " + text);
  }
  return path;
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return end == folder.end() && rest != file.end();
}

}  // namespace

Bytes read_regular_file(const fs::path& file, std::uint64_t max_bytes) {
  Bytes bytes;
  const std::string why = read_bounded_file(file, max_bytes, Readable::regular_file, bytes);
  if (!why.empty()) throw std::runtime_error(why);
  return bytes;
}

SceneFolder::SceneFolder(const fs::path& folder, std::uint64_t file_bytes, std::uint64_t total_bytes)
    : file_bytes_(file_bytes), budget_(total_bytes) {
  if (!folder.empty()) folder_ = fs::canonical(folder);
}

Bytes SceneFolder::read(std::string_view uri) {
  Bytes bytes;
  if (uri.starts_with("data:")) {
    bytes = decode_data_uri(uri);
  } else {
    const fs::path relative = checked_relative_path(uri);
    if (folder_.empty()) throw std::runtime_error("a scene in memory has no files: " + std::string(uri));
    std::error_code error;
    const fs::path file = fs::canonical(folder_ / relative, error);
    if (error) throw std::runtime_error("'" + relative.string() + "' cannot be read: " + error.message());
    if (!lies_in(file, folder_)) {
      throw std::runtime_error("'" + relative.string() + "' is a link out of the scene's folder");
    }
    try {
      bytes = read_regular_file(file, std::min(file_bytes_, budget_));
    } catch (const std::runtime_error& e) {
      throw std::runtime_error("'" + relative.string() + "' " + e.what());
    }
  }
  if (bytes.size() > budget_) throw std::runtime_error("all files together exceed the limit");
  budget_ -= bytes.size();
  hash_ = fnv_of(bytes, hash_);
  return bytes;
}

}  // namespace gnomon::detail
