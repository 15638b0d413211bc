// Where do the arrays of a call lie in the one block of memory that its caller gives?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace gnomon {

/// Every array begins at a multiple of it.
inline constexpr std::size_t kMemoryAlignment = 16;
/// Bytes beyond those of the arrays: a block may begin anywhere, and its size alone decides what it holds.
inline constexpr std::size_t kMemorySlack = kMemoryAlignment - 1;

/// Bytes of an array.
template <typename T>
[[nodiscard]] constexpr std::size_t memory_of(std::size_t count) noexcept {
  return (count * sizeof(T) + kMemoryAlignment - 1) / kMemoryAlignment * kMemoryAlignment;
}

/// Deals out a block, array by array. The caller has checked that it is large enough.
class MemoryParts {
 public:
  explicit MemoryParts(std::span<std::byte> memory) noexcept
      : at_(memory.data() + (0 - reinterpret_cast<std::uintptr_t>(memory.data())) % kMemoryAlignment) {}

  /// Records as the memory left them: to be written before they are read.
  template <typename T>
  [[nodiscard]] std::span<T> take(std::size_t count) noexcept {
    static_assert(alignof(T) <= kMemoryAlignment && std::is_trivially_destructible_v<T>);
    T* const first = reinterpret_cast<T*>(at_);
    at_ += memory_of<T>(count);
    return {first, count};
  }

 private:
  std::byte* at_;
};

}  // namespace gnomon
