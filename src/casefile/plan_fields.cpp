// The table of a plan's options: the only place where files and command lines reach into PlanOptions.
#include "gnomon/casefile/plan_fields.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

namespace gnomon {
namespace {

std::vector<std::string> warp_names() {
  std::vector<std::string> names{"auto"};
  for (const Warp* warp : all_warps()) names.emplace_back(warp->name);
  return names;
}

bool set_warp(std::string_view name, PlanOptions& options) {
  const Warp* warp = find_warp(name);
  if (warp == nullptr && name != "auto") return false;
  options.warp.warp = warp;
  return true;
}

std::string warp_of(const PlanOptions& options) {
  return options.warp.warp == nullptr ? "auto" : std::string(options.warp.warp->name);
}

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const Shape* shape : all_shapes()) names.emplace_back(shape->name);
  return names;
}

bool set_shape(std::string_view name, PlanOptions& options) {
  const Shape* shape = find_shape(name);
  if (shape == nullptr) return false;
  options.warp.shape = shape;
  return true;
}

std::string shape_of(const PlanOptions& options) {
  return std::string((options.warp.shape == nullptr ? shapes::linear : *options.warp.shape).name);
}

std::vector<std::string> split_range_names() {
  return {"auto", "receivers", "camera"};
}

bool set_split_range(std::string_view name, PlanOptions& options) {
  constexpr std::array kRanges{SplitRange::automatic, SplitRange::receivers, SplitRange::camera};
  const std::vector<std::string> names = split_range_names();
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return false;
  options.split.range = kRanges[static_cast<std::size_t>(at - names.begin())];
  return true;
}

std::string split_range_of(const PlanOptions& options) {
  switch (options.split.range) {
    case SplitRange::receivers:
      return "receivers";
    case SplitRange::camera:
      return "camera";
    case SplitRange::automatic:
      break;
  }
  return "auto";
}

std::string prune_of(const PlanOptions& options) {
  if (options.prune == default_prune_rules()) return "default";
  if (options.prune == PruneRules::all()) return "all";
  if (options.prune == kPruneNothing) return "none";
  if (options.prune == exact_prune_rules()) return "exact";
  std::string names;
  for (const PruneRuleInfo& rule : prune_rules()) {
    if (options.prune.has(rule.rule)) names += (names.empty() ? "" : ",") + std::string(rule.name);
  }
  return names;
}

/// The table's shorthand for a member, of whatever type.
#define GNOMON_AT(type, member)                                  \
  PlanMember<type> {                                             \
    [](PlanOptions& options) -> type& { return options.member; } \
  }
/// A member that has an enumeration with names: `from` reads one, to_string() writes it.
#define GNOMON_CHOICE(member, from, ...)                                                        \
  PlanChoice {                                                                                  \
    [] { return std::vector<std::string>{__VA_ARGS__}; },                                       \
        [](std::string_view name, PlanOptions& options) { return from(name, options.member); }, \
        [](const PlanOptions& options) { return std::string(to_string(options.member)); }       \
  }

