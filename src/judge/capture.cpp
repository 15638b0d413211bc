// The capture format: which keys there are, and what they become.
#include "judge/capture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bounded_file.hpp"
#include "json_fields.hpp"
#include "json_text.hpp"
#include "judge/capture_scene.hpp"
#include "judge/json_place.hpp"
#include "shared_fields.hpp"

namespace gnomon::judge {
namespace {

using nlohmann::json;

constexpr std::string_view kFormat = "gnomon-capture/1";
constexpr std::size_t kMostFrames = 4096, kMostLights = 64;
constexpr std::size_t kMostThings = 4'000'000;

/// Keys of the file, and those of a frame, which stand beside them for all frames.
constexpr std::array<std::string_view, 8> kFileKeys{
    "format", "name", "engine", "clip_space", "camera_clip_space", "matrices", "atlas", "frames"};
constexpr std::array<std::string_view, 9> kFrameKeys{
    "camera", "lights", "maps", "selection", "receivers", "casters", "points", "depth_picture", "bias"};
constexpr std::array<std::string_view, 4> kSceneKeys{"receivers", "casters", "points", "depth_picture"};

/// Whether the key has the first of two words; false where it is absent.
bool flag(const Fields& fields, std::string_view key, std::string_view yes, std::string_view no) {
  bool is = false;
  read_name(fields, key, is, (std::string(yes) + ", " + std::string(no)).c_str(),
            [&](std::string_view word, bool& out) {
              out = word == yes;
              return word == yes || word == no;
            });
  return is;
}

/// What all frames of a file share.
struct Convention {
  ClipSpace camera;
  bool rows_first = false;  // matrices are written row by row
};

glm::dmat4 matrix_from(const Fields& fields, std::string_view key, const Convention& convention) {
  const std::vector<double> numbers = fields.numbers(key);
  if (numbers.size() != 16) fields.refuse(key, "needs 16 numbers");
  glm::dmat4 m{};
  for (int i = 0; i < 16; ++i) {
    const double value = numbers[static_cast<std::size_t>(i)];
    if (!(std::abs(value) <= kLargestNumber)) fields.refuse(key, "has an entry beyond 1e30");
    (convention.rows_first ? m[i % 4][i / 4] : m[i / 4][i % 4]) = value;
  }
  return m;
}

Camera camera_of(const json& value, const std::string& path, const Convention& convention) {
  const Fields fields(value, path, {"view_from_world", "clip_from_view", "width", "height"});
  const CameraFrom from = camera_from(matrix_from(fields, "view_from_world", convention),
                                      matrix_from(fields, "clip_from_view", convention), convention.camera,
                                      size_from(fields, "width"), size_from(fields, "height"));
  if (from.error != CameraError::none) throw CaseError(path + ": " + std::string(to_string(from.error)));
  return from.camera;
}

Light light_of(const json& value, const std::string& path) {
  Light light = light_from(value, path);
  // Of any length, also one whose square is no number.
  const auto scaled = [&](glm::dvec3& direction) {
    const double largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (!(largest > 0.0)) throw CaseError(path + ".direction: must not be zero");
    direction /= largest;
  };
  const auto positive = [&](double range) {
    if (!(range > 0.0)) throw CaseError(path + ".range: must be above 0");
  };
  if (auto* sun = std::get_if<DirectionalLight>(&light)) scaled(sun->direction);
  if (auto* bulb = std::get_if<PointLight>(&light)) positive(bulb->range);
  if (auto* spot = std::get_if<SpotLight>(&light)) {
    scaled(spot->direction);
    positive(spot->range);
  }
  return light;
}

CapturedBias bias_of(const json& value, const std::string& path) {
  const Fields fields(value, path,
                      {"depth", "slope_factor", "world", "texels", "slope_texels", "normal_world",
                       "normal_texels", "follows_plane"});
  CapturedBias bias;
  fields.read("depth", bias.depth);
  if (!(std::abs(bias.depth) <= 1.0)) fields.refuse("depth", "must lie in -1..1, shares of the map's depths");
  fields.read("slope_factor", bias.slope_factor);
  fields.read("world", bias.world);
  fields.read("texels", bias.texels);
  fields.read("slope_texels", bias.slope_texels);
  fields.read("normal_world", bias.normal_world);
  fields.read("normal_texels", bias.normal_texels);
  fields.read("follows_plane", bias.follows_plane);
  return bias;
}

void read_depths(const Fields& fields, CapturedMap& map) {
  if (!fields.has("depths")) return;
  const std::vector<double> depths = fields.numbers("depths");
  if (depths.size() != 2 || !(depths[0] < depths[1]))
    fields.refuse("depths", "needs two view depths, the nearer first");
  map.begin = depths[0];
  map.end = depths[1];
}

TexelRect rectangle_of(const Fields& fields, std::string_view key) {
  const std::vector<double> n = fields.numbers(key);
  const bool whole = n.size() == 4 && std::all_of(n.begin(), n.end(), [](double v) {
                       return v == std::floor(v) && v >= 0.0 && v <= kLargestMap;
                     });
  if (!whole || n[2] < 1.0 || n[3] < 1.0)
    fields.refuse(key, "needs x, y, width, height: whole numbers of texels");
  return {static_cast<int>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]), static_cast<int>(n[3])};
}

