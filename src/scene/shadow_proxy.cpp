// Which simpler meshes cast in place of a scene's own?
#include "shadow_proxy.hpp"

#include <map>
#include <set>

#include "bounds_of.hpp"
#include "gnomon/scene/edit.hpp"
#include "refusal.hpp"

namespace gnomon {
namespace detail {

std::vector<std::string> why_no_proxies(const Scene& scene) {
  std::vector<std::string> why(scene.nodes.size());
  const auto note = [&](const Instance& instance, const char* text) {
    if (instance.node != kNoNode && why[instance.node].empty()) why[instance.node] = text;
  };
  for (const Instance& instance : scene.instances) {
    if (instance.has_proxy) note(instance, "has a shadow proxy of its own");
    if (!instance.casts) note(instance, "casts no shadow");
  }
  for (const DeformedMesh& mesh : scene.motion.meshes)
    note(scene.instances[mesh.instance], "is bent by an animation");
  for (std::size_t n = 0; n < why.size(); ++n)
    if (scene.nodes[n].skinned) why[n] = "has a skin";
  return why;
}

void check_limit(std::uint64_t count, std::uint64_t most, const char* what) {
  if (count > most)
    throw Refusal("shadow proxies", "take the scene above " + std::to_string(most) + " " + what);
}

ProxyPlacer::ProxyPlacer(Scene& scene, const LoadLimits& limits)
    : scene_(scene),
      limits_(limits),
      triangles_(scene.triangle_count()),
      instances_(scene.nodes.size()),
      moved_by_(scene.instances.size(), -1) {
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    if (scene.instances[i].node != kNoNode) instances_[scene.instances[i].node].push_back(i);
  for (const MovedInstance& moved : scene.motion.instances)
    moved_by_[moved.instance] = static_cast<int>(moved.node);
}

void ProxyPlacer::place(std::uint32_t node, std::span<const std::uint32_t> primitives) {
  const std::vector<std::uint32_t>& originals = instances_[node];
  for (const std::uint32_t i : originals) {
    Instance& original = scene_.instances[i];
    original.casts = false;
    original.has_proxy = true;
    // Each place of the mesh begins with its first primitive.
    if (original.primitive != scene_.instances[originals.front()].primitive) continue;
    Instance proxy = original;
    proxy.casts = true;
    proxy.receives = proxy.shown = proxy.has_proxy = false;
    for (const std::uint32_t primitive : primitives) {
      triangles_ += scene_.primitives[primitive].index_count / 3;
      check_limit(triangles_, limits_.triangles, "triangles");
      check_limit(scene_.instances.size() + 1, limits_.nodes, "instances");
      proxy.primitive = primitive;
      proxy.bounds_world = transformed_bounds(scene_, scene_.primitives[primitive], proxy.world_from_object);
      if (!is_finite(proxy.bounds_world))
        throw Refusal(element("nodes", scene_.nodes[node].index),
                      "the vertices of its shadow proxy are not finite");
      const auto index = static_cast<std::uint32_t>(scene_.instances.size());
      scene_.instances.push_back(proxy);
      if (moved_by_[i] >= 0)
        scene_.motion.instances.push_back({index, static_cast<std::uint32_t>(moved_by_[i])});
    }
  }
}

}  // namespace detail

namespace {

/// Copies meshes of another scene behind those of this one, each once.
class Copier {
 public:
  Copier(const Scene& from, Scene& to) : from_(from), to_(to) {}

  [[nodiscard]] std::uint32_t primitive(std::uint32_t index) {
    const auto known = primitives_.find(index);
    if (known != primitives_.end()) return known->second;
    Primitive copy = from_.primitives[index];
    const std::span corners = std::span(from_.indices).subspan(copy.first_index, copy.index_count);
    copy.first_index = static_cast<std::uint32_t>(to_.indices.size());
    for (const std::uint32_t corner : corners) to_.indices.push_back(vertex(corner));
    copy.material = material(copy.material);
    to_.primitives.push_back(copy);
    const auto result = static_cast<std::uint32_t>(to_.primitives.size() - 1);
    primitives_.emplace(index, result);
    return result;
  }

 private:
  std::uint32_t vertex(std::uint32_t index) {
    const auto [known, is_new] = vertices_.emplace(index, static_cast<std::uint32_t>(to_.positions.size()));
    if (is_new) {
      to_.positions.push_back(from_.positions[index]);
      to_.normals.push_back(from_.normals[index]);
      to_.texcoords.push_back(from_.texcoords[index]);
    }
    return known->second;
  }
  int material(int index) {
    const auto [known, is_new] = materials_.emplace(index, static_cast<int>(to_.materials.size()));
    if (is_new) {
      Material copy = from_.materials[static_cast<std::size_t>(index)];
      // Nobody sees the colours of a proxy.
      if (copy.alpha_mode == AlphaMode::opaque) copy.base_color_image = -1;
      if (copy.base_color_image >= 0) copy.base_color_image = image(copy.base_color_image);
      to_.materials.push_back(copy);
    }
    return known->second;
  }
  int image(int index) {
    const auto [known, is_new] = images_.emplace(index, static_cast<int>(to_.images.size()));
    if (is_new) to_.images.push_back(from_.images[static_cast<std::size_t>(index)]);
    return known->second;
  }

