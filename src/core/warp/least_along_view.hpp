// How low does the error of a warp along the view come, at most, whatever its strength?
#pragma once

#include "warp/plane_error.hpp"

namespace gnomon {

/// Nearly the least that PlaneError::value comes to at the body's vertices under a choice that is
/// WarpInput::along_view: no such warp is better by more than some hundredths. 0 where that is not known: by
/// p95, of which vertices are no part, and where the best strength is out of reach.
[[nodiscard]] double least_along_view(const WarpInput& input, const PlaneError& error) noexcept;

}  // namespace gnomon
