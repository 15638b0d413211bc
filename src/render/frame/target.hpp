// The images a frame is drawn into.
#pragma once

#include <cstdint>

#include "gl/gl_object.hpp"
#include "gnomon/motion.hpp"

namespace gnomon::render {

/// One value per pixel, read without a filter.
[[nodiscard]] Texture pixel_image(GLenum format, int width, int height);
/// Depths as shadow maps store them.
[[nodiscard]] Texture depth_layers(int width, int height, int layers);
/// Draws depths alone, into what is attached later.
[[nodiscard]] Framebuffer depth_framebuffer();

/// Everything at the size of the picture.
struct FrameTargets {
  int width = 0, height = 0;
  Texture position, normal, albedo, depth, mask, color, aliasing, heat, tint;
  Framebuffer surfaces_fbo, mask_fbo, color_fbo, aliasing_fbo, heat_fbo, tint_fbo;

  Texture off_plane;           ///< heights of positions over their triangles' planes; made by add_off_plane
  Framebuffer off_plane_fbo;   ///< surfaces_fbo with those
  Texture identifier;          ///< numbers of what pixels show; made by add_identifiers
  Framebuffer identified_fbo;  ///< surfaces_fbo with those

  /// Makes all images anew where the size differs.
  void resize(int new_width, int new_height);
  /// Makes the image of heights where there is none of this size.
  void add_off_plane();
  /// The same of identifiers.
  void add_identifiers();

 private:
  /// `fourth`: nullptr, or an image more that is drawn into.
  [[nodiscard]] Framebuffer surfaces_framebuffer(const Texture* fourth) const;
};

/// One layer per shadow map; a map smaller than the layers uses their lower left corner.
struct MapTargets {
  int width = 0, height = 0, layers = 0;
  Texture depth;
  Texture scratch;  ///< one layer, made by the first move()
  Texture beneath;  ///< static casters alone, layer by layer; made by add_beneath()
  Framebuffer fbo;
  Sampler compare_sampler;  ///< compares, bilinear
  Sampler plain_sampler;    ///< reads depths, nearest

  /// Depths of all casters, or of static ones alone.
  enum class Of : std::uint8_t { all, static_casters };

  MapTargets();
  /// Grows to hold maps of this size; never shrinks the number of layers. More layers of the same size keep
  /// what they hold. True where all maps are new.
  bool fit(int new_width, int new_height, int new_layers);
  /// Copies what lies in the rectangle of a layer, once moved by `shift`, from where it is now.
  void move(Of which, int layer, const TexelRect& to, int shift_x, int shift_y) noexcept;
  /// Makes one layer of these depths the one that is drawn into.
  void attach(Of which, int layer) const noexcept;
  /// Binds the depths of all casters where look-ups read them.
  void bind() const noexcept;
  /// Makes room for the depths of static casters, where there is none.
  void add_beneath();
  /// Copies a rectangle of a layer into these depths from the others.
  void copy(Of into_which, int layer, const TexelRect& at) const noexcept;
  [[nodiscard]] std::uint64_t bytes() const noexcept;
};

}  // namespace gnomon::render
