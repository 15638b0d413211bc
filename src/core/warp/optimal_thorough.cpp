// The best projective map of the light plane for this body: `optimal` from eight starts.
#include "gnomon/extend/warp.hpp"
#include "warp/map_search.hpp"

namespace gnomon::warps {
namespace {

WarpChoice choose(const WarpInput& input) noexcept {
  return search_map(input, SearchEffort::thorough);
}

}  // namespace

const Warp optimal_thorough{
    "optimal_thorough", "optimal searched from eight starts: up to nine times as long", choose, true, true};

}  // namespace gnomon::warps
