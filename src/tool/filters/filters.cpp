// The list of filters and the table of their cost.
#include "filters.hpp"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "compare/technique_words.hpp"
#include "filter_words.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/report/statistics.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "scene_words.hpp"
#include "stage.hpp"

namespace gnomon::tool {
namespace {

using render::FilterSettings;
using report::median;

constexpr double kBlurRadii[] = {0.0, 1.0, 3.0};  // none, 3 x 3, 7 x 7

struct MeasuredFilter {
  FilterSettings settings;
  std::vector<double> milliseconds;
  render::FrameStats stats;
};

/// Every filter with every blur; `hard`, which has none, comes first.
std::vector<MeasuredFilter> runs_of(const std::vector<FilterSettings>& filters) {
  std::vector<MeasuredFilter> runs{{filter_from("hard"), {}, {}}};
  for (const FilterSettings& settings : filters) {
    if (settings.filter == runs[0].settings.filter) continue;
    for (const double radius : kBlurRadii) {
      MeasuredFilter& run = runs.emplace_back();
      run.settings = settings;
      run.settings.radius = radius;
    }
  }
  return runs;
}

std::string cost_row(int map_size, const MeasuredFilter& run, const MeasuredFilter& hard, bool json) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < run.milliseconds.size(); ++i)
    ratios.push_back(run.milliseconds[i] / hard.milliseconds[i]);
  const auto bytes = static_cast<double>(run.stats.map_bytes);
  const double bytes_ratio = bytes / static_cast<double>(hard.stats.map_bytes);
  const int blur = static_cast<int>(2.0 * run.settings.radius + 1.0);
  if (json) {
    return nlohmann::ordered_json{{"map_size", map_size},
                                  {"filter", to_string(run.settings)},
                                  {"blur", blur},
                                  {"ms", median(run.milliseconds)},
                                  {"ms_ratio", median(ratios)},
                                  {"prefilter_passes", run.stats.prefilter_passes},
                                  {"bytes", run.stats.map_bytes},
                                  {"scratch_bytes", run.stats.scratch_bytes},
                                  {"bytes_ratio", bytes_ratio}}
        .dump();
  }
  constexpr double kMebi = 1024.0 * 1024.0;
  const std::string box = blur == 1 ? "none" : std::to_string(blur) + "x" + std::to_string(blur);
  char text[256];
  std::snprintf(text, sizeof text, "| %d | %s | %s | %.1f | %.2f | %d | %.1f | %.2f | %.1f |", map_size,
                std::string(run.settings.filter->info.name).c_str(), box.c_str(), median(run.milliseconds),
                median(ratios), run.stats.prefilter_passes, bytes / kMebi, bytes_ratio,
                static_cast<double>(run.stats.scratch_bytes) / kMebi);
  return text;
}

nlohmann::ordered_json filter_as_json(const render::Filter& filter) {
  nlohmann::ordered_json options = nlohmann::ordered_json::array(), formats = options;
  for (const render::FilterOption& option : filter.info.options) {
    options.push_back({{"name", option.name},
                       {"default", option.fallback},
                       {"min", option.min},
                       {"max", option.max},
                       {"summary", option.summary}});
  }
  for (const render::TexelFormat format : filter.info.formats) formats.push_back(to_string(format));
  return {{"name", filter.info.name},
          {"summary", filter.info.summary},
          {"source", filter.info.source},
          {"options", options},
          {"formats", formats}};
}

std::string filter_list(bool json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  std::string text;
  for (const render::Filter* filter : render::all_filters()) {
    list.push_back(filter_as_json(*filter));
    const std::string name = std::string(filter->info.name) + ": ";
    text += name + std::string(13 - std::min<std::size_t>(13, name.size()), ' ') +
            std::string(filter->info.summary) + "\n";
  }
  return json ? list.dump() : text + "\ngnomon filters NAME prints the options of one filter.";
}

/// The filter called `name`. Throws std::runtime_error with the name that may have been meant.
const render::Filter& filter_called(const std::string& name) {
  const render::Filter* filter = render::find_filter(name);
  if (filter != nullptr) return *filter;
  throw std::runtime_error("there is no filter '" + one_line(name, 80) + "'" +
                           meant(name, names_in(render::all_filters())) + " (gnomon filters lists all)");
}

void print_one_filter(const FiltersRequest& request) {
  const render::Filter& filter = filter_called(request.name);
  std::string text = request.json ? filter_as_json(filter).dump() : render::filter_help(filter);
  if (text.ends_with('\n')) text.pop_back();
  print_line(text);
  flush_output();
}

/// Settings of these words; "all" stands for every filter as by default.
std::vector<FilterSettings> read_settings(const std::string& option, const std::vector<std::string>& words) {
  std::vector<FilterSettings> all;
  for (const std::string& word : split_lists(words)) {
    if (word != "all") {
      all.push_back(filter_word(option, word));
      continue;
    }
    for (const render::Filter* filter : render::all_filters())
      all.push_back(render::default_settings(*filter));
  }
  return all;
}

}  // namespace

