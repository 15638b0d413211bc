// The moment problem that moment shadow maps rest on. shaders/library/moments.glsl mirrors it.
#pragma once

#include <array>
#include <glm/vec2.hpp>

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

}  // namespace gnomon::render
