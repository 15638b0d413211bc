// The case format: which keys there are, and what they become.
#include "gnomon/casefile/casefile.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
#include <variant>

#include "base/bounded_file.hpp"
#include "base/nearest_name.hpp"
#include "gnomon/casefile/plan_fields.hpp"
#include "json_fields.hpp"
#include "json_text.hpp"
#include "shared_fields.hpp"

namespace gnomon {
namespace {

using nlohmann::json;

/// A depth, or infinity: the word, null, or nothing at all. JSON has no number for it.
double far_depth(const Fields& fields) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!fields.has("far") || fields.at("far").is_null()) return kInfinity;
  if (!fields.at("far").is_string()) return fields.number("far");
  if (fields.text("far") != "infinity")
    fields.refuse("far", "is \"" + one_line(fields.text("far"), 40) + "\", not a number or \"infinity\"");
  return kInfinity;
}

Camera edges_camera(const Fields& fields) {
  if (fields.has("aspect")) fields.refuse("aspect", "says nothing beside left, right, bottom, top");
  Camera camera;
  camera.position = fields.vector("position");
  camera.forward = fields.vector("forward");
  camera.up = fields.vector("up");
  camera.left = fields.number("left");
  camera.right = fields.number("right");
  camera.bottom = fields.number("bottom");
  camera.top = fields.number("top");
  camera.near_depth = fields.number("near");
  camera.far_depth = far_depth(fields);
  camera.width = fields.integer("width");
  camera.height = fields.integer("height");
  fields.read("orthographic", camera.orthographic);
  return camera;
}

Camera camera_from(const json& value) {
  const Fields fields(value, "camera",
                      {"position", "forward", "up", "fov_y_deg", "height_world", "aspect", "near", "far",
                       "width", "height", "left", "right", "bottom", "top", "orthographic"});
  const bool edges = fields.has("left") || fields.has("right") || fields.has("bottom") || fields.has("top");
  const bool fov = fields.has("fov_y_deg");
  const bool parallel = fields.has("height_world");
  if (int{edges} + int{fov} + int{parallel} != 1)
    throw CaseError("camera: needs one of fov_y_deg, height_world, or left with right, bottom and top");
  if (edges) return edges_camera(fields);
  if (fields.has("orthographic")) fields.refuse("orthographic", "is only read with left, right, bottom, top");
  const double extent = fov ? half_open_degrees(fields, "fov_y_deg") : fields.positive("height_world");
  return (fov ? perspective_camera : orthographic_camera)(
      fields.vector("position"), fields.vector("forward"), fields.vector("up"), extent,
      fields.positive("aspect"), fields.number("near"), far_depth(fields), fields.integer("width"),
      fields.integer("height"));
}

std::vector<LightRequest> lights_from(const Fields& fields) {
  const json& list = fields.at("lights");
  if (!list.is_array() || list.empty()) fields.refuse("lights", "needs a list of lights");
  std::vector<LightRequest> lights;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string path = element_path("lights", i);
    LightRequest request{light_from(list[i], path, {"weight", "draws", "triangles"})};
    const auto read = [&](const char* key, double& value) {
      if (!list[i].contains(key)) return;
      if (!list[i].at(key).is_number()) throw CaseError(path + "." + key + ": needs a number");
      value = list[i].at(key).get<double>();
    };
    read("weight", request.weight);
    read("draws", request.draws);
    read("triangles", request.triangles);
    lights.push_back(request);
  }
  return lights;
}

BiasOptions bias_from(const json& value) {
  const Fields fields(value, "options.bias",
                      {"constant_texels", "slope_texels", "normal_offset_texels", "max_slope"});
  BiasOptions bias;
  fields.read("constant_texels", bias.constant_texels);
  fields.read("slope_texels", bias.slope_texels);
  fields.read("normal_offset_texels", bias.normal_offset_texels);
  fields.read("max_slope", bias.max_slope);
  return bias;
}

WarpPlanes planes_from(const Fields& fields, std::string_view key) {
  WarpPlanes planes{};
  const json& list = fields.at(key);
  if (!list.is_array()) fields.refuse(key, "is no list of planes");
  if (list.size() > planes.size())
    fields.refuse(key, "holds more than " + std::to_string(planes.size()) + " planes");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Fields plane(list[i], element_path(fields.path_of(key), i), {"point", "normal", "thickness"});
    planes[i] = {plane.vector("point"), plane.vector("normal"), plane.positive("thickness")};
  }
  return planes;
}

