// What is left to draw after each rule that leaves something out, scene by scene.
#include "waterfall.hpp"

#include <algorithm>
#include <set>

#include "gnomon/options.hpp"
#include "summary.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

struct Step {
  std::string rule, what, why;
  double texels = 0.0, triangles = 0.0, filtered = 0.0;  ///< saved, over all frames
};

struct Waterfall {
  std::string scene;
  int frames = 0;
  double texels = 0.0, triangles = 0.0;  ///< drawn in the end
  double filtered = 0.0;                 ///< texels that filters stored, over all techniques
  std::vector<Step> steps = {};
};

bool draws_from_last_frame(std::string_view rule) noexcept {
  const PruneRuleInfo* const info = find_prune_rule(rule);
  return info != nullptr && info->source == PruneSource::last_frame;
}

Step& step_of(const LeftOut& l, Waterfall& fall) {
  auto at = std::find_if(fall.steps.begin(), fall.steps.end(),
                         [&](const Step& step) { return step.rule == l.rule; });
  if (at == fall.steps.end()) at = fall.steps.insert(fall.steps.end(), {l.rule, l.what, l.why});
  return *at;
}

/// Of every filter: they differ in the texels that they store.
void add_filtered(const Row& row, Waterfall& fall) {
  fall.filtered += static_cast<double>(row.costs.filtered_texels);
  for (const LeftOut& l : row.left_out)
    if (!l.rule.empty() && l.saves_filtered > 0)
      step_of(l, fall).filtered += static_cast<double>(l.saves_filtered);
}

void add(const Row& row, Waterfall& fall) {
  ++fall.frames;
  fall.texels += static_cast<double>(row.costs.texels);
  fall.triangles += static_cast<double>(row.costs.triangles);
  for (const LeftOut& l : row.left_out) {
    if (l.rule.empty() || (l.saves_texels == 0 && l.saves_triangles == 0)) continue;
    Step& step = step_of(l, fall);
    step.texels += static_cast<double>(l.saves_texels);
    step.triangles += static_cast<double>(l.saves_triangles);
  }
}

std::vector<Waterfall> waterfalls_of(const std::vector<Row>& rows) {
  std::vector<Waterfall> falls;
  std::set<std::string> counted;
  for (const Row& row : rows) {
    auto at = std::find_if(falls.begin(), falls.end(),
                           [&](const Waterfall& fall) { return fall.scene == row.scene; });
    if (at == falls.end()) at = falls.insert(falls.end(), {row.scene});
    add_filtered(row, *at);
    if (counted.insert(plan_of(row)).second) add(row, *at);
  }
  for (Waterfall& fall : falls)
    std::stable_partition(fall.steps.begin(), fall.steps.end(),
                          [](const Step& step) { return !draws_from_last_frame(step.rule); });
  std::erase_if(falls, [](const Waterfall& fall) { return fall.steps.empty(); });
  return falls;
}

std::string share_with_bar(double part, double whole) {
  constexpr double kBarPixels = 120.0;
  const double share = whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 1.0;
  return "<td>" + short_number(100.0 * share) +
         "&nbsp;%</td><td><svg width=\"120\" height=\"10\" role=\"img\" " + "aria-label=\"" +
         short_number(100.0 * share) + " percent\"><rect width=\"" + short_number(kBarPixels * share) +
         "\" height=\"10\" fill=\"currentColor\" opacity=\"0.6\"/></svg></td>";
}

std::string table(const Waterfall& fall) {
  double texels = fall.texels, triangles = fall.triangles, filtered = fall.filtered;
  for (const Step& step : fall.steps) {
    if (draws_from_last_frame(step.rule)) continue;
    texels += step.texels;
    triangles += step.triangles;
    filtered += step.filtered;
  }
  const double all_texels = texels, all_triangles = triangles, all_filtered = filtered;
  std::string out =
      "<h3>" + escaped(fall.scene) + "</h3>\n<p class=\"note\">Without rules " +
      short_number(texels / fall.frames / 1e6) + " million texels and " +
      short_number(triangles / fall.frames / 1e3) +
      " thousand triangles a frame, mean over all parametrizations and frames.</p>\n" +
      scroll_box("Savings of each rule: " + fall.scene, true) +
      "<table class=\"words\"><thead><tr><th>rule</th><th>omits</th><th colspan=\"2\">texels left</th><th "
      "colspan=\"2\">triangles left</th><th colspan=\"2\">filtered texels left</th><th>proof or "
      "bound</th></tr></thead><tbody>\n";
  for (const Step& step : fall.steps) {
    texels -= step.texels;
    triangles -= step.triangles;
    filtered -= step.filtered;
    out += "<tr><td>" + escaped(step.rule) + "</td><td>" + escaped(step.what) + "</td>" +
           share_with_bar(texels, all_texels) + share_with_bar(triangles, all_triangles) +
           share_with_bar(filtered, all_filtered) + "<td>" + escaped(step.why) + "</td></tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace

std::string waterfalls(const std::vector<Row>& rows) {
  std::string out;
  for (const Waterfall& fall : waterfalls_of(rows)) out += table(fall);
  if (out.empty()) return out;
  return "<h3>Savings of each prune rule</h3>\n<p>The rules are listed in the order in which a frame applies "
         "them. A sweep measures each frame alone. The savings of stable fits over a previous frame are "
         "subtracted last.</p>\n" +
         out;
}

}  // namespace gnomon::report
