// A scene other than its file has it.
// Based on: Sutherland, Hodgman, "Reentrant Polygon Clipping", 1974.
#include "gnomon/scene/edit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "bounds_of.hpp"
#include "surface_samples.hpp"
#include "view_subject.hpp"

namespace gnomon {
namespace {

// A plane as a mesh has it: a vertex is kept where value() <= 0.
struct ObjectPlane {
  glm::dvec3 normal;
  double distance;
  [[nodiscard]] double value(const glm::vec3& at) const {
    return glm::dot(normal, glm::dvec3(at)) - distance;
  }
};

ObjectPlane in_object(const SectionPlane& plane, const glm::dmat4& world_from_object) {
  const glm::dmat4& m = world_from_object;
  return {{glm::dot(plane.normal, glm::dvec3(m[0])), glm::dot(plane.normal, glm::dvec3(m[1])),
           glm::dot(plane.normal, glm::dvec3(m[2]))},
          plane.distance - glm::dot(plane.normal, glm::dvec3(m[3]))};
}

// Cuts one primitive; edges that triangles share are cut once.
class Cut {
 public:
  Cut(Scene& scene, const ObjectPlane& plane) : scene_(scene), plane_(plane) {}

  void add(const std::array<std::uint32_t, 3>& triangle) {
    std::array<std::uint32_t, 4> kept{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      const double a = plane_.value(scene_.positions[from]), b = plane_.value(scene_.positions[to]);
      if (a <= 0.0) kept[count++] = from;
      // One that touches the plane from inside is no edge across it.
      if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) kept[count++] = crossing(from, to);
    }
    for (std::size_t i = 2; i < count; ++i)
      for (const std::uint32_t corner : {kept[0], kept[i - 1], kept[i]}) indices_.push_back(corner);
  }
  // Appends what is left to the scene's indices.
  [[nodiscard]] Primitive primitive(const Primitive& of) {
    Primitive result = of;
    result.first_index = static_cast<std::uint32_t>(scene_.indices.size());
    result.index_count = static_cast<std::uint32_t>(indices_.size());
    result.bounds = {};
    for (const std::uint32_t i : indices_) result.bounds.extend(glm::dvec3(scene_.positions[i]));
    scene_.indices.insert(scene_.indices.end(), indices_.begin(), indices_.end());
    return result;
  }

 private:
  std::uint32_t crossing(std::uint32_t from, std::uint32_t to) {
    if (from > to) std::swap(from, to);  // one edge, whichever triangle asks
    const auto known = crossings_.find({from, to});
    if (known != crossings_.end()) return known->second;
    const double a = plane_.value(scene_.positions[from]), b = plane_.value(scene_.positions[to]);
    const double t = a / (a - b);
    const auto between = [t](const auto& values, std::uint32_t i, std::uint32_t k) {
      using Value = std::decay_t<decltype(values[0])>;
      return Value(glm::mix(glm::vec<Value::length(), double>(values[i]),
                            glm::vec<Value::length(), double>(values[k]), t));
    };
    scene_.positions.push_back(between(scene_.positions, from, to));
    const glm::vec3 normal = between(scene_.normals, from, to);
    scene_.normals.push_back(glm::length(normal) > 0.0f ? glm::normalize(normal) : scene_.normals[from]);
    scene_.texcoords.push_back(between(scene_.texcoords, from, to));
    const auto vertex = static_cast<std::uint32_t>(scene_.positions.size() - 1);
    crossings_.emplace(std::pair(from, to), vertex);
    return vertex;
  }