/// Other names of a field, which must not stand beside it.
constexpr std::array<std::array<std::string_view, 2>, 2> kOtherNames{
    {{"pseudo_near", "near_hint"}, {"stable", "fit"}}};

/// The list that files may name in a message: "a, b, c".
std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Reads the value under `key` into the field's place.
void read_field(const Fields& fields, std::string_view key, const PlanField& field, PlanOptions& options) {
  if (!fields.has(key)) return;
  std::visit(
      [&](const auto& place) {
        using Place = std::remove_cvref_t<decltype(place)>;
        if constexpr (std::is_same_v<Place, PlanChoice>) {
          const std::string name = fields.text(key);
          if (!place.set(name, options))
            fields.refuse(key, "is \"" + one_line(name, 40) + "\", not one of " + listed(place.names()) +
                                   meant(name, place.names()));
        } else if constexpr (std::is_same_v<Place, PlanMember<Box>>) {
          place(options) = box_from(fields.at(key), fields.path_of(key));
        } else if constexpr (std::is_same_v<Place, PlanMember<BiasOptions>>) {
          place(options) = bias_from(fields.at(key));
        } else if constexpr (std::is_same_v<Place, PlanMember<ClipSpace>>) {
          place(options) = clip_space_from(fields.at(key), fields.path_of(key));
        } else if constexpr (std::is_same_v<Place, PlanMember<SplitDepths>>) {
          const std::vector<double> depths = fields.numbers(key);
          if (depths.size() > place(options).size()) fields.refuse(key, "holds too many depths");
          std::copy(depths.begin(), depths.end(), place(options).begin());
        } else if constexpr (std::is_same_v<Place, PlanMember<WarpPlanes>>) {
          place(options) = planes_from(fields, key);
        } else {
          fields.read(key, place(options));
          if constexpr (std::is_same_v<Place, PlanMember<double>>) {
            if (field.unit != 1.0) place(options) *= field.unit;
          }
        }
      },
      field.place);
}

void set_name(std::string_view key, std::string_view name, PlanOptions& options) {
  std::get<PlanChoice>(plan_field(key).place).set(name, options);
}

/// What some keys mean for others.
void apply_implications(const Fields& fields, PlanOptions& options) {
  if (fields.has("given_splits")) {
    if (fields.has("split") && fields.text("split") != "given")
      fields.refuse("given_splits", "needs split to be given");
    set_name("split", "given", options);
  } else if (fields.has("lambda") && !fields.has("split")) {
    set_name("split", "practical", options);  // who gives a blend means the scheme that blends
  }
  if (fields.has("stable")) set_name("fit", fields.boolean("stable") ? "stable" : "tight", options);
}

/// The separating plane is counted among the warps, too: two maps, the first of them warped as the plan
/// chooses.
bool names_partition_as_warp(const Fields& fields) {
  if (!fields.has("warp") || fields.text("warp") != to_string(Partition::separating_plane)) return false;
  if (fields.has("partition")) fields.refuse("warp", "is a partition: give it as partition alone");
  return true;
}

/// `known`: what else may stand beside them.
PlanOptions options_from(const json& value, std::vector<std::string_view> known = {}) {
  for (const PlanField& field : plan_fields()) known.push_back(field.key);
  for (const auto& [other, key] : kOtherNames) known.push_back(other);
  const Fields fields(value, "options", known);
  for (const auto& [other, key] : kOtherNames) {
    if (fields.has(other) && fields.has(key))
      fields.refuse(other, "is another name of " + std::string(key) + ": give one of them");
  }
  PlanOptions options;
  const bool partition_as_warp = names_partition_as_warp(fields);
  for (const PlanField& field : plan_fields()) {
    if (field.key == "warp" && partition_as_warp) continue;
    read_field(fields, field.key, field, options);
  }
  read_field(fields, "pseudo_near", plan_field("near_hint"), options);
  apply_implications(fields, options);
  if (partition_as_warp) set_name("partition", to_string(Partition::separating_plane), options);
  return options;
}

