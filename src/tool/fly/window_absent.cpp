// What stands in for the window where GLFW was not there at build time.
#include <stdexcept>

#include "flight.hpp"

namespace gnomon::tool::fly {

int fly_in_window(const Options&, Flight&) {
  throw std::runtime_error(
      "--context glfw: this program was built without GLFW (Debian package libglfw3-dev)");
}

}  // namespace gnomon::tool::fly
