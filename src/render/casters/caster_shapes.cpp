// Copies of moved casters' triangles, and boxes round runs of them.
#include "casters/caster_shapes.hpp"

#include <algorithm>
#include <glm/common.hpp>

namespace gnomon::render {
namespace {

// Of more triangles a copy takes more memory and time than texels are worth.
constexpr std::size_t kMaxIndices = 3 * std::size_t{1 << 18};

}  // namespace

CasterShapes::CasterShapes(const SceneBuffers& scene)
    : scene_(scene), mesh_of_(scene.primitives().size(), kUnread), is_kept_(scene.boxes().size()) {}

CasterShapes::Mesh& CasterShapes::mesh_of(std::uint32_t primitive) {
  if (mesh_of_[primitive] < meshes_.size()) return meshes_[mesh_of_[primitive]];
  Mesh mesh;
  mesh.bent = mesh_of_[primitive] == kUnreadBent;
  if (scene_.primitives()[primitive].index_count <= kMaxIndices)
    mesh.indices = scene_.read_near_indices(primitive);
  mesh.vertices = mesh.indices;
  std::sort(mesh.vertices.begin(), mesh.vertices.end());
  mesh.vertices.erase(std::unique(mesh.vertices.begin(), mesh.vertices.end()), mesh.vertices.end());
  for (std::uint32_t& index : mesh.indices) {
    const auto at = std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), index);
    index = static_cast<std::uint32_t>(at - mesh.vertices.begin());
  }
  if (!mesh.vertices.empty()) {
    const std::uint32_t first = mesh.vertices.front();
    const std::vector<glm::vec3> range =
        scene_.read_positions(first, std::size_t{mesh.vertices.back()} - first + 1);
    for (const std::uint32_t vertex : mesh.vertices) mesh.now.positions.push_back(range[vertex - first]);
  }
  mesh.stale_parts = true;
  mesh_of_[primitive] = static_cast<std::uint32_t>(meshes_.size());
  meshes_.push_back(std::move(mesh));
  return meshes_.back();
}

void CasterShapes::keep(std::size_t instance) {
  if (is_kept_[instance] != 0) return;
  is_kept_[instance] = 1;
  const auto i = static_cast<std::uint32_t>(instance);
  kept_.push_back({i, scene_.boxes()[instance], scene_.world_from_object(i)});
}

void CasterShapes::bend(std::size_t instance, std::uint32_t first, std::span<const glm::vec3> positions) {
  keep(instance);
  std::uint32_t& own = mesh_of_[scene_.primitive_index(static_cast<std::uint32_t>(instance))];
  if (own == kUnread) own = kUnreadBent;
  for (Mesh& mesh : meshes_) {
    const std::size_t end = first + positions.size();
    const auto begin = std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), first);
    if (begin == mesh.vertices.end() || *begin >= end) continue;
    if (!mesh.bent) {
      if (mesh.stale_parts) make_parts(mesh, mesh.now);
      mesh.before = mesh.now;
    }
    mesh.bent = mesh.stale_parts = true;
    for (auto at = begin; at != mesh.vertices.end() && *at < end; ++at)
      mesh.now.positions[static_cast<std::size_t>(at - mesh.vertices.begin())] = positions[*at - first];
  }
}

void CasterShapes::forget_moves() noexcept {
  for (const Kept& kept : kept_) {
    is_kept_[kept.instance] = 0;
    std::uint32_t& mesh = mesh_of_[scene_.primitive_index(kept.instance)];
    if (mesh == kUnreadBent) mesh = kUnread;
  }
  kept_.clear();
  for (Mesh& mesh : meshes_) mesh.bent = false;
}

void CasterShapes::make_parts(const Mesh& mesh, Posed& posed) {
  posed.parts.clear();
  const std::size_t triangles = mesh.indices.size() / 3;
  if (triangles <= kMaxParts) return;
  const std::size_t run = 3 * ((triangles + kMaxParts - 1) / kMaxParts);
  for (std::size_t begin = 0; begin < mesh.indices.size(); begin += run) {
    glm::vec3 low = posed.positions[mesh.indices[begin]], high = low;
    for (std::size_t i = begin; i < std::min(begin + run, mesh.indices.size()); ++i) {
      low = glm::min(low, posed.positions[mesh.indices[i]]);
      high = glm::max(high, posed.positions[mesh.indices[i]]);
    }
    posed.parts.push_back({glm::dvec3(low), glm::dvec3(high)});
  }
}

CasterShape CasterShapes::shape(const Mesh& mesh, const Posed& posed) {
  CasterShape shape;
  shape.positions = posed.positions;
  shape.parts = posed.parts;
  if (shape.parts.empty() && !posed.positions.empty()) shape.indices = mesh.indices;
  return shape;
}

std::span<const MovedCaster> CasterShapes::moved() {
  moved_.clear();
  for (const Kept& kept : kept_) {
    Mesh& mesh = mesh_of(scene_.primitive_index(kept.instance));
    if (mesh.stale_parts) make_parts(mesh, mesh.now);
    mesh.stale_parts = false;
    MovedCaster caster{kept.instance, shape(mesh, mesh.bent ? mesh.before : mesh.now), shape(mesh, mesh.now)};
    caster.from.bounds_world = kept.bounds_world;
    caster.from.world_from_object = kept.world_from_object;
    caster.to.bounds_world = scene_.boxes()[kept.instance];
    caster.to.world_from_object = scene_.world_from_object(kept.instance);
    moved_.push_back(caster);
  }
  return moved_;
}

}  // namespace gnomon::render
