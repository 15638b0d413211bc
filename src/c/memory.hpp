// Where do handles come from? malloc: with it, no program needs the C++ library.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>

namespace gnomon::c {

/// `count` objects as they are made by default, to be freed by std::free; nullptr where there is no memory.
template <typename T>
[[nodiscard]] T* new_array(std::size_t count) noexcept {
  static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= alignof(std::max_align_t));
  if (count > std::numeric_limits<std::size_t>::max() / 2 / sizeof(T)) return nullptr;
  // At least one, as malloc may return nullptr for none.
  T* const first = static_cast<T*>(std::malloc((count > 0 ? count : 1) * sizeof(T)));
  for (std::size_t i = 0; first != nullptr && i < count; ++i) new (first + i) T;
  return first;
}
template <typename T>
[[nodiscard]] T* new_object() noexcept {
  return new_array<T>(1);
}

}  // namespace gnomon::c
