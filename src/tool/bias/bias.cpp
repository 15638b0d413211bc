// `gnomon bias`: which depth should a map store, and which bias does it need, on solids, sheets and leaves?
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/travel.hpp"
#include "bias/bias_sweep.hpp"
#include "command.hpp"
#include "compare/measure.hpp"
#include "compare/planned.hpp"
#include "compare/stage.hpp"
#include "compare/sweep.hpp"
#include "float_channel.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/extend/shape.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/report/errors.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/study/bias.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "picture_words.hpp"
#include "plan_option.hpp"
#include "progress.hpp"
#include "scene_words.hpp"

namespace gnomon::tool {
namespace {

/// A bias as the table names it.
struct NamedBias {
  std::string_view name;
  BiasOptions options;
  bool receiver_plane = false;
};
// Constant: two texels, as engines set it that know no slope. The others with the usual constant, against
// rounding.
constexpr double kRounding = BiasOptions{}.constant_texels, kTwoTexels = 2.0;
constexpr NamedBias kBiases[] = {
    {"zero", {0.0, 0.0, 0.0}, false},          {"constant", {kTwoTexels, 0.0, 0.0}, false},
    {"slope", {kRounding, 0.5, 0.0}, false},   {"normal_offset", {kRounding, 0.0, 0.5}, false},
    {"adaptive", {kRounding, 0.0, 0.0}, true}, {"default", {}, true},
};

struct BiasRequest : Measuring {
  bool sweeps = false;  ///< many settings over many views
  BiasSweep sweep;
  bool layers_given = false;
  MeasuredMaps maps;
  TechniqueFilter filter;
  std::vector<TechniqueLayer> layers;
  std::vector<NamedBias> biases;
  PlanOptions plan;  ///< its light_near_share alone
};

std::vector<std::string> bias_names() {
  std::vector<std::string> names{"all"};
  for (const NamedBias& bias : kBiases) names.emplace_back(bias.name);
  return names;
}

std::vector<NamedBias> read_biases(const std::string& option, const Words& words) {
  std::vector<NamedBias> chosen;
  for (const std::string& text : split_lists(words)) {
    const auto known = std::find_if(std::begin(kBiases), std::end(kBiases),
                                    [&](const NamedBias& bias) { return bias.name == text; });
    if (text != "all" && known == std::end(kBiases)) refuse_name(option, text, bias_names());
    text == "all" ? void(chosen.insert(chosen.end(), std::begin(kBiases), std::end(kBiases)))
                  : chosen.push_back(*known);
  }
  return chosen;
}

Sweep sweep_of(const BiasRequest& request) {
  SweepRequest product = one_kind_of_maps(request, request.maps);
  // Closed solids, an open sheet, alpha-masked leaves.
  if (product.scenes.empty()) product.scenes = {"builtin:city", "builtin:terrain", "builtin:trees"};
  product.filters = {request.filter};
  product.layers = request.layers;
  product.frames = 1;
  Sweep sweep = make_sweep(product);
  for (SweepEntry& entry : sweep.entries) {
    entry.plan.light_near_share = request.plan.light_near_share;
    if (entry.irregular())
      throw std::runtime_error("--filter " + request.filter.name + ": compares no depths, and knows no bias");
  }
  return sweep;
}

/// From each pixel in shadow to the nearest thing that shadows it, world units along the light; below zero:
/// lit.
std::vector<double> blocker_distances(const Stage& stage, const FrameTruth& truth) {
  std::vector<double> distances(truth.seen.mask.size(), -1.0);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (truth.seen.mask[i] != 0.0f) continue;
    const trace::SurfacePoint& point = truth.points.pixels[i];
    trace::Ray ray;
    ray.origin = point.position;
    ray.direction = -travel_at(stage.light(), point.position);
    ray.except = point.triangle;
    const trace::Hit hit = stage.tracer().first_caster(ray);
    if (hit.triangle != trace::kNoTriangle) distances[i] = hit.t;
  }
  return distances;
}

/// How far from a contact shadows begin: the distance of a blocker, in texels at the receiver, within which
/// pixels in shadow are lit falsely at least half way from the frame's own share to all. 0: shadows begin at
/// the contact.
double contact_gap(const Planned& plan, const Stage& stage, const FrameTruth& truth, const FloatImage& mask,
                   const std::vector<double>& blocker) {
  struct Contact {
    double texels = 0.0;
    bool lit = false;
  };
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < blocker.size(); ++i) {
    const ShadowMap* const map = plan.map(static_cast<int>(mask.values[2 * i + 1]));
    if (blocker[i] < 0.0 || map == nullptr) continue;
    const glm::dvec3& point = truth.points.pixels[i].position;
    const glm::dvec2 texel =
        texel_extent_world(map->clip_from_world, map->texels(), travel_at(stage.light(), point), point);
    contacts.push_back({blocker[i] / std::max(texel.x, texel.y), mask.values[2 * i] > 0.5f});
  }
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& a, const Contact& b) { return a.texels < b.texels; });
  // Thin casters that the map misses anywhere are false light, but no gap.
  const auto all_lit = static_cast<double>(
      std::count_if(contacts.begin(), contacts.end(), [](const Contact& c) { return c.lit; }));
  const double wanted = 0.5 * (1.0 + all_lit / std::max(1.0, static_cast<double>(contacts.size())));
  // Fewer pixels say nothing: an edge that a texel misses is no gap.
  constexpr std::size_t kLeast = 10;
  double gap = 0.0, lit = 0.0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    lit += contacts[i].lit ? 1.0 : 0.0;
    const auto count = static_cast<double>(i + 1);
    if (i + 1 >= kLeast && lit >= wanted * count) gap = contacts[i].texels;
  }
  return gap;
}

