// Which nodes does a glTF document hide, which stand in many places, and which cast and receive shadows?
// Based on: Khronos Group, EXT_mesh_gpu_instancing and KHR_node_visibility (glTF extensions).
#include "gltf_placement.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "gltf_accessor.hpp"
#include "gltf_check.hpp"
#include "node_matrix.hpp"
#include "refusal.hpp"

namespace gnomon::detail {
namespace {

using nlohmann::json;

bool is_hidden(const json& node, const std::string& where, std::vector<std::string>& warnings) {
  const json* found = find_extension(node, "KHR_node_visibility");
  if (found == nullptr || !found->contains("visible")) return false;
  const json& visible = found->at("visible");
  if (visible.is_boolean()) return !visible.get<bool>();
  warn(warnings, where, "KHR_node_visibility.visible is not true or false, the node is shown");
  return false;
}

PlacementSource::Places places_in(const json& source, const json& node, const std::string& where,
                                  std::vector<std::string>& warnings) {
  PlacementSource::Places places;
  try {
    const json checked = checked_instancing(source, node, where + ".EXT_mesh_gpu_instancing");
    if (checked.is_null()) return places;
    const json& attributes = checked["attributes"];
    places.translation = attributes.value("TRANSLATION", -1);
    places.rotation = attributes.value("ROTATION", -1);
    places.scale = attributes.value("SCALE", -1);
  } catch (const Refusal& e) {
    warn(warnings, std::string(e.what()) + ", the mesh is shown once");
  }
  return places;
}

// Tools write what a user calls so: true and false, or 1 and 0 where they have no booleans.
void take_flag(const json& owner, const char* name, const std::string& where, bool& flag,
               std::vector<std::string>& warnings) {
  const json* extras = find_object(owner, "extras");
  if (extras == nullptr || !extras->contains(name)) return;
  const json& value = extras->at(name);
  if (value.is_boolean())
    flag = value.get<bool>();
  else if (value.is_number() && (value == 0 || value == 1))
    flag = value == 1;
  else
    warn(warnings, where + ".extras." + name, "is not true or false, and does not count");
}

std::optional<std::size_t> mesh_of(const json& source, const json& node) {
  const auto meshes = source.find("meshes");
  const auto mesh = node.is_object() ? node.find("mesh") : node.end();
  if (mesh == node.end() || !mesh->is_number_unsigned() || meshes == source.end() || !meshes->is_array() ||
      mesh->get<std::uint64_t>() >= meshes->size())
    return std::nullopt;
  return mesh->get<std::size_t>();
}

PlacementSource::Shadows shadows_of(const json& source, const json& node, const std::string& where,
                                    std::vector<std::string>& warnings) {
  PlacementSource::Shadows shadows;
  const auto take = [&](const json& owner, const std::string& of) {
    take_flag(owner, "castShadow", of, shadows.casts, warnings);
    take_flag(owner, "receiveShadow", of, shadows.receives, warnings);
  };
  if (const auto mesh = mesh_of(source, node)) take(source["meshes"][*mesh], element("meshes", *mesh));
  take(node, where);
  return shadows;
}

/// What says that the node has a shadow proxy: its own extras, else those of its mesh.
struct ProxyName {
  const json* value = nullptr;  ///< nullptr: there is none
  std::string where;
};
ProxyName proxy_name(const json& source, const json& node, std::size_t n) {
  const auto value_in = [](const json& owner) -> const json* {
    const json* extras = find_object(owner, "extras");
    return extras == nullptr || !extras->contains("shadowProxy") ? nullptr : &extras->at("shadowProxy");
  };
  if (const json* value = value_in(node)) return {value, element("nodes", n) + ".extras.shadowProxy"};
  const auto mesh = mesh_of(source, node);
  if (!mesh) return {};
  return {value_in(source["meshes"][*mesh]), element("meshes", *mesh) + ".extras.shadowProxy"};
}

using NodesByName = std::multimap<std::string, std::size_t>;

NodesByName nodes_by_name(const json& nodes) {
  NodesByName by_name;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto name = nodes[n].is_object() ? nodes[n].find("name") : nodes[n].end();
    if (name != nodes[n].end() && name->is_string()) by_name.emplace(name->get<std::string>(), n);
  }
  return by_name;
}

/// The node of that name. Throws LeftOut where its mesh cannot be a proxy.
int proxy_called(const json& source, const NodesByName& by_name, const json& name) {
  if (!name.is_string()) throw LeftOut("is no name of a node");
  const auto [first, last] = by_name.equal_range(name.get_ref<const std::string&>());
  const std::string shown = "'" + one_line(name.get_ref<const std::string&>()) + "'";
  if (first == last) throw LeftOut("no node is called " + shown);
  const std::size_t n = first->second;
  const std::string where = element("nodes", n);
  if (std::next(first) != last)
    throw LeftOut(where + " and " + element("nodes", std::next(first)->second) + " are both called " + shown);
  const json& node = source["nodes"][n];
  if (!mesh_of(source, node)) throw LeftOut(where + " has no mesh");
  if (node.contains("skin")) throw LeftOut(where + " has a skin");
  if (proxy_name(source, node, n).value != nullptr) throw LeftOut(where + " has a shadow proxy itself");
  return static_cast<int>(n);
}

int proxy_of(const json& source, const NodesByName& by_name, std::size_t n,
             std::vector<std::string>& warnings) {
  const json& node = source["nodes"][n];
  const ProxyName name = proxy_name(source, node, n);
  if (name.value == nullptr) return -1;
  try {
    if (!mesh_of(source, node)) throw LeftOut("the node has no mesh");
    return proxy_called(source, by_name, *name.value);
  } catch (const LeftOut& e) {
    warn(warnings, name.where, std::string(e.what()) + ", and does not count");
    return -1;
  }
}

std::vector<double> mark_widths(const json& source, std::vector<std::string>& warnings) {
  constexpr const char* kName = "markWidth";
  constexpr double kMost = 1e30;
  std::vector<double> out;
  const auto meshes = source.find("meshes");
  if (meshes == source.end() || !meshes->is_array()) return out;
  for (const json& mesh : *meshes) {
    out.push_back(0.0);
    const json* extras = find_object(mesh, "extras");
    if (extras == nullptr || !extras->contains(kName)) continue;
    const json& value = extras->at(kName);
    if (value.is_number() && value.get<double>() > 0.0 && value.get<double>() <= kMost)
      out.back() = value.get<double>();
    else
      warn(warnings, element("meshes", out.size() - 1) + ".extras." + kName,
           "is no number above 0, and does not count");
  }
  return out;
}

}  // namespace

