// How is a shadow map read? A filter's stored texels, its visibility and its cost.
// One entry of the registry filters.def.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>

#include "gnomon/plan.hpp"
#include "gnomon/study/bias.hpp"

namespace gnomon::render {

struct Filter;

inline constexpr std::size_t kMaxFilterOptions = 16;  ///< those that a filter sets for itself included
inline constexpr std::size_t kMaxChannels = 32;   ///< 8 images of 4, what every driver can draw into at once
inline constexpr double kMaxRadiusTexels = 32.0;  ///< of a kernel
inline constexpr double kMaxRadiusWorld = 1.0e6;
inline constexpr int kMaxAnisotropy = 16;

/// A number that one filter alone understands. A switch is a number, too.
struct FilterOption {
  std::string_view name;        ///< as on command lines
  double fallback = 0.0;        ///< the default
  double min = 0.0, max = 1.0;  ///< both ends included
  std::string_view summary;     ///< one line, with the unit
  bool whole = false;           ///< settle_options() rounds it
};

/// Number format of a channel of a stored texel.
/// nonlinear16: as unorm16, and the filter stores other numbers, whose means are nothing
/// (FilterReference::pack).
enum class TexelFormat : std::uint8_t { fp32, fp16, unorm16, unorm8, uint32, nonlinear16 };
[[nodiscard]] std::string_view to_string(TexelFormat format) noexcept;
[[nodiscard]] int bytes_per_channel(TexelFormat format) noexcept;
/// True where only numbers in [0, 1] can be stored.
[[nodiscard]] bool is_unsigned_unit(TexelFormat format) noexcept;
/// Largest error of storing a number in [-1, 1] (unorm: [0, 1]): half a step at 1. uint32 counts as fp32,
/// which the sums are converted to.
[[nodiscard]] double rounding_of(TexelFormat format) noexcept;
/// The number as it comes back out of a texel. Floats overflow to infinity, unorm is clamped to [0, 1].
[[nodiscard]] double rounded_to(TexelFormat format, double value) noexcept;

enum class KernelUnit : std::uint8_t {
  texels,  ///< of the map that serves the point: narrow close to the camera, wide far from it
  world,   ///< across the light, world units: the same blur on the ground in every cascade and under every
           ///< warp
};
enum class BlurShape : std::uint8_t { box, gauss };

/// A filter with its settings. Made by default_settings or parse_filter.
struct FilterSettings {
  const Filter* filter = nullptr;  ///< never nullptr in what parse_filter understood
  /// Half width of the kernel. In texels, the kernel is a box of 2 radius + 1 texels (0: the single texel, or
  /// the hardware's 2 x 2). In world units, it has the variance of a disc of this radius.
  double radius = 1.0;
  KernelUnit unit = KernelUnit::texels;  ///< of `radius`
  BlurShape blur = BlurShape::box;       ///< of stored texels; filters that read the depth map have their own
  TexelFormat format = TexelFormat::fp32;  ///< of stored channels
  bool mipmap = false;  ///< averages over the pixel's footprint where texels are smaller than pixels
  int anisotropy = 1;   ///< 1..16 probes along a long footprint; needs `mipmap`
  /// Also marches towards the light through what the camera sees, as far as light leaks behind a caster by
  /// the fall-off or the bias (contacts.hpp). Closes contacts that are in view; takes a pass over the pixels.
  /// For whole maps: pages and many lights refuse it.
  bool contacts = false;
  std::array<double, kMaxFilterOptions>
      option{};  ///< in the order of FilterInfo::options; then the filter's own

