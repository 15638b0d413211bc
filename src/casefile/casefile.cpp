// The case format: which keys there are, and what they become.
#include "gnomon/casefile/casefile.hpp"

#include <algorithm>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <numbers>

#include "json_fields.hpp"
#include "json_text.hpp"

namespace gnomon {
namespace {

using nlohmann::json;

double radians(double degrees) {
  return degrees * (std::numbers::pi / 180.0);
}

double half_open_degrees(const Fields& fields, std::string_view key) {
  const double degrees = fields.number(key);
  if (!(degrees > 0.0 && degrees < 180.0)) fields.refuse(key, "must be between 0 and 180");
  return degrees;
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
  camera.far_depth = fields.number("far");
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
  const double extent =
      fov ? radians(half_open_degrees(fields, "fov_y_deg")) : fields.positive("height_world");
  return (fov ? perspective_camera : orthographic_camera)(
      fields.vector("position"), fields.vector("forward"), fields.vector("up"), extent,
      fields.positive("aspect"), fields.number("near"), fields.number("far"), fields.integer("width"),
      fields.integer("height"));
}

Light light_from(const json& value) {
  // The type decides which keys are known.
  const Fields any(value, "light", {"type", "direction", "position", "outer_deg", "range"});
  const std::string type = any.text("type");
  if (type == "directional") {
    const Fields fields(value, "light", {"type", "direction"});
    return DirectionalLight{fields.vector("direction")};
  }
  if (type == "spot") {
    return SpotLight{any.vector("position"), any.vector("direction"),
                     radians(half_open_degrees(any, "outer_deg")), any.number("range")};
  }
  if (type == "point") {
    const Fields fields(value, "light", {"type", "position", "range"});
    return PointLight{fields.vector("position"), fields.number("range")};
  }
  any.refuse("type", "is \"" + one_line(type, 40) + "\", not one of directional, spot, point");
}

template <typename Value, typename Set>
void read_name(const Fields& fields, std::string_view key, Value& out, const char* names, Set set) {
  if (!fields.has(key)) return;
  const std::string name = fields.text(key);
  if (!set(name, out)) fields.refuse(key, "is \"" + one_line(name, 40) + "\", not one of " + names);
}

std::string warp_names() {
  std::string names = "auto";
  for (const Warp* warp : all_warps()) names += ", " + std::string(warp->name);
  return names;
}

bool warp_from_name(std::string_view name, const Warp*& warp) {
  warp = name == "auto" ? nullptr : find_warp(name);
  return name == "auto" || warp != nullptr;
}

bool split_range_from_name(std::string_view name, SplitRange& range) {
  if (name == "auto") range = SplitRange::automatic;
  if (name == "receivers") range = SplitRange::receivers;
  if (name == "camera") range = SplitRange::camera;
  return name == "auto" || name == "receivers" || name == "camera";
}

bool ndc_depth_from_name(std::string_view name, NdcDepth& depth) {
  if (name == "minus_one_to_one") depth = NdcDepth::minus_one_to_one;
  if (name == "zero_to_one") depth = NdcDepth::zero_to_one;
  return name == "minus_one_to_one" || name == "zero_to_one";
}

bool handedness_from_name(std::string_view name, Handedness& handedness) {
  handedness = name == "left" ? Handedness::left : Handedness::right;
  return name == "left" || name == "right";
}

bool first_row_from_name(std::string_view name, FirstRow& row) {
  row = name == "y_plus_one" ? FirstRow::y_plus_one : FirstRow::y_minus_one;
  return name == "y_plus_one" || name == "y_minus_one";
}

ClipSpace clip_space_from(const json& value) {
  const Fields fields(value, "options.clip_space",
                      {"ndc_depth", "reversed_z", "y_down", "handedness", "first_row"});
  ClipSpace clip_space;
  read_name(fields, "ndc_depth", clip_space.ndc_depth, "minus_one_to_one, zero_to_one", ndc_depth_from_name);
  fields.read("reversed_z", clip_space.reversed_z);
  fields.read("y_down", clip_space.y_down);
  read_name(fields, "handedness", clip_space.handedness, "right, left", handedness_from_name);
  read_name(fields, "first_row", clip_space.first_row, "y_minus_one, y_plus_one", first_row_from_name);
  return clip_space;
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

/// The separating plane is counted among the warps, too: two maps, the first of them warped as the plan
/// chooses.
void read_warp(const Fields& fields, PlanOptions& options) {
  if (!fields.has("warp") || fields.text("warp") != to_string(Partition::separating_plane)) {
    read_name(fields, "warp", options.warp.warp, warp_names().c_str(), warp_from_name);
    return;
  }
  if (fields.has("partition")) fields.refuse("warp", "is a partition: give it as partition alone");
  options.split.partition = Partition::separating_plane;
}

PlanOptions options_from(const json& value) {
  const Fields fields(value, "options",
                      {"map_size",
                       "cascades",
                       "split",
                       "given_splits",
                       "lambda",
                       "pseudo_near",
                       "near_hint",
                       "split_range",
                       "split_overlap",
                       "target_m",
                       "focus",
                       "focus_weight",
                       "texel_budget",
                       "partition",
                       "warp",
                       "objective",
                       "stable",
                       "fit",
                       "stable_size_steps",
                       "filter_radius_texels",
                       "filter_radius_world",
                       "prune",
                       "prune_m",
                       "bias",
                       "clip_space"});
  PlanOptions options;
  fields.read("map_size", options.resolution.max_size);
  fields.read("cascades", options.cascades);
  read_name(fields, "split", options.split.scheme,
            "auto, uniform, logarithmic, practical, pseudo_near, optimal, given", split_scheme_from_name);
  if (fields.has("given_splits")) {
    if (fields.has("split") && options.split.scheme != SplitScheme::given)
      fields.refuse("given_splits", "needs split to be given");
    const std::vector<double> depths = fields.numbers("given_splits");
    if (depths.size() > options.split.given.size()) fields.refuse("given_splits", "holds too many depths");
    std::copy(depths.begin(), depths.end(), options.split.given.begin());
    options.split.scheme = SplitScheme::given;
  }
  fields.read("split_overlap", options.split.overlap);
  fields.read("target_m", options.resolution.max_error);
  if (fields.has("focus")) options.warp.focus = box_from(fields.at("focus"), "options.focus");
  fields.read("focus_weight", options.warp.focus_weight);
  fields.read("texel_budget", options.resolution.texel_budget);
  fields.read("lambda", options.split.lambda);
  // Who gives a blend means the scheme that blends.
  if (fields.has("lambda") && !fields.has("split") && !fields.has("given_splits"))
    options.split.scheme = SplitScheme::practical;
  if (fields.has("pseudo_near") && fields.has("near_hint"))
    fields.refuse("pseudo_near", "is another name of near_hint: give one of them");
  fields.read("pseudo_near", options.split.pseudo_near);
  fields.read("near_hint", options.split.pseudo_near);
  read_name(fields, "split_range", options.split.range, "auto, receivers, camera", split_range_from_name);
  read_name(fields, "partition", options.split.partition, "view_depth, frustum_faces, separating_plane",
            partition_from_name);
  read_warp(fields, options);
  read_name(fields, "objective", options.warp.objective, "storage, max, p95", objective_from_name);
  if (fields.has("stable") && fields.has("fit"))
    fields.refuse("stable", "is another name of fit: give one of them");
  if (fields.has("stable")) options.fit = fields.boolean("stable") ? Fit::stable : Fit::tight;
  read_name(fields, "fit", options.fit, "tight, rotated, stable, warped_stable", fit_from_name);
  fields.read("stable_size_steps", options.resolution.stable_size_steps);
  fields.read("filter_radius_texels", options.filter.texels);
  fields.read("filter_radius_world", options.filter.world);
  read_name(fields, "prune", options.prune, "all, none, exact, or names of rules divided by commas",
            parse_prune_rules);
  fields.read("prune_m", options.resolution.prune_error);
  if (fields.has("bias")) options.bias = bias_from(fields.at("bias"));
  if (fields.has("clip_space")) options.clip_space = clip_space_from(fields.at("clip_space"));
  return options;
}

std::string read_text(const std::filesystem::path& file) {
  const auto close = [](std::FILE* stream) { (void)std::fclose(stream); };
  const std::unique_ptr<std::FILE, decltype(close)> stream(std::fopen(file.c_str(), "rb"), close);
  if (!stream) throw CaseError(std::strerror(errno));
  std::string text;
  std::array<char, 65536> block;
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), stream.get())) {
    text.append(block.data(), count);
    if (text.size() > kMaxCaseBytes) throw CaseError("larger than 16 MiB");
  }
  if (std::ferror(stream.get())) throw CaseError(std::strerror(errno));
  return text;
}

}  // namespace

