// Which triangles does a glTF primitive stand for? Read once into the scene and shared by all its instances.
// Based on: Khronos Group, glTF 2.0 Specification (2021), section 3.7 "Geometry".
#include "gltf_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "bounds_of.hpp"
#include "gltf_accessor.hpp"
#include "gltf_animation.hpp"
#include "gltf_skin.hpp"
#include "marks.hpp"
#include "refusal.hpp"
#include "triangles.hpp"

namespace gnomon::detail {

namespace {

constexpr int kFirstTriangleMode = TINYGLTF_MODE_TRIANGLES;
constexpr std::uint64_t kMaxIndex = std::numeric_limits<std::uint32_t>::max();

// Every triangle gets corners of its own, with its plane's normal: what glTF says a mesh without normals
// looks like.
void make_flat(Vertices& vertices, std::vector<std::uint32_t>& triangles) {
  Vertices flat;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const auto& p = vertices.positions;
    const glm::vec3 normal = face_normal(p[triangles[i]], p[triangles[i + 1]], p[triangles[i + 2]]);
    for (std::size_t k = i; k < i + 3; ++k) {
      flat.positions.push_back(p[triangles[k]]);
      flat.normals.push_back(normal);
      flat.texcoords.push_back(vertices.texcoords[triangles[k]]);
    }
  }
  std::iota(triangles.begin(), triangles.end(), 0u);
  vertices = std::move(flat);
}

/// Every triangle gets corners of its own, as make_flat gives them to the vertices.
void make_flat(DeformedMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  const auto spread = [&triangles](auto& values, std::size_t width) {
    if (values.empty()) return;
    std::remove_reference_t<decltype(values)> out;
    out.reserve(triangles.size() * width);
    for (const std::uint32_t corner : triangles) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(corner * width);
      out.insert(out.end(), first, first + static_cast<std::ptrdiff_t>(width));
    }
    values = std::move(out);
  };
  spread(mesh.positions, 1);
  for (MorphTarget& target : mesh.targets) spread(target.positions, 1);
  spread(mesh.joints, mesh.influences);
  spread(mesh.joint_weights, mesh.influences);
}

void take_influences(Influences influences, DeformedMesh& mesh) {
  mesh.influences = influences.per_vertex;
  mesh.joints = std::move(influences.joints);
  mesh.joint_weights = std::move(influences.weights);
}

/// That a mesh takes besides its morph targets.
std::uint64_t numbers_of(const DeformedMesh& mesh) {
  return 3 * (mesh.positions.size() + mesh.normals.size()) + 2 * mesh.joints.size();
}

}  // namespace

MeshReader::MeshReader(const Document& document, const NodeTree& tree, const LoadLimits& limits,
                       MotionReader& motion, Scene& scene)
    : document_(document),
      tree_(tree),
      limits_(limits),
      motion_(motion),
      scene_(scene),
      vertices_left_(std::min(limits.vertices, kMaxIndex)),
      corners_left_(std::min(limits.triangles, kMaxIndex / 3) * 3),
      built_(document.model.meshes.size()) {}

const std::vector<std::uint32_t>& MeshReader::primitives_of(int mesh) {
  auto& slot = built_[static_cast<std::size_t>(mesh)];
  if (!slot) {
    slot.emplace();
    const std::size_t count = document_.model.meshes[static_cast<std::size_t>(mesh)].primitives.size();
    for (std::size_t p = 0; p < count; ++p) {
      if (const auto built = build(mesh, p, nullptr)) slot->push_back(*built);
    }
  }
  return *slot;
}

