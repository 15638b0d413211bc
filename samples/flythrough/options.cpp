// Reads and checks the command line.
#include "options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "gnomon/render/perceptual.hpp"
#include "gnomon/scene/load.hpp"
#include "gnomon/split.hpp"

namespace flythrough {
namespace {

constexpr int kMaxFrames = 100'000, kMaxSide = 16'384;

/// The names of a registry, for messages and help: "a, b or c".
template <class Entries>
std::string names_of(const Entries& entries) {
  std::string all;
  std::size_t n = 0;
  for (const auto& entry : entries) {
    if (n > 0) all += n + 1 == entries.size() ? " or " : ", ";
    all += entry->name;
    ++n;
  }
  return all;
}

/// What the command line says, before it is understood.
struct Raw {
  std::string size = "960x540", context = "auto", split, warp = "auto", objective = "storage", filter = "pcf",
              path, light = "sun";
  std::string cost_model;
  std::string fit = "tight", resolution = "given", transition = "cut";
  std::string prune = "all";
  bool stable = false, lambda_given = false;
  std::vector<std::string> compared_warps;
};

void parse_size(const std::string& text, Options& options) {
  const std::size_t x = text.find('x');
  const auto number = [&text](std::size_t begin, std::size_t end, int& value) {
    const auto [last, error] = std::from_chars(text.data() + begin, text.data() + end, value);
    return error == std::errc{} && last == text.data() + end && value >= 16 && value <= kMaxSide;
  };
  if (x == std::string::npos || !number(0, x, options.width) || !number(x + 1, text.size(), options.height)) {
    throw UsageError(
        fmt::format("--size {}: wants WIDTHxHEIGHT, each 16 to {}, as in 960x540", text, kMaxSide));
  }
}

/// nullptr: chosen by the plan.
const gnomon::Warp* warp_named(const char* option, const std::string& name) {
  const gnomon::Warp* warp = gnomon::find_warp(name);
  if (warp == nullptr && name != "auto") {
    throw UsageError(fmt::format("{} {}: wants auto, {}", option, name, names_of(gnomon::all_warps())));
  }
  return warp;
}

/// CLI::Range lets not-a-number through.
void need_number(const char* name, double value) {
  if (std::isnan(value)) throw UsageError(fmt::format("{} nan: wants a number", name));
}

void resolve_resolution(const Raw& raw, Options& options) {
  need_number("--blocker-distance", options.blocker_distance);
  options.perceptual_resolution = raw.resolution == "perceptual";
  if (!options.perceptual_resolution && raw.resolution != "given") {
    throw UsageError(fmt::format("--resolution {}: wants given or perceptual", raw.resolution));
  }
  if (options.perceptual_resolution && !gnomon::render::is_kernel_in_world(options.filter)) {
    throw UsageError(
        fmt::format("--resolution perceptual: {} has no size in the world; give it radius and unit=world, or "
                    "take pcss",
                    gnomon::render::to_string(options.filter)));
  }
}

void resolve_budget(const Raw& raw, Options& options) {
  need_number("--budget-ms", options.budget.milliseconds);
  need_number("--target-error", options.budget.target_error);
  if (!raw.cost_model.empty()) options.cost_model = raw.cost_model;
  if (options.budget.milliseconds > 0.0 && !options.cost_model)
    throw UsageError("--budget-ms: wants --cost-model FILE, which gnomon calibrate writes");
  const bool chosen = options.budget.milliseconds > 0.0 || options.budget.target_error > 0.0;
  if (chosen && options.perceptual_resolution)
    throw UsageError("--resolution perceptual: --budget-ms and --target-error choose the maps already");
}

void resolve_transition(const Raw& raw, Options& options) {
  using gnomon::render::SplitTransition;
  if (raw.transition == "cut") return;
  if (raw.transition != "blend" && raw.transition != "dither") {
    throw UsageError(fmt::format("--transition {}: wants cut, blend or dither", raw.transition));
  }
  options.transition = raw.transition == "blend" ? SplitTransition::blend : SplitTransition::dither;
  options.plan.split.overlap = kTransitionShare;
}

void resolve(const Raw& raw, Options& options) {
  parse_size(raw.size, options);
  need_number("--lambda", options.plan.split.lambda);
  need_number("--map-memory-mib", options.map_memory_mib);
  need_number("--light-elevation-deg", options.light.elevation_deg);
  need_number("--light-azimuth-deg", options.light.azimuth_deg);
  if (!gnomon::render::context_kind_from_name(raw.context, options.context)) {
    throw UsageError(fmt::format("--context {}: wants auto, osmesa, egl or glfw", raw.context));
  }
  if (!raw.split.empty() && !gnomon::split_scheme_from_name(raw.split, options.plan.split.scheme)) {
    throw UsageError(fmt::format(
        "--split {}: wants auto, uniform, logarithmic, practical, pseudo_near or optimal", raw.split));
  }
  if (raw.split.empty() && raw.lambda_given) options.plan.split.scheme = gnomon::SplitScheme::practical;
  if (!gnomon::light_kind_from_name(raw.light, options.light.kind)) {
    throw UsageError(fmt::format("--light {}: wants sun, spot or point", raw.light));
  }
  options.plan.warp.warp = warp_named("--warp", raw.warp);
  for (const std::string& name : raw.compared_warps)
    options.compared_warps.push_back(warp_named("--compare-warps", name));
  if (!gnomon::objective_from_name(raw.objective, options.plan.warp.objective)) {
    throw UsageError(fmt::format("--objective {}: wants storage, max or p95", raw.objective));
  }
  const gnomon::render::ParsedFilter filter = gnomon::render::parse_filter(raw.filter);
  if (!filter.error.empty()) throw UsageError(fmt::format("--filter {}", filter.error));
  options.filter = filter.settings;
  if (!gnomon::fit_from_name(raw.fit, options.plan.fit)) {
    throw UsageError(fmt::format("--fit {}: wants tight, rotated, stable or warped_stable", raw.fit));
  }
  if (raw.stable) options.plan.fit = gnomon::Fit::stable;
  // A warped grid can only stand still from frame to frame.
  if (options.plan.fit == gnomon::Fit::warped_stable) options.history = true;
  gnomon::render::set_margin(options.filter, options.plan);
  if (!gnomon::parse_prune_rules(raw.prune, options.prune)) {
    std::string names;
    for (const gnomon::PruneRuleInfo& rule : gnomon::prune_rules()) names += fmt::format(", {}", rule.name);
    throw UsageError(fmt::format("--prune {}: wants all, exact, none, or a list of rules without spaces{}",
                                 raw.prune, names));
  }
  options.plan.prune = options.prune;
  // Whoever asks for texels that the filter hides may want more of them than the metric.
  if (raw.resolution == "perceptual")
    options.plan.prune = options.plan.prune.without(gnomon::PruneRule::metric_resolution);
  resolve_resolution(raw, options);
  resolve_transition(raw, options);
  resolve_budget(raw, options);
  if (!raw.path.empty()) options.path = raw.path;
}

std::string scene_help() {
  std::string text = "glTF file (.gltf, .glb) or one of";
  for (const gnomon::BuiltinScene& scene : gnomon::builtin_scenes())
    text += fmt::format(" builtin:{}", scene.name);
  return text;
}

std::string prune_help() {
  std::string text;
  for (const gnomon::PruneRuleInfo& rule : gnomon::prune_rules())
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", rule.name, rule.what);
  return text;
}

std::string first_line(std::string text) {
  return text.substr(0, text.find('\n'));
}

void declare_light(CLI::App& app, Raw& raw, Options& options) {
  app.add_option("--light", raw.light, "sun, or a spot or point light in the middle of the scene");
  app.add_option("--light-elevation-deg", options.light.elevation_deg, "of the sun above the horizon")
      ->check(CLI::Range(0.1, 90.0));
  app.add_option("--light-azimuth-deg", options.light.azimuth_deg,
                 "where the sun stands: 0 over -Z, 90 over +X")
      ->check(CLI::Range(-360.0, 360.0));
}

void declare(CLI::App& app, Raw& raw, Options& options) {
  app.set_version_flag("--version", "flythrough " GNOMON_VERSION);
  app.option_defaults()->always_capture_default();
  app.add_option("scene", options.scene, scene_help());
  app.add_option("--frames", options.frames, "pictures along the flight")->check(CLI::Range(1, kMaxFrames));
  app.add_option("--size", raw.size, "of a picture, WIDTHxHEIGHT");
  app.add_option("--out", options.out, "folder that the files go to");
  app.add_option("--context", raw.context, "auto, osmesa, egl, or glfw for a window");
  app.add_option("--cascades", options.plan.cascades, "shadow maps along the view")
      ->check(CLI::Range(1, gnomon::kMaxMaps));
  app.add_option("--split", raw.split, "auto, uniform, logarithmic, practical, pseudo_near or optimal");
  app.add_option("--lambda", options.plan.split.lambda,
                 "practical split (taken for it): 0 uniform .. 1 logarithmic")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--warp", raw.warp, "auto, " + names_of(gnomon::all_warps()));
  app.add_option("--compare-warps", raw.compared_warps,
                 "draw every frame with each of these side by side as well, as in none,lispsm,auto")
      ->delimiter(',');
  app.add_option("--objective", raw.objective, "what the warp lowers: storage, max or p95");
  app.add_option("--filter", raw.filter, "as in pcf:radius=2,unit=texels. " + gnomon::render::filter_help());
  app.add_option("--map-size", options.plan.resolution.max_size, "texels along each side of a map")
      ->check(CLI::Range(4, kMaxSide));
  app.add_option(
         "--map-memory-mib", options.map_memory_mib,
         "MiB that all maps may take together; larger ones are halved until they fit; 0: what there is")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--max-triangles", options.max_triangles,
                 "scenes of more, over all instances, are refused; one takes up to 100 bytes")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  app.add_option("--resolution", raw.resolution,
                 "given by --map-size, or perceptual: the smallest maps whose texels the filter hides");
  app.add_option("--budget-ms", options.budget.milliseconds,
                 "choose warp, maps and filter for the least error within these milliseconds; 0: no budget")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--target-error", options.budget.target_error,
                 "choose the cheapest that brings m, in the mean over what is seen, to this; 0: none")
      ->check(CLI::Range(0.0, 1e9));
  app.add_option("--cost-model", raw.cost_model,
                 "what gnomon calibrate wrote; without it texels are the cost");
  app.add_option("--blocker-distance", options.blocker_distance,
                 "world units from a shadow to what casts it, for pcss; 0: half the scene's height")
      ->check(CLI::Range(0.0, 1e12));
  app.add_option("--fit", raw.fit, "how maps are laid: tight, rotated, stable or warped_stable");
  app.add_option("--transition", raw.transition,
                 "from map to map: cut at the split; blend or dither over the tenth of the map before it");
  app.add_flag("--stable", raw.stable, "the same as --fit stable: texel grids that stand still");
  app.add_flag("--history", options.history,
               "let texels change smoothly from frame to frame; for flights of many frames");
  app.add_flag("--visible-depths", options.visible_depths,
               "draw each frame twice and plan the second for the depths that the first one shows");
  app.add_option(
         "--filter-precision", options.filter_precision,
         "let the filter store less where its answers on the maps just drawn differ by no more than this, "
         "in steps of 8 bits; asked after the first frame and every 60th; 0: never")
      ->check(CLI::Range(0.0, 255.0));
  app.add_option("--prune", raw.prune,
                 "what may be left out: all, exact, none, or RULE,.. of " + prune_help());
  declare_light(app, raw, options);
  app.add_option("--path", raw.path, "camera flight, a JSON file; else the scene's own");
}

}  // namespace

std::optional<Options> parse_options(int argc, char** argv) {
  CLI::App app{
      "Flies through a scene and draws it with the shadow maps that gnomon plans for each frame: the "
      "picture, "
      "the aliasing error per pixel, and which map serves what."};
  app.name("flythrough");
  Options options;
  Raw raw;
  declare(app, raw, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw UsageError(first_line(error.what()));
    app.exit(error);
    return std::nullopt;
  }
  options.frames_given = app.count("--frames") > 0;
  raw.lambda_given = app.count("--lambda") > 0;
  resolve(raw, options);
  return options;
}

}  // namespace flythrough
