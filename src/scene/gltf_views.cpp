// Which lights and cameras does a glTF document have, and which nodes hold them?
// Based on: Khronos Group, KHR_lights_punctual; glTF 2.0 Specification (2021), section 3.10 "Cameras".
#include "gltf_views.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "gltf_check.hpp"
#include "gltf_nodes.hpp"
#include "gnomon/scene/default_light.hpp"
#include "refusal.hpp"

namespace gnomon::detail {
namespace {

using nlohmann::json;

/// A number of `owner`, or `otherwise` where it has none. Throws LeftOut for what is no number within the
/// ends.
double number_in(const json& owner, const char* key, double otherwise, double least, double most) {
  const auto found = owner.find(key);
  if (found == owner.end()) return otherwise;
  if (!found->is_number()) throw LeftOut(std::string(key) + " is no number");
  const double value = found->get<double>();
  if (!(value >= least && value <= most)) throw LeftOut(std::string(key) + " is out of range");
  return value;
}

/// Empty where it has none.
std::string name_of(const json& owner) {
  const auto found = owner.find("name");
  return found != owner.end() && found->is_string() ? one_line(found->get_ref<const std::string&>()) : "";
}

constexpr double kLargest = 1e30;

/// Three numbers from 0 on; white where there are none.
glm::vec3 color_in(const json& light) {
  const auto found = light.find("color");
  if (found == light.end()) return glm::vec3(1.0f);
  if (!found->is_array() || found->size() != 3) throw LeftOut("color is not three numbers");
  glm::vec3 color;
  for (std::size_t c = 0; c < 3; ++c) {
    const json& value = (*found)[c];
    const std::string where = element("color", c);
    if (!value.is_number()) throw LeftOut(where + " is no number");
    if (!(value.get<double>() >= 0.0 && value.get<double>() <= kLargest))
      throw LeftOut(where + " is out of range");
    color[static_cast<int>(c)] = value.get<float>();
  }
  return color;
}

Light shape_in(const json& light) {
  const std::string type = light.contains("type") && light["type"].is_string() ? light["type"] : json("");
  const double range = number_in(light, "range", 0.0, 0.0, kLargest);
  const json* spot = find_object(light, "spot");
  constexpr double kHalf = std::numbers::pi / 2.0;
  const double outer =
      spot == nullptr ? kHalf / 2.0 : number_in(*spot, "outerConeAngle", kHalf / 2.0, 1e-6, kHalf);
  constexpr glm::dvec3 kOrigin{0.0, 0.0, 0.0}, kAhead{0.0, 0.0, -1.0};
  if (type == "directional") return DirectionalLight{kAhead};
  if (type == "point") return PointLight{kOrigin, range};
  if (type == "spot") return SpotLight{kOrigin, kAhead, outer, range};
  throw LeftOut("has no type that is known");
}

SceneLight light_in(const json& light) {
  return {name_of(light), shape_in(light), color_in(light),
          number_in(light, "intensity", 1.0, 0.0, kLargest)};
}

SceneCamera camera_in(const json& camera) {
  SceneCamera out;
  out.name = name_of(camera);
  const json* perspective = find_object(camera, "perspective");
  const json* parallel = find_object(camera, "orthographic");
  if (perspective == nullptr && parallel == nullptr) throw LeftOut("is neither perspective nor orthographic");
  const json& of = perspective != nullptr ? *perspective : *parallel;
  out.orthographic = perspective == nullptr;
  const double least = out.orthographic ? 0.0 : 1e-12;
  out.near_depth = number_in(of, "znear", -1.0, least, kLargest);
  if (out.near_depth < 0.0) throw LeftOut("has no znear");
  out.far_depth = number_in(of, "zfar", std::numeric_limits<double>::infinity(), least, kLargest);
  if (!(out.near_depth < out.far_depth)) throw LeftOut("zfar is not above znear");
  if (out.orthographic) {
    out.height_world = 2.0 * std::abs(number_in(of, "ymag", 0.0, -kLargest, kLargest));
    if (!(out.height_world > 0.0)) throw LeftOut("has no ymag");
    if (of.contains("xmag")) {
      const double width = 2.0 * std::abs(number_in(of, "xmag", 0.0, -kLargest, kLargest));
      out.aspect = width / out.height_world;
      if (!(width > 0.0)) throw LeftOut("xmag is zero");
    }
  } else {
    out.fov_y_radians = number_in(of, "yfov", 0.0, 1e-6, std::numbers::pi - 1e-6);
    if (!(out.fov_y_radians > 0.0)) throw LeftOut("has no yfov");
    constexpr double kNone = 0.0, kLeast = 1e-12;
    if (of.contains("aspectRatio")) out.aspect = number_in(of, "aspectRatio", kNone, kLeast, kLargest);
  }
  return out;
}

/// Each entry as `read` makes it; nothing where it is broken, which is warned of.
template <class Source, class Read>
std::vector<std::optional<Source>> entries(const json* list, const std::string& kind, Read&& read,
                                           std::vector<std::string>& warnings) {
  std::vector<std::optional<Source>> out;
  if (list != nullptr && !list->is_array()) warn(warnings, kind, "is no list, skipped");
  for (std::size_t i = 0; list != nullptr && list->is_array() && i < list->size(); ++i) {
    const std::string where = element(kind, i);
    out.emplace_back();
    try {
      if (!(*list)[i].is_object()) throw LeftOut("is no object");
      out.back() = read((*list)[i]);
    } catch (const LeftOut& e) {
      warn(warnings, where, std::string(e.what()) + ", skipped");
    }
  }
  return out;
}

/// The entry that a node's `owner` names; nothing where it names none, or one that is broken or not there,
/// which is warned of. One without a name has its node's.
template <class Source>
std::optional<Source> named_by(const json* owner, const char* key, const std::string& where,
                               const std::vector<std::optional<Source>>& all, const json& node,
                               std::vector<std::string>& warnings) {
  if (owner == nullptr || !owner->contains(key)) return std::nullopt;
  const json& number = (*owner)[key];
  const std::string what = std::string(key) + "s";
  if (!number.is_number_unsigned()) {
    warn(warnings, where, "is no number of one of the " + what + ", skipped");
    return std::nullopt;
  }
  const auto index = number.get<std::size_t>();
  if (index >= all.size()) {
    warn(warnings, where,
         "names " + element(what, index) + ", there are " + std::to_string(all.size()) + ", skipped");
    return std::nullopt;
  }
  if (!all[index]) return std::nullopt;
  Source source = *all[index];
  if (source.name.empty()) source.name = name_of(node);
  if (source.name.empty()) source.name = std::to_string(index);
  return source;
}

glm::dvec3 axis_of(const glm::dmat4& m, int column, const glm::dvec3& otherwise) {
  const glm::dvec3 axis(m[column]);
  const double length = glm::length(axis);
  return length > 0.0 && std::isfinite(length) ? axis / length : otherwise;
}

Light placed(Light light, const glm::dmat4& world, const Box& scene) {
  const glm::dvec3 position(world[3]), direction = -axis_of(world, 2, {0.0, 1.0, 0.0});
  const auto endless = [&](double& range) {
    if (!(range > 0.0)) range = covering_range(position, scene);
  };
  if (auto* sun = std::get_if<DirectionalLight>(&light)) sun->direction = direction;
  if (auto* bulb = std::get_if<PointLight>(&light)) {
    bulb->position = position;
    endless(bulb->range);
  }
  if (auto* spot = std::get_if<SpotLight>(&light)) {
    spot->position = position;
    spot->direction = direction;
    endless(spot->range);
  }
  return light;
}

}  // namespace

ViewSource read_view_source(const json& source, std::vector<std::string>& warnings) {
  ViewSource out;
  constexpr const char* kPunctual = "KHR_lights_punctual";
  const json* punctual = find_extension(source, kPunctual, "", warnings);
  const auto list_in = [](const json* owner, const char* key) -> const json* {
    return owner != nullptr && owner->contains(key) ? &owner->at(key) : nullptr;
  };
  const auto lights =
      entries<SceneLight>(list_in(punctual, "lights"), "KHR_lights_punctual.lights", light_in, warnings);
  const auto cameras = entries<SceneCamera>(list_in(&source, "cameras"), "cameras", camera_in, warnings);
  const json* nodes = list_in(&source, "nodes");
  for (std::size_t n = 0; nodes != nullptr && nodes->is_array() && n < nodes->size(); ++n) {
    const json& node = (*nodes)[n];
    if (!node.is_object()) continue;
    const std::string where = element("nodes", n);
    const json* lit = find_extension(node, kPunctual, where, warnings);
    if (const auto light = named_by(lit, "light", where + "." + kPunctual + ".light", lights, node, warnings))
      out.lights.push_back({n, *light});
    if (const auto camera = named_by(&node, "camera", where + ".camera", cameras, node, warnings))
      out.cameras.push_back({n, *camera});
  }
  return out;
}

void place_views(const ViewSource& source, const NodeTree& tree, Scene& scene) {
  std::vector<bool> shown(tree.world_from_node.size());
  for (const int node : tree.shown) shown[static_cast<std::size_t>(node)] = true;
  for (const auto& [node, of_file] : source.lights) {
    if (!shown[node]) continue;
    SceneLight& light = scene.lights.emplace_back(of_file);
    light.light = placed(light.light, tree.world_from_node[node], scene.bounds_world);
  }
  for (const auto& [node, of_file] : source.cameras) {
    if (!shown[node]) continue;
    const glm::dmat4& world = tree.world_from_node[node];
    SceneCamera& camera = scene.cameras.emplace_back(of_file);
    camera.position = glm::dvec3(world[3]);
    camera.forward = -axis_of(world, 2, {0.0, 0.0, 1.0});
    camera.up = axis_of(world, 1, {0.0, 1.0, 0.0});
  }
}

}  // namespace gnomon::detail