  /// The option of this name, one of the filter's own included; 0 where the filter has none of that name.
  [[nodiscard]] double value(std::string_view name) const noexcept;
};

/// Channels of one texel; those beyond the filter's are 0.
using StoredTexel = std::array<double, kMaxChannels>;

/// A point to be looked up, in the map's own units. Mirrors ShadowLookup of shaders/library/lookup.glsl.
struct FilterLookup {
  /// Depth of the texel at column x, row y; 1 outside of the map, where everything is lit.
  std::function<double(int x, int y)> map_depth;
  /// The mean stored texel over a box of these half sides, in texels, round `position`: MapRead::summed
  /// alone. Empty: the texel that the lookup was given stands in.
  std::function<StoredTexel(const glm::dvec2& half_sides)> mean_of_box;
  /// A point of the casters' outline in the square between the centres of texels (x, y) and (x + 1, y + 1).
  /// It is a share of the square's sides; (0.5, 0.5) where no outline crosses it. Empty: (0.5, 0.5)
  /// everywhere. For FilterInfo::draws_silhouettes.
  std::function<glm::dvec2(int x, int y)> silhouette;
  /// Largest depth within the kernel of the stored texels, for filters that need it.
  double depth_max = 1.0;
  glm::dvec2 position{0.0};          ///< in texels: the centre of texel i is at i + 0.5
  double depth = 0.0;                ///< of the receiver, 0 near the light .. 1, bias already taken off
  glm::dvec2 depth_gradient{0.0};    ///< change of the receiver plane's depth per texel along x and y
  glm::dvec2 box{0.5};               ///< half sides of the kernel as a box, texels
  glm::dmat2 disc{1.0};              ///< the kernel as an ellipse: texels from the unit disc
  glm::dmat2 texels_per_world{1.0};  ///< texels per world unit across the light, along two axes of a basis
  /// Distance from the receiver towards the light to where the map's depth is d. It is (x - d y) / (z - d w)
  /// world units, with this vector's x, y, z, w. Exact along the receiver's own ray.
  glm::dvec4 ray{0.0, 1.0, 1.0, 0.0};
  double light_distance = 0.0;  ///< to the light, world units; 0: parallel light
  double rotation = 0.0;        ///< radians: turns sample patterns, random from pixel to pixel
  /// Half sides of the box that has the pixel's variance, texels: kernels with option `footprint` are at
  /// least as wide. 0: the option is off.
  glm::dvec2 pixel{0.0};
  /// Offsets along x and y, texels, beyond which texels have other lengths, as in maps of shape rectilinear.
  /// Below the point, and above it.
  glm::dvec2 ends_below{0.0}, ends_above{0.0};
  /// Lengths of those texels over the point's own, less 1; 0: all are alike.
  glm::dvec2 longer_below{0.0}, longer_above{0.0};
};

/// Kind of texels that a filter reads.
enum class MapRead : std::uint8_t {
  depth,     ///< the depth map as it was rasterized; nothing is stored besides
  filtered,  ///< stored texels, blurred, whose weighted means the hardware takes (bilinear, mip-maps)
  joined,    ///< stored texels, blurred, that only `join` may put together (minima, logarithms of sums)
  summed,    ///< the summed-area table of stored texels, in integers: any box at a constant price
};

/// Description of a filter: names, texels that it reads and stores, needs of its plan.
struct FilterInfo {
  std::string_view name;                                 ///< as on command lines
  std::string_view summary;                              ///< one line
  std::string_view source;                               ///< paper or book
  MapRead reads = MapRead::depth;                        ///< what the lookup reads
  FilterClass bias_class = FilterClass::single_compare;  ///< which bias fits (study/bias.hpp)
  std::span<const FilterOption> options = {};            ///< of this filter alone
  /// Names of the values behind them that the filter sets for itself (settle, fit_map, adapt). The last may
  /// be the first of several.
  std::span<const std::string_view> own_options = {};
  std::span<const TexelFormat> formats = {};  ///< the first is the default; none for MapRead::depth
  bool may_mipmap = false;      ///< mip-maps and anisotropic reads, for MapRead::filtered and joined
  double default_radius = 1.0;  ///< texels
  bool has_kernel = true;       ///< false: the nearest texel alone, whatever the radius says
  /// How far from the point the lookup itself reads the depth map, in texels, beyond the kernel's box.
  double lookup_reach_texels = 1.0;
  /// True if the lookup reads FilterLookup::silhouette: renderers then draw the casters' outlines after each
  /// map, which is redrawn whole whenever it changes. For MapRead::depth, and not for pages or many lights.
  bool draws_silhouettes = false;
  /// Which of `options` says how many terms or layers are stored, each in channels of its own; -1: none.
  int terms_option = -1;
  /// A cheaper filter of the same family, usable where its results match (filter_fit.hpp). nullptr: none.
  const Filter* leaner = nullptr;

