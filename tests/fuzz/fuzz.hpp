// What every fuzz target uses: a promise that is checked in each build, and bytes taken apart into values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::fuzz {

/// Stops the fuzzer, which then keeps the input. Unlike assert() it stands in every build.
inline void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

/// What a user is told is one line, whatever stood in the file.
inline void require_one_line(std::string_view text) {
  require(!text.empty(), "a refusal says why");
  for (const char c : text) require(c != '\n' && c != '\r' && c != '\0' && c != '\x1b', "one printable line");
}

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Where files lie that the input names; empty: nowhere, as with made-up bytes.
inline std::string& folder_of_input() {
  static std::string folder;
  return folder;
}

/// Takes values off the front of the input; zeros where it has ended.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}
  [[nodiscard]] bool empty() const { return left_.empty(); }
  template <class T>
  T take() {
    T value{};
    const std::size_t size = left_.size() < sizeof(T) ? left_.size() : sizeof(T);
    std::memcpy(&value, left_.data(), size);
    left_ = left_.subspan(size);
    return value;
  }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace gnomon::fuzz
