// How does a struct grow without breaking programs that were compiled against an older header? Its first
// field is its size: what an older one lacks keeps its default, and nothing is written beyond it.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "gnomon/c/gnomon.h"

namespace gnomon::c {

/// Of each struct that grows: its name in messages, and its size in the first version that had it.
template <typename T>
struct Sized;

#define GNOMON_C_SIZED(type, text, first_size)              \
  template <>                                               \
  struct Sized<type> {                                      \
    static constexpr const char* kName = text;              \
    static constexpr const char* kSizeName = text ".size";  \
    static constexpr std::uint32_t kFirstSize = first_size; \
  }
// A struct that has grown keeps the size that it had here, as a number.
GNOMON_C_SIZED(gnomon_camera, "camera", sizeof(gnomon_camera));
GNOMON_C_SIZED(gnomon_light, "light", sizeof(gnomon_light));
GNOMON_C_SIZED(gnomon_scene, "scene", sizeof(gnomon_scene));
GNOMON_C_SIZED(gnomon_view, "view", sizeof(gnomon_view));
GNOMON_C_SIZED(gnomon_plan_options, "plan_options", sizeof(gnomon_plan_options));
GNOMON_C_SIZED(gnomon_map, "map", sizeof(gnomon_map));
GNOMON_C_SIZED(gnomon_plan, "plan", sizeof(gnomon_plan));
GNOMON_C_SIZED(gnomon_measure_options, "measure_options", sizeof(gnomon_measure_options));
GNOMON_C_SIZED(gnomon_stats, "stats", sizeof(gnomon_stats));
GNOMON_C_SIZED(gnomon_shadow_picture, "shadow_picture", sizeof(gnomon_shadow_picture));
GNOMON_C_SIZED(gnomon_page_options, "page_options", sizeof(gnomon_page_options));
GNOMON_C_SIZED(gnomon_page_plan, "page_plan", sizeof(gnomon_page_plan));
GNOMON_C_SIZED(gnomon_page_history, "page_history", sizeof(gnomon_page_history));
GNOMON_C_SIZED(gnomon_light_request, "light_request", sizeof(gnomon_light_request));
GNOMON_C_SIZED(gnomon_light_options, "light_options", sizeof(gnomon_light_options));
GNOMON_C_SIZED(gnomon_light_maps, "light_maps", sizeof(gnomon_light_maps));
GNOMON_C_SIZED(gnomon_light_plan, "light_plan", sizeof(gnomon_light_plan));
GNOMON_C_SIZED(gnomon_light_clusters, "light_clusters", sizeof(gnomon_light_clusters));

// Defaults: those of the C++ structs.
void set_defaults(gnomon_camera& to) noexcept;
void set_defaults(gnomon_light& to) noexcept;
void set_defaults(gnomon_scene& to) noexcept;
void set_defaults(gnomon_view& to) noexcept;
void set_defaults(gnomon_plan_options& to) noexcept;
void set_defaults(gnomon_map& to) noexcept;
void set_defaults(gnomon_plan& to) noexcept;
void set_defaults(gnomon_measure_options& to) noexcept;
void set_defaults(gnomon_stats& to) noexcept;
void set_defaults(gnomon_shadow_picture& to) noexcept;
void set_defaults(gnomon_page_options& to) noexcept;
void set_defaults(gnomon_page_plan& to) noexcept;
void set_defaults(gnomon_page_history& to) noexcept;
void set_defaults(gnomon_light_request& to) noexcept;
void set_defaults(gnomon_light_options& to) noexcept;
void set_defaults(gnomon_light_maps& to) noexcept;
void set_defaults(gnomon_light_plan& to) noexcept;
void set_defaults(gnomon_light_clusters& to) noexcept;

/// True where some version of this library had the struct in this size.
template <typename T>
[[nodiscard]] constexpr bool known_size(std::uint32_t size) noexcept {
  static_assert(std::is_trivially_copyable_v<T>);
  return size >= Sized<T>::kFirstSize && size <= sizeof(T);
}

/// nullptr where `*at` can be read and written, else the name of what is wrong.
template <typename T>
[[nodiscard]] const char* fault_of(const T* at) noexcept {
  if (at == nullptr) return Sized<T>::kName;
  return known_size<T>(at->size) ? nullptr : Sized<T>::kSizeName;
}

/// Copies `size` bytes from `from` into `to`, which holds defaults.
template <typename T>
void read_bytes(const void* from, std::uint32_t size, T& to) noexcept {
  std::memcpy(&to, from, size);
  to.size = sizeof(T);
}
/// Copies as much of `from` as a struct of `size` bytes holds.
template <typename T>
void write_bytes(const T& from, std::uint32_t size, void* to) noexcept {
  std::memcpy(to, &from, size);
  std::memcpy(to, &size, sizeof size);
}

/// The caller's struct, of which fault_of() found nothing: itself, or `older` with defaults for what it
/// lacks. Defaults and a copy of all structs of a plan would take longer than the rest of the way from C to
/// C++.
template <typename T>
[[nodiscard]] const T& whole(const T& from, T& older) noexcept {
  if (from.size == sizeof(T)) return from;
  set_defaults(older);
  read_bytes(&from, from.size, older);
  return older;
}
/// Copies the caller's struct; returns what is wrong with it.
template <typename T>
[[nodiscard]] const char* read(const T* from, T& to) noexcept {
  if (const char* fault = fault_of(from)) return fault;
  if (const T& all = whole(*from, to); &all != &to) to = all;
  return nullptr;
}
/// Writes to the caller's struct, of which fault_of() found nothing.
template <typename T>
void write(const T& from, T* to) noexcept {
  write_bytes(from, to->size, to);
}

/// What a _default() function does.
template <typename T>
[[nodiscard]] std::int32_t write_defaults(T* to, std::uint32_t size) noexcept {
  if (to == nullptr || !known_size<T>(size)) return GNOMON_INVALID_INPUT;
  T all;
  set_defaults(all);
  write_bytes(all, size, to);
  return GNOMON_OK;
}

/// What a call returns on bad input.
[[nodiscard]] inline std::int32_t refuse(const char* fault, const char** invalid_field) noexcept {
  if (invalid_field != nullptr) *invalid_field = fault;
  return GNOMON_INVALID_INPUT;
}
/// What a call returns otherwise.
[[nodiscard]] inline std::int32_t done(const char** invalid_field, std::int32_t status = GNOMON_OK) noexcept {
  if (invalid_field != nullptr) *invalid_field = nullptr;
  return status;
}

}  // namespace gnomon::c