CapturedMap map_of(const json& value, const std::string& path, const Convention& convention,
                   const std::optional<CapturedBias>& bias) {
  const Fields fields(value, path,
                      {"clip_from_world", "light", "width", "height", "atlas", "depths", "overlap",
                       "depth_bits", "filter_texels", "clamps_depth", "stores", "bias"});
  CapturedMap map;
  map.path = path;
  map.clip_from_world = matrix_from(fields, "clip_from_world", convention);
  if (!(std::abs(glm::determinant(map.clip_from_world)) > 0.0))
    fields.refuse("clip_from_world", "is singular");
  fields.read("light", map.light);
  map.width = size_from(fields, "width");
  map.height = size_from(fields, "height");
  if (fields.has("atlas")) map.atlas = rectangle_of(fields, "atlas");
  read_depths(fields, map);
  fields.read("overlap", map.overlap);
  if (!(map.overlap >= 0.0)) fields.refuse("overlap", "must not be below 0");
  fields.read("depth_bits", map.depth_bits);
  constexpr std::array kBits{0, 16, 24, 32};
  if (std::find(kBits.begin(), kBits.end(), map.depth_bits) == kBits.end())
    fields.refuse("depth_bits", "must be 16, 24 or 32, or 0 for single precision");
  fields.read("filter_texels", map.filter_texels);
  if (!(map.filter_texels >= 0.0 && map.filter_texels <= kLargestMap))
    fields.refuse("filter_texels", "must lie in 0..65536");
  fields.read("clamps_depth", map.clamps_depth);
  map.stores_back = flag(fields, "stores", "back", "front");
  map.bias = fields.has("bias") ? bias_of(fields.at("bias"), path + ".bias") : bias;
  return map;
}

void read_maps(const Fields& fields, const Convention& convention, CapturedFrame& frame) {
  const json& list = fields.at("maps");
  const std::string path = fields.path_of("maps");
  if (!list.is_array() || list.empty()) fields.refuse("maps", "needs a list of maps");
  std::optional<CapturedBias> bias;
  if (fields.has("bias")) bias = bias_of(fields.at("bias"), fields.path_of("bias"));
  std::vector<std::size_t> of_light(frame.lights.size(), 0);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const CapturedMap map = map_of(list[i], element_path(path, i), convention, bias);
    if (map.light < 0 || static_cast<std::size_t>(map.light) >= frame.lights.size())
      throw CaseError(map.path + ".light: there is no light " + std::to_string(map.light));
    if (++of_light[static_cast<std::size_t>(map.light)] > kMostMapsOfLight)
      throw CaseError(map.path + ".light: has more than " + std::to_string(kMostMapsOfLight) + " maps");
    frame.maps.push_back(map);
  }
}

/// Of each light by itself: a sun's cascades may have depths where a spot's map has none.
void read_selection(const Fields& fields, CapturedFrame& frame) {
  MapSelection said = MapSelection::view_depth;
  read_name(fields, "selection", said, "view_depth, first_holding, finest",
            [](std::string_view name, MapSelection& selection) {
              if (name == "first_holding") selection = MapSelection::first_holding;
              return name == "first_holding" || map_selection_from_name(name, selection);
            });
  frame.selection.assign(frame.lights.size(), said);
  if (said != MapSelection::view_depth) return;
  for (std::size_t light = 0; light < frame.lights.size(); ++light) {
    std::size_t maps = 0, with_depths = 0;
    const CapturedMap* without = nullptr;
    for (const CapturedMap& map : frame.maps) {
      if (map.light != static_cast<int>(light)) continue;
      ++maps;
      with_depths += std::isfinite(map.begin) ? 1 : 0;
      if (!std::isfinite(map.begin)) without = &map;
    }
    if (with_depths == 0) frame.selection[light] = MapSelection::first_holding;
    if (with_depths > 0 && with_depths < maps)
      throw CaseError(without->path + ".depths: is missing, and other maps of its light have it");
  }
}

CapturedFrame frame_of(const json& value, const std::string& path, const Convention& convention) {
  const Fields fields(value, path, kFrameKeys);
  CapturedFrame frame;
  frame.camera = camera_of(fields.at("camera"), fields.path_of("camera"), convention);
  const json& lights = fields.at("lights");
  if (!lights.is_array() || lights.empty() || lights.size() > kMostLights)
    fields.refuse("lights", "needs a list of 1 to 64 lights");
  for (std::size_t i = 0; i < lights.size(); ++i)
    frame.lights.push_back(light_of(lights[i], element_path(fields.path_of("lights"), i)));
  read_maps(fields, convention, frame);
  read_selection(fields, frame);
  return frame;
}

