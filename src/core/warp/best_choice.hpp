// Which of a search's result and other warps is the best at points that the search does not go by?
#pragma once

#include <array>
#include <cstddef>

#include "gnomon/extend/warp.hpp"
#include "lanes/lanes.hpp"
#include "warp/plane_error.hpp"

namespace gnomon {

/// A warp's choice with its value by a PlaneError.
struct Judged {
  WarpChoice choice;
  double value;
};

/// Choices of the registry's other warps.
struct OtherChoices {
  std::array<Judged, kDoubleLanes> judged;
  std::size_t count = 0;
};

/// How many times the value of a search's result others may have and still be better at other points; 1:
/// there are no other points.
[[nodiscard]] double nearly_as_good(const WarpInput& input, const PlaneError& error) noexcept;

/// `found`, or one of `others` where that is better at other points: of a percentile those of several sets,
/// of the worst where rays through boxes begin and end. May leave `error` with other points.
[[nodiscard]] Judged best_choice(const WarpInput& input, PlaneError& error, const Judged& found,
                                 const OtherChoices& others) noexcept;

}  // namespace gnomon
