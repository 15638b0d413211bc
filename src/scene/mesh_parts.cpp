// Halves a mesh along its longest side, so that each half has as many triangles.
#include "mesh_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <span>

#include "bounds_of.hpp"

namespace gnomon::detail {
namespace {

// Each box costs a plan time (docs/survey.md#boxes-of-parts).
constexpr std::size_t kShares = 128;
// A box costs more than so few triangles leave empty.
constexpr std::size_t kFewTriangles = 16;

struct Triangle {
  glm::vec3 middle;  ///< of its box, single precision: it only says which half
  std::uint32_t first_index;
};

class Halving {
 public:
  Halving(const Scene& scene, std::size_t largest, std::vector<MeshPart>& parts)
      : scene_(scene), largest_(largest), parts_(parts) {}

  void add(std::uint32_t instance) {
    instance_ = instance;
    const Primitive& primitive = scene_.primitives[scene_.instances[instance].primitive];
    triangles_.clear();
    for (std::uint32_t i = 0; i < primitive.index_count; i += 3) {
      const std::uint32_t first = primitive.first_index + i;
      const Box box = box_of(first);
      triangles_.push_back({glm::vec3(0.5 * (box.min + box.max)), first});
    }
    halve(triangles_);
  }

 private:
  [[nodiscard]] Box box_of(std::uint32_t first_index) const {
    return transformed_bounds(scene_, Primitive{first_index, 3, 0, {}},
                              scene_.instances[instance_].world_from_object);
  }

  void halve(std::span<Triangle> triangles) {
    if (triangles.size() <= largest_) {
      MeshPart part{instance_, {}};
      for (const Triangle& triangle : triangles) part.bounds_world.extend(box_of(triangle.first_index));
      parts_.push_back(part);
      return;
    }
    glm::vec3 low = triangles.front().middle, high = low;
    for (const Triangle& triangle : triangles) {
      low = glm::min(low, triangle.middle);
      high = glm::max(high, triangle.middle);
    }
    const glm::vec3 side = high - low;
    const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    const std::size_t half = triangles.size() / 2;
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half),
                     triangles.end(),
                     [&](const Triangle& a, const Triangle& b) { return a.middle[axis] < b.middle[axis]; });
    halve(triangles.first(half));
    halve(triangles.subspan(half));
  }

  const Scene& scene_;
  std::size_t largest_;
  std::vector<MeshPart>& parts_;
  std::uint32_t instance_ = 0;
  std::vector<Triangle> triangles_;
};

}  // namespace

std::vector<MeshPart> mesh_parts(const Scene& scene) {
  const auto triangles = [&](const Instance& instance) -> std::size_t {
    return instance.receives ? scene.primitives[instance.primitive].index_count / 3 : 0;
  };
  std::size_t all = 0;
  for (const Instance& instance : scene.instances) all += triangles(instance);
  const std::size_t largest = std::max(all / kShares, kFewTriangles);
  std::vector<MeshPart> parts;
  Halving halving(scene, largest, parts);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (triangles(scene.instances[i]) > largest) halving.add(static_cast<std::uint32_t>(i));
  }
  return parts;
}

}  // namespace gnomon::detail
