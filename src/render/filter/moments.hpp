// The moment problem that moment shadow maps rest on, and how their moments are stored.
// shaders/library/moments.glsl mirrors it.
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "gnomon/render/filter.hpp"

namespace gnomon::render {

/// Means of u, u^2, u^3, u^4.
using Moments = std::array<double, 4>;

/// Least share of a distribution with these moments that lies in front of u, and the two other depths of the
/// distribution that attains it (rising). NaN where the moments are those of one or two depths exactly.
struct ShareInFront {
  double share = 0.0;
  glm::dvec2 others{0.0};
};
[[nodiscard]] ShareInFront share_in_front(const Moments& b, double u) noexcept;

/// The same where all depths are known to lie in [-1, 1]: at least as large.
[[nodiscard]] double share_in_front_bounded(const Moments& b, double u) noexcept;

/// The four moments of u = 2 depth - 1. In formats of 0..1 they go through a change of basis that makes use
/// of all steps (Peters 2017, whose linear part it is).
[[nodiscard]] StoredTexel store_four_moments(double depth, const glm::dvec2& slope,
                                             const FilterSettings& settings) noexcept;
/// Four moments as four numbers of 0..1 that may be rounded apart and still are moments: the two depths of
/// the only distribution of two depths with the first three, the share of the farther one, and the root of
/// where the fourth lies between the least and the largest that depths of -1..1 allow (after Peters 2017).
[[nodiscard]] StoredTexel packed_moments(const Moments& b) noexcept;
[[nodiscard]] Moments unpacked_moments(const StoredTexel& stored) noexcept;

/// Moved by a share towards those of depths spread out.
[[nodiscard]] Moments spread_by(double share, Moments b) noexcept;
/// The moments of a stored texel, moved by a share of `bias` towards those of depths spread out: what is
/// stored has been rounded, and may be no moments at all. Never less than what the format's rounding needs.
[[nodiscard]] Moments moments_of(const StoredTexel& texel, const FilterSettings& settings,
                                 double bias) noexcept;
/// The receiver as depths are stored, less the part of a slanted plane that lies in front of it within a box
/// of these half sides, texels.
[[nodiscard]] double receiver_of_moments(const FilterLookup& lookup, const glm::dvec2& box) noexcept;

}  // namespace gnomon::render
