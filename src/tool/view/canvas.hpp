// A picture on the GPU that is put together from the renderer's pictures, images and lines.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>

#include "gnomon/scene/scene.hpp"

namespace gnomon::tool::view {

/// A line in pixels from the upper left corner.
struct ScreenLine {
  glm::dvec2 from{0.0}, to{0.0};
  glm::u8vec4 color{255};
  double width = 1.0;  ///< pixels
};

/// Needs its context current in every call and at destruction.
class Canvas {
 public:
  /// Throws RenderError.
  Canvas();
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Drops the content where the size is another one. Both at least 1.
  void resize(int width, int height);
  [[nodiscard]] int width() const noexcept;
  [[nodiscard]] int height() const noexcept;
  /// OpenGL name of the framebuffer, for Renderer::copy().
  [[nodiscard]] std::uint32_t framebuffer() const noexcept;

  /// Puts the image with its upper left corner at (x, y), clipped to the canvas.
  void put(const Image& image, int x, int y);
  /// Copies the columns begin <= x < end of a canvas of the same size.
  void take(const Canvas& from, int begin, int end);
  void draw(std::span<const ScreenLine> lines);
  [[nodiscard]] Image image() const;
  /// Copies the canvas to the window with its upper left corner at (x, y) of a window this high.
  void show(int x, int y, int window_height) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The content of the window's back buffer. `width` and `height`: its size in pixels.
[[nodiscard]] Image window_image(int width, int height);
/// Fills the window's back buffer with one colour.
void clear_window(int width, int height);
/// Waits until all that was drawn is there, so that its time can be taken.
void finish_gl();
/// The first OpenGL error since the last call, as a number; 0: none.
[[nodiscard]] unsigned last_gl_error();

}  // namespace gnomon::tool::view