  Scene& scene_;
  ObjectPlane plane_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings_;
  std::vector<std::uint32_t> indices_;
};

enum class Side { kept, cut_away, across };

Side side_of(const Box& box, const SectionPlane& plane) {
  const glm::dvec3 high = glm::mix(box.min, box.max, glm::greaterThan(plane.normal, glm::dvec3(0.0))),
                   low = box.min + box.max - high;
  if (glm::dot(plane.normal, high) <= plane.distance) return Side::kept;
  return glm::dot(plane.normal, low) > plane.distance ? Side::cut_away : Side::across;
}

bool is_usable(const SectionPlane& plane) {
  return glm::dot(plane.normal, plane.normal) > 0.0 && std::isfinite(glm::dot(plane.normal, plane.normal)) &&
         std::isfinite(plane.distance);
}

void cut_by_one(const SectionPlane& plane, Scene& scene) {
  std::vector<Instance> kept;
  for (const Instance& instance : scene.instances) {
    const Side side = instance.bounds_world.empty() ? Side::kept : side_of(instance.bounds_world, plane);
    if (side == Side::kept) kept.push_back(instance);
    if (side != Side::across) continue;
    const Primitive whole = scene.primitives[instance.primitive];
    Cut cut(scene, in_object(plane, instance.world_from_object));
    for (std::uint32_t k = 0; k + 2 < whole.index_count; k += 3) {
      const std::size_t at = whole.first_index + k;
      cut.add({scene.indices[at], scene.indices[at + 1], scene.indices[at + 2]});
    }
    const Primitive primitive = cut.primitive(whole);
    if (primitive.index_count == 0) continue;
    scene.primitives.push_back(primitive);
    Instance left = instance;
    left.primitive = static_cast<std::uint32_t>(scene.primitives.size() - 1);
    left.bounds_world = detail::transformed_bounds(scene, primitive, left.world_from_object);
    kept.push_back(left);
  }
  scene.instances = std::move(kept);
  scene.bounds_world = {};
  for (const Instance& instance : scene.instances)
    if (instance.shown) scene.bounds_world.extend(instance.bounds_world);
}

// (x, y, z) to (x, z, -y).
glm::dvec3 turned(const glm::dvec3& v) {
  return {v.x, v.z, -v.y};
}
Box turned(const Box& box) {
  if (box.empty()) return box;
  return {{box.min.x, box.min.z, -box.max.y}, {box.max.x, box.max.z, -box.min.y}};
}
glm::dmat4 turned(const glm::dmat4& world_from_object) {
  glm::dmat4 out = world_from_object;
  for (int column = 0; column < 4; ++column)
    out[column] = glm::dvec4(turned(glm::dvec3(out[column])), out[column].w);
  return out;
}

// Turns the vertices of a primitive that are its own.
void turn_vertices(Primitive& primitive, Scene& scene) {
  const auto first = scene.indices.begin() + primitive.first_index;
  std::vector<std::uint32_t> vertices(first, first + primitive.index_count);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const std::uint32_t v : vertices) {
    scene.positions[v] = glm::vec3(turned(glm::dvec3(scene.positions[v])));
    scene.normals[v] = glm::vec3(turned(glm::dvec3(scene.normals[v])));
  }
  primitive.bounds = turned(primitive.bounds);
}

// The instances that are skies, each by its only piece.
std::vector<std::size_t> skies_that_cast(const Scene& scene) {
  std::vector<std::size_t> skies;
  for (const detail::Piece& piece : detail::view_subject(scene).skies) {
    const bool whole = 3 * piece.triangles.size() == scene.primitives[piece.instance->primitive].index_count;
    if (whole && piece.instance->casts)
      skies.push_back(static_cast<std::size_t>(piece.instance - scene.instances.data()));
  }
  return skies;
}

}  // namespace

void turn_up(UpAxis up, Scene& scene) {
  if (up == UpAxis::y) return;
  // A skin that moves puts its vertices into world space in each pose: their instances stay there.
  std::vector<bool> in_world(scene.instances.size(), false);
  for (const DeformedMesh& mesh : scene.motion.meshes)
    if (mesh.skin >= 0) in_world[mesh.instance] = true;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    Instance& instance = scene.instances[i];
    if (in_world[i])
      turn_vertices(scene.primitives[instance.primitive], scene);
    else
      instance.world_from_object = turned(instance.world_from_object);
    instance.bounds_world = turned(instance.bounds_world);
  }
  scene.bounds_world = turned(scene.bounds_world);
  for (MotionNode& node : scene.motion.nodes)
    if (node.parent < 0) node.world_from_parent = turned(node.world_from_parent);
  for (SceneLight& of_file : scene.lights)
    std::visit(
        [](auto& light) {
          if constexpr (requires { light.position; }) light.position = turned(light.position);
          if constexpr (requires { light.direction; }) light.direction = turned(light.direction);
        },
        of_file.light);
  for (SceneCamera& camera : scene.cameras) {
    camera.position = turned(camera.position);
    camera.forward = turned(camera.forward);
    camera.up = turned(camera.up);
  }
}

