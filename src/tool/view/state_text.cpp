// The viewer's state as a JSON file, and what of it no command line has.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/bounded_file.hpp"
#include "base/json_scan.hpp"
#include "base/json_words.hpp"
#include "base/nearest_name.hpp"
#include "base/whole_file.hpp"
#include "edit_words.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "identifier_word.hpp"
#include "option_words.hpp"
#include "picture_words.hpp"
#include "plan_option.hpp"
#include "state.hpp"

namespace gnomon::tool::view {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kVersionKey = "gnomon_view";
constexpr int kVersion = 1;

Json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json key_json(const CameraKey& key) {
  Json json{{"position", vector_json(key.position)}, {"target", vector_json(key.target)}};
  if (key.up != CameraKey().up) json["up"] = vector_json(key.up);
  return json;
}

Json clip_space_json(const ClipSpace& clip) {
  return {{"ndc_depth", clip.ndc_depth == NdcDepth::zero_to_one ? "zero_to_one" : "minus_one_to_one"},
          {"reversed_z", clip.reversed_z},
          {"y_down", clip.y_down},
          {"handedness", clip.handedness == Handedness::left ? "left" : "right"},
          {"first_row", clip.first_row == FirstRow::y_plus_one ? "y_plus_one" : "y_minus_one"}};
}

Json bias_json(const BiasOptions& bias) {
  return {{"constant_texels", bias.constant_texels},
          {"slope_texels", bias.slope_texels},
          {"normal_offset_texels", bias.normal_offset_texels},
          {"max_slope", bias.max_slope}};
}

/// What plan_options_json() leaves out, where it is not the default.
Json structured_options(const PlanOptions& options) {
  Json json = Json::object();
  const PlanOptions none;
  if (!options.warp.focus.empty())
    json["focus"] = {{"min", vector_json(options.warp.focus.min)},
                     {"max", vector_json(options.warp.focus.max)}};
  if (options.split.scheme == SplitScheme::given) {
    Json depths = Json::array();
    for (const double depth : options.split.given)
      if (std::isfinite(depth)) depths.push_back(depth);
    json["given_splits"] = depths;
  }
  if (options.warp.has_planes()) {
    Json planes = Json::array();
    for (const WarpPlane& plane : options.warp.planes)
      if (plane.thickness != 0.0)
        planes.push_back({{"point", vector_json(plane.point_world)},
                          {"normal", vector_json(plane.normal)},
                          {"thickness", plane.thickness}});
    json["planes"] = planes;
  }
  if (bias_json(options.bias) != bias_json(none.bias)) json["bias"] = bias_json(options.bias);
  if (options.clip_space != none.clip_space) json["clip_space"] = clip_space_json(options.clip_space);
  return json;
}

Json options_json(const PlanOptions& options) {
  Json json = plan_options_json(options);
  json.update(structured_options(options));
  return json;
}

Json pages_json(const PageSetting& pages) {
  return {{"policy", page_policy_name(pages)},
          {"page_texels", pages.page_texels},
          {"capacity", pages.capacity},
          {"target_m", pages.target_m}};
}

Json settings_json(const Settings& settings) {
  return {{"options", options_json(settings.plan)},
          {"pages", pages_json(settings.pages)},
          {"filter", render::to_string(settings.filter)},
          {"transition", transition_names()[static_cast<std::size_t>(settings.transition)]},
          {"identifiers", identifier_names()[identifier_index(settings.identifiers)]},
          {"identifier_neighbours", settings.identifiers ? settings.identifiers->neighbours : 0},
          {"layer", render::info_of(settings.layer).name},
          {"linear_depth", settings.linear_depth},
          {"map_passes", map_passes_names()[static_cast<std::size_t>(settings.map_passes)]},
          {"history", settings.history},
          {"visible_depths", settings.visible_depths}};
}

Json light_json(const LightState& light) {
  Json json{{"type", to_string(light.sun.kind)},
            {"elevation_deg", light.sun.elevation_deg},
            {"azimuth_deg", light.sun.azimuth_deg}};
  if (light.all) json["all"] = true;
  if (light.spot)
    json["spot"] = {{"position", vector_json(light.spot->position)},
                    {"direction", vector_json(light.spot->direction)},
                    {"outer_deg", light.spot->outer_radians * kDegrees},
                    {"range", light.spot->range}};
  if (light.point)
    json["point"] = {{"position", vector_json(light.point->position)}, {"range", light.point->range}};
  return json;
}

/// An object of the file, whose keys are taken one by one; done() refuses those that are left.
class Reader {
 public:
  Reader(const Json& json, std::string path) : json_(json), path_(std::move(path)) {
    if (!json.is_object()) throw std::runtime_error(path_ + (path_.empty() ? "" : ": ") + "needs an object");
  }

