// EXT_meshopt_compression in a build without meshoptimizer: what the file has beside it is used.
#include "gltf_compression.hpp"

namespace gnomon::detail {

bool decodes_meshopt() noexcept {
  return false;
}

void decode_meshopt_views(Compressed&) {}

}  // namespace gnomon::detail
