// Entries of others for a sweep: a capture of an engine's maps, or a folder of masks.
#include "entry_file.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/bounded_file.hpp"
#include "base/json_scan.hpp"
#include "base/json_words.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "judge/judge.hpp"
#include "mask_file.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "gnomon-masks/1";

[[noreturn]] void refuse_entry(const std::string& where, const std::string& why) {
  throw std::runtime_error(where + ": " + why);
}

/// A left-handed world with its z turned round, and each map with its x, so that faces keep their winding.
void make_right_handed(judge::Capture& capture) {
  if (capture.clip_space.handedness == Handedness::right) return;
  capture.clip_space.handedness = Handedness::right;
  glm::dmat4 turn_x(1.0), turn_z(1.0);
  turn_x[0][0] = turn_z[2][2] = -1.0;
  for (judge::CapturedFrame& frame : capture.frames) {
    Camera& camera = frame.camera;
    for (glm::dvec3* const v : {&camera.position, &camera.forward, &camera.up}) v->z = -v->z;
    for (Light& light : frame.lights)
      if (auto* const sun = std::get_if<DirectionalLight>(&light)) sun->direction.z = -sun->direction.z;
    for (judge::CapturedMap& map : frame.maps) map.clip_from_world = turn_x * map.clip_from_world * turn_z;
  }
}

bool is_near(const glm::dvec3& a, const glm::dvec3& b, double most) noexcept {
  return glm::length(a - b) <= most;
}

double real_of(const Json& json, const char* key, double least, double most) {
  const Json& value = json.at(key);
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= least && number <= most)) throw std::runtime_error(std::string(key) + " is out of range");
  return number;
}

GivenMasks::Frame frame_from(const std::string& line) {
  constexpr int kDepth = 8;
  if (nested_deeper_at(line, kDepth) != std::string_view::npos)
    throw std::runtime_error("nested deeper than " + std::to_string(kDepth) + " levels");
  const Json json = Json::parse(line);
  if (json.at("format") != kFormat)
    throw std::runtime_error("format: must be \"" + std::string(kFormat) + "\"");
  constexpr double kMostFrames = 1e6, kMostMs = 1e9;
  GivenMasks::Frame frame;
  frame.scene = json.at("scene");
  frame.light = json.value("light", std::string("sun"));
  frame.camera = json.value("camera", std::string());
  frame.animation = json.value("animation", std::string());
  frame.light_elevation_deg = real_of(json, "light_elevation_deg", -360.0, 360.0);
  frame.light_azimuth_deg = real_of(json, "light_azimuth_deg", -720.0, 720.0);
  frame.frame = static_cast<int>(real_of(json, "frame", 0.0, kMostFrames));
  frame.frames = static_cast<int>(real_of(json, "frames", 1.0, kMostFrames));
  frame.mask = json.at("mask");
  frame.before = json.value("mask_before", std::string());
  frame.moved = json.value("mask_moved", std::string());
  if (!json.contains("ms")) return frame;
  const Json& ms = json["ms"];
  if (ms.is_object()) {
    frame.ms = real_of(ms, "median", 0.0, kMostMs);
    frame.ms_low = real_of(ms, "low", 0.0, frame.ms);
    frame.ms_high = real_of(ms, "high", frame.ms, kMostMs);
  } else {
    frame.ms = frame.ms_low = frame.ms_high = real_of(json, "ms", 0.0, kMostMs);
  }
  return frame;
}

Json matrix_json(const glm::dmat4& matrix) {
  Json list = Json::array();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) list.push_back(matrix[column][row]);
  return list;
}

/// One box around all of them; absent for none.
void add_bounds(Json& json, const char* key, const Boxes& boxes) {
  Box all;
  for (const Box& box : boxes.list()) all.extend(box);
  if (!all.empty())
    json[key] = {{"min", {all.min.x, all.min.y, all.min.z}}, {"max", {all.max.x, all.max.y, all.max.z}}};
}

Json camera_json(const Camera& camera) {
  return {{"view_from_world", matrix_json(view_from_world(camera))},
          {"clip_from_view", matrix_json(clip_from_view(camera))}};
}

}  // namespace

const CapturedMaps::Frame* CapturedMaps::at(const Camera& camera) const noexcept {
  constexpr double kAngle = 1e-5;  // a hundredth of a pixel in 1000
  const auto same = [&](const Frame& frame) {
    const Camera& other = frame.camera;
    const CameraAxes a = camera_axes(camera), b = camera_axes(other);
    const double close = 1e-3 * std::min(camera.near_depth, other.near_depth);
    return camera.orthographic == other.orthographic && is_near(camera.position, other.position, close) &&
           is_near(a.forward, b.forward, kAngle) && is_near(a.up, b.up, kAngle) &&
           std::abs(camera.left - other.left) <= kAngle && std::abs(camera.right - other.right) <= kAngle &&
           std::abs(camera.bottom - other.bottom) <= kAngle && std::abs(camera.top - other.top) <= kAngle;
  };
  const auto found = std::find_if(frames.begin(), frames.end(), same);
  return found == frames.end() ? nullptr : &*found;
}

bool is_entry_name(const std::string& name) noexcept {
  constexpr std::size_t kLongest = 60;
  return !name.empty() && name.size() <= kLongest &&
         std::none_of(name.begin(), name.end(),
                      [](unsigned char c) { return c < ' ' || c == 0x7f || c == '/' || c == '|'; });
}

