// Loads one scene and says how it went: exit 0 with a summary, or 2 with one line that says why not. Made to
// be run on hostile files in a process of its own.
#include <cstdio>
#include <exception>

#include "gnomon/scene/load.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: load_scene_main FILE\n");
    return 64;
  }
  try {
    const gnomon::Scene scene = gnomon::load_scene(argv[1]);
    std::printf("triangles %llu instances %zu images %zu warnings %zu\n",
                static_cast<unsigned long long>(scene.triangle_count()), scene.instances.size(),
                scene.images.size(), scene.warnings.size());
    for (const std::string& warning : scene.warnings) std::printf("warning %s\n", warning.c_str());
    return 0;
  } catch (const gnomon::SceneError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
