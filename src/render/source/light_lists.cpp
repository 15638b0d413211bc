// Many lights on the GPU: their numbers, their maps, and the lists by which pixels find them.
#include "source/light_lists.hpp"

#include <algorithm>

namespace gnomon::render {
namespace {

// Bindings as shaders/pass/mask/source/clusters.glsl and shaders/pass/shade/clusters.frag state them.
constexpr GLuint kLightBinding = 2, kMapBinding = 3, kBeginBinding = 4, kListBinding = 5;
constexpr GLint kStorageBlocks = 4;
// With more entries clusters become larger.
constexpr std::size_t kFirstEntries = std::size_t{1} << 16, kMaxEntries = std::size_t{1} << 22;

/// ClusterBegins of shaders/pass/shade/clusters.frag before its list.
struct ClusterHeader {
  glm::ivec4 size;
  glm::vec4 depth;
};

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
    if (!coarser || entries >= kMaxEntries) return clusters;
    listed_.resize(2 * entries);
  }
}

bool LightLists::send(const Camera& camera, const ClusterOptions& options) {
  const LightClusters clusters = list(camera, options);
  if (clusters.status != PlanStatus::ok) return false;
  const ClusterHeader header{{clusters.columns, clusters.rows, clusters.slices, clusters.tile_pixels},
                             glm::vec4(glm::dvec4(clusters.depth_scale, clusters.depth_offset,
                                                  clusters.orthographic ? 1.0 : 0.0, 0.0))};
  own_buffer_ = filled_buffer(own_);
  map_buffer_ = filled_buffer(maps_);
  begin_buffer_ = filled_buffer({std::as_bytes(std::span(&header, 1)), std::as_bytes(clusters.begin)});
  list_buffer_ = filled_buffer({std::as_bytes(clusters.lights)});
  const auto bind = [](GLuint binding, const Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
  };
  bind(kLightBinding, own_buffer_);
  bind(kMapBinding, map_buffer_);
  bind(kBeginBinding, begin_buffer_);
  bind(kListBinding, list_buffer_);
  return true;
}

}  // namespace gnomon::render