void print_filter_cost(const FiltersRequest& request) {
  FilterStage stage(request.scene);
  const Camera camera = default_path(stage.scene()).at(0.5, kStageWidth, kStageHeight);
  if (!request.json) {
    print_line(
        "| map | filter | blur | ms | ratio to hard | prefilter passes | MiB kept | ratio | MiB scratch |");
    print_line("|---|---|---|---|---|---|---|---|---|");
  }
  for (const int map_size : request.map_sizes) {
    std::vector<MeasuredFilter> runs = runs_of(request.filters);
    for (int round = 0; round < request.rounds; ++round) {
      for (MeasuredFilter& run : runs) {
        // Images are made anew where the filter before had others: the first of two draws pays for that.
        (void)stage.draw(run.settings, camera, map_size);
        run.stats = stage.draw(run.settings, camera, map_size);
        run.milliseconds.push_back(run.stats.shadow_ms());
      }
    }
    for (const MeasuredFilter& run : runs) print_line(cost_row(map_size, run, runs[0], request.json));
    flush_output();
  }
}

namespace {

/// Prints the list, one filter or the cost table, or writes the gallery. Throws std::runtime_error.
int run_filters(const FiltersRequest& request) {
  if (!request.name.empty()) {
    if (request.cost || request.contacts || !request.fit.empty() || !request.gallery.empty())
      throw std::runtime_error(one_line(request.name, 80) + ": --cost and --fit take filters by --filters");
    print_one_filter(request);
    return 0;
  }
  check_scene_word("--scene", request.scene);
  check_scene_word("--fit", request.fit);
  if (!request.gallery.empty()) check_folder("--gallery", request.gallery);
  if (request.contacts) {
    print_filter_contacts(request);
    return 0;
  }
  if (!request.cost && request.fit.empty() && request.filters_given)
    throw std::runtime_error("--filters requires --cost, --contacts or --fit");
  if (!request.cost && request.fit.empty() && request.gallery.empty()) {
    print_line(filter_list(request.json));
    flush_output();
    return 0;
  }
  const auto context = render::create_context(request.context);
  if (request.cost) {
    if (!request.json) {
      print_line(context->info().renderer +
                 ": wall clock with glFinish after each pass, median of interleaved rounds\n");
    }
    print_filter_cost(request);
  }
  if (!request.fit.empty()) print_filter_needs(request);
  if (!request.gallery.empty()) write_filter_gallery(request.gallery, request.scene);
  return 0;
}

/// What --fit takes.
std::vector<Option> fit_options(FiltersRequest& request) {
  return {
      {.name = "--fit",
       .target = &request.fit,
       .help =
           "find the cheapest settings of each filter on the maps of this scene: builtin:NAME or a glTF file",
       .names = builtin_scene_words(),
       .only_names = false,
       .completion = Completion::files},
      {.name = "--fit-bound",
       .target = &request.fit_bound,
       .help = "largest difference in visibility that is accepted, steps of 1/255",
       .range = {{0.0, 255.0}},
       .needs = "--fit"},
      {.name = "--fit-exceptions",
       .target = &request.fit_exceptions,
       .help = "percent of the tested receivers that may differ by more",
       .range = {{0.0, 100.0}},
       .needs = "--fit"}};
}

/// What the cost table takes.
std::vector<Option> cost_options(FiltersRequest& request) {
  request.filters = read_settings("--filters", {"all"});
  const auto set_filters = [&request](const std::string& option, const std::vector<std::string>& words) {
    request.filters = read_settings(option, words);
  };
  return {{.name = "--filters",
           .target = ParsedWords{set_filters, "all"},
           .help = "filters of --cost, --contacts and --fit, with options as in vsm:radius=3; or all",
           .names = names_in(render::all_filters(), {"all"}),
           .given = &request.filters_given},
          {.name = "--map-sizes",
           .target = &request.map_sizes,
           .help = "map sizes of --cost, texels along each side",
           .range = {{kLeastMapSize, kMaxMapSize}},
           .needs = "--cost"},
          {.name = "--rounds",
           .target = &request.rounds,
           .help = "measuring rounds of --cost",
           .range = {{1, 1000}},
           .needs = "--cost"},
          {.name = "--scene",
           .target = &request.scene,
           .help = "scene of --cost and --gallery: builtin:NAME or a glTF file",
           .names = builtin_scene_words(),
           .only_names = false,
           .completion = Completion::files}};
}

}  // namespace

std::function<int()> declare_filters(Arguments& arguments) {
  const auto request = std::make_shared<FiltersRequest>();
  std::vector<Option>& options = arguments.options;
  options = {{.name = "NAME",
              .target = &request->name,
              .help = "print the options of this filter: range, default, unit, use and source",
              .names = names_in(render::all_filters()),
              .only_names = false},
             {.name = "--cost",
              .target = &request->cost,
              .help = "measure time and memory of each filter against hard, as a table"},
             {.name = "--contacts",
              .target = &request->contacts,
              .help = "print the light left close behind a flat occluder, for each filter and format"},
             {.name = "--gallery",
              .target = &request->gallery,
              .help = "write the comparisons of the filters' papers as pictures into this folder",
              .completion = Completion::folders}};
  for (Option& option : fit_options(*request)) options.push_back(std::move(option));
  for (Option& option : cost_options(*request)) options.push_back(std::move(option));
  options.push_back({.name = "--json",
                     .target = &request->json,
                     .help = "print the list, one filter or the table as JSON"});
  options.push_back(context_option(request->context));
  return [request] { return run_filters(*request); };
}

}  // namespace gnomon::tool
