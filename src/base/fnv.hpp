// A number that changes with the bytes it stands for.
// FNV-1a: Fowler, Noll, Vo 1991, 64 bits.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon {

inline constexpr std::uint64_t kFnvBasis = 0xcbf29ce484222325ULL;

/// Of bytes that follow those that `before` stands for.
[[nodiscard]] inline std::uint64_t fnv_of(std::span<const std::uint8_t> bytes,
                                          std::uint64_t before = kFnvBasis) noexcept {
  std::uint64_t hash = before;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3ULL;
  return hash;
}
[[nodiscard]] inline std::uint64_t fnv_of(std::string_view text) noexcept {
  return fnv_of({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace gnomon
