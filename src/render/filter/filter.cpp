// The registry of filters, their formats, and what kernels ask of a plan.
#include "gnomon/render/filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::render {
namespace {

constexpr std::array kFilters{
#define GNOMON_FILTER(name) &filters::name,
#include "gnomon/render/filters.def"
#undef GNOMON_FILTER
};

struct FormatData {
  TexelFormat format;
  std::string_view name;
  int bytes;
  double rounding;
};
constexpr FormatData kFormats[] = {
    {TexelFormat::fp32, "fp32", 4, 0x1p-24},
    {TexelFormat::fp16, "fp16", 2, 0x1p-11},
    {TexelFormat::unorm16, "unorm16", 2, 0.5 / 65535},
    {TexelFormat::unorm8, "unorm8", 1, 0.5 / 255},
    {TexelFormat::uint32, "uint32", 4, 0x1p-24},
    {TexelFormat::nonlinear16, "nonlinear16", 2, 0.5 / 65535},
};
const FormatData& data_of(TexelFormat format) noexcept {
  return kFormats[static_cast<std::size_t>(format)];
}

/// Rounds to a binary float of `bits` significant bits whose largest is `max` and smallest step is `least`.
double rounded_to_float(double value, int bits, double max, double least) noexcept {
  if (!(std::abs(value) > 0.0) || !std::isfinite(value)) return value;
  const double step = std::max(std::ldexp(1.0, std::ilogb(value) + 1 - bits), least);
  const double rounded = std::nearbyint(value / step) * step;
  return std::abs(rounded) > max ? std::copysign(std::numeric_limits<double>::infinity(), value) : rounded;
}

}  // namespace

std::span<const Filter* const> all_filters() noexcept {
  return kFilters;
}

const Filter* find_filter(std::string_view name) noexcept {
  for (const Filter* filter : kFilters) {
    if (filter->info.name == name) return filter;
  }
  return nullptr;
}

std::string_view to_string(TexelFormat format) noexcept {
  return data_of(format).name;
}
int bytes_per_channel(TexelFormat format) noexcept {
  return data_of(format).bytes;
}
double rounding_of(TexelFormat format) noexcept {
  return data_of(format).rounding;
}

bool is_unsigned_unit(TexelFormat format) noexcept {
  return format != TexelFormat::fp32 && format != TexelFormat::fp16;
}

double rounded_to(TexelFormat format, double value) noexcept {
  const auto steps = [value](double count) {
    return std::nearbyint(std::clamp(value, 0.0, 1.0) * count) / count;
  };
  switch (format) {
    case TexelFormat::fp32:
    case TexelFormat::uint32:
      return static_cast<double>(static_cast<float>(value));
    case TexelFormat::fp16:
      return rounded_to_float(value, 11, 65504.0, 0x1p-24);
    case TexelFormat::unorm16:
    case TexelFormat::nonlinear16:
      return steps(65535.0);
    case TexelFormat::unorm8:
      return steps(255.0);
  }
  return value;
}

double FilterSettings::value(std::string_view name) const noexcept {
  if (filter == nullptr) return 0.0;
  const std::span<const FilterOption> named = filter->info.options;
  const std::span<const std::string_view> own = filter->info.own_options;
  for (std::size_t i = 0; i < named.size(); ++i)
    if (named[i].name == name) return option[i];
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i] == name) return option[named.size() + i];
  return 0.0;
}

FilterSettings default_settings(const Filter& filter) noexcept {
  FilterSettings settings;
  settings.filter = &filter;
  settings.radius = filter.info.default_radius;
  if (!filter.info.formats.empty()) settings.format = filter.info.formats[0];
  for (std::size_t i = 0; i < filter.info.options.size(); ++i)
    settings.option[i] = filter.info.options[i].fallback;
  settle_options(settings);
  return settings;
}

void settle_options(FilterSettings& settings) noexcept {
  const FilterInfo& info = settings.filter->info;
  for (std::size_t i = 0; i < info.options.size(); ++i)
    if (info.options[i].whole) settings.option[i] = std::round(settings.option[i]);
  if (info.settle != nullptr) info.settle(settings);
}

MapRead reads_of(const FilterSettings& settings) noexcept {
  const Filter& filter = *settings.filter;
  const bool averages = filter.hooks.averages != nullptr && filter.hooks.averages(settings);
  return averages ? MapRead::filtered : filter.info.reads;
}

bool covers_pixel(const FilterSettings& settings) noexcept {
  return settings.value("footprint") > 0.5;
}

FilterSettings settings_for_map(const FilterSettings& settings, const MapDepths& depths) noexcept {
  FilterSettings own = settings;
  if (settings.filter->hooks.fit_map != nullptr) settings.filter->hooks.fit_map(own, depths);
  return own;
}

double bytes_per_texel(const FilterSettings& settings) noexcept {
  const Filter& filter = *settings.filter;
  constexpr double kDepthBytes = 4.0, kMipChain = 4.0 / 3.0, kMaxPyramid = 4.0 / 3.0;
  double bytes = kDepthBytes;
  if (filter.info.channels != nullptr) {
    // Textures of three channels cannot be drawn into: they take four.
    const int channels = filter.info.channels(settings),
              stored = channels > 2 ? (channels + 3) / 4 * 4 : channels;
    bytes += stored * bytes_per_channel(settings.format) * (settings.mipmap ? kMipChain : 1.0);
  }
  constexpr double kOutlineBytes = 2.0;
  if (filter.info.draws_silhouettes) bytes += kOutlineBytes;
  return bytes + (filter.hooks.needs_depth_max != nullptr && filter.hooks.needs_depth_max(settings)
                      ? kMaxPyramid
                      : 0.0);
}

void set_margin(const FilterSettings& settings, PlanOptions& options) noexcept {
  const Filter& filter = *settings.filter;
  constexpr double kBilinear = 1.0;
  // A trilinear read over a footprint of r texels takes levels whose texels are up to 2 r wide, one and a
  // half of them to each side at most.
  const double widest = filter.info.may_mipmap ? 3.0 : 1.0;
  const bool in_world = settings.unit == KernelUnit::world;
  options.filter.texels = filter.info.lookup_reach_texels + (in_world ? 0.0 : settings.radius) +
                          (filter.info.channels ? kBilinear : 0.0);
  options.filter.world = in_world ? settings.radius * widest : 0.0;
}

}  // namespace gnomon::render
