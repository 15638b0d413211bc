// Section 5 of the page: tables of what `gnomon stress` found, between its charts.
#include <algorithm>

#include "stability.hpp"
#include "stiff_axis.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

template <typename Get>
std::string worst_cell(const StabilityAxis& axis, Get get) {
  const StabilityRow* row = worst_row(axis.rows, get);
  if (row == nullptr) return "<td>-</td>";
  return "<td>" + short_number(get(*row)) + "<br><small>" + escaped(row->variant) + " at " +
         short_number(row->value) + "</small></td>";
}

template <typename Get>
std::string half_texel_cell(const StabilityAxis& axis, Get get) {
  const auto range = beyond_half_texel(axis.rows, get);
  if (!range) return "<td>nowhere</td>";
  const auto [low, high] = *range;
  return "<td>" + short_number(low) + (high > low ? " to " + short_number(high) : "") + "</td>";
}

std::string fallback_cell(const StabilityAxis& axis) {
  constexpr std::size_t kShown = 6;
  const std::vector<const StabilityRow*> changes = changes_of_use(axis.rows);
  std::string out = "<td>";
  for (std::size_t i = 0; i < std::min(changes.size(), kShown); ++i)
    out += (i == 0 ? "" : "; from " + short_number(changes[i]->value) + ": ") + escaped(changes[i]->used);
  if (changes.size() > kShown) out += "; " + std::to_string(changes.size() - kShown) + " more";
  return out + "</td>";
}

std::string axes_table(const Stability& stability) {
  std::string out =
      "<div class=\"wide\"><table class=\"words\"><thead><tr><th>axis</th><th>double against long double, "
      "texels</th><th>in units of the last place</th><th>float relative to the camera, texels</th><th>over "
      "half "
      "a texel at</th><th>absolute float over half a texel at</th><th>condition number</th><th>texels per "
      "area, "
      "change for a step of 1e-6</th><th>one map that may warp uses</th><th>left out there</th></tr></thead>"
      "<tbody>\n";
  const auto relative = [](const StabilityRow& r) { return r.float_relative_texels; };
  const auto error = [](const StabilityRow& r) { return r.error_texels; };
  for (const StabilityAxis& axis : stability.axes) {
    const StabilityRow* worst = worst_row(axis.rows, error);
    out += "<tr><td>" + escaped(axis.name) + "</td>" + worst_cell(axis, error) + "<td>" +
           (worst == nullptr ? "-" : short_number(worst->error_ulp)) + "</td>" + worst_cell(axis, relative) +
           half_texel_cell(axis, relative) +
           half_texel_cell(axis, [](const StabilityRow& r) { return r.float_absolute_texels; }) +
           worst_cell(axis, [](const StabilityRow& r) { return r.condition; }) +
           worst_cell(axis, [](const StabilityRow& r) { return r.jump; }) + fallback_cell(axis) + "<td>" +
           (worst == nullptr ? std::string() : escaped(worst->left_out)) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string cases_table(const Stability& stability) {
  std::string out =
      "<div class=\"wide tall\"><table class=\"words\"><thead><tr><th>row</th><th>input</th><th>verdict</th>"
      "<th>required</th><th>found</th></tr></thead><tbody>\n";
  for (const StabilityCase& c : stability.cases) {
    out += "<tr><td>" + std::to_string(c.row) + "</td><td>" + escaped(c.input) + "</td><td>" +
           (c.verdict == "holds" ? escaped(c.verdict) : "<b>" + escaped(c.verdict) + "</b>") + "</td><td>" +
           escaped(c.required) + "</td><td>" + escaped(c.found) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string filters_table(const Stability& stability) {
  std::string out =
      "<div class=\"wide tall\"><table class=\"words\"><thead><tr><th>strain</th><th>filter</th><th>largest "
      "error</th><th>at</th><th>bound there</th><th>share beyond their bound</th><th>every answer in [0, "
      "1]</th></tr>"
      "</thead><tbody>\n";
  for (const StabilityFilter& filter : stability.filters) {
    const StabilityFilterRow worst = worst_of_filter(filter.rows);
    out += "<tr><td>" + escaped(filter.axis) + "</td><td>" + escaped(filter.filter) + "</td><td>" +
           short_number(worst.error) + "</td><td>" + short_number(worst.value) + "</td><td>" +
           short_number(worst.bound) + "</td><td>" + short_number(worst.beyond) + "</td><td>" +
           (worst.within ? "yes" : "<b>no</b>") + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace

std::string stability_section(const Stability& stability) {
  std::string out;
  if (!stability.axes.empty()) {
    out +=
        "<p>One quantity at a time is driven to its limits. Errors are distances in the map, in texels, at "
        "the "
        "corners of what it shows and at points between, the worst over warps, fits and scenes. <b>Double "
        "against "
        "long double</b>: the plan against exact arithmetic with the same parameters. <b>Float</b>: what a "
        "shader "
        "makes of it, from absolute coordinates and from offsets to the camera.</p>\n";
    out += axes_table(stability);
    for (std::size_t i = 0; i < stability.axes.size(); ++i)
      out += stability_chart(stability.axes[i]).embedded("stability-" + std::to_string(i));
  }
  if (!stability.cases.empty()) out += "<h3>Extreme cases</h3>\n" + cases_table(stability);
  if (!stability.filters.empty()) {
    out += "<h3>Filters at their limits</h3>\n" + filters_table(stability);
    out += "<details><summary>a chart for each of them</summary>\n";
    for (std::size_t i = 0; i < stability.filters.size(); ++i)
      out += filter_chart(stability.filters[i]).embedded("filter-limits-" + std::to_string(i));
    out += "</details>\n";
  }
  return out;
}

}  // namespace gnomon::report
