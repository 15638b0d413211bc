// How a shadow map is read: what a filter stores in a texel, how it answers "lit or not", and what it costs.
// One entry of the registry filters.def.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>

namespace gnomon::render {

/// What a filter may be told. One struct for all: a filter reads what concerns it.
struct FilterParameters {
  /// Half width of the kernel in texels, 0..4: the kernel is 2 * round(radius) + 1 texels wide. Wider is
  /// softer, hides more of the texels, and costs more reads.
  double radius_texels = 1.0;
};

/// What a texel of the map a filter reads is made of.
enum class TexelFormat : std::uint8_t {
  depth32f,  ///< the depth map itself, as it was rasterized: nothing is stored besides
};

/// Depths and values of one texel; channels beyond Filter::channels are unused.
using StoredTexel = std::array<double, 4>;

/// A point to be looked up, in the map's own units.
struct FilterLookup {
  /// The stored texel at column x, row y; both may lie outside the map, where everything is lit.
  std::function<StoredTexel(int x, int y)> texel;
  glm::dvec2 position{0.0};        ///< in texels: the centre of texel i is at i + 0.5
  double depth = 0.0;              ///< of the receiver, 0 near the light .. 1, bias already taken off
  glm::dvec2 depth_gradient{0.0};  ///< change of the receiver plane's depth per texel along x and y
};

/// A filter is data and functions; the shader file of the same name holds the same two formulas, and a test
/// compares them.
struct Filter {
  std::string_view name;
  std::string_view summary;  ///< one line
  std::string_view source;   ///< paper or book
  TexelFormat format = TexelFormat::depth32f;
  int channels = 1;         ///< of a stored texel
  int bytes_per_texel = 4;  ///< of everything that is stored, the depth map included
  bool may_blur = false;    ///< blurring the stored texels blurs the shadow
  bool may_mipmap = false;
  bool may_anisotropic = false;
  /// How far from the point the lookup reads, in texels: what PlanOptions::filter_radius_texels must be.
  double (*reach_texels)(const FilterParameters& parameters) noexcept = nullptr;
  /// Reference of the shader's shadow_store.
  StoredTexel (*store)(double depth, const FilterParameters& parameters) noexcept = nullptr;
  /// Reference of the shader's shadow_visibility: 1 lit .. 0 in shadow.
  double (*visibility)(const FilterLookup& lookup, const FilterParameters& parameters) = nullptr;
};

/// All filters, in the order of filters.def.
[[nodiscard]] std::span<const Filter* const> all_filters() noexcept;
/// nullptr where there is none of that name.
[[nodiscard]] const Filter* find_filter(std::string_view name) noexcept;

namespace filters {
#define GNOMON_FILTER(name) extern const Filter name;
#include "gnomon/render/filters.def"
#undef GNOMON_FILTER
}  // namespace filters

}  // namespace gnomon::render
