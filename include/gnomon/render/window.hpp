// A window to draw into. In its own library, gnomon::window: programs without a display never load GLFW.
#pragma once

#include <memory>
#include <string>

#include "gnomon/render/context.hpp"

struct GLFWwindow;

namespace gnomon::render {

/// A context whose default framebuffer is a window. Input is read through GLFW with handle().
class Window : public Context {
 public:
  /// The window for GLFW's functions; valid while this lives.
  [[nodiscard]] virtual GLFWwindow* handle() const noexcept = 0;
};

/// Opens a window of this size in screen units and makes its context current. Throws RenderError where there
/// is no display or no OpenGL 4.5.
[[nodiscard]] std::unique_ptr<Window> create_window(int width, int height, const std::string& title);

}  // namespace gnomon::render
