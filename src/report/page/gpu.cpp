// Section 8 of the page: masks and times of GPUs beside those of software.
#include "gpu.hpp"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "file.hpp"
#include "gnomon/report/gpu_files.hpp"
#include "gnomon/report/row.hpp"
#include "text.hpp"

namespace gnomon::report {
namespace {

using GpuJson = nlohmann::json;

void add_machine(const GpuJson& row, GpuRun& run) {
  const GpuJson& context = row.at("contexts").at(0);
  const bool software = context.at("software").get<bool>();
  const auto renderer = context.at("renderer").get<std::string>();
  run.device = software ? "software" : renderer;
  run.machine = renderer + ", OpenGL " + context.at("version").get<std::string>() + ", " +
                row.at("cpu").get<std::string>();
  run.timers_trusted = context.at("timer_queries").at("trusted").get<bool>();
}

void add_mask(const GpuJson& row, GpuRun& run) {
  const auto what = row.at("what").get<std::string>();
  MaskCounts& counts = run.masks[what.substr(0, what.find(' '))];
  ++counts.masks;
  const auto differ = row.at("differ").get<std::uint64_t>() + row.at("other_map").get<std::uint64_t>();
  counts.equal += differ == 0 ? 1 : 0;
  counts.pixels += row.at("pixels").get<std::uint64_t>();
  counts.visibly += row.at("visibly").get<std::uint64_t>();
  counts.most = std::max(counts.most, row.at("most").get<double>());
}

void add_times(const GpuJson& row, const std::string& name, GpuRun& run) {
  const auto time = [&](const char* key) {
    return GpuTime{row.at(key).at("p50").get<double>(), row.at(key).at("p99").get<double>()};
  };
  run.wall[name] = time("wall_ms");
  run.timer[name] = time("timer_ms");
}

/// Numbers with leading zeros, so that names sort as their numbers do.
std::string padded(int number, int digits) {
  std::string text = std::to_string(number);
  return std::string(static_cast<std::size_t>(std::max(0, digits - static_cast<int>(text.size()))), ' ') +
         text;
}

void add_gpu_row(const GpuJson& row, GpuRun& run) {
  const std::string part = row.value("part", std::string());
  if (part == "machine" && row.contains("contexts")) add_machine(row, run);
  if (part == "masks" && row.contains("what")) add_mask(row, run);
  const std::string frame = row.contains("width") ? std::to_string(row.at("width").get<int>()) + " x " +
                                                        std::to_string(row.at("height").get<int>())
                                                  : "";
  if (part == "filters" && row.contains("filter")) {
    add_times(row,
              row.at("filter").get<std::string>() + ", kernel " + padded(row.at("kernel").get<int>(), 2) +
                  ", map " + padded(row.at("map_size").get<int>(), 4) + ", frame " + frame,
              run);
  }
  if (part == "flight" && row.contains("scene"))
    add_times(row, "flight of " + row.at("scene").get<std::string>() + ", frame " + frame, run);
}

std::string device_heads(const std::vector<GpuRun>& runs, const char* first) {
  std::string out = "<thead><tr><th scope=\"col\">" + std::string(first) + "</th>";
  for (const GpuRun& run : runs) out += "<th scope=\"col\">" + escaped(run.device) + "</th>";
  return out + "</tr></thead>\n<tbody>\n";
}

/// A table with a row for each key that any run has, below what its cells are; nothing where no run has a
/// key. `cell` writes what a run has under a key.
template <class Map, class Cell>
std::string device_table(const std::vector<GpuRun>& runs, const std::string& cells, const char* label,
                         const char* first, Map map, Cell cell) {
  std::set<std::string> keys;
  for (const GpuRun& run : runs) {
    for (const auto& [key, value] : map(run)) keys.insert(key);
  }
  if (keys.empty()) return "";
  std::string out =
      "<p>" + cells + "</p>\n" + scroll_box(label, true) + "<table>\n" + device_heads(runs, first);
  for (const std::string& key : keys) {
    out += "<tr><th scope=\"row\">" + escaped(key) + "</th>";
    for (const GpuRun& run : runs) {
      const auto found = map(run).find(key);
      out += "<td>" +
             (found == map(run).end() ? std::string("&ndash;") : cell(run, found->first, found->second)) +
             "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table>\n" + std::string(kScrollBoxEnd);
}

}  // namespace

GpuRun read_gpu_run(const std::string& text, const std::string& where) {
  GpuRun run;
  for_each_json_line(text, where, [&run](std::string_view line) {
    // A run that was cut off and went on leaves a line that is not whole.
    if (!GpuJson::accept(line)) return;
    try {
      add_gpu_row(GpuJson::parse(line), run);
    } catch (const GpuJson::exception& error) {
      throw ReportError(error.what());
    }
  });
  if (run.device.empty())
    throw ReportError(one_line(where + ": no row names the machine: is it a file of measure_gpu?"));
  return run;
}

std::vector<GpuRun> read_gpu_runs(const std::filesystem::path& folder) {
  std::error_code none;
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / kGpuFolder, none))
    files.insert(entry.path());
  std::vector<GpuRun> runs;
  for (const std::filesystem::path& file : files)
    runs.push_back(read_gpu_run(read_text(file), file.string()));
  return runs;
}

std::string gpu_section(const std::vector<GpuRun>& runs) {
  if (runs.empty()) return "";
  std::string out = "<section id=\"s8\">\n<h2>8. Software and GPUs</h2>\n<ul>\n";
  for (const GpuRun& run : runs) {
    out += "<li>" + escaped(run.device) + ": " + escaped(run.machine) + "; timer queries " +
           (run.timers_trusted ? "agree" : "do not agree") + " with the wall clock</li>\n";
  }
  out += "</ul>\n";
  out += device_table(
      runs,
      "Masks against those that software drew: how many are equal bit by bit, the share of pixels whose "
      "visibility differs by more than 1/255, and the largest difference.",
      "Masks of GPUs", "masks of", [](const GpuRun& run) -> const auto& { return run.masks; },
      [](const GpuRun&, const std::string&, const MaskCounts& counts) {
        const double share = static_cast<double>(counts.visibly) /
                             static_cast<double>(std::max<std::size_t>(1, counts.pixels));
        return std::to_string(counts.equal) + " of " + std::to_string(counts.masks) + " equal; " +
               percent(share) + "; " + short_number(counts.most);
      });
  out += device_table(
      runs,
      "Times in milliseconds, 50th and 99th percentile: wall clock; by the driver's timer where it agrees "
      "with the wall clock.",
      "Times of GPUs", "time of", [](const GpuRun& run) -> const auto& { return run.wall; },
      [](const GpuRun& run, const std::string& key, const GpuTime& wall) {
        std::string cell = short_number(wall.p50) + ", " + short_number(wall.p99);
        if (run.timers_trusted)
          cell +=
              "; timer " + short_number(run.timer.at(key).p50) + ", " + short_number(run.timer.at(key).p99);
        return cell;
      });
  return out + "</section>\n";
}

void add_gpu_files(const std::filesystem::path& folder, std::span<const std::filesystem::path> files) {
  make_folder(folder / kGpuFolder);
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::string text = read_text(files[i]);
    (void)read_gpu_run(text, files[i].string());
    std::string number = padded(static_cast<int>(i), 3);
    std::replace(number.begin(), number.end(), ' ', '0');
    write_text(folder / kGpuFolder / (number + ".jsonl"), text);
  }
}

}  // namespace gnomon::report