bool has_sky_that_casts(const Scene& scene) {
  return !skies_that_cast(scene).empty();
}

void open_sky(Scene& scene) {
  for (const std::size_t sky : skies_that_cast(scene)) scene.instances[sky].casts = false;
}

bool has_ground(const Scene& scene) {
  constexpr int kSamples = 24'000, kCells = 12;
  constexpr double kUp = 0.7;  // of a normal: up to 45 degrees steep
  const detail::ViewSubject subject = detail::view_subject(scene);
  if (subject.grounded || !subject.lands.empty()) return true;
  const glm::dvec3 low = subject.bounds.min, size = subject.bounds.max - low;
  if (subject.bounds.empty() || !(size.x > 0.0 && size.z > 0.0)) return false;
  struct Cell {
    double lowest = std::numeric_limits<double>::infinity();
    bool floor = false;  // what is lowest there faces up
  };
  std::array<Cell, kCells * kCells> cells;
  for (const detail::SurfaceSample& sample : detail::surface_samples(scene, subject.pieces, low, kSamples)) {
    const auto part = [](double share) {
      return static_cast<std::size_t>(std::clamp(share * kCells, 0.0, kCells - 1.0));
    };
    Cell& cell = cells[part(sample.at.x / size.x) * kCells + part(sample.at.z / size.z)];
    if (sample.at.y >= cell.lowest) continue;
    cell = {sample.at.y, sample.normal.y > kUp};
  }
  return 2 * std::count_if(cells.begin(), cells.end(), [](const Cell& cell) { return cell.floor; }) >=
         kCells * kCells;
}

void add_ground(Scene& scene) {
  constexpr double kHalf = 8.0, kBelow = 1e-4;  // of the extent
  const detail::ViewSubject subject = detail::view_subject(scene);
  if (subject.bounds.empty()) return;
  const glm::dvec3 size = subject.bounds.max - subject.bounds.min;
  const double extent = std::max({size.x, size.y, size.z});
  if (!(extent > 0.0)) return;
  Material material;
  material.name = "ground";
  material.base_color = {0.5f, 0.5f, 0.5f, 1.0f};
  scene.materials.push_back(material);
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  Primitive primitive;
  primitive.first_index = static_cast<std::uint32_t>(scene.indices.size());
  primitive.material = static_cast<int>(scene.materials.size() - 1);
  for (const auto& [x, z] : {std::pair{-1.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, -1.0f}, {-1.0f, -1.0f}}) {
    scene.positions.emplace_back(x, 0.0f, z);
    scene.normals.emplace_back(0.0f, 1.0f, 0.0f);
    scene.texcoords.emplace_back(0.0f);
    primitive.bounds.extend({x, 0.0, z});
  }
  for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(first + corner);
  primitive.index_count = 6;
  scene.primitives.push_back(primitive);
  Instance ground;
  ground.primitive = static_cast<std::uint32_t>(scene.primitives.size() - 1);
  ground.casts = false;
  // Object units are half sides: a scene far from the origin keeps its ground in single precision.
  glm::dvec3 middle = (subject.bounds.min + subject.bounds.max) * 0.5;
  middle.y = subject.bounds.min.y - kBelow * extent;
  ground.world_from_object = glm::dmat4(kHalf * extent);
  ground.world_from_object[3] = glm::dvec4(middle, 1.0);
  ground.bounds_world = detail::transformed_bounds(scene, primitive, ground.world_from_object);
  scene.instances.push_back(ground);
}

void cut_by(std::span<const SectionPlane> planes, Scene& scene) {
  bool any = false;
  for (const SectionPlane& plane : planes) {
    if (!is_usable(plane)) continue;
    any = true;
    cut_by_one(plane, scene);
  }
  if (!any) return;
  const bool plays = !scene.motion.animations.empty();
  scene.motion = {};
  if (!plays) return;
  scene.warnings.emplace_back("scene: a section is of the scene at rest, its animations are not played");
}

void edit(const SceneEdits& edits, Scene& scene, const LoadLimits& limits) {
  turn_up(edits.up, scene);
  if (edits.open_sky) open_sky(scene);
  if (!edits.proxies.empty())
    cast_by_proxies(load_scene(edits.proxies, limits), edits.proxies, limits, scene);
  cut_by(edits.sections, scene);
  if (edits.ground) add_ground(scene);
}

}  // namespace gnomon
