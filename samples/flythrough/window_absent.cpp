// What stands in for the window where GLFW was not there at build time.
#include "flight.hpp"

namespace flythrough {

int fly_in_window(const Options&, const Flight&) {
  throw UsageError("--context glfw: this program was built without GLFW (Debian package libglfw3-dev)");
}

}  // namespace flythrough
