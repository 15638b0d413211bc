// From a glTF file to a scene: which instances are drawn, and where they stand.
#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "bounds_of.hpp"
#include "gltf_animation.hpp"
#include "gltf_document.hpp"
#include "gltf_material.hpp"
#include "gltf_mesh.hpp"
#include "gltf_nodes.hpp"
#include "gnomon/scene/load.hpp"
#include "load_memory.hpp"
#include "marks.hpp"
#include "refusal.hpp"
#include "shadow_proxy.hpp"

namespace gnomon {

namespace {

using detail::element;
using detail::Refusal;

class Placer {
 public:
  Placer(const detail::Document& document, const LoadLimits& limits, Scene& scene)
      : document_(document), limits_(limits), scene_(scene) {}

  std::uint32_t place(std::uint32_t primitive, const glm::dmat4& world_from_object, std::size_t node) {
    triangles_ += scene_.primitives[primitive].index_count / 3;
    if (triangles_ > limits_.triangles) {
      throw Refusal(element("nodes", node),
                    "takes the scene above " + std::to_string(limits_.triangles) + " triangles");
    }
    if (scene_.instances.size() >= limits_.nodes) {
      throw Refusal(element("nodes", node),
                    "takes the scene above " + std::to_string(limits_.nodes) + " instances");
    }
    Instance instance;
    instance.world_from_object = world_from_object;
    instance.primitive = primitive;
    instance.mirrored = glm::determinant(glm::dmat3(world_from_object)) < 0.0;
    instance.bounds_world =
        detail::transformed_bounds(scene_, scene_.primitives[primitive], world_from_object);
    if (!detail::is_finite(instance.bounds_world))
      throw Refusal(element("nodes", node), "its vertices are not finite");
    const std::vector<detail::PlacementSource::Shadows>& shadows = document_.placement.shadows;
    if (node < shadows.size()) {
      instance.casts = shadows[node].casts;
      instance.receives = shadows[node].receives;
    }
    instance.node = named(node);
    scene_.bounds_world.extend(instance.bounds_world);
    scene_.instances.push_back(instance);
    return static_cast<std::uint32_t>(scene_.instances.size() - 1);
  }

 private:
  /// Index into Scene::nodes. All instances of a node are placed before those of the next.
  std::uint32_t named(std::size_t node) {
    if (scene_.nodes.empty() || scene_.nodes.back().index != node) {
      const tinygltf::Node& of = document_.model.nodes[node];
      scene_.nodes.push_back({static_cast<std::uint32_t>(node), of.name,
                              document_.model.meshes[static_cast<std::size_t>(of.mesh)].name, of.skin >= 0});
    }
    return static_cast<std::uint32_t>(scene_.nodes.size() - 1);
  }

  const detail::Document& document_;
  const LoadLimits& limits_;
  Scene& scene_;
  std::uint64_t triangles_ = 0;
};

/// Triangles that a primitive will come to, by what it says and no more than its bytes allow.
std::uint64_t announced(const detail::Document& document, std::size_t mesh, std::size_t primitive) {
  const tinygltf::Primitive& source = document.model.meshes[mesh].primitives[primitive];
  int corners = document.indices[mesh][primitive];
  const auto position = source.attributes.find("POSITION");
  if (corners < 0 && position != source.attributes.end()) corners = position->second;
  if (corners < 0) return 0;
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(corners)];
  if (accessor.bufferView < 0) return 0;
  const auto& view = document.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)];
  const std::uint64_t count = std::min<std::uint64_t>(accessor.count, view.byteLength);
  if (source.mode == TINYGLTF_MODE_POINTS) return count * detail::kPointTriangles;
  if (source.mode == TINYGLTF_MODE_LINE) return count / 2 * detail::kLineTriangles;
  if (source.mode < TINYGLTF_MODE_TRIANGLES) return count * detail::kLineTriangles;
  if (source.mode == TINYGLTF_MODE_TRIANGLES) return count / 3;
  return count < 3 ? 0 : count - 2;
}