/// The message with the line that it is about before it, where the text has lines.
std::string with_line(std::string_view text, const std::string& message) {
  if (text.find('\n') == std::string_view::npos || message.starts_with("line ")) return message;
  const std::string_view path = std::string_view(message).substr(0, message.find(": "));
  std::size_t found = 0, found_shared = 0;
  std::size_t line = line_of(text, path, found);
  // What all frames share stands beside them.
  const std::size_t rest = path.starts_with("frames[") ? path.find("].") : std::string_view::npos;
  if (rest != std::string_view::npos) {
    const std::size_t shared = line_of(text, path.substr(rest + 2), found_shared);
    if (found_shared > 0 && found <= 2) {
      line = shared;
      found = found_shared;
    }
  }
  return found == 0 ? message : "line " + std::to_string(line) + ", " + message;
}

}  // namespace

Capture read_capture(std::string_view json_text) {
  const json value = parse_json(json_text);
  if (!value.is_object()) throw CaseError("capture: needs an object, is " + std::string(value.type_name()));
  std::vector<std::string_view> known(kFileKeys.begin(), kFileKeys.end());
  known.insert(known.end(), kFrameKeys.begin(), kFrameKeys.end());
  const Fields fields(value, "", known);
  if (fields.text("format") != kFormat)
    fields.refuse("format",
                  "is \"" + one_line(fields.text("format"), 40) + "\", not " + std::string(kFormat));
  Capture capture;
  if (fields.has("name")) capture.name = fields.text("name");
  if (fields.has("engine")) capture.engine = fields.text("engine");
  Convention convention;
  if (fields.has("clip_space")) capture.clip_space = clip_space_from(fields.at("clip_space"), "clip_space");
  convention.camera = capture.clip_space;
  if (fields.has("camera_clip_space"))
    convention.camera = clip_space_from(fields.at("camera_clip_space"), "camera_clip_space");
  capture.camera_clip_space = convention.camera;
  convention.rows_first = flag(fields, "matrices", "row_major", "column_major");
  if (fields.has("atlas")) {
    const std::vector<double> size = fields.numbers("atlas");
    if (size.size() != 2 || !(size[0] >= 1.0 && size[1] >= 1.0 && std::max(size[0], size[1]) <= 1e6))
      fields.refuse("atlas", "needs width and height, texels");
    capture.atlas_width = static_cast<int>(size[0]);
    capture.atlas_height = static_cast<int>(size[1]);
  }
  json shared = json::object();
  for (const std::string_view key : kFrameKeys) {
    if (fields.has(key)) shared[std::string(key)] = fields.at(key);
  }
  capture.scenes.push_back(scene_of(fields));
  if (!fields.has("frames")) {
    capture.frames.push_back(frame_of(shared, "", convention));
    read_depth_picture(fields, capture.frames.back().camera, capture.scenes.back());
    return capture;
  }
  if (fields.has("depth_picture")) fields.refuse("depth_picture", "stands beside frames: each has its own");
  const json& list = fields.at("frames");
  if (!list.is_array() || list.empty() || list.size() > kMostFrames)
    fields.refuse("frames", "needs a list of 1 to 4096 frames");
  std::size_t things = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string path = element_path("frames", i);
    if (!list[i].is_object()) throw CaseError(path + ": needs an object");
    json frame = list[i];
    const bool own_scene = std::any_of(kSceneKeys.begin(), kSceneKeys.end(),
                                       [&](std::string_view key) { return frame.contains(key); });
    for (const auto& [key, common] : shared.items()) {
      const bool of_scene = std::find(kSceneKeys.begin(), kSceneKeys.end(), key) != kSceneKeys.end();
      if (!frame.contains(key) && (own_scene || !of_scene)) frame[key] = common;
    }
    capture.frames.push_back(frame_of(frame, path, convention));
    if (!own_scene) continue;
    capture.frames.back().scene = capture.scenes.size();
    const Fields frame_fields(frame, path, kFrameKeys);
    capture.scenes.push_back(scene_of(frame_fields));
    read_depth_picture(frame_fields, capture.frames.back().camera, capture.scenes.back());
    const CapturedScene& scene = capture.scenes.back();
    things += scene.receivers.size() + scene.casters.size() + scene.points.size();
    if (things > kMostThings)
      throw CaseError(path + ": boxes and points of all frames are more than 4 million");
  }
  return capture;
}

Capture load_capture(const std::filesystem::path& file) {
  std::string text;
  try {
    const std::string why = read_bounded_file(file, kMaxCaseBytes, Readable::file_or_pipe, text);
    if (!why.empty()) throw CaseError(why);
    return read_capture(text);
  } catch (const CaseError& error) {
    throw CaseError(shown_name(file) + ": " + with_line(text, error.what()));
  }
}

}  // namespace gnomon::judge