  /// Channels of a stored texel, 1..kMaxChannels. nullptr for MapRead::depth.
  int (*channels)(const FilterSettings& settings) noexcept = nullptr;
  /// Brings options into what the format can hold, once those that are whole are rounded: see
  /// settle_options(). nullptr: nothing to do.
  void (*settle)(FilterSettings& settings) noexcept = nullptr;
  /// Radius of the kernel over the shadow of something this far from the receiver. Across the light at the
  /// receiver, world units; light_distance 0: parallel light. FilterSettings::radius is then the widest that
  /// a kernel gets. nullptr: it is the kernel's own.
  double (*penumbra_radius_world)(const FilterSettings& settings, double blocker_distance_world,
                                  double light_distance_world) noexcept = nullptr;
};

/// The filter's formulas on the CPU, in double. The shader file of the same name holds the same formulas, and
/// laws over the registry compare them (tests/render/filter/filter_laws_test.cpp).
struct FilterReference {
  /// Largest error where all texels of the kernel agree, as filter_laws tests it. The receiver is at least
  /// `contact` (of the map's depth range) in front of or behind them.
  double tolerance = 1e-6, contact = 0.0;
  /// shadow_store: the texel of a depth whose surface changes by `slope` per texel (at most half of which is
  /// within the texel). nullptr for MapRead::depth.
  StoredTexel (*store)(double depth, const glm::dvec2& slope,
                       const FilterSettings& settings) noexcept = nullptr;
  /// shadow_join and shadow_nothing: adds a texel of weight > 0; weights sum up to 1. nullptr: the weighted
  /// sum.
  void (*join)(StoredTexel& sum, const StoredTexel& texel, double weight,
               const FilterSettings& settings) noexcept = nullptr;
  /// The sum of no texels, to which join() adds.
  StoredTexel (*nothing)(const FilterSettings& settings) noexcept = nullptr;
  /// shadow_pack: the texel to store for a sum that join() made. nullptr: the sum itself.
  StoredTexel (*pack)(const StoredTexel& sum, const FilterSettings& settings) noexcept = nullptr;
  /// SHADOW_INTERPOLATES: look-ups take the bilinear mean of visibility() of four texels, and join() serves
  /// blur and mip-maps alone. False: they take visibility() of what join() makes of the four.
  bool interpolates = false;
  /// shadow_visibility: 1 lit .. 0 in shadow. `texel`: what was stored, over the kernel; unused by
  /// MapRead::depth.
  double (*visibility)(const StoredTexel& texel, const FilterLookup& lookup,
                       const FilterSettings& settings) = nullptr;
};

/// Lengths that decide a filter's exponents and offsets in one map: along and across the light, world
/// units.
struct MapDepths {
  double range_world = 0.0;   ///< from the map's near to its far plane (ShadowMap::depth_range_world)
  double kernel_world = 0.0;  ///< half width of the kernel, at the body's centre; 0: unknown
};

/// Work of the renderer for a filter besides running its shaders.
struct FilterHooks {
  /// True if these settings' texels may be averaged though FilterInfo::reads says joined: hardware then
  /// blurs, shrinks and interpolates them. nullptr: never.
  bool (*averages)(const FilterSettings& settings) noexcept = nullptr;
  /// Turns lengths in the world into the options of one map; see settings_for_map. nullptr: nothing to do.
  void (*fit_map)(FilterSettings& settings, const MapDepths& depths) noexcept = nullptr;
  /// Options for levels of pages, which span the depths of all casters; see settings_for_pages. nullptr: as
  /// for maps.
  void (*for_pages)(FilterSettings& settings) noexcept = nullptr;
  /// True if shadow_store uses its slope: two to four more depths are fetched per texel. nullptr: never.
  bool (*reads_slope)(const FilterSettings& settings) noexcept = nullptr;
  /// True if the lookup reads the largest depth under the kernel. nullptr: never.
  bool (*needs_depth_max)(const FilterSettings& settings) noexcept = nullptr;
  /// True if `adapt` has something to do for every map. nullptr: never.
  bool (*adapts)(const FilterSettings& settings) noexcept = nullptr;
  /// Sets the options behind those of FilterInfo::options for one map from the depths that were drawn into
  /// it, 1 where there is nothing. Costs a copy of them to the CPU in every frame that redraws the map.
  void (*adapt)(FilterSettings& settings, std::span<const float> depths) noexcept = nullptr;
};

/// One entry of the registry. See shaders/README.md for the shader's side.
struct Filter {
  FilterInfo info;            ///< names, options, formats
  FilterReference reference;  ///< the formulas on the CPU
  FilterHooks hooks = {};     ///< what the renderer does besides
};

/// All filters, in the order of filters.def.
[[nodiscard]] std::span<const Filter* const> all_filters() noexcept;
/// nullptr where there is none of that name.
[[nodiscard]] const Filter* find_filter(std::string_view name) noexcept;

[[nodiscard]] FilterSettings default_settings(const Filter& filter) noexcept;
/// How these settings' texels are read: FilterInfo::reads, or filtered where they may be averaged.
[[nodiscard]] MapRead reads_of(const FilterSettings& settings) noexcept;
/// True if the kernel is at least as wide as the pixel on the map: option `footprint` of pcf and pcf_tent.
[[nodiscard]] bool covers_pixel(const FilterSettings& settings) noexcept;
/// The options for one map: a fall-off in world units becomes an exponent or offset, a share of the map's
/// depth range. Settings as they are where the filter has no such option. Renderers do this for each map.
[[nodiscard]] FilterSettings settings_for_map(const FilterSettings& settings,
                                              const MapDepths& depths) noexcept;

/// Rounds options that are whole numbers, and brings all into what the format can hold. After each change of
/// options, of the format or of the unit.
void settle_options(FilterSettings& settings) noexcept;

/// Settings, or one line that says what is wrong with the text.
struct ParsedFilter {
  FilterSettings settings;  ///< the filter's default where the text is wrong; no filter where the name is
  std::string error;        ///< empty where the text was understood
};
/// Reads "NAME" or "NAME:KEY=VALUE,KEY=VALUE". Keys are radius, unit (texels, world), blur (box, gauss),
/// mipmap (0, 1), anisotropy, contacts (0, 1), and the filter's own options. The key format takes fp32, fp16,
/// unorm16, unorm8, uint32 or nonlinear16. Example: "esm:c=40,radius=3,format=fp32".
[[nodiscard]] ParsedFilter parse_filter(std::string_view text);
/// The text that parse_filter reads back to the same settings; defaults are not written.
[[nodiscard]] std::string to_string(const FilterSettings& settings);
/// Help text of one filter: its use, its source, and a table of the keys that parse_filter reads. Lines have
/// at most 100 columns.
[[nodiscard]] std::string filter_help(const Filter& filter);

/// Bytes of one texel of everything that is kept: the depth map, stored channels with mip-maps, depth
/// pyramid.
[[nodiscard]] double bytes_per_texel(const FilterSettings& settings) noexcept;

/// Sets PlanOptions::filter, so that no kernel reads outside of its map.
void set_margin(const FilterSettings& settings, PlanOptions& options) noexcept;

namespace filters {
#define GNOMON_FILTER(name) extern const Filter name;
#include "gnomon/render/filters.def"
#undef GNOMON_FILTER
}  // namespace filters

}  // namespace gnomon::render
