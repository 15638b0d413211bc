// What stands in for a window where GLFW was not there at build time.
#include "gnomon/render/error.hpp"
#include "gnomon/render/window.hpp"

namespace gnomon::render {

std::unique_ptr<Window> create_window(int, int, const std::string&) {
  throw RenderError("GLFW: this program was built without it (Debian package libglfw3-dev)");
}

}  // namespace gnomon::render
