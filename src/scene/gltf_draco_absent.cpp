// KHR_draco_mesh_compression in a build without libdraco: what the file has beside it is used.
#include "gltf_compression.hpp"

namespace gnomon::detail {

bool decodes_draco() noexcept {
  return false;
}

void decode_draco_primitives(Compressed&) {}

}  // namespace gnomon::detail
