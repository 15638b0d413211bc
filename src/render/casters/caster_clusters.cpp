// Bounds of runs of triangles, and of groups of runs.
#include "casters/caster_clusters.hpp"
#include "gnomon/extend/body.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace gnomon::render {
namespace {

// Fewer draw more commands, more draw triangles that a map does not need.
constexpr std::uint32_t kClusterIndices = 3 * 64;
constexpr std::size_t kGroupClusters = 16;
// A primitive of fewer is not worth a command more.
constexpr std::uint32_t kLeastIndices = 2 * kClusterIndices;
// Clusters outside that are drawn all the same where they lie between others: a command costs more.
constexpr std::uint32_t kBridgedIndices = kClusterIndices;
// Relative to the distance from the object's origin: of single precision, and of the matrix on the GPU.
constexpr float kRounding = 1e-6f;
// Triangles are sorted where the surfaces of their clusters' bounds are so many times the surface of the
// whole's, and a copy of the indices is kept where that makes them so much smaller.
constexpr float kScattered = 3.0f, kWorthACopy = 0.7f;

float surface(const glm::vec3& size) noexcept {
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// The lowest ten bits, each followed by two zeros.
std::uint32_t spread(std::uint32_t bits) noexcept {
  bits = (bits | bits << 16) & 0x030000FFu;
  bits = (bits | bits << 8) & 0x0300F00Fu;
  bits = (bits | bits << 4) & 0x030C30C3u;
  return (bits | bits << 2) & 0x09249249u;
}

/// The triangles along a curve through their bounds that keeps neighbours together (Morton 1966).
std::vector<std::uint32_t> sorted_by_place(const Scene& scene, std::span<const std::uint32_t> indices,
                                           const glm::vec3& low, const glm::vec3& size) {
  constexpr float kSteps = 1023.0f;
  const glm::vec3 scale = kSteps / glm::max(size, glm::vec3(1e-30f));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order(indices.size() / 3);  // place, triangle
  for (std::uint32_t t = 0; t < order.size(); ++t) {
    const std::uint32_t* const corner = &indices[3 * std::size_t{t}];
    const glm::vec3 middle =
        (scene.positions[corner[0]] + scene.positions[corner[1]] + scene.positions[corner[2]]) / 3.0f;
    const glm::uvec3 step(glm::clamp((middle - low) * scale, 0.0f, kSteps));
    order[t] = {spread(step.x) | spread(step.y) << 1 | spread(step.z) << 2, t};
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> sorted;
  sorted.reserve(indices.size());
  for (const auto& [place, triangle] : order)
    sorted.insert(sorted.end(), &indices[3 * std::size_t{triangle}], &indices[3 * std::size_t{triangle}] + 3);
  return sorted;
}

}  // namespace

float CasterClusters::add_clusters(const Scene& scene, std::span<const std::uint32_t> indices, Part& part) {
  const auto bounds_of = [](const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 middle = 0.5f * low + 0.5f * high;
    const glm::vec3 half = glm::max(high - middle, middle - low);
    return Bounds{middle, half + kRounding * (glm::abs(middle) + half)};
  };
  part.first_cluster = clusters_.size();
  part.first_group = groups_.size();
  part.cluster_count = 0;
  part.first_vertex = ~0u;
  part.last_vertex = 0;
  glm::vec3 group_low(0.0f), group_high(0.0f);
  float surfaces = 0.0f;
  for (std::size_t begin = 0; begin < indices.size(); begin += kClusterIndices) {
    const std::size_t end = std::min(begin + kClusterIndices, indices.size());
    glm::vec3 low = scene.positions[indices[begin]], high = low;
    for (const std::uint32_t index : indices.subspan(begin, end - begin)) {
      low = glm::min(low, scene.positions[index]);
      high = glm::max(high, scene.positions[index]);
      part.first_vertex = std::min(part.first_vertex, index);
      part.last_vertex = std::max(part.last_vertex, index);
    }
    const bool first_of_group = part.cluster_count % kGroupClusters == 0;
    group_low = first_of_group ? low : glm::min(group_low, low);
    group_high = first_of_group ? high : glm::max(group_high, high);
    if (first_of_group) groups_.emplace_back();
    groups_.back() = bounds_of(group_low, group_high);
    clusters_.push_back(bounds_of(low, high));
    surfaces += surface(high - low);
    ++part.cluster_count;
  }
  return surfaces;
}

void CasterClusters::drop_clusters(const Part& part) {
  clusters_.resize(part.first_cluster);
  groups_.resize(part.first_group);
}

CasterClusters::CasterClusters(const Scene& scene) : parts_(scene.primitives.size()) {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Primitive& primitive = scene.primitives[p];
    Part& part = parts_[p];
    part.first_index = primitive.first_index;
    part.index_count = primitive.index_count;
    if (primitive.index_count < kLeastIndices) continue;
    const std::span indices(scene.indices.data() + primitive.first_index, primitive.index_count);
    const float in_file = add_clusters(scene, indices, part);
    const glm::vec3 low(primitive.bounds.min), size(primitive.bounds.max - primitive.bounds.min);
    if (!(in_file > kScattered * surface(size))) continue;
    const std::vector<std::uint32_t> sorted = sorted_by_place(scene, indices, low, size);
    drop_clusters(part);
    if (add_clusters(scene, sorted, part) < kWorthACopy * in_file) {
      part.first_index = static_cast<std::uint32_t>(scene.indices.size() + sorted_.size());
      sorted_.insert(sorted_.end(), sorted.begin(), sorted.end());
      continue;
    }
    drop_clusters(part);
    (void)add_clusters(scene, indices, part);
  }
}

void CasterClusters::forget(std::uint32_t first, std::size_t count) noexcept {
  for (Part& part : parts_) {
    if (part.cluster_count > 0 && part.last_vertex >= first && part.first_vertex < first + count)
      part.cluster_count = 0;
  }
}

bool CasterClusters::outside(const Bounds& bounds) const noexcept {
  return std::any_of(planes_.begin(), planes_.end(), [&bounds](const glm::vec4& plane) {
    const glm::vec3 normal(plane);
    const float reach = glm::dot(normal, bounds.middle) + glm::dot(glm::abs(normal), bounds.half);
    // What rounds here, rounds by a few steps of the largest term.
    return reach + plane.w <
           -kRounding * (glm::dot(glm::abs(normal), glm::abs(bounds.middle)) + glm::abs(plane.w));
  });
}

void CasterClusters::add(const Part& part, std::size_t cluster) {
  const auto begin = static_cast<std::uint32_t>(cluster * kClusterIndices);
  const std::uint32_t end = std::min(begin + kClusterIndices, part.index_count);
  if (!runs_.empty()) {
    IndexRun& last = runs_.back();
    if (part.first_index + begin - (last.first_index + last.index_count) <= kBridgedIndices) {
      last.index_count = part.first_index + end - last.first_index;
      return;
    }
  }
  runs_.push_back({part.first_index + begin, end - begin});
}

std::span<const IndexRun> CasterClusters::within(std::uint32_t primitive, const glm::dmat4& world_from_object,
                                                 std::span<const glm::dvec4> planes) {
  const Part& part = parts_[primitive];
  planes_.clear();
  for (const glm::dvec4& plane : planes) {
    // The plane's row times the matrix.
    const glm::dvec4 of_object = plane * world_from_object;
    planes_.emplace_back(of_object);
  }
  runs_.clear();
  for (std::size_t begin = 0; begin < part.cluster_count; begin += kGroupClusters) {
    if (outside(groups_[part.first_group + begin / kGroupClusters])) continue;
    const std::size_t end = std::min(begin + kGroupClusters, part.cluster_count);
    for (std::size_t cluster = begin; cluster < end; ++cluster) {
      if (!outside(clusters_[part.first_cluster + cluster])) add(part, cluster);
    }
  }
  return runs_;
}

}  // namespace gnomon::render
