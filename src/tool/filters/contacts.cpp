// How much light is left close behind a flat occluder, by the formulas alone? One row for each filter and
// format.
#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "filters.hpp"
#include "gnomon/render/contacts.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

using render::FilterSettings;

constexpr std::array kBehind{0.001, 0.003, 0.01, 0.03, 0.1};  // of the depth range

/// The most light that any of some occluders leaves this far behind it.
double most_light_behind(const FilterSettings& settings, double behind) {
  double most = 0.0;
  for (const double occluder : {0.05, 0.31, 0.5, 0.74, 0.88})
    most = std::max(most, render::light_behind(settings, occluder, behind));
  return most;
}

std::string row_of(const FilterSettings& settings, bool json) {
  const std::string format =
      settings.filter->info.formats.empty() ? "depth map" : std::string(to_string(settings.format));
  nlohmann::ordered_json row{{"filter", to_string(settings)}, {"format", format}};
  std::string text = "| " + std::string(settings.filter->info.name) + " | " + format + " |";
  for (const double behind : kBehind) {
    const double lit = most_light_behind(settings, behind);
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
  for (const FilterSettings& asked : request.filters) {
    FilterSettings settings = asked;
    if (asked.filter->info.formats.empty()) print_line(row_of(settings, request.json));
    for (const render::TexelFormat format : asked.filter->info.formats) {
      settings = asked;
      settings.format = format;
      render::settle_options(settings);
      print_line(row_of(settings, request.json));
    }
  }
  flush_output();
}

}  // namespace gnomon::tool
