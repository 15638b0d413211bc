// Which pixels look into each texel of a frame's maps? Casters are tested against those pixels in place of a
// depth. Based on: Johnson et al., The Irregular Z-Buffer, 2005; Aila, Laine, Alias-Free Shadow Maps, 2004;
// Sintorn et al., Sample Based Visibility for Soft Shadows, 2008; Wyman et al., Frustum-Traced Raster
// Shadows, 2015.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gl/gl_object.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/plan.hpp"

namespace gnomon::render {

/// The uniform block LightFrames of shaders/pass/lists/lists.glsl.
struct LightFrames {
  std::array<glm::vec4, 3 * kMaxMaps> row;
  glm::vec4 light;
};
/// `scene_extent`: the largest terms that the rounding of coordinates is measured by, world units.
[[nodiscard]] LightFrames light_frames(const ShadowPlan& plan, const Camera& camera,
                                       double scene_extent) noexcept;

/// Programs and memory of the lists. One list per texel, linked through one entry per sample: no list
/// overflows.
class PixelLists {
 public:
  /// Compiles the programs. Throws RenderError, also where the driver has no storage buffers in fragment
  /// shaders.
  PixelLists();

  /// True where the driver can hold an entry for each sample of so many pixels.
  [[nodiscard]] bool fits(int width, int height, int samples) const noexcept;
  /// Makes room for the pixels of a frame with so many samples each, and empty lists for texels of maps of at
  /// most this size.
  void clear(glm::ivec2 frame, int samples, glm::ivec2 map, int maps);
  /// Binds the frame's light for all of its passes, before its surfaces are drawn.
  void set_light(const LightFrames& frames) noexcept;
  /// Lists the pixels of the surfaces whose images are bound and whose heights these are, and writes what the
  /// mask is without casters.
  void list(GLuint heights, GLuint mask) noexcept;
  /// Binds what the casters' programs read and write, and their framebuffer.
  void bind(GLuint mask) const noexcept;
  /// Once all casters are drawn: of several samples a pixel, the share that light reaches.
  void average(GLuint mask) const noexcept;

  /// Draws surfaces with their heights.
  [[nodiscard]] const Program& surfaces() const noexcept { return surfaces_; }
  [[nodiscard]] const Program& opaque() const noexcept { return opaque_; }
  [[nodiscard]] const Program& masked() const noexcept { return masked_; }
  [[nodiscard]] int samples() const noexcept { return samples_; }
  /// Samples of all pixels.
  [[nodiscard]] std::uint64_t entries() const noexcept;
  [[nodiscard]] std::uint64_t bytes() const noexcept;
  /// Lengths of the lists that are not empty, in no order.
  [[nodiscard]] std::vector<std::uint32_t> lengths() const;

 private:
  void dispatch() const noexcept;

  Program surfaces_, list_, opaque_, masked_, mean_;
  Texture heads_;
  Buffer pixels_, frames_ = make_buffer();
  Framebuffer fbo_ = make_framebuffer();
  glm::ivec2 frame_{0}, map_{0};
  int layers_ = 0, samples_ = 1;
  std::uint64_t most_bytes_ = 0;  ///< of a storage buffer
};

}  // namespace gnomon::render