  [[nodiscard]] const Json* take(const char* key) {
    known_.emplace_back(key);
    const auto found = json_.find(key);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
  }
  void read(const char* key, double& out, double least, double most) {
    const Json* value = take(key);
    if (value == nullptr) return;
    if (!value->is_number()) refuse(key, fmt::format("needs a number, is {}", value->type_name()));
    const double number = value->get<double>();
    if (!(number >= least && number <= most))
      refuse(key, fmt::format("{:g} is not in {:g}..{:g}", number, least, most));
    out = number;
  }
  void read(const char* key, int& out, int least, int most) {
    double number = out;
    read(key, number, static_cast<double>(least), static_cast<double>(most));
    if (number != std::floor(number)) refuse(key, fmt::format("{:g} is not a whole number", number));
    out = static_cast<int>(number);
  }
  void read(const char* key, bool& out) {
    const Json* value = take(key);
    if (value == nullptr) return;
    if (!value->is_boolean()) refuse(key, fmt::format("needs true or false, is {}", value->type_name()));
    out = value->get<bool>();
  }
  void read(const char* key, std::string& out) {
    const Json* value = take(key);
    if (value == nullptr) return;
    if (!value->is_string()) refuse(key, fmt::format("needs a text, is {}", value->type_name()));
    out = value->get<std::string>();
  }
  void read(const char* key, glm::dvec3& out) {
    const Json* value = take(key);
    if (value == nullptr) return;
    constexpr double kMost = 1e30;
    const bool numbers = value->is_array() && value->size() == 3 &&
                         std::all_of(value->begin(), value->end(), [](const Json& v) {
                           return v.is_number() && std::abs(v.get<double>()) <= kMost;
                         });
    if (!numbers) refuse(key, "needs three numbers");
    out = {(*value)[0].get<double>(), (*value)[1].get<double>(), (*value)[2].get<double>()};
  }
  /// The index of a name; `out` as it was where the key is absent.
  template <class Enum>
  void read_name(const char* key, Enum& out, const std::vector<std::string>& names) {
    std::string name;
    read(key, name);
    if (name.empty()) return;
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      refuse(key, "is \"" + one_line(name, 40) + "\", not one of " + any_of_text(names) + meant(name, names));
    out = static_cast<Enum>(found - names.begin());
  }
  [[nodiscard]] std::string path_of(const char* key) const { return path_.empty() ? key : path_ + "." + key; }
  [[noreturn]] void refuse(const char* key, const std::string& why) const {
    throw std::runtime_error(path_of(key) + ": " + why);
  }
  void done() const {
    for (const auto& [key, value] : json_.items()) {
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      const std::string shown = one_line(key, 60);
      throw std::runtime_error(path_of(shown.c_str()) + ": unknown key" + meant(key, known_));
    }
  }

