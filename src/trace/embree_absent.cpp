// What stands in for Embree where it was not there at build time.
#include "embree_scene.hpp"

namespace gnomon::trace {

bool built_with_embree() noexcept {
  return false;
}

std::unique_ptr<EmbreeScene> make_embree_scene(const WorldTriangles&) {
  throw TraceError("this program was built without Embree (Debian package libembree-dev)");
}

}  // namespace gnomon::trace
