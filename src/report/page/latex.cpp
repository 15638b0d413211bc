// Tables and a section on method for a paper, in LaTeX.
#include "latex.hpp"

#include <set>

#include "kinds.hpp"
#include "text.hpp"
#include "views.hpp"

namespace gnomon::report {
namespace {

constexpr std::string_view kColumns[] = {"wrong", "pixel_error", "twinkle", "ratio"};

/// Percent signs stand in the head of a column.
std::string number_of(const Measure& measure, double value) {
  const std::string text = short_number(measure.shown(value));
  return text == "-" ? "--" : latex_text(text);
}

std::string interval_of(const Measure& measure, const Estimate& e) {
  return number_of(measure, e.median) + " & {\\scriptsize " + number_of(measure, e.low) + "--" +
         number_of(measure, e.high) + "}";
}

std::string head_of(const Measure& measure) {
  return latex_text(measure.column) + (measure.unit == "%" ? ", \\%" : "");
}

std::string latex_medians(const ViewTable& table, const Summary& summary) {
  std::string out = "\\begin{tabular}{lrlrlrlrl}\n\\toprule\ntechnique";
  for (const std::string_view key : kColumns)
    out += " & \\multicolumn{2}{c}{" + head_of(measures()[measure_index(key)]) + "}";
  out += " \\\\\n\\midrule\n";
  for (const std::size_t t : table.by_median()) {
    out += latex_text(summary.techniques[t].name());
    for (const std::string_view key : kColumns) {
      const auto e = table.over(key, t);
      out += " & " + (e ? interval_of(measures()[measure_index(key)], *e) : std::string("-- &"));
    }
    out += " \\\\\n";
  }
  return out + "\\bottomrule\n\\end{tabular}\n";
}

std::string kind_table(const std::vector<KindBest>& best, const Summary& summary) {
  std::string out =
      "\n% The best technique of each kind of scene, and the best with another filter.\n"
      "\\begin{tabular}{lrllrllr}\n\\toprule\nkind & views & error & technique & \\multicolumn{2}{c}{median, "
      "\\%} & "
      "next & less in \\\\\n\\midrule\n";
  for (const KindBest& b : best) {
    const Measure& measure = measures()[b.measure];
    out += latex_text(b.kind) + " & " + std::to_string(b.views) + " & " + latex_text(measure.column) + " & " +
           latex_text(summary.techniques[b.technique].name()) + " & " + interval_of(measure, b.error) +
           " & " + latex_text(summary.techniques[b.next].name()) + " & " + std::to_string(b.test.less) + "/" +
           std::to_string(b.test.less + b.test.more) + " \\\\\n";
  }
  return out + "\\bottomrule\n\\end{tabular}\n";
}

/// "a", "a and b", "a, b and c".
std::string list_of(const std::set<std::string>& words) {
  std::string out;
  std::size_t left = words.size();
  for (const std::string& word : words) out += word + (left > 2 ? ", " : left == 2 ? " and " : ""), --left;
  return out;
}

}  // namespace

std::string latex_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    constexpr std::string_view kEscaped = "&%$#_{}";
    if (kEscaped.find(c) != std::string_view::npos) {
      out += std::string("\\") + c;
    } else if (c == '\\') {
      out += "\\textbackslash{}";
    } else if (c == '~') {
      out += "\\textasciitilde{}";
    } else if (c == '^') {
      out += "\\textasciicircum{}";
    } else {
      const auto byte = static_cast<unsigned char>(c);
      // Of a character of several bytes the first stands for all.
      if (byte < 0x80) out += byte < ' ' ? ' ' : c;
      if (byte >= 0xc0) out += '?';
    }
  }
  return out;
}

std::string latex_tables(const std::vector<Row>& rows, const Summary& summary) {
  const ViewTable table = view_table(rows, summary);
  std::string out = "% Written by gnomon " + latex_text(rows.empty() ? "" : rows.front().machine.version) +
                    ". Needs \\usepackage{booktabs}.\n% Medians over " + counted(table.views, "view") +
                    ", with bootstrap intervals at 95 %.\n" + latex_medians(table, summary);
  const std::vector<KindBest> best = best_of_kinds(rows, summary);
  return best.empty() ? out : out + kind_table(best, summary);
}

std::string latex_method(const std::vector<Row>& rows, const Summary& summary) {
  if (rows.empty()) return "% Nothing was measured.\n";
  const ViewTable table = view_table(rows, summary);
  std::set<std::string> scenes, sizes, lights, samples, rounds, machines;
  bool entries = false;
  for (const Row& row : rows) {
    scenes.insert(row.scene);
    sizes.insert(std::to_string(row.width) + " $\\times$ " + std::to_string(row.height));
    lights.insert(latex_text(row.light) + " at " + short_number(row.light_elevation_deg) +
                  "$^\\circ$ elevation and " + short_number(row.light_azimuth_deg) + "$^\\circ$ azimuth");
    samples.insert(std::to_string(row.pixel_samples));
    if (row.times.rounds > 0) rounds.insert(counted(static_cast<std::size_t>(row.times.rounds), "round"));
    const Machine& m = row.machine;
    machines.insert(latex_text(m.renderer + " on " + m.cpu + " (" + std::to_string(m.cores) +
                               " cores), gnomon " + m.version + ", rays: " + m.rays));
    entries = entries || row.technique.is_given();
  }
  std::string out = "\\section{Method}\n";
  out += counted(summary.techniques.size(), "technique") + " were measured on " +
         counted(table.views, "view") + " of " + counted(scenes.size(), "scene") + ", at " + list_of(sizes) +
         " pixels. ";
  if (table.dropped > 0)
    out += "Not counted were " + counted(table.dropped, "view") + " without a frame of " +
           std::to_string(kFewestPixels) + " evaluated pixels. ";
  out += "Light: " + list_of(lights) + ".\n\n";
  out +=
      "Truth is exact: from the surface at the centre of each pixel, one ray goes to the light. Pixels whose "
      "edge is "
      "closer than the certified error of the rays do not count. Misclassified pixels are on the wrong side "
      "of one "
      "half. Pixel error is the mean distance of the mask to the share of the light over the whole pixel, "
      "from " +
      list_of(samples) +
      " stratified rays from the eye. Twinkling is the share of pixels that change by over a quarter more "
      "than the "
      "light over them, between two frames of a viewer at 60\\,Hz.\n\n";
  out +=
      "Medians are over views, each the mean of its frames; their intervals are percentile bootstraps over "
      "the views at 95\\,\\%. Pairs "
      "of "
      "techniques are compared by exact sign tests, without correction for the number of pairs. ";
  out += "Times are wall clock of " + (rounds.empty() ? std::string("no rounds") : list_of(rounds)) +
         " in random order after a warm-up, after the driver had finished. ";
  if (!table.again.empty())
    out += "The baseline, measured twice as two techniques, differs by less than a factor of " +
           short_number(table.noise()) + " in 95\\,\\% of the frames. ";
  if (entries)
    out += "Entries of others were measured by the same code; times of masks are as stated by them. ";
  return out + "Machine: " + list_of(machines) + ".\n";
}

}  // namespace gnomon::report