 private:
  const Json& json_;
  std::string path_;
  std::vector<std::string> known_;
};

std::vector<std::string> names_of(std::span<const Named> all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.emplace_back(one.name);
  return names;
}

CameraKey read_key(const Json& json, const std::string& path) {
  Reader reader(json, path);
  CameraKey result;
  reader.read("position", result.position);
  reader.read("target", result.target);
  reader.read("up", result.up);
  reader.done();
  if (result.position == result.target) throw std::runtime_error(path + ": position and target must differ");
  if (result.up == glm::dvec3(0.0)) throw std::runtime_error(path + ": up must not be zero");
  return result;
}

std::optional<CameraKey> read_key(Reader& from, const char* key) {
  const Json* json = from.take(key);
  if (json == nullptr) return {};
  return read_key(*json, from.path_of(key));
}

std::vector<CameraKey> read_keys(Reader& from, const char* key) {
  std::vector<CameraKey> keys;
  const Json* json = from.take(key);
  if (json == nullptr) return keys;
  if (!json->is_array() || json->size() > kMaxPathKeys)
    from.refuse(key, fmt::format("needs a list of at most {} keys", kMaxPathKeys));
  for (std::size_t i = 0; i < json->size(); ++i)
    keys.push_back(read_key((*json)[i], fmt::format("{}[{}]", from.path_of(key), i)));
  return keys;
}

std::vector<SectionPlane> read_sections(Reader& from, const char* key) {
  constexpr double kMost = 1e30;
  std::vector<SectionPlane> planes;
  const Json* json = from.take(key);
  if (json == nullptr) return planes;
  if (!json->is_array() || json->size() > kMaxSections)
    from.refuse(key, fmt::format("needs a list of at most {} planes", kMaxSections));
  for (const Json& plane : *json) {
    const bool numbers =
        plane.is_array() && plane.size() == 4 && std::all_of(plane.begin(), plane.end(), [](const Json& v) {
          return v.is_number() && std::abs(v.get<double>()) <= kMost;
        });
    if (!numbers) from.refuse(key, "needs planes of four numbers");
    planes.push_back(
        {{plane[0].get<double>(), plane[1].get<double>(), plane[2].get<double>()}, plane[3].get<double>()});
  }
  return planes;
}

std::optional<render::IdentifierTest> read_identifiers(Reader& reader) {
  std::size_t of = 0;  // off
  reader.read_name("identifiers", of, identifier_names());
  int neighbours = 0;
  reader.read("identifier_neighbours", neighbours, 0, render::kMaxIdentifierNeighbours);
  return identifier_test(of, neighbours);
}

PageSetting read_pages(const Json& json, const std::string& path) {
  Reader reader(json, path);
  PageSetting pages;
  std::size_t policy = 0;  // off
  reader.read_name("policy", policy, page_policy_names());
  pages.policy = page_policy_of(page_policy_names()[policy]);
  reader.read("page_texels", pages.page_texels, kLeastPageTexels, kMaxPageTexels);
  if (pages.page_texels != 64 && pages.page_texels != 128 && pages.page_texels != 256)
    reader.refuse("page_texels", fmt::format("{} is not 64, 128 or 256", pages.page_texels));
  reader.read("capacity", pages.capacity, 1, kMaxPoolPages);
  reader.read("target_m", pages.target_m, 0.0, kMaxTargetM);
  reader.done();
  return pages;
}

Settings read_settings(const Json& json, const std::string& path) {
  Reader reader(json, path);
  Settings settings;
  if (const Json* options = reader.take("options")) {
    try {
      settings.plan = read_plan_options(options->dump());
    } catch (const CaseError& error) {
      throw std::runtime_error(path + "." + error.what());
    }
  }
  if (const Json* pages = reader.take("pages")) settings.pages = read_pages(*pages, path + ".pages");
  std::string filter;
  reader.read("filter", filter);
  if (!filter.empty()) {
    const render::ParsedFilter parsed = render::parse_filter(filter);
    if (!parsed.error.empty()) reader.refuse("filter", parsed.error);
    settings.filter = parsed.settings;
  }
  reader.read_name("transition", settings.transition, transition_names());
  settings.identifiers = read_identifiers(reader);
  reader.read_name("layer", settings.layer, layer_names());
  reader.read("linear_depth", settings.linear_depth);
  reader.read_name("map_passes", settings.map_passes, map_passes_names());
  reader.read("history", settings.history);
  reader.read("visible_depths", settings.visible_depths);
  reader.done();
  return settings;
}

constexpr double kMaxLength = 1e30;

LightState read_light(const Json& json) {
  Reader reader(json, "light");
  LightState light;
  reader.read_name("type", light.sun.kind, {"sun", "spot", "point"});
  reader.read("elevation_deg", light.sun.elevation_deg, 0.1, 90.0);
  reader.read("azimuth_deg", light.sun.azimuth_deg, -360.0, 360.0);
  reader.read("all", light.all);
  if (const Json* spot = reader.take("spot")) {
    Reader fields(*spot, "light.spot");
    light.spot.emplace();
    fields.read("position", light.spot->position);
    fields.read("direction", light.spot->direction);
    double outer_deg = 30.0;
    fields.read("outer_deg", outer_deg, 0.1, 179.9);
    light.spot->outer_radians = outer_deg / kDegrees;
    fields.read("range", light.spot->range, 0.0, kMaxLength);
    fields.done();
    if (light.spot->direction == glm::dvec3(0.0)) fields.refuse("direction", "must not be zero");
  }
  if (const Json* point = reader.take("point")) {
    Reader fields(*point, "light.point");
    light.point.emplace();
    fields.read("position", light.point->position);
    fields.read("range", light.point->range, 0.0, kMaxLength);
    fields.done();
  }
  reader.done();
  return light;
}

void read_rest(Reader& reader, State& state) {
  reader.read_name("view", state.view, names_of(view_names()));
  reader.read("map", state.map, 0, static_cast<int>(kMaxPageLevels) - 1);
  reader.read_name("comparison", state.comparison, names_of(comparison_names()));
  reader.read("b_is_truth", state.b_is_truth);
  reader.read("wipe", state.wipe, 0.0, 1.0);
  reader.read("gain", state.gain, 1.0, 64.0);
  if (const Json* drawn = reader.take("drawn")) {
    Reader fields(*drawn, "drawn");
    fields.read("frustum", state.drawn.frustum);
    fields.read("bodies", state.drawn.bodies);
    fields.read("maps", state.drawn.maps);
    fields.read("culling", state.drawn.culling);
    fields.read("casters", state.drawn.casters);
    fields.done();
  }
  if (const Json* motion = reader.take("motion")) {
    Reader fields(*motion, "motion");
    fields.read("camera", state.motion.camera);
    fields.read("sun", state.motion.sun);
    fields.read("path_seconds", state.motion.path_seconds, 1.0, 3600.0);
    fields.read("sun_degrees_per_second", state.motion.sun_degrees_per_second, -360.0, 360.0);
    fields.read("hold_sun_pixels", state.motion.hold_sun_pixels, 0.0, kMaxHoldPixels);
    fields.done();
  }
  if (const Json* playing = reader.take("playing")) {
    Reader fields(*playing, "playing");
    fields.read("animation", state.playing.animation);
    fields.read("time_s", state.playing.time_s, -1e9, 1e9);
    fields.read("on", state.playing.on);
    fields.read("speed", state.playing.speed, -100.0, 100.0);
    fields.done();
  }
}

}  // namespace

