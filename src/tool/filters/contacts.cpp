// How much light is left close behind a flat occluder, by the formulas alone? One row for each filter and
// format.
#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "filters.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

using render::FilterSettings;

constexpr std::array kBehind{0.001, 0.003, 0.01, 0.03, 0.1};  // of the depth range

/// The most light that any of some occluders leaves this far behind it, with what the format rounds.
double light_behind(const FilterSettings& settings, double behind) {
  const render::Filter& filter = *settings.filter;
  double most = 0.0;
  for (const double occluder : {0.05, 0.31, 0.5, 0.74, 0.88}) {
    render::FilterLookup lookup;
    lookup.map_depth = [occluder](int, int) { return occluder; };
    lookup.depth_max = occluder;
    lookup.position = {8.5, 8.5};
    lookup.depth = occluder + behind;
    lookup.box = glm::dvec2(settings.radius + 0.5);
    lookup.disc = glm::dmat2(settings.radius + 0.5);
    render::StoredTexel texel{};
    if (filter.reference.store != nullptr) {
      texel = filter.reference.store(occluder, glm::dvec2(0.0), settings);
      for (double& channel : texel) channel = render::rounded_to(settings.format, channel);
      if (filter.reference.pack != nullptr) {
        render::StoredTexel read = filter.reference.nothing(settings);
        filter.reference.join(read, texel, 1.0, settings);
        texel = read;
      }
    }
    most = std::max(most, filter.reference.visibility(texel, lookup, settings));
  }
  return most;
}

std::string row_of(const FilterSettings& settings, bool json) {
  const std::string format =
      settings.filter->info.formats.empty() ? "depth map" : std::string(to_string(settings.format));
  nlohmann::ordered_json row{{"filter", to_string(settings)}, {"format", format}};
  std::string text = "| " + std::string(settings.filter->info.name) + " | " + format + " |";
  for (const double behind : kBehind) {
    const double lit = light_behind(settings, behind);
    char number[32], key[32];
    std::snprintf(number, sizeof number, " %.2f |", lit);
    std::snprintf(key, sizeof key, "%g", behind);
    text += number;
    row["lit_behind"][key] = lit;
  }
  return json ? row.dump() : text;
}

}  // namespace

void print_filter_contacts(const FiltersRequest& request) {
  if (!request.json) {
    print_line("Visibility behind a flat occluder, by the distance as a share of the depth range\n");
    print_line("| filter | format | 0.001 | 0.003 | 0.01 | 0.03 | 0.1 |");
    print_line("|--|--|--|--|--|--|--|");
  }
  for (const FilterSettings& asked : filters_asked_for(request.filters)) {
    FilterSettings settings = asked;
    if (asked.filter->info.formats.empty()) print_line(row_of(settings, request.json));
    for (const render::TexelFormat format : asked.filter->info.formats) {
      settings = asked;
      settings.format = format;
      if (asked.filter->info.settle != nullptr) asked.filter->info.settle(settings);
      print_line(row_of(settings, request.json));
    }
  }
  flush_output();
}

}  // namespace gnomon::tool
