// How do files have lights, clip spaces and points of surfaces? Cases and captures have them alike.
#include "shared_fields.hpp"

#include <numbers>

namespace gnomon {
namespace {

using nlohmann::json;

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

}  // namespace

std::string element_path(const std::string& path, std::size_t index) {
  return path + "[" + std::to_string(index) + "]";
}

double half_open_degrees(const Fields& fields, std::string_view key) {
  const double degrees = fields.number(key);
  if (!(degrees > 0.0 && degrees < 180.0)) fields.refuse(key, "must be between 0 and 180");
  return degrees * (std::numbers::pi / 180.0);
}

Light light_from(const json& value, const std::string& path, const std::vector<std::string_view>& more) {
  const auto keys = [&](std::vector<std::string_view> known) {
    known.insert(known.end(), more.begin(), more.end());
    return known;
  };
  // The type decides which keys are known.
  const Fields any(value, path, keys({"type", "direction", "position", "outer_deg", "range"}));
  const std::string type = any.text("type");
  if (type == "directional") {
    const Fields fields(value, path, keys({"type", "direction"}));
    return DirectionalLight{fields.vector("direction")};
  }
  if (type == "spot") {
    return SpotLight{any.vector("position"), any.vector("direction"), half_open_degrees(any, "outer_deg"),
                     any.number("range")};
  }
  if (type == "point") {
    const Fields fields(value, path, keys({"type", "position", "range"}));
    return PointLight{fields.vector("position"), fields.number("range")};
  }
  any.refuse("type", "is \"" + one_line(type, 40) + "\", not one of directional, spot, point");
}

ClipSpace clip_space_from(const json& value, const std::string& path) {
  const Fields fields(value, path, {"ndc_depth", "reversed_z", "y_down", "handedness", "first_row"});
  ClipSpace clip_space;
  read_name(fields, "ndc_depth", clip_space.ndc_depth, "minus_one_to_one, zero_to_one", ndc_depth_from_name);
  fields.read("reversed_z", clip_space.reversed_z);
  fields.read("y_down", clip_space.y_down);
  read_name(fields, "handedness", clip_space.handedness, "right, left", handedness_from_name);
  read_name(fields, "first_row", clip_space.first_row, "y_minus_one, y_plus_one", first_row_from_name);
  return clip_space;
}

ListedPoints points_from(const Fields& fields, std::string_view key) {
  const json& list = fields.at(key);
  if (!list.is_array()) fields.refuse(key, "needs a list of points");
  ListedPoints listed;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string path = element_path(fields.path_of(key), i);
    const json& point = list[i];
    const bool with_normal = point.is_array() && point.size() == 6;
    if (!with_normal && !(point.is_array() && point.size() == 3))
      throw CaseError(path + ": needs three numbers, or six with the normal");
    if (i > 0 && with_normal == listed.normals.empty())
      throw CaseError(path + ": has " + (with_normal ? "a" : "no") + " normal, unlike the points before");
    glm::dvec3 parts[2]{};
    for (std::size_t k = 0; k < point.size(); ++k)
      parts[k / 3][static_cast<int>(k % 3)] = finite_number(point[k], element_path(path, k));
    listed.points.push_back(parts[0]);
    if (with_normal) listed.normals.push_back(parts[1]);
  }
  return listed;
}

}  // namespace gnomon