/// The layer, as in --layers.
std::string layer_name(const SweepEntry& entry) {
  return entry.technique.layer.empty() ? "front" : entry.technique.layer;
}

void print_row(const std::string& scene, const SweepEntry& entry, const NamedBias& bias,
               const report::MaskErrors& errors, double gap, bool json) {
  const std::string layer = layer_name(entry), name(bias.name);
  if (json) {
    print_line(nlohmann::ordered_json{
        {"scene", scene},
        {"filter", entry.technique.filter},
        {"layer", layer},
        {"bias", name},
        {"false_shadow", errors.false_shadow},
        {"false_light", errors.false_lit},
        {"contact_gap_texels",
         gap}}.dump());
  } else {
    char text[256];
    std::snprintf(text, sizeof text, "| %s | %s | %s | %.2f %% | %.2f %% | %.1f |", scene.c_str(),
                  layer.c_str(), name.c_str(), 100.0 * errors.false_shadow, 100.0 * errors.false_lit, gap);
    print_line(text);
  }
  flush_output();
}

void measure_scene(const BiasRequest& request, const Sweep& sweep, const std::string& scene,
                   Progress& progress, long long& rows) {
  Stage stage(sweep, scene);
  warn_of(stage.scene());
  const FrameTruth truth = frame_truth(stage, 0, sweep.baseline);
  const std::vector<double> blocker = blocker_distances(stage, truth);
  for (SweepEntry entry : sweep.entries) {
    for (const NamedBias& bias : request.biases) {
      check_interrupt();
      entry.plan.bias = bias.options;
      render::FrameOptions options;
      options.prune = prune_rules_of(PruneSource::this_frame);
      options.receiver_plane = bias.receiver_plane;
      Planned plan(stage, entry, truth.camera);
      if (plan.status() == PlanStatus::invalid_input)
        throw std::runtime_error(scene + ": " + invalid_input_text(plan.invalid_field()));
      (void)plan.draw(truth.camera, options);
      const FloatImage mask = stage.renderer().mask();
      progress.clear();
      print_row(scene, entry, bias, report::mask_errors(channel(mask, 0), truth.seen.mask, truth.seen.mask),
                contact_gap(plan, stage, truth, mask, blocker), request.json);
      progress.set(++rows);
      if (request.out.empty()) continue;
      const std::string name = scene_stem(scene) + "_" + layer_name(entry) + "_" + std::string(bias.name);
      write_png(stage.renderer().image(), std::filesystem::path(request.out) / (name + ".png"));
    }
  }
  render::check_context();
}

