// `gnomon merge` and `gnomon report`: results of many runs into one folder, and the page again.
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "command.hpp"
#include "gnomon/report/figures.hpp"
#include "gnomon/report/gpu_files.hpp"
#include "gnomon/report/page.hpp"
#include "gnomon/report/rows_file.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& line : warnings) warn(line);
}

/// Joins the folders' rows and pictures in `out` and writes the report there.
int run_merge(const std::vector<std::string>& folders, const std::string& out, bool json) {
  const std::vector<std::filesystem::path> paths(folders.begin(), folders.end());
  std::vector<std::string> warnings;
  const std::size_t rows = report::merge_rows(paths, out, &warnings);
  const std::string file = (std::filesystem::path(out) / report::kRowsFile).string();
  const std::string page = report::write_report(out, &warnings).string();
  print_warnings(warnings);
  if (json) {
    print_line(nlohmann::json{{"count", rows}, {"rows", file}, {"report", page}}.dump());
  } else {
    print_line("rows:   " + std::to_string(rows) + " in " + file);
    print_line("report: " + page);
  }
  flush_output();
  return 0;
}

/// Writes the report of each folder again, with files of GPUs added, and the survey's charts where a folder
/// for them is named.
int run_report(const std::vector<std::string>& folders, const std::vector<std::string>& gpu,
               const std::string& figures, bool json) {
  if (!gpu.empty() && folders.size() != 1)
    throw std::runtime_error("--gpu: wants one folder DIR for its report");
  if (!gpu.empty()) {
    const std::vector<std::filesystem::path> files(gpu.begin(), gpu.end());
    report::add_gpu_files(folders.front(), files);
  }
  if (folders.empty() && figures.empty()) throw std::runtime_error("DIR: wants a folder with results.jsonl");
  nlohmann::json pages = nlohmann::json::array(), charts = nlohmann::json::array();
  if (!figures.empty()) {
    for (const std::filesystem::path& file : report::write_figures(figures)) {
      charts.push_back(file.string());
      if (!json) print_line(file.string());
    }
  }
  for (const std::string& folder : folders) {
    std::vector<std::string> warnings;
    pages.push_back(report::write_report(folder, &warnings).string());
    print_warnings(warnings);
    if (!json) print_line(pages.back().get<std::string>());
  }
  if (json) print_line(nlohmann::json{{"reports", pages}, {"figures", charts}}.dump());
  flush_output();
  return 0;
}

struct FoldersRequest {
  std::vector<std::string> folders, gpu;
  std::string out = "out/merged", figures;
  bool json = false;
};

Option folders_option(FoldersRequest& request) {
  return {.name = "DIR",
          .target = &request.folders,
          .help = "folders with results.jsonl",
          .required = true,
          .completion = Completion::folders};
}

Option json_option(FoldersRequest& request) {
  return {.name = "--json", .target = &request.json, .help = "print a summary as one line of JSON"};
}

}  // namespace

std::function<int()> declare_merge(Arguments& arguments) {
  const auto request = std::make_shared<FoldersRequest>();
  arguments.options = {folders_option(*request),
                       {.name = "--out",
                        .target = &request->out,
                        .help = "folder for the joined results and the report",
                        .completion = Completion::folders},
                       json_option(*request)};
  return [request] { return run_merge(request->folders, request->out, request->json); };
}

std::function<int()> declare_report(Arguments& arguments) {
  const auto request = std::make_shared<FoldersRequest>();
  arguments.options = {
      folders_option(*request),
      {.name = "--figures",
       .target = &request->figures,
       .help = "also write two charts of the survey from measured plans into this folder: "
               "storage by number of maps, and error by depth",
       .word = "DIR",
       .completion = Completion::folders},
      {.name = "--gpu",
       .target = &request->gpu,
       .help = "files that measure_gpu of the portable folder wrote: a column for each in the report of DIR",
       .word = "FILE",
       .completion = Completion::files},
      json_option(*request)};
  arguments.options.front().required = false;
  return [request] { return run_report(request->folders, request->gpu, request->figures, request->json); };
}

}  // namespace gnomon::tool