PageOptions pages_from(const json& value) {
  const Fields fields(value, "options.pages",
                      {"policy", "page_texels", "capacity", "target_m", "share", "levels_per_octave",
                       "trials", "virtual_texels", "reach_texels", "fallback", "least_light_sine"});
  PageOptions pages;
  if (fields.has("policy")) {
    const std::string name = fields.text("policy");
    std::vector<std::string> names;
    for (const PagePolicy* policy : all_page_policies()) names.emplace_back(policy->name);
    pages.policy = find_page_policy(name);
    if (pages.policy == nullptr)
      fields.refuse("policy",
                    "is \"" + one_line(name, 40) + "\", not one of " + listed(names) + meant(name, names));
  }
  fields.read("page_texels", pages.page_texels);
  fields.read("capacity", pages.capacity);
  fields.read("target_m", pages.target_m);
  fields.read("share", pages.share);
  fields.read("levels_per_octave", pages.levels_per_octave);
  fields.read("trials", pages.trials);
  fields.read("virtual_texels", pages.virtual_texels);
  fields.read("reach_texels", pages.reach_texels);
  fields.read("fallback", pages.fallback);
  fields.read("least_light_sine", pages.least_light_sine);
  return pages;
}

LightCosts light_costs_from(const json& value) {
  const Fields fields(value, "options.lights.costs",
                      {"per_map", "per_megatexel", "per_kilodraw", "per_megatriangle"});
  LightCosts costs;
  fields.read("per_map", costs.per_map);
  fields.read("per_megatexel", costs.per_megatexel);
  fields.read("per_kilodraw", costs.per_kilodraw);
  fields.read("per_megatriangle", costs.per_megatriangle);
  return costs;
}

LightOptions light_options_from(const json& value) {
  const Fields fields(
      value, "options.lights",
      {"pool_width", "pool_height", "texel_budget", "page_budget", "page_texels", "millisecond_budget",
       "costs", "least_size", "most_size", "enough_m", "most_frames", "full_share"});
  LightOptions options;
  fields.read("pool_width", options.pool_width);
  fields.read("pool_height", options.pool_height);
  fields.read("texel_budget", options.texel_budget);
  fields.read("page_budget", options.page_budget);
  fields.read("page_texels", options.page_texels);
  fields.read("millisecond_budget", options.millisecond_budget);
  if (value.contains("costs")) options.costs = light_costs_from(value.at("costs"));
  fields.read("least_size", options.least_size);
  fields.read("most_size", options.most_size);
  fields.read("enough_m", options.enough_m);
  fields.read("most_frames", options.most_frames);
  fields.read("full_share", options.full_share);
  return options;
}

void read_feedback(const Fields& fields, Case& result) {
  for (const double bits : fields.numbers("seen_feedback")) {
    constexpr double kAllBits = kShadowEdge | kShadowChanged | kDepthEdge;
    if (!(bits >= 0.0 && bits <= kAllBits && bits == static_cast<int>(bits)))
      fields.refuse("seen_feedback", "needs sums of 1 (shadow edge), 2 (shadow changed) and 4 (depth edge)");
    result.seen_feedback.push_back(static_cast<std::uint8_t>(bits));
  }
}

std::string read_text(const std::filesystem::path& file) {
  std::string text;
  const std::string why = read_bounded_file(file, kMaxCaseBytes, Readable::file_or_pipe, text);
  if (!why.empty()) throw CaseError(why);
  return text;
}

}  // namespace

Case read_case(std::string_view json_text) {
  const json value = parse_json(json_text);
  const Fields fields(
      value, "", {"camera", "light", "lights", "receivers", "casters", "options", "seen", "seen_feedback"});
  Case result;
  result.camera = camera_from(fields.at("camera"));
  if (fields.has("lights")) {
    if (fields.has("light")) fields.refuse("lights", "stands in place of light: give one of them");
    result.lights = lights_from(fields);
    result.light = result.lights[0].light;
  } else {
    result.light = light_from(fields.at("light"), "light");
  }
  result.receivers = fields.boxes("receivers");
  result.casters = fields.boxes("casters");
  if (fields.has("options")) {
    result.options = options_from(fields.at("options"), {"pages", "lights"});
    const json& options = fields.at("options");
    if (options.contains("pages")) result.pages = pages_from(options.at("pages"));
    if (options.contains("lights")) result.light_options = light_options_from(options.at("lights"));
    if (options.contains("lights") && result.lights.empty())
      throw CaseError("options.lights: is only read with lights");
    if (result.pages && !result.lights.empty())
      throw CaseError("options.pages: are of one light, not of lights");
  }
  if (fields.has("seen") && !result.pages && result.lights.empty())
    fields.refuse("seen", "is only read with options.pages or lights");
  if (fields.has("seen_feedback") && !result.pages)
    fields.refuse("seen_feedback", "is only read with options.pages");
  if (fields.has("seen")) {
    ListedPoints seen = points_from(fields, "seen");
    result.seen = std::move(seen.points);
    result.seen_normals = std::move(seen.normals);
  }
  if (fields.has("seen_feedback")) read_feedback(fields, result);
  return result;
}

