// The `flythrough` program: `gnomon fly` under a name of its own.
#include "command.hpp"

namespace gnomon::tool {
std::function<int()> declare_fly(Arguments& arguments);
}

int main(int argc, char** argv) {
  using namespace gnomon::tool;
  static constexpr Command kFly{"fly", "", "", declare_fly};
  return run_program({"flythrough",
                      "Flies through a scene and draws it with the shadow maps that gnomon plans for each "
                      "frame: the picture, "
                      "the aliasing error per pixel, and which map serves what.",
                      {&kFly, 1},
                      true},
                     argc, argv);
}