PlacementSource read_placement_source(const json& source, std::vector<std::string>& warnings) {
  PlacementSource out;
  out.mark_widths = mark_widths(source, warnings);
  const auto nodes = source.find("nodes");
  if (nodes == source.end() || !nodes->is_array()) return out;
  const NodesByName by_name = nodes_by_name(*nodes);
  for (std::size_t n = 0; n < nodes->size(); ++n) {
    const std::string where = element("nodes", n);
    out.hidden.push_back(is_hidden((*nodes)[n], where, warnings));
    out.places.push_back(places_in(source, (*nodes)[n], where, warnings));
    out.shadows.push_back(shadows_of(source, (*nodes)[n], where, warnings));
    out.proxies.push_back(proxy_of(source, by_name, n, warnings));
    if (out.proxies.back() >= 0) out.proxy_nodes.insert(out.proxies.back());
  }
  return out;
}

PlaceCount place_count(const tinygltf::Model& model, const PlacementSource::Places& places) {
  if (!places.any()) return {};
  PlaceCount count{UINT64_MAX, 0};
  for (const int accessor : {places.translation, places.rotation, places.scale}) {
    if (accessor < 0) continue;
    const std::uint64_t entries = model.accessors[static_cast<std::size_t>(accessor)].count;
    count = {std::min(count.least, entries), std::max(count.most, entries)};
  }
  return count;
}

std::vector<glm::dmat4> places_of(const tinygltf::Model& model, const PlacementSource::Places& places,
                                  std::uint64_t max_count) {
  const std::uint64_t count = place_count(model, places).least;
  const auto read = [&](int accessor, int components) {
    return accessor < 0 ? std::vector<float>() : read_floats(model, accessor, components, max_count);
  };
  std::vector<float> moves, turns, scales;
  try {
    moves = read(places.translation, 3);
    turns = read(places.rotation, 4);
    scales = read(places.scale, 3);
  } catch (const Refusal& e) {
    throw LeftOut(e.what());
  }
  std::vector<glm::dmat4> out;
  out.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = [&](const std::vector<float>& values, std::size_t width, std::size_t k,
                        double otherwise) {
      return values.empty() ? otherwise : static_cast<double>(values[width * i + k]);
    };
    const glm::dvec3 move{at(moves, 3, 0, 0.0), at(moves, 3, 1, 0.0), at(moves, 3, 2, 0.0)};
    const glm::dquat turn(at(turns, 4, 3, 1.0), at(turns, 4, 0, 0.0), at(turns, 4, 1, 0.0),
                          at(turns, 4, 2, 0.0));
    const glm::dvec3 scale{at(scales, 3, 0, 1.0), at(scales, 3, 1, 1.0), at(scales, 3, 2, 1.0)};
    out.push_back(composed(move, turn, scale));
  }
  return out;
}

}  // namespace gnomon::detail
