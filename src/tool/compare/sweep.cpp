// The product of techniques that `gnomon compare` goes through.
#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "edit_words.hpp"
#include "gnomon/render/probe.hpp"
#include "identifier_word.hpp"
#include "page_setting.hpp"

namespace gnomon::tool {
namespace {

void set_filter(const TechniqueFilter& filter, SweepEntry& entry) {
  entry.technique.filter = filter.name;
  entry.filter = filter.settings;
  entry.identifiers = filter.identifiers;
  entry.irregular_samples = filter.irregular_samples;
  render::set_margin(entry.filter, entry.plan);
}

void set_layer(const TechniqueLayer& layer, SweepEntry& entry) {
  entry.technique.layer = layer.name();
  entry.layer = layer.layer;
  entry.linear_depth = layer.linear;
}

void set_warp(const TechniqueWarp& warp, SweepEntry& entry) {
  entry.technique.warp = warp.name;
  entry.plan.warp.warp = warp.warp;
  if (warp.shape != nullptr) entry.plan.warp.shape = warp.shape;
  if (warp.objective) entry.plan.warp.objective = *warp.objective;
}

/// Warps with shapes: `lispsm:logarithmic`. Without a warp only shapes that do not undo one are of use.
std::vector<TechniqueWarp> with_shapes(const std::vector<TechniqueWarp>& warps,
                                       const std::vector<const Shape*>& shapes) {
  std::vector<TechniqueWarp> both;
  for (const TechniqueWarp& warp : warps) {
    for (const Shape* const shape : shapes) {
      if (shape->affine)
        both.push_back(warp);
      else if (warp.shape != nullptr)
        throw std::runtime_error("--shapes " + std::string(shape->name) + ": " + warp.name +
                                 " has a shape already");
      else if (warp.warp != &warps::none || shape->serving != nullptr || shape->round != nullptr)
        both.push_back({warp.name + ":" + std::string(shape->name), warp.warp, shape, warp.objective});
    }
  }
  return both;
}

TechniqueSplit uniform_split() {
  TechniqueSplit split{.name = "uniform"};
  split.options.scheme = SplitScheme::uniform;
  return split;
}

/// The warp is set before: a shape that follows what is visible needs it.
void set_split(const TechniqueSplit& split, SweepEntry& entry) {
  entry.technique.split = split.name;
  entry.plan.split = split.options;
  entry.visible_depths = split.visible_depths;
  entry.coarse_depths = split.coarse_depths;
  entry.points = split.points;
  entry.shares_texels = split.shares_texels;
  if (entry.points == PlanPoints::none && entry.plan.warp.shape->serving != nullptr)
    entry.points = PlanPoints::visible;
}

void set_fit(Fit fit, SweepEntry& entry) {
  entry.technique.fit = to_string(fit);
  entry.plan.fit = fit;
}

void set_size(int size, SweepEntry& entry) {
  entry.technique.map_size = entry.plan.resolution.max_size = size;
  if (entry.shares_texels)
    entry.plan.resolution.texel_budget = std::int64_t{entry.plan.cascades} * size * size;
  // Techniques are compared at the sizes asked for.
  entry.plan.prune = entry.plan.prune.without(PruneRule::metric_resolution);
}

void set_cascades(int cascades, SweepEntry& entry) {
  entry.technique.cascades = entry.plan.cascades = cascades;
}

void set_pages(const PagePolicy* policy, SweepEntry& entry) {
  entry.technique.pages = policy->name;
  entry.pages.policy = policy;
  // Surfaces between the points that were read keep a shadow.
  entry.pages.fallback = true;
}

void set_page_texels(int texels, SweepEntry& entry) {
  entry.technique.page_texels = entry.pages.page_texels = texels;
}

void set_page_target(double target_m, SweepEntry& entry) {
  entry.technique.page_target_m = target_m;
  entry.pages.target_m = target_of(target_m, entry.pages.page_texels);
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
bool is_double(const SweepEntry& entry, const Firsts& first, LightKind light, bool many_lights) {
  const report::Technique& t = entry.technique;
  const bool is_tetrahedron = entry.plan.split.partition == Partition::tetrahedron;
  // The maps of a local light follow from its cone and what it lights.
  if (light != LightKind::sun)
    return (t.split != first.split && !(is_tetrahedron && light == LightKind::point) &&
            !(many_lights && entry.shares_texels)) ||
           t.cascades != first.cascades || t.fit != first.fit;
  if (is_tetrahedron && t.split != first.split) return true;
  const bool by_depth = entry.plan.split.partition == Partition::view_depth;
  const bool as_many = by_depth || entry.plan.split.partition == Partition::receiver_clusters;
  // What is visible bounds one map, too.
  const bool follows_view = entry.visible_depths || entry.coarse_depths || entry.points != PlanPoints::none;
  if (by_depth && t.cascades == 1 && t.split != first.split && !follows_view) return true;
  if (as_many && !by_depth && t.cascades == 1) return true;
  if (!as_many && t.cascades != first.cascades) return true;
  return entry.plan.fit == Fit::stable && (!by_depth || (t.warp != "none" && t.warp != first.warp));
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

/// Splits of plans that are given what the frame shows, besides what the words say.
std::vector<TechniqueSplit> splits_of(const SweepRequest& request) {
  std::vector<TechniqueSplit> splits = request.splits;
  for (TechniqueSplit& split : splits) {
    if (request.visible_depths && !split.visible_depths) split.name += ":visible_depths";
    if (request.visible_points && split.points == PlanPoints::none) {
      split.name += ":visible_points";
      split.points = PlanPoints::visible;
    }
    split.visible_depths = split.visible_depths || request.visible_depths;
    if (split.visible_depths && split.coarse_depths)
      throw std::runtime_error("--splits " + split.name + ": a plan takes visible depths from one source");
  }
  return splits;
}

std::vector<SweepEntry> product_of(const SweepRequest& request, std::vector<std::string>& left_out) {
  const LightKind light = request.light.kind;
  std::vector<SweepEntry> entries(1);
  const std::vector<TechniqueSplit> splits = splits_of(request);
  const std::vector<TechniqueWarp> warps = with_shapes(request.warps, request.shapes);
  if (warps.empty())
    throw std::runtime_error("--shapes: logarithmic needs a warp other than none, and no other is given");
  multiply(entries, request.filters, set_filter);
  multiply(entries, request.layers, set_layer);
  drop_unread_layers(entries, left_out);
  multiply(entries, request.fits, set_fit);
  multiply(entries, warps, set_warp);
  drop_bent_identifiers(entries, left_out);
  multiply(entries, splits, set_split);
  for (SweepEntry& entry : entries) {
    if (entry.plan.split.scheme == SplitScheme::pseudo_near) entry.plan.split.pseudo_near = request.near_hint;
  }
  multiply(entries, request.cascades, set_cascades);
  multiply(entries, request.map_sizes, set_size);
  Firsts first{splits.front().name, warps.front().name, entries.front().technique.fit,
               entries.front().technique.cascades};
  if (std::any_of(warps.begin(), warps.end(), [](const TechniqueWarp& w) { return w.name == "none"; }))
    first.warp = "none";
  std::erase_if(entries, [&](const SweepEntry& entry) {
    return is_useless(entry.plan.warp.shape, light) ||
           is_double(entry, first, light, request.local_lights > 0);
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

/// One technique beside the product. Throws std::runtime_error where it cannot be measured.
SweepEntry named_entry(const report::Technique& technique, LightKind light) {
  SweepEntry entry = sweep_entry(technique);
  if (!entry.by_pages()) return entry;
  if (entry.pages.policy->octaves) set_fit(Fit::stable, entry);
  entry.pages.capacity = page_capacity(entry, light);
  if (const std::optional<NoPages> why = no_pages(entry, light))
    throw std::runtime_error(technique.name() + ": " + why->what + ": " + why->why);
  return entry;
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
std::vector<SweepEntry> page_product_of(const SweepRequest& request, std::vector<std::string>& left_out) {
  if (request.pages.empty()) return {};
  const LightKind light = request.light.kind;
  std::vector<SweepEntry> entries(1);
  set_warp({}, entries.front());
  set_split(uniform_split(), entries.front());
  multiply(entries, request.filters, set_filter);
  multiply(entries, request.layers, set_layer);
  multiply(entries, request.fits, set_fit);
  multiply(entries, request.pages, set_pages);
  multiply(entries, request.page_sizes, set_page_texels);
  std::vector<int> cascades = request.cascades;
  if (light != LightKind::sun) cascades.resize(1);
  multiply(entries, cascades, set_cascades);
  multiply(entries, request.map_sizes, set_size);
  for (SweepEntry& entry : entries) {
    set_page_target(request.page_target, entry);
    if (entry.pages.policy->octaves) set_fit(Fit::stable, entry);  // its levels are stable whatever the fit
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

std::string fit_to_memory(SweepEntry& entry, LightKind light, double map_memory_mib) {
  const int wanted = entry.plan.resolution.max_size;
  const std::string name = entry.technique.name();
  const render::FittingMaps fitting = render::largest_maps(
      wanted, most_maps(entry, light), render::bytes_per_texel(entry.filter), map_memory_mib);
  if (fitting.size == 0) throw std::runtime_error(name + ": no map fits (" + fitting.why + ")");
  if (fitting.size == wanted) return {};
  set_size(fitting.size, entry);
  if (entry.by_pages()) entry.pages.capacity = page_capacity(entry, light);
  return name + ": maps of " + std::to_string(wanted) + " do not fit (" + fitting.why + "): maps of " +
         std::to_string(fitting.size);
}

}  // namespace

SweepRequest one_kind_of_maps(const Measuring& measuring, const MeasuredMaps& maps) {
  SweepRequest request{measuring};
  request.warps = {maps.warp};
  request.cascades = {maps.cascades};
  request.map_sizes = {maps.map_size};
  return request;
}

std::vector<std::string> fit_to_memory(Sweep& sweep, double map_memory_mib) {
  std::vector<std::string> lines;
  const LightKind light = sweep.light.kind;
  for (SweepEntry& entry : sweep.entries) {
    if (entry.technique.is_given()) continue;  // of a size that others chose
    if (std::string line = fit_to_memory(entry, light, map_memory_mib); !line.empty())
      lines.push_back(std::move(line));
  }
  if (std::string line = fit_to_memory(sweep.baseline, light, map_memory_mib); !line.empty())
    lines.push_back("baseline " + line);
  return lines;
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
  return static_cast<int>(std::clamp(maps * side * side / (slot * slot), 0.0, double{kMaxPages}));
}

SweepEntry captured_entry(const std::string& name, const TechniqueFilter& filter,
                          std::shared_ptr<const CapturedMaps> captured) {
  SweepEntry entry;
  set_filter(filter, entry);
  const std::span<const ShadowMap> maps = captured->frames.front().plan.maps();
  entry.technique.entry = name;
  entry.technique.cascades = entry.plan.cascades = static_cast<int>(maps.size());
  entry.technique.map_size = 0;
  for (const ShadowMap& map : maps)
    entry.technique.map_size = std::max({entry.technique.map_size, map.width, map.height});
  entry.plan.resolution.max_size = entry.technique.map_size;
  entry.captured = std::move(captured);
  return entry;
}

SweepEntry given_entry(const std::string& name, std::shared_ptr<const GivenMasks> given) {
  SweepEntry entry;
  entry.technique.entry = name;
  entry.technique.filter = "masks";
  entry.technique.cascades = entry.technique.map_size = 0;
  entry.given = std::move(given);
  return entry;
}

SweepEntry sweep_entry(const report::Technique& technique) {
  if (technique.is_given())
    throw std::runtime_error(technique.name() +
                             ": gnomon has no plan of it; gnomon compare --entry measures it");
  SweepEntry entry;
  set_filter(technique_filter("--filters", technique.filter), entry);
  if (!technique.layer.empty()) set_layer(technique_layer("--layers", technique.layer), entry);
  set_fit(technique_fit("--fits", technique.fit), entry);
  set_warp(technique_warp("--warps", technique.warp), entry);
  set_split(technique_split("--splits", technique.split), entry);
  set_cascades(technique.cascades, entry);
  set_size(technique.map_size, entry);
  entry.technique.entry = technique.entry;
  if (technique.pages.empty()) return entry;
  set_pages(technique_pages("--pages", technique.pages), entry);
  set_page_texels(technique.page_texels, entry);
  set_page_target(technique.page_target_m, entry);
  return entry;
}

Sweep make_sweep(const SweepRequest& request) {
  Sweep sweep;
  static_cast<Measuring&>(sweep) = request;
  sweep.pixel_samples = request.pixel_samples;
  sweep.timed_frames = request.timed_frames;
  sweep.local_lights = request.local_lights;
  sweep.local_light = request.local_light;
  check_camera(request.camera);
  sweep.camera_text = camera_text(request.camera);
  sweep.edit_text = edit_text(request.edits, limits_of_triangles(request.max_triangles));
  sweep.scenes.clear();
  for (const std::string& scene : request.scenes) {
    if (std::find(sweep.scenes.begin(), sweep.scenes.end(), scene) == sweep.scenes.end())
      sweep.scenes.push_back(scene);
  }
  sweep.entries = product_of(request, sweep.left_out);
  for (SweepEntry& entry : page_product_of(request, sweep.left_out))
    sweep.entries.push_back(std::move(entry));
  for (const report::Technique& technique : request.techniques)
    sweep.entries.push_back(named_entry(technique, request.light.kind));
  // A list that names something twice.
  sweep.entries = without_doubles(std::move(sweep.entries));
  set_filter({}, sweep.baseline);
  set_fit(Fit::tight, sweep.baseline);
  set_warp({}, sweep.baseline);
  set_split(uniform_split(), sweep.baseline);
  set_cascades(1, sweep.baseline);
  set_size(sweep.entries.front().technique.map_size, sweep.baseline);
  for (SweepEntry& entry : sweep.entries) entry.map_passes = request.map_passes;
  return sweep;
}

}  // namespace gnomon::tool