std::optional<std::vector<std::uint32_t>> MeshReader::skinned_primitives_of(int node) {
  const tinygltf::Node& shown = document_.model.nodes[static_cast<std::size_t>(node)];
  const auto skin = static_cast<std::size_t>(shown.skin), mesh = static_cast<std::size_t>(shown.mesh);
  const std::size_t vertices = scene_.positions.size(), indices = scene_.indices.size();
  const std::size_t primitives = scene_.primitives.size();
  try {
    const Bending bending{node, &joints_of(shown.skin), motion_.moves_skin(shown.skin)};
    std::vector<std::uint32_t> out;
    for (std::size_t p = 0; p < document_.model.meshes[mesh].primitives.size(); ++p) {
      spend_bent(node);
      if (const auto built = build(shown.mesh, p, &bending)) out.push_back(*built);
    }
    return out;
  } catch (const LeftOut& e) {
    warn(scene_.warnings, element("skins", skin),
         std::string(e.what()) + "; its node's own transform is used");
    scene_.positions.resize(vertices);
    scene_.normals.resize(vertices);
    scene_.texcoords.resize(vertices);
    scene_.indices.resize(indices);
    scene_.primitives.resize(primitives);
    deformed_.erase(deformed_.lower_bound(static_cast<std::uint32_t>(primitives)), deformed_.end());
    return std::nullopt;
  }
}

std::vector<std::uint32_t> MeshReader::morphed_primitives_of(int node) {
  const int mesh = document_.model.nodes[static_cast<std::size_t>(node)].mesh;
  const Bending bending{node, nullptr, motion_.weights_of(node).has_value()};
  std::vector<std::uint32_t> out;
  for (std::size_t p = 0; p < document_.model.meshes[static_cast<std::size_t>(mesh)].primitives.size(); ++p) {
    spend_bent(node);
    if (const auto built = build(mesh, p, &bending)) out.push_back(*built);
  }
  return out;
}

std::optional<DeformedMesh> MeshReader::take_deformed(std::uint32_t primitive) {
  auto found = deformed_.extract(primitive);
  return found.empty() ? std::nullopt : std::optional(std::move(found.mapped()));
}

// Unlike a plain mesh this is work for each node, so it is held to the same limit.
void MeshReader::spend_bent(int node) {
  if (++bent_ > limits_.nodes) {
    throw Refusal(element("nodes", static_cast<std::size_t>(node)),
                  "takes the scene above " + std::to_string(limits_.nodes) + " skinned primitives");
  }
}

// Computed once per skin, also where that fails: many nodes may name one skin.
const std::vector<glm::dmat4>& MeshReader::joints_of(int skin) {
  const auto [it, is_new] = joints_.try_emplace(skin);
  if (is_new)
    it->second =
        joint_matrices(document_.model, document_.model.skins[static_cast<std::size_t>(skin)], tree_);
  if (it->second.empty()) throw LeftOut("is broken");
  return it->second;
}

std::optional<std::uint32_t> MeshReader::build(int mesh, std::size_t primitive, const Bending* bending) {
  const auto m = static_cast<std::size_t>(mesh);
  const std::string where = element("meshes", m) + "." + element("primitives", primitive);
  const tinygltf::Primitive& source = document_.model.meshes[m].primitives[primitive];
  const char* why = nullptr;
  const bool marks = source.mode < kFirstTriangleMode;
  if (marks && bending != nullptr) why = "points and lines follow no skin and no morph target, skipped";
  if (attributes_of(source)[0] < 0) why = "has no POSITION, skipped";
  if (document_.compressed[m][primitive]) why = "is compressed with Draco, skipped";
  if (why != nullptr) {
    warn(scene_.warnings, where, why);
    return std::nullopt;
  }
  if (bending != nullptr && bending->joints != nullptr)
    return build_triangles(mesh, primitive, where, bending);
  try {
    return marks ? build_marks(mesh, primitive, where) : build_triangles(mesh, primitive, where, bending);
  } catch (const LeftOut& e) {
    warn(scene_.warnings, where, std::string(e.what()) + ", skipped");
    return std::nullopt;
  }
}

