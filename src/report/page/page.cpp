// The report: one file of HTML that needs nothing else, and its charts and tables as files of their own.
#include "gnomon/report/page.hpp"

#include "budgets.hpp"
#include "charts.hpp"
#include "expected.hpp"
#include "file.hpp"
#include "front_table.hpp"
#include "gnomon/report/csv.hpp"
#include "gnomon/report/rows_file.hpp"
#include "kinds.hpp"
#include "latex.hpp"
#include "page_files.hpp"
#include "rows/row_checks.hpp"
#include "sections.hpp"
#include "text.hpp"
#include "views.hpp"

namespace gnomon::report {
namespace {

/// Nothing is loaded, nothing runs but the one script and style that stand in the page.
std::string policy() {
  return "default-src 'none'; img-src data:; style-src '" + policy_hash(page_style()) + "'; script-src '" +
         policy_hash(page_script()) + "'; base-uri 'none'; form-action 'none'";
}

std::string head() {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         policy() +
         "\">\n<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>gnomon: "
         "shadow "
         "error against run time</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>" +
         std::string(page_style()) + "</style>\n</head>\n<body>\n";
}

std::string opening(const PageInput& input) {
  std::string out = "<header>\n<h1>Shadow error against run time</h1>\n<p class=\"sub\">";
  out += counted(input.summary.techniques.size(), "technique") + " on " +
         counted(input.summary.scenes.size() - 1, "scene") + ", " + counted(input.rows.size(), "measurement");
  if (!input.rows.empty()) {
    const Machine& m = input.rows.front().machine;
    out += "; " + escaped(m.renderer) + " on " + escaped(m.cpu) + "; gnomon " + escaped(m.version);
  }
  out += "</p>\n";
  for (const std::string& warning : input.warnings)
    out += "<p class=\"note warning\">" + escaped(warning) + "</p>\n";
  out +=
      "<nav><a href=\"#s1\">Error and time</a><a href=\"#s2\">Table</a><a href=\"#s3\">Pictures</a>"
      "<a href=\"#s4\">Camera path</a><a href=\"#s5\">Stability</a><a href=\"#s6\">Omitted work</a>"
      "<a href=\"#s7\">Method</a>";
  if (!input.gpus.empty()) out += "<a href=\"#s8\">Software and GPUs</a>";
  out += "</nav>\n</header>\n";
  return out;
}

void write_charts(const PageInput& input) {
  const std::filesystem::path folder = input.folder / "charts";
  make_folder(folder);
  write_stability_charts(input.stability, folder);
  if (const std::optional<Chart> expected = expected_chart(input.rows))
    write_text(folder / "expected.svg", expected->standalone());
  if (const ViewTable views = view_table(input.rows, input.summary); views.views > 1)
    write_text(folder / "views.svg", view_chart(views, input.summary).standalone());
  for (std::size_t scene = 0; scene < input.summary.scenes.size(); ++scene) {
    const std::string name = scene == 0 ? "all" : "scene" + std::to_string(scene - 1);
    write_text(folder / ("error_time_" + name + ".svg"), error_time_chart(input.summary, scene).standalone());
    write_text(folder / ("time_to_error_" + name + ".svg"),
               time_to_error_chart(input.summary, scene).standalone());
    if (scene == 0) continue;
    const std::vector<std::size_t> shown = notable(input.summary, scene, kFlightLines);
    for (const std::string_view key : {kDefaultError, std::string_view("flips")}) {
      write_text(folder / (std::string(key) + "_" + name + ".svg"),
                 flight_chart(input.summary, input.rows, scene, measure_index(key), shown).standalone());
    }
  }
}

std::string technique_columns(const Technique& t) {
  return csv_field(t.warp) + "," + csv_field(t.split) + "," + csv_field(t.fit) + "," +
         std::to_string(t.cascades) + "," + std::to_string(t.map_size) + "," + csv_field(t.filter) + "," +
         csv_field(t.pages) + "," + std::to_string(t.page_texels) + "," + exact_number(t.page_target_m) +
         "," + csv_field(t.layer) + "," + csv_field(t.entry);
}

constexpr const char* kTechniqueHead =
    "warp,split,fit,cascades,map_size,filter,pages,page_texels,page_target_m,layer,entry";

std::string measure_head() {
  std::string line;
  for (const Measure& measure : measures()) line += "," + std::string(measure.key);
  return line + "\n";
}

std::string summary_csv(const Summary& summary) {
  std::string out = std::string("scene,") + kTechniqueHead + measure_head();
  for (std::size_t scene = 0; scene < summary.scenes.size(); ++scene) {
    for (std::size_t t = 0; t < summary.techniques.size(); ++t) {
      const Cell& cell = summary.cells[scene][t];
      if (!cell.measured) continue;
      out += csv_field(summary.scenes[scene]) + "," + technique_columns(summary.techniques[t]);
      for (const double value : cell.values) out += "," + exact_number(value);
      out += "\n";
    }
  }
  return out;
}

std::string frames_csv(const std::vector<Row>& rows) {
  std::string head = measure_head();
  head.insert(head.size() - 1, ",camera,edits,view");
  std::string out = std::string("scene,frame,") + kTechniqueHead + head;
  for (const Row& row : rows) {
    out += csv_field(row.scene) + "," + std::to_string(row.frame) + "," + technique_columns(row.technique);
    for (const Measure& measure : measures()) out += "," + exact_number(measure.of(row));
    out += "," + csv_field(row.camera) + "," + csv_field(row.edits) + "," + csv_field(row.view) + "\n";
  }
  return out;
}

}  // namespace

std::string whole_page(const PageInput& input) {
  const PagePictures pictures = page_pictures(input);
  std::string out = head() + opening(input) + "<main>\n";
  out += section_error_time(input) + section_summary(input) + section_viewers(input, pictures) +
         section_flight(input) + section_stability(input) + section_left_out(input) + section_method(input) +
         gpu_section(input.gpus);
  out += "</main>\n<script type=\"application/json\" id=\"data\">" + for_script(page_data(input, pictures)) +
         "</script>\n<script>" + std::string(page_script()) + "</script>\n</body>\n</html>\n";
  return out;
}

PageInput page_input(const std::filesystem::path& folder, std::vector<Row> rows) {
  PageInput input;
  input.folder = folder;
  input.rows = std::move(rows);
  const std::filesystem::path stability = folder / kStabilityFile;
  input.stability = read_stability(optional_text(stability), stability.string());
  input.gpus = read_gpu_runs(folder);
  input.summary = summarize(input.rows);
  // All scenes together say something only where there are several, and a technique that was on all of them.
  const bool together = input.summary.scenes.size() > 2 && !notable(input.summary, 0, 1).empty();
  input.start_scene = together || input.summary.scenes.size() < 2 ? 0 : 1;
  return input;
}

std::filesystem::path write_report(const std::filesystem::path& folder, std::vector<std::string>* warnings) {
  std::error_code ignored;
  if (std::filesystem::exists(folder, ignored) && !std::filesystem::is_directory(folder, ignored))
    throw ReportError(one_line(folder.string() + ": is not a folder"));
  // A folder of gnomon stress or of GPUs alone has a report, too.
  const bool alone = (std::filesystem::exists(folder / kStabilityFile, ignored) ||
                      std::filesystem::exists(folder / kGpuFolder, ignored)) &&
                     !std::filesystem::exists(folder / kRowsFile, ignored);
  std::vector<std::string> lines;
  std::vector<Row> rows = alone ? std::vector<Row>() : read_rows(folder, &lines);
  for (std::string& line : check_rows(folder, rows)) lines.push_back(std::move(line));
  if (warnings != nullptr) warnings->insert(warnings->end(), lines.begin(), lines.end());
  PageInput input = page_input(folder, std::move(rows));
  input.warnings = std::move(lines);
  write_charts(input);
  write_text(folder / "summary.csv", summary_csv(input.summary));
  write_text(folder / "fronts.md", front_tables(input.summary));
  write_text(folder / "views.csv", views_csv(input.rows, input.summary, kTechniqueHead, technique_columns));
  write_text(folder / "kinds.csv", kinds_csv(input.rows, input.summary));
  write_text(folder / "budgets.json", budgets_json(input.rows, input.summary));
  write_text(folder / "pairs.csv", pairs_csv(input.summary));
  write_text(folder / "frames.csv", frames_csv(input.rows));
  write_text(folder / "tables.tex", latex_tables(input.rows, input.summary));
  write_text(folder / "method.tex", latex_method(input.rows, input.summary));
  write_text(folder / "report.html", whole_page(input));
  return folder / "report.html";
}

}  // namespace gnomon::report