std::string state_text(const State& state) {
  Json json{{kVersionKey, kVersion}, {"scene", state.scene}, {"path_time", state.path_time}};
  if (state.panes) json["panes"] = true;
  if (state.edits.up == UpAxis::z) json["up"] = "z";
  if (state.edits.open_sky) json["open_sky"] = true;
  if (state.edits.ground) json["ground"] = true;
  for (const SectionPlane& plane : state.edits.sections)
    json["section"].push_back({plane.normal.x, plane.normal.y, plane.normal.z, plane.distance});
  if (!state.edits.proxies.empty()) json["proxies"] = state.edits.proxies;
  if (state.eye) json["eye"] = key_json(*state.eye);
  if (state.frozen) json["frozen"] = key_json(*state.frozen);
  if (state.frozen && state.frozen_sight.near_depth > 0.0) {
    json["frozen_near"] = state.frozen_sight.near_depth;
    json["frozen_far"] = state.frozen_sight.far_depth;
  }
  for (const CameraKey& key : state.path) json["path"].push_back(key_json(key));
  if (state.fov_y_deg > 0.0) json["fov_y_deg"] = state.fov_y_deg;
  if (state.height_world > 0.0) json["height_world"] = state.height_world;
  if (state.near_depth > 0.0) json["near"] = state.near_depth;
  if (state.far_depth > 0.0) json["far"] = state.far_depth;
  json["light"] = light_json(state.light);
  json["a"] = settings_json(state.a);
  json["b"] = settings_json(state.b);
  json["view"] = view_names()[static_cast<std::size_t>(state.view)].name;
  json["map"] = state.map;
  json["comparison"] = comparison_names()[static_cast<std::size_t>(state.comparison)].name;
  json["b_is_truth"] = state.b_is_truth;
  json["wipe"] = state.wipe;
  json["gain"] = state.gain;
  json["drawn"] = {{"frustum", state.drawn.frustum},
                   {"bodies", state.drawn.bodies},
                   {"maps", state.drawn.maps},
                   {"culling", state.drawn.culling},
                   {"casters", state.drawn.casters}};
  json["motion"] = {{"camera", state.motion.camera},
                    {"sun", state.motion.sun},
                    {"path_seconds", state.motion.path_seconds},
                    {"sun_degrees_per_second", state.motion.sun_degrees_per_second},
                    {"hold_sun_pixels", state.motion.hold_sun_pixels}};
  if (const Playing& playing = state.playing; !playing.animation.empty())
    json["playing"] = {{"animation", playing.animation},
                       {"time_s", playing.time_s},
                       {"on", playing.on},
                       {"speed", playing.speed}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

State read_state(std::string_view text) {
  if (text.size() > kMaxCaseBytes) throw std::runtime_error("larger than 16 MiB");
  if (nested_deeper_at(text, kMaxCaseNesting) != std::string_view::npos)
    throw std::runtime_error("brackets are nested too deep");
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {
    throw std::runtime_error(std::string("no JSON: ") + one_line(json_words(error.what()), 200));
  }
  Reader reader(json, "");
  double version = 0;
  reader.read(kVersionKey, version, kVersion, kVersion);
  if (version != kVersion) reader.refuse(kVersionKey, "is missing: this is no state of the viewer");
  State state;
  reader.read("scene", state.scene);
  reader.read("panes", state.panes);
  reader.read_name("up", state.edits.up, up_axis_names());
  reader.read("open_sky", state.edits.open_sky);
  reader.read("ground", state.edits.ground);
  state.edits.sections = read_sections(reader, "section");
  reader.read("proxies", state.edits.proxies);
  reader.read("path_time", state.path_time, 0.0, 1.0);
  state.eye = read_key(reader, "eye");
  state.frozen = read_key(reader, "frozen");
  state.path = read_keys(reader, "path");
  reader.read("fov_y_deg", state.fov_y_deg, kLeastFovDeg, kMostFovDeg);
  reader.read("height_world", state.height_world, 0.0, 1e30);
  reader.read("near", state.near_depth, 0.0, 1e30);
  reader.read("far", state.far_depth, 0.0, 1e30);
  if (state.near_depth > 0.0 && state.far_depth > 0.0 && !(state.near_depth < state.far_depth))
    reader.refuse("far", "must be above near");
  reader.read("frozen_near", state.frozen_sight.near_depth, 0.0, 1e30);
  reader.read("frozen_far", state.frozen_sight.far_depth, 0.0, 1e30);
  if (state.frozen_sight.near_depth > 0.0 && !(state.frozen_sight.near_depth < state.frozen_sight.far_depth))
    reader.refuse("frozen_far", "must be above frozen_near");
  if (const Json* light = reader.take("light")) state.light = read_light(*light);
  if (const Json* a = reader.take("a")) state.a = read_settings(*a, "a");
  if (const Json* b = reader.take("b")) state.b = read_settings(*b, "b");
  read_rest(reader, state);
  reader.done();
  return state;
}

State load_state(const std::string& file) {
  try {
    std::string text;
    const std::string why = read_bounded_file(file, kMaxCaseBytes, Readable::file_or_pipe, text);
    if (!why.empty()) throw std::runtime_error(why);
    return read_state(text);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(shown_name(file) + ": " + error.what());
  }
}

std::string unspoken_options(const PlanOptions& options) {
  const Json now = plan_options_json(options), none = plan_options_json({});
  Json json = structured_options(options);
  for (const auto& [key, value] : now.items()) {
    if (!is_spoken(key) && !key.starts_with("filter_radius") && value != none[key]) json[key] = value;
  }
  return json.empty() ? std::string() : json.dump();
}

}  // namespace gnomon::tool::view
