// A camera flight as a JSON file: written and read back to the same numbers.
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/bounded_file.hpp"
#include "base/json_words.hpp"
#include "base/whole_file.hpp"
#include "glb.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/load.hpp"
#include "load_memory.hpp"
#include "refusal.hpp"

namespace gnomon {

namespace {

using detail::element;
using detail::Refusal;
using nlohmann::json;

constexpr std::uint64_t kFileBytes = 16u << 20;  // a key takes about 100 bytes; no flight has 100 thousand
constexpr double kLargest = 1e30;                // as make_plan takes it; squares of larger ones overflow
constexpr double kDegree = std::numbers::pi / 180.0;

void refuse_unknown(const json& object, const std::string& where, std::initializer_list<const char*> known) {
  if (!object.is_object()) throw Refusal(where, "must be an object");
  for (const auto& [key, value] : object.items()) {
    bool found = false;
    for (const char* name : known) found = found || key == name;
    if (!found) throw Refusal(where, "unknown key '" + detail::one_line(key) + "'");
  }
}

bool is_number(const json& value) {
  return value.is_number() && std::abs(value.get<double>()) <= kLargest;
}

double number(const json& object, const char* key, double otherwise) {
  const auto it = object.find(key);
  if (it == object.end()) return otherwise;
  if (!is_number(*it)) throw Refusal(key, "must be a number up to 1e30");
  return it->get<double>();
}

glm::dvec3 point(const json& object, const char* key, const std::string& where) {
  const auto it = object.find(key);
  if (it == object.end()) throw Refusal(where, std::string("has no ") + key);
  if (!it->is_array() || it->size() != 3) throw Refusal(where + "." + key, "must be three numbers");
  glm::dvec3 out(0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    const json& value = (*it)[c];
    if (!is_number(value)) throw Refusal(where + "." + key, "must be three numbers up to 1e30");
    out[static_cast<int>(c)] = value.get<double>();
  }
  return out;
}

CameraPath parse(const json& source) {
  refuse_unknown(source, "path", {"keys", "closed", "fov_y_deg", "height_world", "near", "far"});
  CameraPath path;
  const auto keys = source.find("keys");
  if (keys == source.end() || !keys->is_array() || keys->empty())
    throw Refusal("keys", "must be a list of keys");
  for (std::size_t i = 0; i < keys->size(); ++i) {
    const std::string where = element("keys", i);
    refuse_unknown((*keys)[i], where, {"position", "target", "up"});
    CameraKey key{point((*keys)[i], "position", where), point((*keys)[i], "target", where)};
    if (key.position == key.target) throw Refusal(where, "target is the position");
    if ((*keys)[i].contains("up")) key.up = point((*keys)[i], "up", where);
    if (key.up == glm::dvec3(0.0)) throw Refusal(where + ".up", "must not be zero");
    path.keys.push_back(key);
  }
  if (const auto closed = source.find("closed"); closed != source.end()) {
    if (!closed->is_boolean()) throw Refusal("closed", "must be true or false");
    path.closed = closed->get<bool>();
  }
  const double fov_deg = number(source, "fov_y_deg", path.fov_y_radians / kDegree);
  if (!(fov_deg > 0.0 && fov_deg < 180.0)) throw Refusal("fov_y_deg", "must lie between 0 and 180");
  path.fov_y_radians = fov_deg * kDegree;
  if (source.contains("height_world")) {
    if (source.contains("fov_y_deg")) throw Refusal("height_world", "is given beside fov_y_deg");
    path.height_world = number(source, "height_world", 0.0);
    if (!(path.height_world > 0.0)) throw Refusal("height_world", "must be above 0");
  }
  path.near_depth = number(source, "near", path.near_depth);
  path.far_depth = number(source, "far", path.far_depth);
  if (!(path.near_depth > 0.0)) throw Refusal("near", "must be above 0");
  if (!(path.far_depth > path.near_depth)) throw Refusal("far", "must be above near");
  return path;
}

json to_json(const glm::dvec3& v) {
  return json::array({v.x, v.y, v.z});
}

}  // namespace

namespace detail {

CameraPath camera_path_from_text(std::string_view text, const std::string& path_in_errors) {
  try {
    check_json_size(text);
    return parse(json::parse(text));
  } catch (const Refusal& e) {
    throw SceneError(one_line(path_in_errors + ": " + e.what()));
  } catch (const std::exception& e) {
    throw SceneError(one_line(path_in_errors + ": file: " + json_words(e.what())));
  }
}

}  // namespace detail

CameraPath load_camera_path(const std::filesystem::path& file) {
  std::string text;
  const std::string why = read_bounded_file(file, kFileBytes, Readable::file_or_pipe, text);
  if (!why.empty()) throw SceneError(detail::one_line(file.string() + ": file: " + why));
  return detail::camera_path_from_text(text, file.string());
}

void save_camera_path(const CameraPath& path, const std::filesystem::path& file) {
  json keys = json::array();
  for (const CameraKey& key : path.keys) {
    keys.push_back({{"position", to_json(key.position)}, {"target", to_json(key.target)}});
    if (key.up != CameraKey().up) keys.back()["up"] = to_json(key.up);
  }
  json out = {{"keys", keys}, {"closed", path.closed}, {"near", path.near_depth}, {"far", path.far_depth}};
  if (path.height_world > 0.0)
    out["height_world"] = path.height_world;
  else
    out["fov_y_deg"] = path.fov_y_radians / kDegree;
  const std::string why = write_whole_file(file, out.dump(1) + "\n");
  if (!why.empty()) throw SceneError(detail::one_line(file.string() + ": file: cannot be written: " + why));
}

}  // namespace gnomon
