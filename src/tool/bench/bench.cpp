// `gnomon bench`: which technique for which budget on this machine? A short study in minutes, by the code of
// `gnomon compare`, on one page.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench_study.inc"
#include "command.hpp"
#include "compare/compare.hpp"
#include "compare/study_file.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "picture_words.hpp"

namespace gnomon::tool {
namespace {

using Json = nlohmann::ordered_json;

struct BenchRequest : CompareRequest {
  double minutes = 5.0;
};

/// Map sizes of the study are for 270 rows: others have as many texels for a pixel, to a power of two.
void fit_to_picture(const BenchRequest& bench, CompareRequest& view) {
  constexpr double kRows = 270.0;
  const double factor = std::exp2(std::round(std::log2(bench.height / kRows)));
  const auto fitted = [factor](int size) {
    return static_cast<int>(std::clamp(size * factor, double{kLeastMapSize}, double{kMaxMapSize}));
  };
  view.width = bench.width;
  view.height = bench.height;
  for (int& size : view.map_sizes) size = fitted(size);
  for (report::Technique& technique : view.techniques) technique.map_size = fitted(technique.map_size);
}

void print_choices(const Json& budgets) {
  for (const auto& [error, choices] : budgets["choices"].items()) {
    if (choices.empty()) continue;
    print_line("\nleast " + budgets["errors"][error].get<std::string>() + ":");
    for (const Json& choice : choices) {
      std::array<char, 80> text{};
      const double percent = 100.0;
      std::snprintf(text.data(), text.size(), "  from %7.3g ms  %7.3g %% (%.3g to %.3g)  ",
                    choice["budget_ms"].get<double>(), percent * choice["error"]["median"].get<double>(),
                    percent * choice["error"]["low"].get<double>(),
                    percent * choice["error"]["high"].get<double>());
      print_line(text.data() + choice["technique"].get<std::string>());
    }
  }
}

int run_bench(BenchRequest bench) {
  constexpr double kSecondsOfMinute = 60.0;
  bench.seconds = kSecondsOfMinute * bench.minutes;
  std::vector<CompareRequest> views = study_from(kBenchStudy, "gnomon bench", bench, compare_options);
  for (CompareRequest& view : views) fit_to_picture(bench, view);
  const Compared done = compare(views);
  const std::filesystem::path file = std::filesystem::path(bench.out) / "budgets.json";
  std::ifstream in(file);
  const Json budgets = Json::parse(in);
  if (bench.json) {
    print_line(budgets.dump());
  } else {
    print_choices(budgets);
    print_line("\nviews:  " + std::to_string(views.size() - done.frames_left) + " of " +
               std::to_string(views.size()) +
               (done.frames_left > 0 ? ", as many as time allowed; --resume measures the others" : ""));
    print_line("page:   " + done.page);
    print_line("JSON:   " + file.string());
  }
  flush_output();
  return 0;
}

}  // namespace

std::function<int()> declare_bench(Arguments& arguments) {
  const auto request = std::make_shared<BenchRequest>();
  request->out = "out/bench";
  arguments.options = {
      {.name = "--minutes",
       .target = &request->minutes,
       .help = "about how long it may take; one view is measured in any case",
       .range = {{0.01, 1440.0}}},
      size_option(request->width, request->height,
                  "size of a frame in pixels, WIDTHxHEIGHT; maps grow and shrink with it"),
      {.name = "--out",
       .target = &request->out,
       .help = "folder for results and page",
       .completion = Completion::folders},
      {.name = "--resume", .target = &request->resume, .help = "measure more views into --out"},
      {.name = "--json", .target = &request->json, .help = "print budgets.json as one line"},
      context_option(request->context)};
  arguments.footer =
      "Twelve techniques on up to fourteen views of built-in scenes, a view at a time and interleaved, until "
      "the time is over. The page begins with a table of budgets: from which time on a technique has the "
      "least "
      "error, with 95 % intervals, and which differences are noise; budgets.json has the same. gnomon "
      "compare measures other scenes and techniques.\n";
  return [request] { return run_bench(*request); };
}

}  // namespace gnomon::tool