/// A scene too large is refused by what it says it is, before memory is spent on it.
void check_size(const detail::Document& document, const detail::NodeTree& tree, const LoadLimits& limits) {
  std::vector<std::uint64_t> of_mesh(document.model.meshes.size());
  for (std::size_t m = 0; m < of_mesh.size(); ++m) {
    for (std::size_t p = 0; p < document.indices[m].size(); ++p) of_mesh[m] += announced(document, m, p);
  }
  std::uint64_t triangles = 0, stored = 0;
  std::vector<bool> seen(of_mesh.size(), false);
  for (const int n : tree.shown) {
    const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(n)];
    if (node.mesh < 0 || document.placement.is_proxy(n)) continue;
    const auto m = static_cast<std::size_t>(node.mesh);
    const std::uint64_t places =
        place_count(document.model, document.placement.places[static_cast<std::size_t>(n)]).least;
    const std::uint64_t each = of_mesh[m];
    // Products of what a file says may overflow.
    if (each > 0 && places > (UINT64_MAX - triangles) / each) triangles = UINT64_MAX;
    if (triangles < UINT64_MAX) triangles += each * places;
    // A mesh is stored once for all its nodes, but anew for each that bends it.
    const bool bent = node.skin >= 0;
    if (bent || !seen[m]) stored += of_mesh[m];
    seen[m] = seen[m] || !bent;
  }
  if (triangles <= limits.triangles) return;
  // Three corners of 32 bytes and their indices, where no vertex is shared.
  constexpr std::uint64_t kTriangleBytes = 3 * (sizeof(glm::vec3) * 2 + sizeof(glm::vec2) + 4);
  throw Refusal("scene", std::to_string(triangles) + " triangles, up to " +
                             std::to_string(stored * kTriangleBytes >> 20) + " MiB, are above the limit of " +
                             std::to_string(limits.triangles));
}

/// The scene's nodes with meshes, one after the other.
class NodePlacer {
 public:
  NodePlacer(const detail::Document& document, const detail::NodeTree& tree, const LoadLimits& limits,
             Scene& scene)
      : document_(document),
        tree_(tree),
        limits_(limits),
        scene_(scene),
        motion_(document, tree, limits, scene),
        meshes_(document, tree, limits, motion_, scene),
        placer_(document, limits, scene) {}

  void place(int n) {
    const auto index = static_cast<std::size_t>(n);
    const tinygltf::Node& node = document_.model.nodes[index];
    if (node.mesh < 0 || document_.placement.is_proxy(n)) return;
    if (node.skin >= 0) {
      if (const auto bent = meshes_.skinned_primitives_of(n)) {
        for (const std::uint32_t primitive : *bent)
          keep_deformed(placer_.place(primitive, glm::dmat4(1.0), index), -1);
        return;
      }
    }
    if (document_.placement.places[index].any() && place_instances(n)) return;
    const int moved = motion_.moved_node(n);
    const glm::dmat4& at = tree_.world_from_node[index];
    if (motion_.weights_of(n)) {
      for (const std::uint32_t primitive : meshes_.morphed_primitives_of(n))
        keep_deformed(placer_.place(primitive, at, index), moved);
      return;
    }
    for (const std::uint32_t primitive : primitives_at_rest(n)) {
      const std::uint32_t instance = placer_.place(primitive, at, index);
      if (moved >= 0) scene_.motion.instances.push_back({instance, static_cast<std::uint32_t>(moved)});
    }
  }

  /// The meshes that cast in place of those that are placed.
  void place_proxies() {
    if (document_.placement.proxy_nodes.empty()) return;
    const std::vector<std::string> why_not = detail::why_no_proxies(scene_);
    detail::ProxyPlacer placer(scene_, limits_);
    for (std::uint32_t n = 0; n < why_not.size(); ++n) {
      const std::uint32_t node = scene_.nodes[n].index;
      const int proxy = document_.placement.proxies[node];
      if (proxy < 0) continue;
      const auto& primitives =
          meshes_.primitives_of(document_.model.nodes[static_cast<std::size_t>(proxy)].mesh);
      std::string why = why_not[n];
      if (why.empty() && primitives.empty())
        why = element("nodes", static_cast<std::size_t>(proxy)) + " has no triangles";
      if (why.empty())
        placer.place(n, primitives);
      else
        detail::warn(scene_.warnings, element("nodes", node), why + ", its shadow proxy does not count");
    }
  }

 private:
  /// With the mesh's morph targets where its weights at rest are.
  [[nodiscard]] std::vector<std::uint32_t> primitives_at_rest(int n) {
    if (meshes_.morphs_at_rest(n)) return meshes_.morphed_primitives_of(n);
    return meshes_.primitives_of(document_.model.nodes[static_cast<std::size_t>(n)].mesh);
  }