Case load_case(const std::filesystem::path& file) {
  try {
    return read_case(read_text(file));
  } catch (const CaseError& error) {
    throw CaseError(shown_name(file) + ": " + error.what());
  }
}

PlanOptions read_plan_options(std::string_view json_text) {
  return options_from(parse_json(json_text));
}

std::string invalid_input_text(std::string_view invalid_field) {
  struct Entry {
    std::string_view field, text;
  };
  static constexpr auto kTexts = std::to_array<Entry>({
      {"camera.position", "camera.position: is beyond 1e30"},
      {"camera.forward", "camera.forward: must not be zero"},
      {"camera.left, camera.right", "camera: left must lie below right"},
      {"camera.bottom, camera.top", "camera: bottom must lie below top"},
      {"camera.near_depth", "camera.near: must be above 0 and at least 1e-12 of far"},
      {"camera.far_depth", "camera.far: must lie above near"},
      {"camera.width, camera.height", "camera.width, camera.height: must lie in 1..1048576"},
      {"light.direction", "light.direction: must not be zero"},
      {"light.outer_radians", "light.outer_deg: must be between 0 and 180"},
      {"light.range", "light.range: must be above 0"},
      {"bounds.casters", "casters: a corner is beyond 1e30"},
      {"bounds.receivers", "receivers: a corner is beyond 1e30"},
      {"pages.page_texels", "options.pages.page_texels: must be 64, 128 or 256, and at most virtual_texels"},
      {"pages.virtual_texels", "options.pages.virtual_texels: must lie in 1..67108864"},
      {"pages.capacity", "options.pages.capacity: must lie in 1..1048576, and hold a page for each map"},
      {"pages.target_m", "options.pages.target_m: must be at least 1e-9"},
      {"pages.share", "options.pages.share: must lie above 0 and at most at 1"},
      {"pages.levels_per_octave", "options.pages.levels_per_octave: must lie in 1..4"},
      {"pages.trials", "options.pages.trials: must lie in 1..16"},
      {"pages.reach_texels", "options.pages.reach_texels: must lie in 0..page_texels"},
      {"pages.least_light_sine", "options.pages.least_light_sine: must lie in 0..1"},
      {"light.weight", "light.weight: must lie in 0..1e30"},
      {"light.draws", "light.draws: must lie in 0..1e30"},
      {"light.triangles", "light.triangles: must lie in 0..1e30"},
      {"lights", "lights: must be at most 4096"},
      {"lights.pool_width, lights.pool_height",
       "options.lights.pool_width, pool_height: must be multiples of most_size up to 65536"},
      {"lights.texel_budget", "options.lights.texel_budget: is too small for a map of each light"},
      {"lights.page_budget", "options.lights.page_budget: is too small for a page of each map"},
      {"lights.page_texels", "options.lights.page_texels: must be a power of two up to most_size"},
      {"lights.millisecond_budget",
       "options.lights.millisecond_budget: is too small for the least maps of all lights"},
      {"lights.costs", "options.lights.costs: must lie in 0..1e30"},
      {"lights.least_size", "options.lights.least_size: must be a power of two up to most_size"},
      {"lights.most_size",
       "options.lights.most_size: must be a power of two in 16..16384 that holds filters"},
      {"lights.enough_m", "options.lights.enough_m: must lie in 0..1e30"},
      {"lights.most_frames", "options.lights.most_frames: must lie in 1..64"},
      {"lights.full_share", "options.lights.full_share: must lie above 0 and at most at 1"},
      {"view.points_world", "seen: a point is beyond 1e30"},
      {"view.normals_world", "seen: a normal is not of length 1"},
      {"history.feedback", "seen_feedback: needs one number for each point of seen"},
  });
  for (const Entry& entry : kTexts)
    if (entry.field == invalid_field) return std::string(entry.text);
  for (const PlanField& field : plan_fields()) {
    if (!field.invalid_field.empty() && field.invalid_field == invalid_field)
      return "options." + std::string(field.key) + ": " + std::string(field.must);
  }
  return std::string(invalid_field) + ": not usable";
}

std::string one_line(std::string_view text, std::size_t max_length) {
  std::string line(text.substr(0, max_length));
  for (char& c : line)
    if (c < ' ' || c > '~') c = '?';
  if (text.size() > max_length) line += "...";
  return line;
}

std::string shown_name(const std::filesystem::path& file) {
  std::string name = file.string();
  for (char& c : name)
    if ((c >= 0 && c < ' ') || c == '\x7f') c = '?';
  return name;
}

}  // namespace gnomon
