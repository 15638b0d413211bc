// No warp: the orthographic map, kappa = 0.
#include "gnomon/extend/warp.hpp"

namespace gnomon::warps {

const Warp none{"none", "orthographic map, evenly spaced texels",
                [](const WarpInput& input) noexcept { return input.unwarped; }, true};

}  // namespace gnomon::warps