  /// One instance for each place of the node's mesh. False where they are broken, which is warned of.
  bool place_instances(int n) {
    const auto index = static_cast<std::size_t>(n);
    const detail::PlaceCount count = detail::place_count(document_.model, document_.placement.places[index]);
    if (count.least > limits_.nodes)
      throw Refusal(element("nodes", index),
                    "takes the scene above " + std::to_string(limits_.nodes) + " instances");
    std::vector<glm::dmat4> places;
    try {
      places = detail::places_of(document_.model, document_.placement.places[index], limits_.nodes);
    } catch (const detail::LeftOut& e) {
      detail::warn(scene_.warnings, element("nodes", index),
                   std::string("its instances are broken: ") + e.what() + "; the mesh is shown once");
      return false;
    }
    if (count.least != count.most)
      detail::warn(scene_.warnings, element("nodes", index),
                   "attributes of its instances are of several counts: the first " +
                       std::to_string(places.size()) + " are shown");
    if (motion_.moved_node(n) >= 0 || motion_.weights_of(n))
      detail::warn(scene_.warnings, element("nodes", index), "animations do not move its instances");
    const std::vector<std::uint32_t> primitives = primitives_at_rest(n);
    for (const glm::dmat4& place : places) {
      for (const std::uint32_t primitive : primitives)
        placer_.place(primitive, tree_.world_from_node[index] * place, index);
    }
    return true;
  }

  /// `moved`: index of the node that places the instance, or -1.
  void keep_deformed(std::uint32_t instance, int moved) {
    auto mesh = meshes_.take_deformed(scene_.instances[instance].primitive);
    if (!mesh) return;
    mesh->instance = instance;
    mesh->node = moved;
    scene_.motion.meshes.push_back(std::move(*mesh));
  }

  const detail::Document& document_;
  const detail::NodeTree& tree_;
  const LoadLimits& limits_;
  Scene& scene_;
  detail::MotionReader motion_;
  detail::MeshReader meshes_;
  Placer placer_;
};

}  // namespace

namespace detail {

Scene load_gltf_bytes(std::span<const std::uint8_t> bytes, const std::string& scene_name,
                      const std::string& path_in_errors, const std::filesystem::path& folder,
                      const LoadLimits& limits, std::uint64_t* files_hash) {
  try {
    Scene scene;
    scene.name = scene_name;
    SceneFolder files(folder, limits.file_bytes, limits.total_bytes);
    const Document document = open_document(bytes, files, limits, scene.warnings);
    const NodeTree tree = build_node_tree(document.model, document.placement.hidden, scene.warnings);
    check_size(document, tree, limits);
    NodePlacer placer(document, tree, limits, scene);
    for (const int node : tree.shown) placer.place(node);
    placer.place_proxies();
    if (scene.bounds_world.empty()) warn(scene.warnings, "scene", "has no triangles, and shows nothing");
    place_views(document.views, tree, scene);
    read_materials(document, files, limits, scene);
    if (files_hash != nullptr) *files_hash = fnv_of(bytes, files.hash());
    return scene;
  } catch (const std::bad_alloc&) {
    throw SceneError(one_line(path_in_errors + ": file: needs more memory than there is"));
  } catch (const std::exception& e) {
    throw SceneError(one_line(path_in_errors + ": " + e.what()));
  }
}

}  // namespace detail

namespace {

constexpr std::string_view kBuiltin = "builtin:";

Scene load_file(const std::filesystem::path& path, const LoadLimits& limits, std::uint64_t* files_hash) {
  detail::Bytes bytes;
  try {
    bytes = detail::read_regular_file(path, limits.file_bytes);
  } catch (const std::exception& e) {
    throw SceneError(detail::one_line(path.string() + ": file: " + e.what()));
  }
  const std::filesystem::path parent = path.parent_path();
  return detail::load_gltf_bytes(bytes, path.stem().string(), path.string(), parent.empty() ? "." : parent,
                                 limits, files_hash);
}

}  // namespace

LoadLimits limits_of_triangles(std::uint64_t triangles) noexcept {
  LoadLimits limits;
  limits.triangles = triangles;
  // Where none shares a corner.
  limits.vertices = std::max(limits.vertices, 3 * std::min(triangles, UINT64_MAX / 3));
  return limits;
}

Scene load_gltf(const std::filesystem::path& path, const LoadLimits& limits) {
  return load_file(path, limits, nullptr);
}

Scene load_scene(const std::string& spec, const LoadLimits& limits) {
  if (spec.starts_with(kBuiltin)) return load_builtin(std::string_view(spec).substr(kBuiltin.size()));
  return load_gltf(spec, limits);
}

std::uint64_t scene_files_hash(const std::string& spec, const LoadLimits& limits) {
  std::uint64_t hash = 0;
  if (!spec.starts_with(kBuiltin)) {
    (void)load_file(spec, limits, &hash);
    return hash;
  }
  const std::string_view name = std::string_view(spec).substr(kBuiltin.size());
  const auto known = builtin_scenes();
  if (std::none_of(known.begin(), known.end(), [&](const BuiltinScene& scene) { return scene.name == name; }))
    (void)load_builtin(name);  // refuses, and says which there are
  return hash;
}

}  // namespace gnomon
