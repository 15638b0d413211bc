// The words of `flythrough` and `gnomon fly`, and what they become.
#include "options.hpp"

#include <fmt/core.h>

#include <array>
#include <memory>
#include <stdexcept>

#include "command.hpp"
#include "edit_words.hpp"
#include "filter_words.hpp"
#include "gnomon/render/perceptual.hpp"
#include "gnomon/scene/load.hpp"
#include "lights_frame.hpp"
#include "named_in.hpp"
#include "picture_words.hpp"
#include "plan_option.hpp"
#include "scene_words.hpp"

namespace gnomon::tool::fly {
namespace {

constexpr int kMaxFrames = 100'000;

/// The command line: options, with words that stand for others or name files.
struct Request {
  Options options;
  std::string cost_model, out = options.out.string();
  bool stable = false, split_given = false, lambda_given = false;
};

void resolve_resolution(Options& options) {
  if (!options.perceptual_resolution) return;
  // Whoever asks for texels that the filter hides may want more of them than the metric.
  options.plan.prune = options.plan.prune.without(PruneRule::metric_resolution);
  if (!render::is_kernel_in_world(options.filter)) {
    throw std::runtime_error(
        fmt::format("--resolution perceptual: {} has no size in the world; give it radius and unit=world, or "
                    "take pcss",
                    render::to_string(options.filter)));
  }
}

void resolve_budget(const Request& request, Options& options) {
  if (!request.cost_model.empty()) options.cost_model = request.cost_model;
  if (options.budget.milliseconds > 0.0 && !options.cost_model)
    throw std::runtime_error("--budget-ms: wants --cost-model FILE, which gnomon calibrate writes");
  const bool chosen = options.budget.milliseconds > 0.0 || options.budget.target_error > 0.0;
  if (options.cost_model && !chosen)
    throw std::runtime_error("--cost-model requires --budget-ms or --target-error");
  if (chosen && options.perceptual_resolution)
    throw std::runtime_error(
        "--resolution perceptual: --budget-ms and --target-error choose the maps already");
}

void check_animation(const Options& options) {
  if (!options.animation.empty() && options.perceptual_resolution)
    throw std::runtime_error(
        "--animation: not with --resolution perceptual, which looks at the scene at rest");
}

}  // namespace

std::string_view for_whole_maps(const Options& options) {
  const std::array<std::pair<bool, const char*>, 7> of_maps{{
      {!options.compared_warps.empty(), "--compare-warps"},
      {options.history, "--history"},
      {options.visible_depths, "--visible-depths"},
      {options.coarse_depths, "--coarse-depths"},
      {options.transition != render::SplitTransition::cut, "--transition"},
      {options.perceptual_resolution, "--resolution perceptual"},
      {options.filter_precision > 0.0, "--filter-precision"},
  }};
  for (const auto& [given, name] : of_maps)
    if (given) return name;
  return {};
}

namespace {

Options resolved(const Request& request) {
  Options options = request.options;
  check_scene_word("scene", options.scene);
  options.out = request.out;
  resolve_lambda(request.lambda_given, request.split_given, options.plan);
  if (request.stable) (void)set_plan_choice("fit", "stable", options.plan);
  render::set_margin(options.filter, options.plan);
  options.prune = options.plan.prune;
  resolve_resolution(options);
  if (options.transition != render::SplitTransition::cut) options.plan.split.overlap = kTransitionShare;
  resolve_budget(request, options);
  check_page_size(options.pages);
  if (const std::string_view other = for_whole_maps(options); options.pages.on() && !other.empty())
    throw std::runtime_error(fmt::format("--pages: {} is for whole maps", other));
  if (options.all_lights())
    if (const std::string refusal = all_lights_refusal(options); !refusal.empty())
      throw std::runtime_error(refusal);
  check_animation(options);
  check_camera(options.camera);
  return options;
}

std::string prune_footer() {
  std::string text = "Rules of --prune (docs/pruning.md):\n";
  for (const PruneRuleInfo& rule : prune_rules()) text += fmt::format("  {:<20} {}\n", rule.name, rule.what);
  return text;
}

Option prune_option(PlanOptions& plan) {
  Option option = plan_option(
      "prune", plan, "work that may be omitted: default, all, exact, none, or rules joined by commas");
  option.names = {"default", "all", "exact", "none"};
  for (const PruneRuleInfo& rule : prune_rules()) option.names.emplace_back(rule.name);
  return option;
}

/// Where to fly, and what becomes of it.
std::vector<Option> flight_options(Request& request) {
  Options& options = request.options;
  const std::vector<std::string> contexts{"auto", "osmesa", "egl", "glfw"};  // in the order of ContextKind
  return {
      {.name = "scene",
       .target = &options.scene,
       .help = scene_help(),
       .names = builtin_scene_words(),
       .only_names = false,
       .completion = Completion::files},
      {.name = "--frames",
       .target = &options.frames,
       .help = "frames along the camera path, from its first point to its last",
       .range = {{1, kMaxFrames}},
       .given = &options.frames_given},
      size_option(options.width, options.height, "size of a frame in pixels, WIDTHxHEIGHT",
                  &options.size_given),
      {.name = "--animation",
       .target = &options.animation,
       .help = "animation that the scene plays during the flight, by name or number",
       .word = "NAME"},
      {.name = "--animation-fps",
       .target = &options.animation_fps,
       .help = "frames in a second of the animation",
       .range = {{1e-3, 1e6}},
       .needs = "--animation"},
      {.name = "--animation-start",
       .target = &options.animation_start,
       .help = "time of the first frame within the animation, seconds",
       .range = {{-1e9, 1e9}},
       .needs = "--animation"},
      {.name = "--out",
       .target = &request.out,
       .help = "folder for the files",
       .completion = Completion::folders},
      {.name = "--shadow-only",
       .target = &options.shadow_only,
       .help = "write the shadow alone, to composite over a picture: black, with the share of light that is "
               "missing as alpha",
       .excludes = {"--compare-warps"}},
      {.name = "--json",
       .target = &options.json,
       .help = "print files, options and the figures of each frame as one line of JSON"},
      {.name = "--context",
       .target = enum_word(options.context, contexts),
       .help = "OpenGL context: auto, osmesa, egl, or glfw for a window",
       .names = contexts}};
}

Option compare_warps_option(std::vector<const Warp*>& warps) {
  const auto set = [&warps](const std::string& option, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      PlanOptions one;
      if (!set_plan_choice("warp", name, one)) refuse_name(option, name, plan_choice_names("warp"));
      warps.push_back(one.warp.warp);
    }
  };
  return {.name = "--compare-warps",
          .target = ParsedWords{set, {}},
          .help = "also draw every frame with these warps side by side, as in none,lispsm,auto",
          .names = plan_choice_names("warp"),
          .delimiter = ','};
}

/// What a plan may choose.
std::vector<Option> map_options(Request& request) {
  PlanOptions& plan = request.options.plan;
  Option split = plan_option("split", plan);
  std::erase(split.names, "given");  // a command line has no list of splits
  split.given = &request.split_given;
  Option lambda = plan_option("lambda", plan);
  lambda.given = &request.lambda_given;
  Option fit = plan_option("fit", plan);
  fit.excludes = {"--stable"};
  return {
      plan_option("cascades", plan),
      split,
      lambda,
      plan_option("near_hint", plan),
      plan_option("warp", plan),
      compare_warps_option(request.options.compared_warps),
      plan_option("objective", plan),
      plan_option("map_size", plan),
      fit,
      {.name = "--stable", .target = &request.stable, .help = "the same as --fit stable: texel-snapped maps"},
      {.name = "--transition",
       .target = enum_word(request.options.transition, transition_names()),
       .help = "transition between cascades: cut; blend or dither over the last tenth of each",
       .names = transition_names()},
      layer_option(request.options.layer),
      map_passes_option(request.options.map_passes),
      {.name = "--history",
       .target = &request.options.history,
       .help = "change texel density smoothly from frame to frame; for paths of many frames"},
      {.name = "--visible-depths",
       .target = &request.options.visible_depths,
       .help = "draw each frame twice, and plan the second for the depths that the first shows"},
      {.name = "--coarse-depths",
       .target = &request.options.coarse_depths,
       .help =
           "plan each frame for the depths that a coarse pass on the CPU finds visible, in the scene at rest",
       .excludes = {"--visible-depths", "--animation"}},
      prune_option(plan)};
}

/// How large maps are, and what is chosen by itself.
std::vector<Option> budget_options(Request& request) {
  Options& options = request.options;
  const std::vector<std::string> resolutions{"given", "perceptual"};
  return {{.name = "--map-memory-mib",
           .target = &options.map_memory_mib,
           .help = "memory for all maps, MiB; larger maps are halved until they fit; 0: no limit",
           .range = {{0.0, 1e9}}},
          max_triangles_option(options.max_triangles),
          {.name = "--resolution",
           .target = enum_word(options.perceptual_resolution, resolutions),
           .help = "given: by --map-size; perceptual: the smallest maps whose texels the filter hides",
           .names = resolutions},
          {.name = "--budget-ms",
           .target = &options.budget.milliseconds,
           .help = "choose warp, maps and filter for the least error within this time, milliseconds; with "
                   "--pages, pages as well; 0: off",
           .range = {{0.0, 1e9}}},
          {.name = "--target-error",
           .target = &options.budget.target_error,
           .help = "choose the cheapest technique that misclassifies at most this share of pixels; 0: off",
           .range = {{0.0, 1.0}}},
          {.name = "--cost-model",
           .target = &request.cost_model,
           .help = "cost model written by gnomon calibrate; without it cost is counted in texels",
           .completion = Completion::files}};
}

std::vector<Option> filter_options(Request& request) {
  Options& options = request.options;
  const auto set_filter = [&options](const std::string& word) {
    options.filter = filter_word("--filter", word);
    return true;
  };
  return {
      {.name = "--filter",
       .target = ParsedWord{set_filter, render::to_string(options.filter)},
       .help = "shadow filter, with options as in pcf:radius=2,unit=texels; gnomon filters lists all, gnomon "
               "filters NAME the options of one",
       .names = names_in(render::all_filters())},
      {.name = "--filter-precision",
       .target = &options.filter_precision,
       .help = "let the filter store less if visibility then changes by at most this, steps of 1/255; "
               "checked at the first frame and every 60th; 0: off",
       .range = {{0.0, 255.0}}},
      {.name = "--blocker-distance",
       .target = &options.blocker_distance,
       .help =
           "distance from receiver to caster that pcss is sized for, world units; 0: half the scene's height",
       .range = {{0.0, 1e12}},
       .needs = "--resolution"}};
}

std::vector<Option> page_options(Request& request) {
  return page_setting_options(request.options.pages);
}

std::vector<Option> scene_options(Request& request) {
  std::vector<Option> options = light_options(request.options.light);
  options.push_back(scene_light_option(request.options.light_of_file));
  for (Option& option : camera_options(request.options.camera)) options.push_back(std::move(option));
  for (Option& option : edit_options(request.options.edits)) options.push_back(std::move(option));
  return options;
}

}  // namespace

Light light_of(const Options& options, const Scene& scene) {
  if (options.light_of_file.empty()) return default_light(options.light, scene.bounds_world);
  return named_in(scene.lights, options.light_of_file, "--scene-light", "light").light;
}

}  // namespace gnomon::tool::fly

namespace gnomon::tool {

std::function<int()> declare_fly(Arguments& arguments) {
  const auto request = std::make_shared<fly::Request>();
  for (const auto& part : {fly::flight_options, fly::map_options, fly::page_options, fly::budget_options,
                           fly::filter_options, fly::scene_options}) {
    for (Option& option : part(*request)) arguments.options.push_back(std::move(option));
  }
  arguments.footer = fly::prune_footer();
  return [request] { return fly::run(fly::resolved(*request)); };
}

}  // namespace gnomon::tool