EntryWord entry_word(const std::string& option, const std::string& word) {
  const std::size_t equals = word.find('=');
  const EntryWord entry{word.substr(0, equals), equals == std::string::npos ? "" : word.substr(equals + 1)};
  if (entry.path.empty() || !is_entry_name(entry.name))
    refuse_entry(option + " " + one_line(word, 80),
                 "wants NAME=PATH, with a name of at most 60 characters other than / and |");
  return entry;
}

std::shared_ptr<const CapturedMaps> load_captured_maps(const std::filesystem::path& file) {
  judge::Capture capture = judge::load_capture(file);
  make_right_handed(capture);
  const auto maps = std::make_shared<CapturedMaps>();
  for (std::size_t i = 0; i < capture.frames.size(); ++i) {
    const judge::CapturedFrame& frame = capture.frames[i];
    const std::string where = file.string() + ": frames[" + std::to_string(i) + "]";
    const auto* const sun =
        frame.lights.size() == 1 ? std::get_if<DirectionalLight>(&frame.lights.front()) : nullptr;
    if (sun == nullptr) refuse_entry(where, "has another light than one sun");
    if (frame.maps.empty()) refuse_entry(where, "has no maps");
    const glm::dvec3 direction = glm::normalize(sun->direction);
    constexpr double kAngle = 1e-5;
    if (i > 0 && !is_near(direction, maps->light_direction, kAngle)) refuse_entry(where, "its sun moves");
    maps->light_direction = direction;
    maps->frames.push_back({frame.camera, judge::plan_of(capture, frame, 0)});
  }
  return maps;
}

std::shared_ptr<const GivenMasks> load_given_masks(const std::filesystem::path& folder) {
  constexpr std::uint64_t kMaxBytes = 64u << 20;
  const std::filesystem::path file = folder / kMasksFile;
  std::string text;
  if (const std::string why = read_bounded_file(file, kMaxBytes, Readable::regular_file, text); !why.empty())
    refuse_entry(file.string(), why);
  const auto given = std::make_shared<GivenMasks>();
  given->folder = folder;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    if (line.empty()) continue;
    try {
      given->frames.push_back(frame_from(line));
    } catch (const Json::exception& error) {
      refuse_entry(file.string() + ":" + std::to_string(number), json_words(error.what()));
    } catch (const std::runtime_error& error) {
      refuse_entry(file.string() + ":" + std::to_string(number), error.what());
    }
  }
  if (given->frames.empty()) refuse_entry(file.string(), "lists no frame");
  return given;
}

const GivenMasks::Frame* masks_of(const GivenMasks& given, const report::Row& row) noexcept {
  const auto is_of = [&row](const GivenMasks::Frame& f) {
    return f.scene == row.scene && f.light == row.light && f.camera == row.camera &&
           f.animation == row.animation && f.light_elevation_deg == row.light_elevation_deg &&
           f.light_azimuth_deg == row.light_azimuth_deg && f.frame == row.frame && f.frames == row.frames;
  };
  const auto found = std::find_if(given.frames.rbegin(), given.frames.rend(), is_of);
  return found == given.frames.rend() ? nullptr : &*found;
}

FrameMasks read_masks(const GivenMasks& given, const GivenMasks::Frame& frame, int width, int height) {
  FrameMasks masks;
  masks.mask = read_mask(given.folder, frame.mask, width, height);
  if (!frame.before.empty()) masks.before = read_mask(given.folder, frame.before, width, height);
  if (!frame.moved.empty()) masks.moved = read_mask(given.folder, frame.moved, width, height);
  return masks;
}

void write_masks(const std::filesystem::path& folder, const report::Row& row, const MaskedView& view,
                 const FrameMasks& masks) {
  make_folder("--out", folder);
  // By its place in the whole sweep: no two rows share it.
  const std::string stem = std::to_string(row.index);
  Json json{{"format", kFormat}, {"technique", row.technique.name()}};
  // The view as rows have it.
  const Json of_row = Json::parse(report::to_json_line(row));
  for (const char* key : {"scene", "frame", "frames", "width", "height", "light", "light_elevation_deg",
                          "light_azimuth_deg", "camera", "animation", "animation_time_s"})
    if (of_row.contains(key)) json[key] = of_row[key];
  json["view"] = camera_json(view.camera);
  json["view_before"] = camera_json(view.before);
  if (const auto* const sun = std::get_if<DirectionalLight>(&view.light)) {
    json["light_direction"] = {sun->direction.x, sun->direction.y, sun->direction.z};
  } else {
    const auto* const spot = std::get_if<SpotLight>(&view.light);
    const glm::dvec3 at = spot != nullptr ? spot->position : std::get<PointLight>(view.light).position;
    json["light_position"] = {at.x, at.y, at.z};
  }
  add_bounds(json, "casters", view.bounds.casters);
  add_bounds(json, "receivers", view.bounds.receivers);
  const auto write = [&](const char* key, const std::string& name, const std::vector<float>& values) {
    if (values.empty()) return;
    write_mask(folder / name, values, row.width, row.height);
    json[key] = name;
  };
  write("mask", stem + ".pfm", masks.mask);
  write("mask_before", stem + "_before.pfm", masks.before);
  write("mask_moved", stem + "_moved.pfm", masks.moved);
  const report::Estimate& ms = row.times.total_ms;
  if (ms.median > 0.0) json["ms"] = {{"median", ms.median}, {"low", ms.low}, {"high", ms.high}};
  std::ofstream list(folder / kMasksFile, std::ios::app);
  list << json.dump(-1, ' ', false, Json::error_handler_t::replace) << "\n";
  list.close();
  if (!list) throw std::runtime_error((folder / kMasksFile).string() + ": cannot be written");
}

}  // namespace gnomon::tool
