// What stands in for the window where GLFW or Dear ImGui was not there at build time.
#include <stdexcept>

#include "options.hpp"

namespace gnomon::tool::view {

int open_window(const Options&) {
  throw std::runtime_error("view: this program was built without " GNOMON_VIEW_LACKS
                           "; --out FILE.png draws the picture without a window");
}

}  // namespace gnomon::tool::view
