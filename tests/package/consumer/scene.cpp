// Asks the installed scene library for a scene that it does not have: the exception is caught by its own
// type.
#include <cstdio>

#include "all_headers.hpp"

int main() {
  try {
    (void)gnomon::load_builtin("no such scene");
  } catch (const gnomon::SceneError& error) {
    std::printf("consumer of scene: %s\n", error.what());
    return gnomon::builtin_scenes().empty() ? 1 : 0;
  }
  return 1;
}
