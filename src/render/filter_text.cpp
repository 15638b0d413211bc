// Filter settings as text: "esm:c=40,radius=3,format=fp32".
#include <algorithm>
#include <charconv>
#include <cmath>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {
namespace {

/// The shortest text that reads back to the same number.
std::string number_text(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return error == std::errc{} ? std::string(text, end) : "nan";
}

bool number_from(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

/// Empty where `text` is a number in [min, max].
std::string read_number(std::string_view key, std::string_view text, double min, double max, double& value) {
  if (number_from(text, value) && value >= min && value <= max) return "";
  return std::string(key) + "=" + std::string(text) + ": wants a number from " + number_text(min) + " to " +
         number_text(max);
}

std::string formats_of(const Filter& filter) {
  std::string all;
  for (const TexelFormat format : filter.info.formats) {
    all += all.empty() ? "" : ", ";
    all += to_string(format);
  }
  return all;
}

std::string read_format(std::string_view text, FilterSettings& settings) {
  const Filter& filter = *settings.filter;
  if (filter.info.formats.empty()) return "format: this filter stores nothing besides the depth map";
  for (const TexelFormat format : filter.info.formats) {
    if (to_string(format) != text) continue;
    settings.format = format;
    return "";
  }
  return "format=" + std::string(text) + ": wants " + formats_of(filter);
}

std::string read_choice(std::string_view key, std::string_view text, std::string_view first,
                        std::string_view second, bool& is_second) {
  is_second = text == second;
  if (is_second || text == first) return "";
  return std::string(key) + "=" + std::string(text) + ": wants " + std::string(first) + " or " +
         std::string(second);
}

std::string read_pair(std::string_view key, std::string_view text, FilterSettings& settings) {
  const Filter& filter = *settings.filter;
  bool second = false;
  if (key == "radius") return read_number(key, text, 0.0, kMaxRadiusWorld, settings.radius);
  if (key == "format") return read_format(text, settings);
  if (key == "unit") {
    const std::string error = read_choice(key, text, "texels", "world", second);
    settings.unit = second ? KernelUnit::world : KernelUnit::texels;
    return error;
  }
  if (key == "blur" && (filter.info.reads == MapRead::filtered || filter.info.reads == MapRead::joined)) {
    const std::string error = read_choice(key, text, "box", "gauss", second);
    settings.blur = second ? BlurShape::gauss : BlurShape::box;
    return error;
  }
  if (key == "mipmap" && filter.info.may_mipmap) return read_choice(key, text, "0", "1", settings.mipmap);
  if (key == "anisotropy" && filter.info.may_mipmap) {
    double probes = 1.0;
    const std::string error = read_number(key, text, 1.0, kMaxAnisotropy, probes);
    settings.anisotropy = static_cast<int>(probes);
    return error;
  }
  for (std::size_t i = 0; i < filter.info.options.size(); ++i) {
    const FilterOption& option = filter.info.options[i];
    if (option.name == key) return read_number(key, text, option.min, option.max, settings.option[i]);
  }
  std::string known = "radius, unit";
  if (!filter.info.formats.empty()) known += ", format, blur";
  if (filter.info.may_mipmap) known += ", mipmap, anisotropy";
  for (const FilterOption& option : filter.info.options) known += ", " + std::string(option.name);
  return std::string(key) + ": " + std::string(filter.info.name) + " knows " + known;
}

}  // namespace

ParsedFilter parse_filter(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const std::string_view name = text.substr(0, colon);
  const Filter* filter = find_filter(name);
  if (filter == nullptr) {
    std::string known;
    for (const Filter* each : all_filters())
      known += (known.empty() ? "" : ", ") + std::string(each->info.name);
    return {{}, "'" + std::string(name) + "': wants one of " + known};
  }
  ParsedFilter result{default_settings(*filter), ""};
  text.remove_prefix(std::min(colon + 1, text.size()));
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    const std::string_view pair = text.substr(0, end);
    const std::size_t equals = pair.find('=');
    text.remove_prefix(std::min(end + 1, text.size()));
    result.error = equals == std::string_view::npos
                       ? "'" + std::string(pair) + "': wants KEY=VALUE"
                       : read_pair(pair.substr(0, equals), pair.substr(equals + 1), result.settings);
    if (!result.error.empty()) return result;
  }
  if (result.settings.unit == KernelUnit::texels && result.settings.radius > kMaxRadiusTexels) {
    result.error = "radius=" + number_text(result.settings.radius) + ": at most " +
                   number_text(kMaxRadiusTexels) + " texels";
  }
  if (filter->info.settle != nullptr) filter->info.settle(result.settings);
  return result;
}

std::string to_string(const FilterSettings& settings) {
  if (settings.filter == nullptr) return "";
  const Filter& filter = *settings.filter;
  const FilterSettings usual = default_settings(filter);
  std::string pairs;
  const auto add = [&pairs](std::string_view key, std::string_view value) {
    pairs += (pairs.empty() ? ":" : ",") + std::string(key) + "=" + std::string(value);
  };
  if (settings.radius != usual.radius) add("radius", number_text(settings.radius));
  if (settings.unit != usual.unit) add("unit", "world");
  if (settings.blur != usual.blur) add("blur", "gauss");
  if (settings.format != usual.format) add("format", to_string(settings.format));
  if (settings.mipmap != usual.mipmap) add("mipmap", settings.mipmap ? "1" : "0");
  if (settings.anisotropy != usual.anisotropy) add("anisotropy", std::to_string(settings.anisotropy));
  for (std::size_t i = 0; i < filter.info.options.size(); ++i) {
    if (settings.option[i] != usual.option[i])
      add(filter.info.options[i].name, number_text(settings.option[i]));
  }
  return std::string(filter.info.name) + pairs;
}

std::string filter_help() {
  std::string text;
  for (const Filter* filter : all_filters()) {
    text += std::string(filter->info.name) + ": " + std::string(filter->info.summary);
    for (const FilterOption& option : filter->info.options) {
      text += "; " + std::string(option.name) + " " + number_text(option.min) + ".." +
              number_text(option.max) + " (" + number_text(option.fallback) +
              "): " + std::string(option.summary);
    }
    if (!filter->info.formats.empty()) text += "; format " + formats_of(*filter);
    text += "\n";
  }
  return text;
}

}  // namespace gnomon::render
