// Filter settings as text: "esm:c=40,radius=3,format=fp32".
#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

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
  if (key == "radius" && filter.info.has_kernel)
    return read_number(key, text, 0.0, kMaxRadiusWorld, settings.radius);
  if (key == "format") return read_format(text, settings);
  if (key == "unit" && filter.info.has_kernel) {
    const std::string error = read_choice(key, text, "texels", "world", second);
    settings.unit = second ? KernelUnit::world : KernelUnit::texels;
    return error;
  }
  if (key == "blur" && (filter.info.reads == MapRead::filtered || filter.info.reads == MapRead::joined)) {
    const std::string error = read_choice(key, text, "box", "gauss", second);
    settings.blur = second ? BlurShape::gauss : BlurShape::box;
    return error;
  }
  if (key == "contacts") return read_choice(key, text, "0", "1", settings.contacts);
  if (key == "mipmap" && filter.info.may_mipmap) return read_choice(key, text, "0", "1", settings.mipmap);
  if (key == "anisotropy" && filter.info.may_mipmap) {
    double probes = 1.0;
    const std::string error = read_number(key, text, 1.0, kMaxAnisotropy, probes);
    settings.anisotropy = static_cast<int>(std::round(probes));
    return error;
  }
  for (std::size_t i = 0; i < filter.info.options.size(); ++i) {
    const FilterOption& option = filter.info.options[i];
    if (option.name == key) return read_number(key, text, option.min, option.max, settings.option[i]);
  }
  std::string known = filter.info.has_kernel ? "radius, unit, contacts" : "contacts";
  if (!filter.info.formats.empty()) known += ", format, blur";
  if (filter.info.may_mipmap) known += ", mipmap, anisotropy";
  for (const FilterOption& option : filter.info.options) known += ", " + std::string(option.name);
  return std::string(key) + ": " + std::string(filter.info.name) + " knows " + known;
}

/// A key that parse_filter reads for a filter, as help shows it.
struct KeyLine {
  std::string name, range, fallback, summary;
};

std::string range_text(double min, double max) {
  return number_text(min) + " to " + number_text(max);
}

std::vector<KeyLine> keys_of(const Filter& filter) {
  const FilterInfo& info = filter.info;
  std::vector<KeyLine> keys;
  if (info.has_kernel) {
    keys.push_back({"radius", range_text(0.0, kMaxRadiusTexels), number_text(info.default_radius),
                    "half width of the kernel, texels; world units up to " + number_text(kMaxRadiusWorld) +
                        " with unit=world"});
    keys.push_back({"unit", "texels, world", "texels",
                    "unit of the radius; world gives every cascade the same blur on the ground"});
  }
  keys.push_back({"contacts", "0, 1", "0",
                  "1 marches towards the light through what the camera sees, as far as contacts leak"});
  for (const FilterOption& option : info.options) {
    keys.push_back({std::string(option.name), range_text(option.min, option.max),
                    number_text(option.fallback), std::string(option.summary)});
  }
  if (!info.formats.empty()) {
    keys.push_back({"format", formats_of(filter), std::string(to_string(info.formats.front())),
                    "format of each stored channel"});
  }
  if (info.reads == MapRead::filtered || info.reads == MapRead::joined)
    keys.push_back({"blur", "box, gauss", "box", "shape of the blur of stored texels"});
  if (info.may_mipmap) {
    keys.push_back({"mipmap", "0, 1", "0", "1 averages over the pixel's footprint in far, dense texels"});
    keys.push_back(
        {"anisotropy", range_text(1.0, kMaxAnisotropy), "1", "reads along a long footprint; needs mipmap=1"});
  }
  return keys;
}

std::string stored_text(const Filter& filter) {
  const FilterSettings settings = default_settings(filter);
  const std::string bytes = number_text(bytes_per_texel(settings)) + " bytes a texel";
  if (filter.info.draws_silhouettes)
    return "Stores points of outlines beside the depth map: " + bytes + ".\n";
  if (filter.info.channels == nullptr) return "Stores the depth map alone: " + bytes + ".\n";
  const int channels = filter.info.channels(settings);
  return "Stores " + std::to_string(channels) + (channels == 1 ? " channel of " : " channels of ") +
         std::string(to_string(settings.format)) + " beside the depth map: " + bytes + ".\n";
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - text.size(), ' ');
}