Case read_case(std::string_view json_text) {
  const json value = parse_json(json_text);
  const Fields fields(value, "", {"camera", "light", "receivers", "casters", "options"});
  Case result;
  result.camera = camera_from(fields.at("camera"));
  result.light = light_from(fields.at("light"));
  result.receivers = fields.boxes("receivers");
  result.casters = fields.boxes("casters");
  if (fields.has("options")) result.options = options_from(fields.at("options"));
  return result;
}

Case load_case(const std::filesystem::path& file) {
  try {
    return read_case(read_text(file));
  } catch (const CaseError& error) {
    throw CaseError(shown_name(file) + ": " + error.what());
  }
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
      {"options.resolution.max_size", "options.map_size: must lie in 4..16384"},
      {"options.split.lambda", "options.lambda: must lie in 0..1"},
      {"options.warp.focus", "options.focus: must be a box of finite numbers"},
      {"options.warp.focus_weight", "options.focus_weight: must lie in 1..1e6"},
      {"options.split.pseudo_near", "options.near_hint: must not be below 0"},
      {"options.filter.world", "options.filter_radius_world: must be 0 or more"},
      {"options.resolution.stable_size_steps", "options.stable_size_steps: must lie in 1..1024"},
      {"options.split.given", "options.given_splits: needs cascades - 1 depths, ascending"},
      {"options.split.overlap", "options.split_overlap: must lie in 0..1"},
      {"options.resolution.max_error", "options.target_m: must not be below 0"},
      {"options.resolution.prune_error", "options.prune_m: must be at least 1e-9"},
      {"options.resolution.texel_budget",
       "options.texel_budget: must be 0, or hold the least maps: 16 x 16, or four filter radii"},
      {"options.filter.texels", "options.filter_radius_texels: must lie in 0..map_size/4"},
      {"options.bias", "options.bias: every value must be 0 or above"},
  });
  if (invalid_field == "options.cascades")
    return "options.cascades: must lie in 1.." + std::to_string(kMaxMaps);
  for (const Entry& entry : kTexts)
    if (entry.field == invalid_field) return std::string(entry.text);
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
