// Many lights on the GPU: their numbers, their maps, and the lists by which pixels find them.
#include "light_lists.hpp"

#include <algorithm>
#include <array>

namespace gnomon::render {
namespace {

// Bindings as shaders/common/own_light.glsl and shaders/shade_clusters.frag state them.
constexpr GLuint kLightBinding = 2, kMapBinding = 3, kBeginBinding = 4, kListBinding = 5;
constexpr GLint kStorageBlocks = 4;
// With more entries clusters become larger.
constexpr std::size_t kFirstEntries = std::size_t{1} << 16, kMostEntries = std::size_t{1} << 22;

/// ClusterBegins of shaders/shade_clusters.frag before its list.
struct ClusterHeader {
  glm::ivec4 size;
  glm::vec4 depth;
};

struct Part {
  const void* data;
  std::size_t bytes;
};

/// One buffer of two parts.
void send_parts(Buffer& buffer, GLuint binding, const Part& first, const Part& second = {nullptr, 0}) {
  buffer = make_buffer();
  const std::size_t bytes = std::max<std::size_t>(first.bytes + second.bytes, 16);
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
  glNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(first.bytes), first.data);
  if (second.bytes > 0)
    glNamedBufferSubData(buffer.name(), static_cast<GLintptr>(first.bytes),
                         static_cast<GLsizeiptr>(second.bytes), second.data);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

template <class T>
Part part_of(std::span<const T> values) noexcept {
  return {values.data(), values.size_bytes()};
}

}  // namespace

bool LightLists::are_supported() noexcept {
  GLint blocks = 0;
  glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &blocks);
  return blocks >= kStorageBlocks;
}

void LightLists::clear() noexcept {
  lights_.clear();
  own_.clear();
  maps_.clear();
}

void LightLists::add(const Light& light, const FrameBlock& block, const glm::vec3& color) {
  lights_.push_back(light);
  const auto first = static_cast<float>(maps_.size());
  own_.push_back({block.light, block.light_place, block.light_cone, block.bias, block.layer, block.selection,
                  glm::vec4(color, first)});
  maps_.insert(maps_.end(), block.maps.begin(),
               block.maps.begin() + static_cast<std::ptrdiff_t>(block.light.w));
}

LightClusters LightLists::list(const Camera& camera, const ClusterOptions& options) {
  begin_.resize(cluster_count(camera, options) + 1);
  for (;;) {
    const std::size_t entries = std::max({listed_.size(), kFirstEntries, lights_.size()});
    listed_.resize(entries);
    entries_.resize(entries);
    const LightClusters clusters = cluster_lights(camera, lights_, options, {begin_, listed_, entries_});
    const bool coarser = clusters.status == PlanStatus::ok && clusters.begin.size() < begin_.size();
    if (!coarser || entries >= kMostEntries) return clusters;
    listed_.resize(2 * entries);
  }
}

bool LightLists::send(const Camera& camera, const ClusterOptions& options) {
  const LightClusters clusters = list(camera, options);
  if (clusters.status != PlanStatus::ok) return false;
  const ClusterHeader header{{clusters.columns, clusters.rows, clusters.slices, clusters.tile_pixels},
                             glm::vec4(glm::dvec4(clusters.depth_scale, clusters.depth_offset,
                                                  clusters.orthographic ? 1.0 : 0.0, 0.0))};
  send_parts(own_buffer_, kLightBinding, part_of(std::span<const OwnLight>(own_)));
  send_parts(map_buffer_, kMapBinding, part_of(std::span<const MapBlock>(maps_)));
  send_parts(begin_buffer_, kBeginBinding, {&header, sizeof header}, part_of(clusters.begin));
  send_parts(list_buffer_, kListBinding, part_of(clusters.lights));
  return true;
}

}  // namespace gnomon::render