std::uint32_t MeshReader::build_marks(int mesh, std::size_t primitive, const std::string& where) {
  const auto m = static_cast<std::size_t>(mesh);
  const tinygltf::Primitive& source = document_.model.meshes[m].primitives[primitive];
  const bool points = source.mode == TINYGLTF_MODE_POINTS;
  const Vertices vertices = read_vertices(attributes_of(source), where);
  vertices_left_ += vertices.positions.size();  // those of the marks are stored in their place
  std::vector<std::uint32_t> corners = read_corners(mesh, primitive, vertices.positions.size(), where);
  if (!points) corners = line_list(source.mode, corners);
  const std::uint64_t count = points ? corners.size() : corners.size() / 2;
  spend_vertices(count * (points ? kPointVertices : kLineVertices), where);
  spend_corners(count * 3 * (points ? kPointTriangles : kLineTriangles), where);
  float width = static_cast<float>(document_.placement.mark_widths[m]);
  if (!(width > 0.0f)) {
    width = guessed_width(vertices.positions, corners, points);
    if (width > 0.0f)
      warn(scene_.warnings, where,
           "points and lines have no width, one is guessed: \"markWidth\" in the extras of their mesh sets "
           "it");
  }
  std::vector<std::uint32_t> triangles;
  const Vertices marks = points ? point_marks(vertices, corners, width, triangles)
                                : line_marks(vertices, corners, width, triangles);
  if (triangles.empty() || !(width > 0.0f)) throw LeftOut("its points or lines have no extent");
  return store(append(marks), triangles, source.material);
}

std::uint32_t MeshReader::build_triangles(int mesh, std::size_t primitive, const std::string& where,
                                          const Bending* bending) {
  const tinygltf::Primitive& source =
      document_.model.meshes[static_cast<std::size_t>(mesh)].primitives[primitive];
  const Attributes attributes = attributes_of(source);
  const auto known = bending == nullptr ? shared_.find(attributes) : shared_.end();
  if (known != shared_.end()) {
    std::vector<std::uint32_t> triangles = read_triangles(mesh, primitive, known->second.count, where);
    drop_invisible(source, known->second.count, where, triangles);
    return store(known->second, triangles, source.material);
  }
  Vertices vertices = read_vertices(attributes, where);
  std::vector<std::uint32_t> triangles = read_triangles(mesh, primitive, vertices.positions.size(), where);
  drop_invisible(source, vertices.positions.size(), where, triangles);
  std::optional<DeformedMesh> kept;
  if (bending != nullptr && bending->kept) kept = keep(mesh, primitive, where, *bending, vertices);
  if (bending != nullptr) morph(mesh, primitive, where, bending->node, vertices);
  if (bending != nullptr && bending->joints != nullptr) {
    Influences influences = bend(document_.model, source, *bending->joints, vertices, triangles);
    if (kept) take_influences(std::move(influences), *kept);
  }
  bool shareable = bending == nullptr && !vertices.normals.empty();
  if (vertices.normals.empty()) {
    if (kept) make_flat(*kept, triangles);
    vertices_left_ += vertices.positions.size();  // the flat ones are stored in their place
    spend_vertices(triangles.size(), where);
    make_flat(vertices, triangles);
  } else if (const std::size_t repaired = repair_normals(vertices.positions, triangles, vertices.normals)) {
    warn(scene_.warnings, where,
         std::to_string(repaired) + " normals were zero or not finite, made from triangles");
    shareable = false;
  }
  const Range range = append(vertices);
  if (shareable) shared_[attributes] = range;
  const std::uint32_t stored = store(range, triangles, source.material);
  if (kept) {
    motion_.budget().spend(numbers_of(*kept), 1, where);
    kept->first_vertex = range.first;
    deformed_[stored] = std::move(*kept);
  }
  return stored;
}

DeformedMesh MeshReader::keep(int mesh, std::size_t primitive, const std::string& where,
                              const Bending& bending, const Vertices& vertices) {
  DeformedMesh out;
  out.positions = vertices.positions;
  out.normals = vertices.normals;
  if (bending.joints != nullptr)
    out.skin = motion_.skin_of(document_.model.nodes[static_cast<std::size_t>(bending.node)].skin);
  const auto first_weight = motion_.weights_of(bending.node);
  const auto targets = document_.motion.targets.find({mesh, static_cast<int>(primitive)});
  if (!first_weight || targets == document_.motion.targets.end()) return out;
  out.first_weight = *first_weight;
  const std::size_t count = vertices.positions.size();
  for (std::size_t t = 0; t < targets->second.size(); ++t) {
    const std::string at = where + "." + element("targets", t);
    motion_.budget().spend(count, 6, at);
    out.targets.push_back({read_offsets(targets->second[t].positions, count, "POSITION", at),
                           vertices.normals.empty()
                               ? std::vector<glm::vec3>()
                               : read_offsets(targets->second[t].normals, count, "NORMAL", at)});
  }
  return out;
}