/// Breaks lines between words, so that none is longer than a terminal when `indent` columns stand before it.
std::string wrapped(std::string_view text, std::size_t indent) {
  constexpr std::size_t kColumns = 100;
  std::string out;
  while (indent + text.size() > kColumns) {
    const std::size_t end = text.rfind(' ', kColumns - indent);
    if (end == std::string_view::npos) break;
    out += std::string(text.substr(0, end)) + "\n" + std::string(indent, ' ');
    text.remove_prefix(end + 1);
  }
  return out + std::string(text);
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
  FilterSettings settings = default_settings(*filter);
  const auto wrong = [&filter](std::string why) {
    return ParsedFilter{default_settings(*filter), std::move(why)};
  };
  text.remove_prefix(std::min(colon + 1, text.size()));
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    const std::string_view pair = text.substr(0, end);
    const std::size_t equals = pair.find('=');
    text.remove_prefix(std::min(end + 1, text.size()));
    if (equals == std::string_view::npos) return wrong("'" + std::string(pair) + "': wants KEY=VALUE");
    std::string error = read_pair(pair.substr(0, equals), pair.substr(equals + 1), settings);
    if (!error.empty()) return wrong(std::move(error));
  }
  if (settings.unit == KernelUnit::texels && settings.radius > kMaxRadiusTexels) {
    return wrong("radius=" + number_text(settings.radius) + ": at most " + number_text(kMaxRadiusTexels) +
                 " texels");
  }
  settle_options(settings);
  return {settings, ""};
}

std::string to_string(const FilterSettings& settings) {
  if (settings.filter == nullptr) return "";
  const Filter& filter = *settings.filter;
  const FilterSettings usual = default_settings(filter);
  std::string pairs;
  const auto add = [&pairs](std::string_view key, std::string_view value) {
    pairs += (pairs.empty() ? ":" : ",") + std::string(key) + "=" + std::string(value);
  };
  if (filter.info.has_kernel && settings.radius != usual.radius) add("radius", number_text(settings.radius));
  if (filter.info.has_kernel && settings.unit != usual.unit) add("unit", "world");
  if (settings.blur != usual.blur) add("blur", "gauss");
  if (settings.format != usual.format) add("format", to_string(settings.format));
  if (settings.contacts != usual.contacts) add("contacts", settings.contacts ? "1" : "0");
  if (settings.mipmap != usual.mipmap) add("mipmap", settings.mipmap ? "1" : "0");
  if (settings.anisotropy != usual.anisotropy) add("anisotropy", std::to_string(settings.anisotropy));
  for (std::size_t i = 0; i < filter.info.options.size(); ++i) {
    if (settings.option[i] != usual.option[i])
      add(filter.info.options[i].name, number_text(settings.option[i]));
  }
  return std::string(filter.info.name) + pairs;
}

std::string filter_help(const Filter& filter) {
  const FilterInfo& info = filter.info;
  std::string text = wrapped(std::string(info.name) + ": " + std::string(info.summary) + ".", 0) + "\n" +
                     wrapped("Source: " + std::string(info.source) + ".", 0) + "\n" + stored_text(filter);
  const std::vector<KeyLine> keys = keys_of(filter);
  if (keys.empty()) return text + "It has no options.\n";
  // At least as wide as the words over them.
  std::size_t name = sizeof "name" + 1, range = sizeof "range" + 1, fallback = sizeof "default" + 1;
  for (const KeyLine& key : keys) {
    name = std::max(name, key.name.size() + 2);
    range = std::max(range, key.range.size() + 2);
    fallback = std::max(fallback, key.fallback.size() + 2);
  }
  const auto row = [&](const KeyLine& key) {
    const std::string left =
        "  " + padded(key.name, name) + padded(key.range, range) + padded(key.fallback, fallback);
    text += left + wrapped(key.summary, left.size()) + "\n";
  };
  text += "\nOptions, as in " + std::string(info.name) + ":" + keys.front().name + "=" +
          keys.front().fallback + "\n";
  row({"name", "range", "default", "meaning"});
  for (const KeyLine& key : keys) row(key);
  return text;
}

}  // namespace gnomon::render
