// Everything at the size of the picture: its images, the blocks that shaders read, passes over all pixels.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "casters/caster_scene.hpp"
#include "frame/frame_block.hpp"
#include "frame/target.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/render/frame_options.hpp"

namespace gnomon::render {

/// What the camera's surfaces are drawn into, and by what.
struct SurfacePass {
  GLuint fbo = 0;
  const Program* program = nullptr;  ///< writes at least what Screen::surfaces() writes
  int choice = 0;                    ///< the variant that its uniforms select
};

class Screen {
 public:
  explicit Screen(const CasterScene& casters);

  /// Makes both blocks those that all shaders read.
  void upload(const FrameBlock& frame, const FilterBlock& filtering) noexcept;
  /// Sends the filter's block alone.
  void upload(const FilterBlock& filtering) noexcept;
  /// Draws what the draw lists have for the camera. Draws nothing, and returns false, where the images have
  /// it already.
  bool draw_surfaces(const SurfacePass& by, const glm::dvec3& camera_world, const FrameBlock& frame) noexcept;
  /// The images of the surfaces pass, for shaders that read them.
  void bind_surfaces() const noexcept;
  /// Draws over all of `fbo` with `program`; the images of the surfaces pass are bound.
  void fullscreen(GLuint fbo, const Program& program) const noexcept;
  /// The mask, for shaders that read it.
  void bind_mask() const noexcept;
  /// Makes the noise tile at the first frame that reads it.
  void bind_noise(SampleNoise noise);

  /// What every frame draws surfaces with that needs nothing more of them.
  [[nodiscard]] SurfacePass surfaces() const noexcept;
  [[nodiscard]] GLuint filter_buffer() const noexcept { return filter_buffer_.name(); }

  FrameTargets targets;

 private:
  /// Everything that the images of the surfaces pass depend on.
  struct Seen {
    GLuint fbo = 0, program = 0;
    int choice = 0;
    glm::ivec2 size{0};
    glm::dvec3 camera_world{0.0};
    glm::mat4 clip_from_camera_relative{0.0f};
    glm::vec4 forward{0.0f};
    std::uint64_t scene_changes = 0;
    bool operator==(const Seen&) const = default;
  };

  const CasterScene& casters_;
  Seen seen_;
  Program surfaces_;
  Buffer frame_buffer_, filter_buffer_;
  VertexArray no_vertices_;
  Texture noise_tile_;  ///< blue noise
};

}  // namespace gnomon::render
