// The command line of `gnomon compare`.
#include <charconv>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "command.hpp"
#include "compare.hpp"
#include "edit_words.hpp"
#include "identifier_word.hpp"
#include "offscreen_context.hpp"
#include "output.hpp"
#include "picture_words.hpp"
#include "scene_words.hpp"
#include "study_file.hpp"

namespace gnomon::tool {
namespace {

/// By name: whether the option stands on the command line.
using Given = std::map<std::string, bool>;

int run_compare(const CompareRequest& request, const Given& given) {
  const bool is_study = request.scenes.size() == 1 && is_study_file(request.scenes.front());
  for (const auto& [option, stands] : given) {
    if (is_study && stands && option != "SCENE" && !stands_beside_study(option))
      throw std::runtime_error(option + ": not beside a study, whose file has it as a field");
  }
  const std::vector<CompareRequest> requests =
      is_study ? read_study(request.scenes.front(), request, compare_options) : std::vector{request};
  const Compared done = compare(requests);
  if (request.json) {
    print_line(nlohmann::json{{"rows", done.rows}, {"report", done.page}, {"refused", done.refused}}.dump());
  } else {
    print_line("rows:   " + done.rows);
    if (!done.page.empty()) print_line("report: " + done.page);
  }
  flush_output();
  return done.refused.empty() ? 0 : 1;
}

/// The product that is gone through.
std::vector<Option> technique_options(CompareRequest& request) {
  return {
      {.name = "--warps",
       .target = word_list(request.warps, read_warps, {"none", "lispsm", "optimal"}),
       .help = "perspective warps, or all; auto lets the plan choose; behind a colon a shape or an "
               "objective, as in optimal:picture",
       .names = names_in(all_warps(), {"all", "auto"})},
      {.name = "--shapes",
       .target = word_list(request.shapes, read_shapes, {"linear"}),
       .help = "how texels lie, or all; rectilinear plans with the points that a frame shows",
       .names = names_in(all_shapes(), {"all"})},
      {.name = "--splits",
       .target = word_list(request.splits, read_splits, {"auto"}),
       .help = "how receivers are divided among maps; listed below",
       .names = split_names()},
      {.name = "--near-hint",
       .target = &request.near_hint,
       .help = "view depth, world units, from which the error of split pseudo_near counts; 0: the near plane",
       .range = {{0.0, 1e30}}},
      {.name = "--fits",
       .target = word_list(request.fits, read_fits, {"tight"}),
       .help = "fits of a map: tight, stable",
       .names = {"tight", "stable"}},
      {.name = "--cascades",
       .target = word_list(request.cascades, read_cascades, {"1", "4"}),
       .help = "numbers of shadow maps along the view"},
      {.name = "--filters",
       .target = word_list(request.filters, read_filters, {"all"}),
       .help = "filters, with options as in vsm:radius=3; all, irregular (exact; :samples=8), identifiers",
       .names = names_in(render::all_filters(), {"all", std::string(kIrregular), std::string(kIdentifiers)})},
      {.name = "--layers",
       .target = word_list(request.layers, read_layers, {"front"}),
       .help = "depths that the maps store: front, back, second, ..., or all; listed below",
       .names = layer_names({"all"})},
      {.name = "--map-sizes",
       .target = word_list(request.map_sizes, read_map_sizes, {"1024"}),
       .help = "sizes of a map, texels along each side"},
      {.name = "--pages",
       .target = word_list(request.pages, read_page_policies, {}),
       .help = "page policies, or all: pages of as many texels as the maps, beside them; listed below",
       .names = names_in(all_page_policies(), {"all"})},
      {.name = "--page-sizes",
       .target = word_list(request.page_sizes, read_page_sizes, {"128"}),
       .help = "sizes of a page, texels along each side: 64, 128, 256"},
      {.name = "--page-target",
       .target = &request.page_target,
       .help = "error m that pages are opened for; 0: the least that the pool holds",
       .range = {{0.0, 1e6}}}};
}

Option shard_option(CompareRequest& request) {
  const auto set = [&request](const std::string& word) {
    constexpr std::size_t kMaxShards = 1'000'000;
    std::size_t shard = 0, shards = 0;
    const char* const end = word.data() + word.size();
    const auto [slash, no_shard] = std::from_chars(word.data(), end, shard);
    const bool parted = no_shard == std::errc{} && slash != end && *slash == '/';
    const auto [last, no_shards] = std::from_chars(parted ? slash + 1 : end, end, shards);
    if (!parted || no_shards != std::errc{} || last != end || shard < 1 || shard > shards ||
        shards > kMaxShards)
      throw std::runtime_error("--shard " + word + ": wants I/N with 1 <= I <= N, as in 2/8");
    request.shard = shard - 1;
    request.shards = shards;
    return true;
  };
  return {.name = "--shard",
          .target = ParsedWord{set, "1/1"},
          .help = "I/N: measure only part I of N; gnomon merge joins the parts"};
}

/// What it is measured on.
std::vector<Option> frame_options(CompareRequest& request) {
  return {{.name = "--frames",
           .target = &request.frames,
           .help = "frames: the middles of as many equal parts of the camera path",
           .range = {{1, 100'000}}},
          {.name = "--animation",
           .target = &request.animation,
           .help = "animation that the scenes play while frames pass, by name or number",
           .word = "NAME"},
          {.name = "--pixel-samples",
           .target = &request.pixel_samples,
           .help = "rays through each pixel, for errors over whole pixels and twinkling; 0: none",
           .range = {{0, 64}}},
          {.name = "--rounds",
           .target = &request.rounds,
           .help = "timings of each technique per timed frame",
           .range = {{1, 10'000}}},
          {.name = "--timed-frames",
           .target = &request.timed_frames,
           .help = "of the frames, evenly spread, that are timed; 0: each",
           .range = {{0, 100'000}}},
          map_passes_option(request.map_passes),
          {.name = "--visible-depths",
           .target = &request.visible_depths,
           .help = "plan with the view depths that the frame shows"},
          {.name = "--visible-points",
           .target = &request.visible_points,
           .help = "plan with points of the surfaces that the frame shows, where the split names no others"},
          size_option(request.width, request.height),
          {.name = "--out",
           .target = &request.out,
           .help = "folder for results and report",
           .completion = Completion::folders},
          shard_option(request),
          context_option(request.context)};
}

std::vector<Option> scene_options(CompareRequest& request) {
  std::vector<Option> options = light_options(request.light);
  options.push_back(
      {.name = "--local-lights",
       .target = &request.local_lights,
       .help = "so many spots and points over the scene, each measured alone; behind a split "
               ":budget lets them share their texels (plan_lights)",
       .range = {{0, kMostLocalLights}},
       .excludes = {"--light", "--light-elevation-deg", "--light-azimuth-deg", "--sun", "--capture"}});
  for (Option& option : camera_options(request.camera)) options.push_back(std::move(option));
  for (Option& option : edit_options(request.edits)) options.push_back(std::move(option));
  return options;
}

/// Techniques of others, and where their frames come from.
std::vector<Option> entry_options(CompareRequest& request) {
  const auto set = [&request](const std::string& option, const std::vector<std::string>& words) {
    request.entries.clear();
    for (const std::string& word : words) request.entries.push_back(entry_word(option, word));
  };
  return {
      {.name = "--entry",
       .target = ParsedWords{set, {}},
       .help = "techniques of others as NAME=PATH: a capture of their maps, or a folder of their masks",
       .word = "NAME=PATH"},
      {.name = "--capture",
       .target = &request.capture,
       .help = "take cameras and sun from a capture, in place of path and light",
       .completion = Completion::files},
      {.name = "--write-masks",
       .target = &request.write_masks,
       .help = "write masks of each technique into --out, as --entry reads them"},
      {.name = "--exact",
       .target = &request.exact,
       .help =
           "folder that keeps exact results for later runs; none: keep nothing; default: exact, beside --out",
       .completion = Completion::folders}};
}

/// What the machine may give.
std::vector<Option> limit_options(CompareRequest& request) {
  return {{.name = "--map-memory-mib",
           .target = &request.map_memory_mib,
           .help = "memory for a technique's maps, MiB; larger maps are halved until they fit; 0: no limit",
           .range = {{0.0, 1e9}}},
          max_triangles_option(request.max_triangles),
          {.name = "--resume", .target = &request.resume, .help = "continue with the results in --out"},
          {.name = "--json", .target = &request.json, .help = "print a summary as one line of JSON"}};
}

/// What the lists take.
std::string compare_footer() {
  return "Lists take commas or spaces. Every combination of the lists is measured once. Each result is on "
         "the disk before the next frame begins: after a crash, --resume continues. Errors compare the "
         "shadow mask with exact rays.\n\n"
         "Warps: " +
         any_of_text(names_in(all_warps(), {"auto"})) + ".\nSplits: " + any_of_text(split_names()) +
         ", each with :finest, :visible_depths, :coarse_depths, :visible_points, :shadow_edges or :budget "
         "(maps share their texels) behind "
         "it, and "
         "frustum_faces with :slices=K for up to K maps along each side face. practical takes :lambda=L, "
         "0 uniform .. 1 logarithmic" +
         ".\nPages: " + any_of_text(names_in(all_page_policies())) +
         ": virtual shadow maps of as many texels as the maps beside them, with every filter of --filters "
         "that can be drawn on pages; the others are named and skipped. docs/pages.md explains them." +
         "\nLayers: " + any_of_text(layer_names()) +
         ", each with :linear behind it for depths even along the light. gnomon bias and docs/bias.md "
         "compare them." +
         "\nFilters: " + any_of_text(names_in(render::all_filters())) +
         ". gnomon filters NAME prints the options of one. " + std::string(kIrregular) +
         " takes no filter: casters are tested against each pixel, for exact hard shadows at their price. " +
         std::string(kIdentifiers) +
         " compares who is nearest in place of how near; :of=triangle numbers triangles in place of "
         "instances, neighbours=1 takes the texels around as well."
         "\n\nExit: 0 all is measured; 1 an entry was refused, which a line names, and all else is measured; "
         "2 "
         "bad input.\n";
}

}  // namespace

std::vector<Option> compare_options(CompareRequest& request) {
  request.out = "out/compare";
  request.pixel_samples = report::kPixelSamples;
  std::vector<Option> options{scenes_option(request, "builtin:NAME or glTF files; or one study.json", true)};
  for (const auto& part : {technique_options, entry_options, frame_options, scene_options, limit_options}) {
    for (Option& option : part(request)) options.push_back(std::move(option));
  }
  return options;
}

std::function<int()> declare_compare(Arguments& arguments) {
  const auto request = std::make_shared<CompareRequest>();
  const auto given = std::make_shared<Given>();
  arguments.options = compare_options(*request);
  for (Option& option : arguments.options) option.given = &(*given)[option.name];
  arguments.footer = compare_footer();
  return [request, given] { return run_compare(*request, *given); };
}

}  // namespace gnomon::tool