std::vector<PlanField> make_fields() {
  static const std::string kCascades = "must lie in 1.." + std::to_string(kMaxMaps);
  static const std::string kPlanes =
      "needs finite points, normals with a length, and cascades plus planes up to " +
      std::to_string(kMaxMaps);
  return {
      {"map_size", "texels along each side of a map", GNOMON_AT(int, resolution.max_size),
       "options.resolution.max_size", "must lie in 4..16384", kLeastMapSize, kMaxMapSize},
      {"cascades", "shadow maps along the view", GNOMON_AT(int, cascades), "options.cascades", kCascades, 1,
       kMaxMaps},
      {"split", "how view depths are divided among the cascades",
       GNOMON_CHOICE(split.scheme, split_scheme_from_name, "auto", "uniform", "logarithmic", "practical",
                     "pseudo_near", "optimal", "given")},
      {"given_splits", "view depths between the cascades", GNOMON_AT(SplitDepths, split.given),
       "options.split.given", "needs cascades - 1 depths, ascending"},
      {"split_overlap", "share of a cascade that the next one covers as well",
       GNOMON_AT(double, split.overlap), "options.split.overlap", "must lie in 0..1", 0.0, 1.0},
      {"selection", "which cascade serves a point",
       GNOMON_CHOICE(split.selection, map_selection_from_name, "view_depth", "finest")},
      {"cadence_frames", "frames from one plan of a far cascade to its next", GNOMON_AT(int, cadence.frames),
       "options.cadence.frames", "must lie in 1..64", 1, kMaxCadenceFrames},
      {"cadence_step", "largest step of the eye from frame to frame, world units",
       GNOMON_AT(double, cadence.largest_step), "options.cadence.largest_step", "must not be below 0"},
      {"cadence_turn_deg", "largest turn of the camera from frame to frame, degrees",
       GNOMON_AT(double, cadence.largest_turn), "options.cadence.largest_turn", "must lie in 0..180", 0.0,
       180.0, std::numbers::pi / 180.0},
      {"target_m",
       "the fewest cascades whose aliasing error m stays below this; 0: always `cascades` of them",
       GNOMON_AT(double, resolution.max_error), "options.resolution.max_error", "must not be below 0"},
      {"focus", "box whose error is weighted by focus_weight", GNOMON_AT(Box, warp.focus),
       "options.warp.focus", "must be a box of finite numbers"},
      {"focus_weight", "weight of the error in focus", GNOMON_AT(double, warp.focus_weight),
       "options.warp.focus_weight", "must lie in 1..1e6", 1.0, 1e6},
      {"planes", "planes that get a map each, one texel per pixel on them",
       GNOMON_AT(WarpPlanes, warp.planes), "options.warp.planes", kPlanes},
      {"texel_budget", "texels that all maps share; 0: map_size decides",
       GNOMON_AT(std::int64_t, resolution.texel_budget), "options.resolution.texel_budget",
       "must be 0, or hold the least maps: 16 x 16, or four filter radii"},
      {"lambda", "blend of the practical split, which it selects: 0 uniform, 1 logarithmic",
       GNOMON_AT(double, split.lambda), "options.split.lambda", "must lie in 0..1", 0.0, 1.0},
      {"near_hint", "view depth from which error counts; 0: the near plane",
       GNOMON_AT(double, split.pseudo_near), "options.split.pseudo_near", "must not be below 0"},
      {"split_range", "which view depths are divided",
       PlanChoice{split_range_names, set_split_range, split_range_of}},
      {"partition", "what divides the receivers among the maps",
       GNOMON_CHOICE(split.partition, partition_from_name, "view_depth", "frustum_faces", "separating_plane",
                     "tetrahedron", "receiver_clusters")},
      {"face_slices", "most slices along the view of a side face; of partition frustum_faces",
       GNOMON_AT(int, split.face_slices), "options.split.face_slices", kCascades, 1, kMaxMaps},
      {"warp", "perspective warp of the maps", PlanChoice{warp_names, set_warp, warp_of}},
      {"shape", "how texels lie along the warp", PlanChoice{shape_names, set_shape, shape_of}},
      {"objective", "error that the warp lowers",
       GNOMON_CHOICE(warp.objective, objective_from_name, "storage", "max", "p95", "picture")},
      {"fit", "how a map is fitted to its part of the view",
       GNOMON_CHOICE(fit, fit_from_name, "tight", "rotated", "stable", "warped_stable")},
      {"stable_size_steps", "sizes per octave of stable maps", GNOMON_AT(int, resolution.stable_size_steps),
       "options.resolution.stable_size_steps", "must lie in 1..1024", 1, 1024},
      {"filter_radius_texels", "kernel radius in texels", GNOMON_AT(double, filter.texels),
       "options.filter.texels", "must lie in 0..map_size/4"},
      {"filter_radius_world", "kernel radius in world units", GNOMON_AT(double, filter.world),
       "options.filter.world", "must be 0 or more"},
      {"prune", "what may be omitted",
       PlanChoice{
           [] {
             return std::vector<std::string>{"default", "all", "none", "exact",
                                             "names of rules divided by commas"};
           },
           [](std::string_view text, PlanOptions& options) { return parse_prune_rules(text, options.prune); },
           prune_of}},
      {"prune_m", "largest error m that bounded rules may leave", GNOMON_AT(double, resolution.prune_error),
       "options.resolution.prune_error", "must be at least 1e-9"},
      {"bias", "how far depths are moved off the surface", GNOMON_AT(BiasOptions, bias), "options.bias",
       "every value must be 0 or above"},
      {"light_near_share", "where maps of a local light begin, of the farthest receiver's distance",
       GNOMON_AT(double, light_near_share), "options.light_near_share", "must lie in 1e-7..0.5",
       kLeastLightNearShare, kMaxLightNearShare},
      {"clip_space", "clip space of the matrices", GNOMON_AT(ClipSpace, clip_space)}};
}

#undef GNOMON_AT
#undef GNOMON_CHOICE

}  // namespace

std::span<const PlanField> plan_fields() {
  static const std::vector<PlanField> fields = make_fields();
  return fields;
}

const PlanField& plan_field(std::string_view key) {
  for (const PlanField& field : plan_fields())
    if (field.key == key) return field;
  throw std::out_of_range("no option of a plan is called " + std::string(key));
}

}  // namespace gnomon
