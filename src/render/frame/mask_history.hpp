// What is kept of the mask from frame to frame: two images that take turns, and where the camera was.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "frame/frame_block.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::render {

/// Boxes that shaders/pass/mask/accumulate.frag has room for. Of more the last one is round all that are
/// left.
inline constexpr std::size_t kMaxMovedBoxes = 32;

class MaskHistory {
 public:
  /// Makes the images of this size at the first call and where it differs, and forgets what they held.
  void resize(int width, int height);
  void forget() noexcept { valid_ = false; }
  /// Bounds of casters that moved since the last frame, before and after: the next frame forgets pixels in
  /// their shadow.
  void forget_behind(std::span<const Box> moved_world) noexcept;
  /// The framebuffer for this frame's mask alone.
  [[nodiscard]] GLuint single_fbo() const noexcept { return single_fbo_.name(); }
  /// Binds this frame's mask and the history, and the block that shaders/pass/mask/accumulate.frag reads.
  void bind(const Camera& camera, const Accumulation& settings) noexcept;
  /// Where the pass draws: `mask` first, the new history second.
  [[nodiscard]] GLuint fbo_with(const Texture& mask) noexcept;
  /// Ends the frame: it is the one before, from now on.
  void keep(const Camera& camera, const FrameBlock& frame) noexcept;

 private:
  int width_ = 0, height_ = 0;
  bool valid_ = false;
  std::size_t current_ = 0;  ///< image that this frame's history goes to
  Texture single_;
  std::array<Texture, 2> history_;
  std::array<Framebuffer, 2> fbo_;
  Framebuffer single_fbo_;
  Buffer block_;
  std::array<Box, kMaxMovedBoxes> moved_;
  std::size_t moved_count_ = 0;
  glm::dmat4 clip_from_relative_{1.0};  ///< of the frame before
  glm::dvec3 eye_{0.0}, forward_{0.0, 0.0, -1.0};
};

}  // namespace gnomon::render
