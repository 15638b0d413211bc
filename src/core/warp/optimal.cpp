// The best projective map of the light plane for this body, as far as some microseconds find it.
#include "gnomon/extend/warp.hpp"
#include "warp/map_search.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  return search_map(input, SearchEffort::quick);
}

}  // namespace

const Warp optimal{"optimal", "perspective along any axis, searched for the objective", choose, true, true};

}  // namespace gnomon::warps