const std::vector<float>* MeshReader::weights_at_rest(int node) const {
  const MotionSource& motion = document_.motion;
  const auto of_node = motion.node_weights.find(node);
  if (of_node != motion.node_weights.end()) return &of_node->second;
  const auto of_mesh = motion.mesh_weights.find(document_.model.nodes[static_cast<std::size_t>(node)].mesh);
  return of_mesh != motion.mesh_weights.end() ? &of_mesh->second : nullptr;
}

bool MeshReader::morphs_at_rest(int node) const {
  const std::vector<float>* const weights = weights_at_rest(node);
  if (weights == nullptr || std::all_of(weights->begin(), weights->end(), [](float w) { return w == 0.0f; }))
    return false;
  const int mesh = document_.model.nodes[static_cast<std::size_t>(node)].mesh;
  const auto first = document_.motion.targets.lower_bound({mesh, 0});
  return first != document_.motion.targets.end() && first->first.first == mesh;
}

void MeshReader::morph(int mesh, std::size_t primitive, const std::string& where, int node,
                       Vertices& vertices) {
  const std::vector<float>* const weights = weights_at_rest(node);
  const auto targets = document_.motion.targets.find({mesh, static_cast<int>(primitive)});
  if (weights == nullptr || targets == document_.motion.targets.end()) return;
  const std::size_t count = vertices.positions.size();
  const auto add = [&](int accessor, const char* name, const std::string& at, float weight,
                       std::vector<glm::vec3>& to) {
    if (to.empty()) return;
    const std::vector<glm::vec3> offsets = read_offsets(accessor, count, name, at);
    for (std::size_t v = 0; v < offsets.size(); ++v) to[v] += weight * offsets[v];
  };
  for (std::size_t t = 0; t < std::min(weights->size(), targets->second.size()); ++t) {
    const float weight = (*weights)[t];
    if (weight == 0.0f) continue;
    const std::string at = where + "." + element("targets", t);
    add(targets->second[t].positions, "POSITION", at, weight, vertices.positions);
    add(targets->second[t].normals, "NORMAL", at, weight, vertices.normals);
  }
  for (const glm::vec3& position : vertices.positions) {
    if (!is_finite(position)) throw Refusal(where, "its weights at rest make positions that are not finite");
  }
}

MeshReader::Range MeshReader::append(const Vertices& vertices) {
  const Range range{static_cast<std::uint32_t>(scene_.positions.size()),
                    static_cast<std::uint32_t>(vertices.positions.size())};
  scene_.positions.insert(scene_.positions.end(), vertices.positions.begin(), vertices.positions.end());
  scene_.normals.insert(scene_.normals.end(), vertices.normals.begin(), vertices.normals.end());
  scene_.texcoords.insert(scene_.texcoords.end(), vertices.texcoords.begin(), vertices.texcoords.end());
  return range;
}

std::uint32_t MeshReader::store(Range range, const std::vector<std::uint32_t>& triangles, int material) {
  Primitive out;
  out.first_index = static_cast<std::uint32_t>(scene_.indices.size());
  out.index_count = static_cast<std::uint32_t>(triangles.size());
  // The default material stands behind the file's own.
  out.material = material >= 0 ? material : static_cast<int>(document_.model.materials.size());
  for (const std::uint32_t corner : triangles) {
    scene_.indices.push_back(range.first + corner);
    out.bounds.extend(glm::dvec3(scene_.positions[range.first + corner]));
  }
  scene_.primitives.push_back(out);
  return static_cast<std::uint32_t>(scene_.primitives.size() - 1);
}

void MeshReader::spend_vertices(std::uint64_t count, const std::string& where) {
  if (count > vertices_left_) {
    throw Refusal(where, "takes the scene above " + std::to_string(limits_.vertices) + " vertices");
  }
  vertices_left_ -= count;
}

void MeshReader::spend_corners(std::uint64_t count, const std::string& where) {
  if (count > corners_left_) {
    throw Refusal(where, "takes the scene above " + std::to_string(limits_.triangles) + " triangles");
  }
  corners_left_ -= count;
}

}  // namespace gnomon::detail
