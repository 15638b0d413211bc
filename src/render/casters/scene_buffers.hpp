// A scene on the GPU, and the order in which its instances are drawn.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "casters/caster_clusters.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon::render {

/// Instances that one state of the pipeline draws: entries [begin, end) of SceneBuffers::order.
struct Batch {
  std::uint32_t begin = 0, end = 0;
  bool masked = false, double_sided = false, mirrored = false, receives = true;
  glm::vec4 base_color{1.0f};
  float alpha_cutoff = -1.0f;  ///< nothing is below it
  AlphaMode alpha_mode = AlphaMode::opaque;
  float transmission = 0.0f;
  GLuint texture = 0, sampler = 0;
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;  ///< as the sampler's
};

/// glMultiDrawElementsIndirect's own layout.
struct DrawCommand {
  std::uint32_t index_count, instance_count, first_index;
  std::int32_t base_vertex;
  std::uint32_t base_instance;
};

class SceneBuffers {
 public:
  /// Uploads everything that does not change. Throws RenderError where an image exceeds the driver's limit.
  explicit SceneBuffers(const Scene& scene);

  /// Who draws: maps are drawn from an origin of their own, so that they stay what they are under a camera
  /// that moves.
  enum class Placed : std::uint8_t { for_camera, for_maps };
  /// Sends the instances' matrices relative to `origin_world`, where they are not there yet.
  void place(Placed placed, const glm::dvec3& origin_world);
  /// Places one instance elsewhere, with other bounds; seen by the next place().
  void move(std::size_t instance, const Instance& to);
  /// Replaces vertices from `first` on. Their arrays are of one length.
  void bend(std::uint32_t first, std::span<const glm::vec3> positions, std::span<const glm::vec3> normals);
  [[nodiscard]] std::size_t vertex_count() const noexcept { return vertex_count_; }
  /// Grows with every move() and bend().
  [[nodiscard]] std::uint64_t changes() const noexcept { return changes_; }
  /// Takes those for the next draws.
  void use(Placed placed) const noexcept;
  /// The maps' origin follows the camera in steps of this length, a power of two: 1/4 of the scene's extent
  /// or less. Each step draws what is kept again; longer ones round positions near the camera more coarsely.
  [[nodiscard]] double origin_step() const noexcept { return origin_step_; }
  /// Diagonal of the box round all instances, or round most of them where few lie far off; world units; 0 for
  /// an empty scene.
  [[nodiscard]] double extent() const noexcept { return extent_; }

  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept { return order_; }
  [[nodiscard]] std::span<const Batch> batches() const noexcept { return batches_; }
  /// Parts of large casters, for maps: their runs are of this scene's index buffer.
  [[nodiscard]] CasterClusters& clusters() noexcept { return clusters_; }
  [[nodiscard]] std::span<const Box> boxes() const noexcept { return boxes_; }
  /// Instance::casts.
  [[nodiscard]] bool casts(std::uint32_t instance) const noexcept { return casts_[instance]; }
  /// Instance::shown.
  [[nodiscard]] bool shown(std::uint32_t instance) const noexcept { return shown_[instance]; }
  [[nodiscard]] const Primitive& primitive_of(std::uint32_t instance) const noexcept {
    return primitives_[primitive_of_[instance]];
  }
  /// As shaders have it, whose upper part is rounded to single precision.
  [[nodiscard]] glm::dmat4 world_from_object(std::uint32_t instance) const noexcept;
  [[nodiscard]] std::uint64_t triangles_of(std::uint32_t instance) const noexcept {
    return primitive_of(instance).index_count / 3;
  }
  [[nodiscard]] std::uint32_t primitive_index(std::uint32_t instance) const noexcept {
    return primitive_of_[instance];
  }
  [[nodiscard]] GLuint vertex_array() const noexcept { return vertex_array_.name(); }
  /// As uploaded, or bent since; waits for the driver.
  [[nodiscard]] std::vector<glm::vec3> read_positions() const;
  [[nodiscard]] std::vector<glm::vec3> read_positions(std::uint32_t first, std::size_t count) const;
  [[nodiscard]] std::vector<std::uint32_t> read_indices(const Primitive& primitive) const;
  /// The same triangles, in an order in which neighbours are near each other.
  [[nodiscard]] std::vector<std::uint32_t> read_near_indices(std::uint32_t primitive) const;
  [[nodiscard]] std::span<const Primitive> primitives() const noexcept { return primitives_; }
  [[nodiscard]] GLuint index_buffer() const noexcept { return indices_.name(); }
  /// The vertex attribute that says which object a vertex belongs to comes from this buffer.
  void set_object_index_buffer(GLuint buffer) const noexcept;

 private:
  struct Row4 {
    float value[4];
  };
  struct Object {
    Row4 row[3];
  };
  [[nodiscard]] std::vector<std::uint32_t> read_indices(const IndexRun& run) const;
  void upload_vertices(const Scene& scene);
  void upload_images(const Scene& scene);
  /// Sorts the instances by what they are drawn with.
  void make_batches();
  [[nodiscard]] GLuint sampler_for(const Material& material);

  std::vector<Primitive> primitives_;
  CasterClusters clusters_;
  std::vector<Material> materials_;
  std::vector<bool> mirrored_, casts_, receives_, shown_;  ///< by instance
  std::size_t vertex_count_ = 0;
  std::uint64_t changes_ = 0;
  std::vector<std::uint32_t> primitive_of_;
  std::vector<glm::dvec3> translation_;
  std::vector<Box> boxes_;
  std::vector<Object> objects_;
  std::vector<std::uint32_t> order_;
  std::vector<Batch> batches_;
  VertexArray vertex_array_;
  Buffer positions_, normals_, texcoords_, indices_;
  struct Placement {
    Buffer buffer;
    std::optional<glm::dvec3> origin_world;
  };
  std::array<Placement, 2> placement_;  ///< by Placed
  double origin_step_ = 1.0, extent_ = 0.0;
  std::vector<Texture> textures_;
  std::vector<Sampler> samplers_;  ///< by wrap_u * 3 + wrap_v
  Texture white_;
};

}  // namespace gnomon::render
