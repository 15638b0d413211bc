// Which numbers do a frame's maps and pixels hold, where shadows are found by identifiers in place of depths?
// Based on: Hourcade, Nicolas, "Algorithms for Antialiased Cast Shadows", 1985.
#pragma once

#include <cstdint>

#include "casters/scene_buffers.hpp"
#include "frame/target.hpp"
#include "gl/gl_object.hpp"
#include "gnomon/render/renderer.hpp"

namespace gnomon::render {

/// Programs and images of identifiers. Maps keep their depths beside them: the nearest caster writes its
/// number.
class IdentifierPass {
 public:
  /// Numbers the triangles of the scene's instances one after the other. Throws RenderError, also where the
  /// driver has no storage buffers in fragment shaders.
  explicit IdentifierPass(const SceneBuffers& scene);

  /// Makes an image like that of the depths. True where it is new, and holds nothing.
  bool fit(const MapTargets& maps);
  /// What casters' and surfaces' programs number, and where they read it.
  void use(IdentifierOf of) const noexcept;
  /// Makes one layer of the maps, depths and identifiers, the one that is drawn into.
  void attach(const MapTargets& maps, int layer) const noexcept;
  /// Empties what is attached, within the scissor.
  void clear() const noexcept;
  /// Binds the maps and the image that the camera's surfaces wrote, for the mask.
  void bind(GLuint seen_by_camera, int neighbours) const noexcept;

  [[nodiscard]] const Program& opaque() const noexcept { return opaque_; }
  [[nodiscard]] const Program& masked() const noexcept { return masked_; }
  [[nodiscard]] const Program& surfaces() const noexcept { return surfaces_; }
  [[nodiscard]] const Program& mask() const noexcept { return mask_; }
  [[nodiscard]] std::uint64_t bytes() const noexcept;  ///< of the maps' identifiers

 private:
  Program opaque_, masked_, surfaces_, mask_;
  Buffer first_triangle_;
  Texture maps_;
  Framebuffer fbo_ = make_framebuffer();
  int width_ = 0, height_ = 0, layers_ = 0;
};

}  // namespace gnomon::render