  const Scene& from_;
  Scene& to_;
  std::map<std::uint32_t, std::uint32_t> primitives_, vertices_;
  std::map<int, int> materials_, images_;
};

std::string name_of(const SceneNode& node) {
  return node.name.empty() ? detail::element("nodes", node.index) : detail::one_line(node.name);
}

/// The primitives of each node's mesh, in the order in which they are placed.
std::vector<std::vector<std::uint32_t>> meshes_of(const Scene& scene) {
  std::vector<std::vector<std::uint32_t>> meshes(scene.nodes.size());
  std::vector<bool> whole(scene.nodes.size());
  for (const Instance& instance : scene.instances) {
    if (instance.node == kNoNode || whole[instance.node]) continue;
    std::vector<std::uint32_t>& mesh = meshes[instance.node];
    // The mesh stands once more.
    whole[instance.node] = !mesh.empty() && mesh.front() == instance.primitive;
    if (!whole[instance.node]) mesh.push_back(instance.primitive);
  }
  return meshes;
}

/// Proxies by the names of their nodes or of their meshes. Names that stand for several meshes are no names.
class ProxyNames {
 public:
  ProxyNames(const std::vector<std::vector<std::uint32_t>>& meshes, std::string where)
      : meshes_(meshes), where_(std::move(where)) {}

  void add(const std::string& name, std::uint32_t node) {
    if (name.empty()) return;
    const auto [known, is_new] = nodes_.emplace(name, node);
    if (!is_new && meshes_[known->second] != meshes_[node]) ambiguous_.insert(name);
  }
  /// kNoNode: none.
  [[nodiscard]] std::uint32_t find(const std::string& name, std::vector<std::string>& warnings) {
    const auto found = nodes_.find(name);
    if (found == nodes_.end()) return kNoNode;
    if (!ambiguous_.contains(name)) return found->second;
    if (named_.insert(name).second)
      detail::warn(warnings, where_,
                   "several meshes are called " + detail::one_line(name) + ", and do not count");
    return kNoNode;
  }

 private:
  const std::vector<std::vector<std::uint32_t>>& meshes_;
  std::string where_;
  std::map<std::string, std::uint32_t> nodes_;
  std::set<std::string> ambiguous_, named_;
};

/// Nodes of the proxies whose name and mesh the scene does not have, as one line.
std::string unmatched(const Scene& proxies, const Scene& scene) {
  constexpr std::size_t kMaxNames = 20;
  std::set<std::string> nodes, meshes;
  for (const SceneNode& node : scene.nodes) {
    nodes.insert(node.name);
    meshes.insert(node.mesh);
  }
  const auto matches = [](const std::string& name, const std::set<std::string>& known) {
    return !name.empty() && known.contains(name);
  };
  std::string names;
  std::size_t count = 0;
  for (const SceneNode& node : proxies.nodes) {
    if (matches(node.name, nodes) || matches(node.mesh, meshes)) continue;
    if (++count <= kMaxNames) names += (names.empty() ? "" : ", ") + name_of(node);
  }
  if (count > kMaxNames) names += " and " + std::to_string(count - kMaxNames) + " more";
  return names;
}

}  // namespace

void cast_by_proxies(const Scene& proxies, const std::string& where, const LoadLimits& limits, Scene& scene) {
  const std::vector<std::string> why_not = detail::why_no_proxies(scene),
                                 no_proxy = detail::why_no_proxies(proxies);
  const std::vector<std::vector<std::uint32_t>> meshes = meshes_of(proxies);
  ProxyNames by_name(meshes, where), by_mesh(meshes, where);
  for (std::uint32_t n = 0; n < proxies.nodes.size(); ++n) {
    const SceneNode& node = proxies.nodes[n];
    if (!no_proxy[n].empty()) {
      detail::warn(scene.warnings, where + ": " + detail::element("nodes", node.index),
                   no_proxy[n] + ", and is no shadow proxy");
      continue;
    }
    by_name.add(node.name, n);
    by_mesh.add(node.mesh, n);
  }
  detail::ProxyPlacer placer(scene, limits);
  Copier copier(proxies, scene);
  std::map<std::uint32_t, std::vector<std::uint32_t>> copies;  // primitives of the scene, by proxies' nodes
  try {
    detail::check_limit(scene.positions.size() + proxies.positions.size(), limits.vertices, "vertices");
    for (std::uint32_t n = 0; n < scene.nodes.size(); ++n) {
      const SceneNode& node = scene.nodes[n];
      std::uint32_t proxy = by_name.find(node.name, scene.warnings);
      if (proxy == kNoNode) proxy = by_mesh.find(node.mesh, scene.warnings);
      if (proxy == kNoNode) continue;
      if (!why_not[n].empty()) {
        detail::warn(scene.warnings, detail::element("nodes", node.index),
                     why_not[n] + ", the shadow proxy of " + where + " does not count");
        continue;
      }
      const auto [copy, is_new] = copies.try_emplace(proxy);
      if (is_new)
        for (const std::uint32_t primitive : meshes[proxy])
          copy->second.push_back(copier.primitive(primitive));
      placer.place(n, copy->second);
    }
  } catch (const detail::Refusal& e) {
    throw SceneError(detail::one_line(where + ": " + e.what()));
  }
  if (copies.empty())
    throw SceneError(detail::one_line(where + ": no mesh is a shadow proxy of a node of the scene"));
  if (const std::string names = unmatched(proxies, scene); !names.empty())
    detail::warn(scene.warnings, where, "no node of the scene is called " + names);
}

CastTriangles cast_triangles(const Scene& scene) noexcept {
  CastTriangles triangles;
  for (const Instance& instance : scene.instances) {
    const std::uint64_t count = scene.primitives[instance.primitive].index_count / 3;
    if (instance.casts) triangles.by_proxies += count;
    if (instance.has_proxy || (instance.casts && instance.shown)) triangles.without += count;
  }
  return triangles;
}

}  // namespace gnomon
