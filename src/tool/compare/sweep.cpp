// The product of techniques that `gnomon compare` goes through.
#include "sweep.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

#include "command.hpp"
#include "filter_words.hpp"
#include "gnomon/render/probe.hpp"
#include "identifier_word.hpp"
#include "irregular_word.hpp"
#include "offscreen_context.hpp"
#include "page_setting.hpp"
#include "picture_words.hpp"

namespace gnomon::tool {
namespace {

constexpr int kMinMapSize = 4, kMaxMapSize = 16'384, kMinSide = 16, kMaxSide = 16'384, kMaxShards = 1'000'000;

[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& wants) {
  throw std::runtime_error(option + " " + value + ": wants " + wants);
}

bool parse_int(std::string_view text, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// "A<separator>B" as two numbers in [low, high].
bool parse_pair(const std::string& text, char separator, int low, int high, int& a, int& b) {
  const std::size_t at = text.find(separator);
  if (at == std::string::npos) return false;
  const std::string_view view = text;
  return parse_int(view.substr(0, at), a) && parse_int(view.substr(at + 1), b) && a >= low && b >= low &&
         a <= high && b <= high;
}

std::vector<int> parse_numbers(const std::string& option, const std::vector<std::string>& texts, int low,
                               int high) {
  std::vector<int> numbers;
  for (const std::string& text : split_lists(texts)) {
    int number = 0;
    if (!parse_int(text, number) || number < low || number > high)
      refuse(option, text, "whole numbers from " + std::to_string(low) + " to " + std::to_string(high));
    numbers.push_back(number);
  }
  return numbers;
}

std::string_view name_of(const Warp& warp) noexcept {
  return warp.name;
}
std::string_view name_of(const Shape& shape) noexcept {
  return shape.name;
}
std::string_view name_of(const PagePolicy& policy) noexcept {
  return policy.name;
}
std::string_view name_of(const render::Filter& filter) noexcept {
  return filter.info.name;
}

/// The list with "all" replaced by every entry of a registry.
template <class Entries>
std::vector<std::string> expanded(const std::vector<std::string>& texts, const Entries& entries) {
  std::vector<std::string> names;
  for (const std::string& text : split_lists(texts)) {
    if (text != "all") {
      names.push_back(text);
      continue;
    }
    for (const auto* entry : entries) names.emplace_back(name_of(*entry));
  }
  return names;
}

/// The list with "all" replaced by every layer.
std::vector<std::string> expanded_layers(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  for (const std::string& text : split_lists(texts)) {
    if (text != "all") {
      names.push_back(text);
      continue;
    }
    for (const render::DepthLayerInfo& info : render::depth_layers()) names.emplace_back(info.name);
  }
  return names;
}

void set_filter(const std::string& text, SweepEntry& entry) {
  entry.irregular_samples = irregular_samples(text);
  entry.identifiers = identifier_test(text);
  const bool no_filter = entry.irregular() || entry.identifiers;
  entry.filter = no_filter ? render::default_settings(render::filters::hard) : filter_word("--filters", text);
  entry.technique.filter = no_filter ? text : render::to_string(entry.filter);
  render::set_margin(entry.filter, entry.plan);
}

void set_layer(const std::string& text, SweepEntry& entry) {
  constexpr std::string_view kLinear = ":linear";
  entry.linear_depth = text.ends_with(kLinear);
  const std::string layer = text.substr(0, text.size() - (entry.linear_depth ? kLinear.size() : 0));
  const render::DepthLayerInfo* const info = render::find_depth_layer(layer);
  if (info == nullptr) refuse_name("--layers", layer, layer_names());
  entry.layer = info->layer;
  entry.technique.layer = text == render::depth_layers().front().name ? "" : text;
}

void set_warp(const std::string& text, SweepEntry& entry) {
  entry.technique.warp = text;
  const std::size_t colon = text.find(':');
  const std::string warp = text.substr(0, colon);
  entry.plan.warp.warp = find_warp(warp);
  if (entry.plan.warp.warp == nullptr && warp != "auto")
    refuse_name("--warps", text, names_in(all_warps(), {"all", "auto"}));
  if (colon == std::string::npos) return;
  entry.plan.warp.shape = find_shape(text.substr(colon + 1));
  if (entry.plan.warp.shape == nullptr)
    refuse_name("--shapes", text.substr(colon + 1), names_in(all_shapes(), {"all"}));
}

/// Warps with shapes: `lispsm:logarithmic`. Without a warp only shapes that do not undo one are of use.
std::vector<std::string> with_shapes(const std::vector<std::string>& warps,
                                     const std::vector<std::string>& shapes) {
  std::vector<std::string> both;
  for (const std::string& warp : warps) {
    for (const std::string& shape : shapes) {
      const Shape* const known = find_shape(shape);
      if (known == nullptr) refuse_name("--shapes", shape, names_in(all_shapes(), {"all"}));
      if (known->affine)
        both.push_back(warp);
      else if (warp != "none" || known->serving != nullptr || known->round != nullptr)
        both.push_back(warp + ":" + shape);
    }
  }
  return both;
}

/// Takes `:slices=K` off a split's word, where it has one.
std::optional<int> face_slices(const std::string& text, std::string& name) {
  constexpr std::string_view kSlices = ":slices=";
  const std::size_t at = name.find(kSlices);
  if (at == std::string::npos) return std::nullopt;
  const std::size_t begin = at + kSlices.size(), end = std::min(name.find(':', begin), name.size());
  int count = 0;
  const auto [rest, error] = std::from_chars(name.data() + begin, name.data() + end, count);
  const bool whole = error == std::errc() && rest == name.data() + end;
  if (!whole || count < 1 || count > kMaxMaps)
    throw std::runtime_error("--splits " + text + ": slices must be a whole number from 1 to " +
                             std::to_string(kMaxMaps));
  name.erase(at, end - at);
  return count;
}

void set_split(const std::string& text, SweepEntry& entry) {
  entry.technique.split = text;
  std::string name = text;
  const auto has_suffix = [&](std::string_view suffix) {
    const std::size_t at = name.find(suffix);
    if (at == std::string::npos) return false;
    name.erase(at, suffix.size());
    return true;
  };
  if (has_suffix(":finest")) entry.plan.split.selection = MapSelection::finest;
  entry.visible_depths = has_suffix(":visible_depths");
  entry.coarse_depths = has_suffix(":coarse_depths");
  if (entry.visible_depths && entry.coarse_depths)
    throw std::runtime_error("--splits " + text + ": a plan takes visible depths from one source");
  // Set before: a shape that follows what is seen needs it.
  const bool follows_seen = entry.plan.warp.shape != nullptr && entry.plan.warp.shape->serving != nullptr;
  entry.visible_points = has_suffix(":visible_points") || follows_seen;
  const std::optional<int> slices = face_slices(text, name);
  const bool is_partition = partition_from_name(name, entry.plan.split.partition);
  if (slices && (!is_partition || entry.plan.split.partition != Partition::frustum_faces))
    throw std::runtime_error("--splits " + text + ": only frustum_faces has slices");
  entry.plan.split.face_slices = slices.value_or(1);
  if (!split_scheme_from_name(name, entry.plan.split.scheme) && (!is_partition || name == "view_depth"))
    refuse_name("--splits", text, split_names());
}

void set_fit(const std::string& text, SweepEntry& entry) {
  entry.technique.fit = text;
  if (text != "tight" && text != "stable")
    refuse_name("--fits", text, std::vector<std::string>{"tight", "stable"});
  entry.plan.fit = text == "stable" ? Fit::stable : Fit::tight;
}

void set_size(int size, SweepEntry& entry) {
  entry.technique.map_size = entry.plan.resolution.max_size = size;
  // Techniques are compared at the sizes asked for.
  entry.plan.prune = entry.plan.prune.without(PruneRule::metric_resolution);
}

void set_cascades(int cascades, SweepEntry& entry) {
  entry.technique.cascades = entry.plan.cascades = cascades;
}

void set_pages(const std::string& policy, SweepEntry& entry) {
  entry.technique.pages = policy;
  entry.pages.policy = find_page_policy(policy);
  if (entry.pages.policy == nullptr) refuse_name("--pages", policy, names_in(all_page_policies(), {"all"}));
  // Surfaces between the points that were read keep a shadow.
  entry.pages.fallback = true;
}

void set_page_texels(int texels, SweepEntry& entry) {
  entry.technique.page_texels = entry.pages.page_texels = texels;
}

void set_page_target(double target_m, SweepEntry& entry) {
  entry.technique.page_target_m = target_m;
  entry.pages.target_m = target_of(target_m);
}

/// Each entry once for each of the values.
template <class Values, class Set>
void multiply(std::vector<SweepEntry>& entries, const Values& values, Set&& set) {
  std::vector<SweepEntry> product;
  for (const SweepEntry& entry : entries) {
    for (const auto& value : values) {
      product.push_back(entry);
      set(value, product.back());
    }
  }
  entries = std::move(product);
}

/// The first of each list: what stands for all of it where it makes no difference.
struct Firsts {
  std::string split, warp, fit;
  int cascades = 1;
};

/// True for a shape that this light's maps do not take: they would be linear.
bool is_useless(const Shape* shape, LightKind light) noexcept {
  if (shape == nullptr) return false;
  return light == LightKind::sun ? shape->round != nullptr : shape->serving != nullptr;
}

/// True where another entry of the product says the same.
bool is_double(const SweepEntry& entry, const Firsts& first, LightKind light) {
  const report::Technique& t = entry.technique;
  const bool is_tetrahedron = entry.plan.split.partition == Partition::tetrahedron;
  // The maps of a local light follow from its cone and what it lights.
  if (light != LightKind::sun)
    return (t.split != first.split && !(is_tetrahedron && light == LightKind::point)) ||
           t.cascades != first.cascades || t.fit != first.fit;
  if (is_tetrahedron && t.split != first.split) return true;
  const bool by_depth = entry.plan.split.partition == Partition::view_depth;
  const bool as_many = by_depth || entry.plan.split.partition == Partition::receiver_clusters;
  // What is seen bounds one map, too.
  const bool follows_view = entry.visible_depths || entry.coarse_depths || entry.visible_points;
  if (by_depth && t.cascades == 1 && t.split != first.split && !follows_view) return true;
  if (as_many && !by_depth && t.cascades == 1) return true;
  if (!as_many && t.cascades != first.cascades) return true;
  return t.fit == "stable" && (!by_depth || (t.warp != "none" && t.warp != first.warp));
}

/// Removes entries whose maps hold no identifiers; `left_out` gets a line for them.
void drop_bent_identifiers(std::vector<SweepEntry>& entries, std::vector<std::string>& left_out) {
  const std::string line =
      "--shapes skips " + std::string(kIdentifiers) + ": maps that bend lines hold depths alone";
  const auto bent = [](const SweepEntry& e) {
    return e.identifiers && e.plan.warp.shape != nullptr && !e.plan.warp.shape->affine;
  };
  if (std::erase_if(entries, bent) == 0) return;
  if (entries.empty()) throw std::runtime_error(line + "; nothing is left to measure");
  left_out.push_back(line);
}

/// Removes entries whose filter cannot read their layer; `left_out` gets a line for each.
void drop_unread_layers(std::vector<SweepEntry>& entries, std::vector<std::string>& left_out) {
  const auto drop = [&](std::string_view word, const std::string& why, const auto& is) {
    const std::string line =
        "--layers skips " + std::string(word) + ": " + why + ", and is measured with front alone";
    const auto unread = [&](const SweepEntry& e) { return is(e) && !e.technique.layer.empty(); };
    if (std::erase_if(entries, unread) == 0) return;
    if (entries.empty()) throw std::runtime_error(line + "; nothing is left to measure");
    left_out.push_back(line);
  };
  drop(kIrregular, "draws no depth map", [](const SweepEntry& e) { return e.irregular(); });
  drop(kIdentifiers, "compares no depth", [](const SweepEntry& e) { return e.identifiers.has_value(); });
}

std::vector<SweepEntry> product_of(const CompareRequest& request, LightKind light,
                                   std::vector<std::string>& left_out) {
  std::vector<SweepEntry> entries(1);
  std::vector<std::string> splits = split_lists(request.splits);
  for (std::string& split : splits) {
    if (request.visible_depths) split += ":visible_depths";
    if (request.visible_points) split += ":visible_points";
  }
  const std::vector<std::string> warps =
      with_shapes(expanded(request.warps, all_warps()), expanded(request.shapes, all_shapes()));
  if (warps.empty())
    throw std::runtime_error("--shapes: logarithmic needs a warp other than none, and no other is given");
  multiply(entries, expanded(request.filters, render::all_filters()), set_filter);
  multiply(entries, expanded_layers(request.layers), set_layer);
  drop_unread_layers(entries, left_out);
  multiply(entries, split_lists(request.fits), set_fit);
  multiply(entries, warps, set_warp);
  drop_bent_identifiers(entries, left_out);
  multiply(entries, splits, set_split);
  for (SweepEntry& entry : entries) {
    if (entry.plan.split.scheme == SplitScheme::pseudo_near) entry.plan.split.pseudo_near = request.near_hint;
  }
  multiply(entries, parse_numbers("--cascades", request.cascades, 1, kMaxMaps), set_cascades);
  multiply(entries, parse_numbers("--map-sizes", request.map_sizes, kMinMapSize, kMaxMapSize), set_size);
  Firsts first{splits.front(), warps.front(), entries.front().technique.fit,
               entries.front().technique.cascades};
  if (std::find(warps.begin(), warps.end(), "none") != warps.end()) first.warp = "none";
  std::erase_if(entries, [&](const SweepEntry& entry) {
    return is_useless(entry.plan.warp.shape, light) || is_double(entry, first, light);
  });
  if (entries.empty()) throw std::runtime_error("--shapes: this light's maps take none of them");
  return entries;
}

/// What cannot be measured with pages, and why.
std::optional<NoPages> no_pages(const SweepEntry& entry, LightKind light) {
  if (entry.irregular()) return NoPages{std::string(kIrregular), "lists pixels by whole maps"};
  if (entry.linear_depth) return NoPages{entry.technique.layer, "pages store depths divided by w"};
  if (entry.identifiers) return NoPages{std::string(kIdentifiers), "numbers what whole maps see"};
  if (auto why = tool::no_pages(entry.filter, entry.plan, entry.pages.page_texels)) return why;
  const int least = least_pool_pages(light);
  if (entry.pages.capacity < least)
    return NoPages{entry.technique.name(),
                   "fewer than " + std::to_string(least) + " pages fit into its pool"};
  return std::nullopt;
}

/// One line for each reason.
std::vector<std::string> lines_of(const std::vector<NoPages>& left_out) {
  std::vector<NoPages> joined;
  for (const NoPages& one : left_out) {
    const auto same =
        std::find_if(joined.begin(), joined.end(), [&](const NoPages& n) { return n.why == one.why; });
    if (same == joined.end()) {
      joined.push_back(one);
    } else {
      same->what += ", " + one.what;
    }
  }
  std::vector<std::string> lines;
  for (const NoPages& one : joined) lines.push_back("--pages skips " + one.what + ": " + one.why);
  return lines;
}

/// The same with pages in place of maps; what cannot be measured goes into `left_out`, a line for each
/// reason.
std::vector<SweepEntry> page_product_of(const CompareRequest& request, LightKind light,
                                        std::vector<std::string>& left_out) {
  if (request.pages.empty()) return {};
  std::vector<SweepEntry> entries(1);
  set_warp("none", entries.front());
  set_split("uniform", entries.front());
  set_page_target(request.page_target, entries.front());
  multiply(entries, expanded(request.filters, render::all_filters()), set_filter);
  multiply(entries, expanded_layers(request.layers), set_layer);
  multiply(entries, split_lists(request.fits), set_fit);
  multiply(entries, expanded(request.pages, all_page_policies()), set_pages);
  std::vector<int> sizes =
      parse_numbers("--page-sizes", request.page_sizes, kLeastPageTexels, kMostPageTexels);
  for (const int size : sizes) {
    if (!is_page_size(size)) refuse("--page-sizes", std::to_string(size), "64, 128 or 256");
  }
  multiply(entries, sizes, set_page_texels);
  std::vector<int> cascades = parse_numbers("--cascades", request.cascades, 1, kMaxMaps);
  if (light != LightKind::sun) cascades.resize(1);
  multiply(entries, cascades, set_cascades);
  multiply(entries, parse_numbers("--map-sizes", request.map_sizes, kMinMapSize, kMaxMapSize), set_size);
  for (SweepEntry& entry : entries) {
    if (entry.pages.policy->octaves) set_fit("stable", entry);  // its levels are stable whatever the fit
    entry.pages.capacity = page_capacity(entry, light);
  }
  std::vector<NoPages> none;
  std::erase_if(entries, [&](const SweepEntry& entry) {
    const std::optional<NoPages> why = no_pages(entry, light);
    const bool is_new = why && std::none_of(none.begin(), none.end(), [&](const NoPages& n) {
                          return n.what == why->what && n.why == why->why;
                        });
    if (is_new) none.push_back(*why);
    return why.has_value();
  });
  const std::vector<std::string> lines = lines_of(none);
  if (entries.empty()) throw std::runtime_error(lines.front() + "; nothing is left to measure");
  left_out.insert(left_out.end(), lines.begin(), lines.end());
  return entries;
}

/// Each technique once, in the order they appear.
std::vector<SweepEntry> without_doubles(std::vector<SweepEntry> entries) {
  std::vector<SweepEntry> once;
  for (SweepEntry& entry : entries) {
    const bool known = std::any_of(once.begin(), once.end(), [&](const SweepEntry& other) {
      return other.technique == entry.technique;
    });
    if (!known) once.push_back(std::move(entry));
  }
  return once;
}

std::string fit_to_memory(SweepEntry& entry, const Sweep& sweep) {
  const int wanted = entry.plan.resolution.max_size;
  const std::string name = entry.technique.name();
  const render::FittingMaps fitting =
      render::largest_maps(wanted, most_maps(entry, sweep.light.kind), render::bytes_per_texel(entry.filter),
                           sweep.map_memory_mib);
  if (fitting.size == 0) throw std::runtime_error(name + ": no map fits (" + fitting.why + ")");
  if (fitting.size == wanted) return {};
  set_size(fitting.size, entry);
  if (entry.by_pages()) entry.pages.capacity = page_capacity(entry, sweep.light.kind);
  return name + ": maps of " + std::to_string(wanted) + " do not fit (" + fitting.why + "): maps of " +
         std::to_string(fitting.size);
}

}  // namespace

std::vector<std::string> fit_to_memory(Sweep& sweep) {
  std::vector<std::string> lines;
  for (SweepEntry& entry : sweep.entries) {
    if (std::string line = fit_to_memory(entry, sweep); !line.empty()) lines.push_back(std::move(line));
  }
  if (std::string line = fit_to_memory(sweep.baseline, sweep); !line.empty())
    lines.push_back("baseline " + line);
  return lines;
}

std::string compare_footer() {
  return "Lists take commas or spaces. Every combination of the lists is measured once. Each result is on "
         "the disk before the next frame begins: after a crash, --resume continues. Errors compare the "
         "shadow mask with exact rays.\n\n"
         "Warps: " +
         any_of_text(names_in(all_warps(), {"auto"})) + ".\nSplits: " + any_of_text(split_names()) +
         ", each with :finest, :visible_depths, :coarse_depths or :visible_points behind it, and "
         "frustum_faces with :slices=K for up to K maps along each side face" +
         ".\nPages: " + any_of_text(names_in(all_page_policies())) +
         ": virtual shadow maps of as many texels as the maps beside them, with every filter of --filters "
         "that reads depths in texels; the others are named and skipped. docs/pages.md explains them." +
         "\nLayers: " + any_of_text(layer_names()) +
         ", each with :linear behind it for depths even along the light. gnomon bias and docs/bias.md "
         "compare them." +
         "\nFilters: " + any_of_text(names_in(render::all_filters())) +
         ". gnomon filters NAME prints the options of one. " + std::string(kIrregular) +
         " takes no filter: casters are tested against each pixel, for exact hard shadows at their price. " +
         std::string(kIdentifiers) +
         " compares who is nearest in place of how near; :of=triangle numbers triangles in place of "
         "instances, neighbours=1 takes the texels around as well.\n";
}

std::vector<std::string> split_names() {
  return {"auto",    "uniform",    "logarithmic",   "practical",        "pseudo_near",
          "optimal", "view_depth", "frustum_faces", "separating_plane", "receiver_clusters"};
}

std::vector<std::string> split_lists(const std::vector<std::string>& lists) {
  std::vector<std::string> elements;
  for (const std::string& list : lists) {
    bool first_of_list = true;
    for (std::size_t begin = 0; begin <= list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      const std::string element = list.substr(begin, end - begin);
      const bool continues =
          !first_of_list && element.find('=') != std::string::npos && element.find(':') == std::string::npos;
      if (continues) {
        elements.back() += "," + element;
      } else {
        elements.push_back(element);
      }
      first_of_list = false;
      begin = end + 1;
    }
  }
  return elements;
}

int most_maps(const SweepEntry& entry, LightKind light) noexcept {
  constexpr int kCubeFaces = 6, kTetrahedronFaces = 4;
  if (light != LightKind::sun)
    return entry.plan.split.partition == Partition::tetrahedron ? kTetrahedronFaces : kCubeFaces;
  return entry.plan.split.partition == Partition::view_depth ? entry.plan.cascades : kMaxMaps;
}

int page_capacity(const SweepEntry& entry, LightKind light) noexcept {
  const double slot = entry.pages.page_texels + 2.0 * std::ceil(entry.plan.filter.texels);
  const double side = entry.plan.resolution.max_size;
  const int maps = light == LightKind::sun ? entry.technique.cascades : light == LightKind::spot ? 1 : 6;
  return static_cast<int>(std::clamp(maps * side * side / (slot * slot), 0.0, double{kMostPages}));
}

SweepEntry sweep_entry(const report::Technique& technique) {
  SweepEntry entry;
  set_filter(technique.filter, entry);
  if (!technique.layer.empty()) set_layer(technique.layer, entry);
  set_fit(technique.fit, entry);
  set_warp(technique.warp, entry);
  set_split(technique.split, entry);
  set_cascades(technique.cascades, entry);
  set_size(technique.map_size, entry);
  if (technique.pages.empty()) return entry;
  set_pages(technique.pages, entry);
  set_page_texels(technique.page_texels, entry);
  set_page_target(technique.page_target_m, entry);
  return entry;
}

Sweep make_sweep(const CompareRequest& request) {
  Sweep sweep;
  for (const std::string& scene : request.scenes) {
    if (std::find(sweep.scenes.begin(), sweep.scenes.end(), scene) == sweep.scenes.end())
      sweep.scenes.push_back(scene);
  }
  sweep.frames = request.frames;
  sweep.rounds = request.rounds;
  sweep.light = request.sun;
  if (!light_kind_from_name(request.light, sweep.light.kind))
    refuse("--light", request.light, "sun, spot or point");
  sweep.animation = request.animation;
  sweep.out = request.out;
  sweep.resume = request.resume;
  sweep.map_memory_mib = request.map_memory_mib;
  sweep.max_triangles = request.max_triangles;
  read_picture_size(request.size, kMinSide, kMaxSide, sweep.width, sweep.height);
  int shard = 0, shards = 0;
  if (!parse_pair(request.shard, '/', 1, kMaxShards, shard, shards) || shard > shards)
    refuse("--shard", request.shard, "I/N with 1 <= I <= N, as in 2/8");
  sweep.shard = static_cast<std::size_t>(shard - 1);
  sweep.shards = static_cast<std::size_t>(shards);
  sweep.context = offscreen_context(request.context);
  sweep.entries = product_of(request, sweep.light.kind, sweep.left_out);
  for (SweepEntry& entry : page_product_of(request, sweep.light.kind, sweep.left_out))
    sweep.entries.push_back(std::move(entry));
  // A list that names something twice.
  sweep.entries = without_doubles(std::move(sweep.entries));
  sweep.baseline =
      sweep_entry({"none", "uniform", "tight", "hard", 1, sweep.entries.front().technique.map_size});
  for (SweepEntry& entry : sweep.entries) entry.map_passes = map_passes_from_name(request.map_passes);
  return sweep;
}

}  // namespace gnomon::tool