int run_bias(const BiasRequest& request) {
  const Sweep sweep = sweep_of(request);
  for (const std::string& line : sweep.left_out) warn(line);
  watch_interrupts();
  if (!request.out.empty()) make_folder("--out", request.out);
  const auto context = render::create_context(sweep.context);
  if (!request.json) {
    print_line("| scene | layer | bias | false shadow | false light | contact gap, texels |");
    print_line("|--|--|--|--:|--:|--:|");
  }
  long long rows = 0;
  Progress progress("gnomon bias, rows", static_cast<long long>(sweep.scenes.size() * sweep.entries.size() *
                                                                request.biases.size()));
  for (const std::string& scene : sweep.scenes) measure_scene(request, sweep, scene, progress, rows);
  return 0;
}

/// Which maps are drawn and read.
std::vector<Option> map_options(BiasRequest& request) {
  const auto set_filter = [&request](const std::string& word) {
    request.filter = technique_filter("--filter", word);
    return true;
  };
  std::vector<Option> options{
      {.name = "--layers",
       .target = word_list(request.layers, read_layers, {"all"}),
       .help = "depths that the maps store, or all; :linear behind one makes them even along the light",
       .names = layer_names({"all"}),
       .given = &request.layers_given},
      {.name = "--biases",
       .target = word_list(request.biases, read_biases, {"all"}),
       .help = "biases of the comparison, or all",
       .names = bias_names()},
      {.name = "--filter",
       .target = ParsedWord{set_filter, request.filter.name},
       .help = "filter that reads the maps, with options as in pcf:radius=2; or identifiers",
       .names = names_in(render::all_filters())}};
  for (Option& option : measured_maps_options(request.maps)) options.push_back(std::move(option));
  options.push_back(plan_option("light_near_share", request.plan));
  options.push_back(
      {.name = "--sweep",
       .target = &request.sweeps,
       .help = "draw the product of the lists below in every scene, each setting beside the default"});
  for (Option& option : bias_sweep_options(request.sweep)) options.push_back(std::move(option));
  return options;
}

}  // namespace

std::function<int()> declare_bias(Arguments& arguments) {
  const auto request = std::make_shared<BiasRequest>();
  arguments.options = measuring_options(
      *request,
      scenes_option(*request,
                    "builtin:NAME or glTF files; without any: builtin:city, terrain and trees; with --sweep "
                    "all built-in",
                    false),
      map_options(*request), "folder for a picture of each row; without it none are written");
  arguments.footer =
      "False shadow and false light are shares of the pixels that exact rays decide. The contact gap is\n"
      "how far from a contact shadows begin: up to this distance of a blocker, in texels at the receiver,\n"
      "light leaks more than in the rest of the frame. docs/bias.md explains layers and biases.";
  // A sweep has lists in place of these.
  constexpr std::string_view kOfOneView[] = {"--biases",
                                             "--filter",
                                             "--warp",
                                             "--map-size",
                                             "--light-near-share",
                                             "--light",
                                             "--light-elevation-deg",
                                             "--light-azimuth-deg",
                                             "--sun",
                                             "--out"};
  for (Option& option : arguments.options) {
    if (std::find(std::begin(kOfOneView), std::end(kOfOneView), option.name) != std::end(kOfOneView))
      option.excludes.emplace_back("--sweep");
  }
  return [request] {
    if (!request->sweeps) return run_bias(*request);
    SweepRequest product = one_kind_of_maps(*request, request->maps);
    // One depth shows what biases do to it; others only when asked for.
    if (request->layers_given) product.layers = request->layers;
    sweep_biases(request->sweep, product);
    return 0;
  };
}

}  // namespace gnomon::tool
