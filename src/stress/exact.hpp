// The numbers that the core's doubles are held against, in long double: 64 bits of mantissa on x86, 113 on
// most others.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <vector>

#include "input.hpp"

namespace gnomon::stress {

using Real = long double;
using Real2 = glm::vec<2, Real>;
using Real3 = glm::vec<3, Real>;
using Real4 = glm::vec<4, Real>;
using Real4x4 = glm::mat<4, 4, Real>;

/// Whether Real tells more than a double: a judge must know better than the judged.
inline constexpr bool kRealIsFiner =
    std::numeric_limits<Real>::digits >= std::numeric_limits<double>::digits + 8;

/// What of the receivers' one box the camera sees between two view depths: its vertices, relative to the
/// camera. Every three planes are met with each other and kept where all others hold them; nothing here is
/// shared with the core's clipping.
[[nodiscard]] std::vector<Real3> visible_vertices(const Camera& camera, const Box& receiver, double begin,
                                                  double end);

/// Ratio of the largest to the smallest singular value; infinite for a singular matrix. By one-sided Jacobi
/// rotations, which keep small values exact. Based on: Demmel, Veselic, "Jacobi's method is more accurate
/// than QR", 1992.
[[nodiscard]] double condition_number(const Real4x4& matrix);

/// Where the map shows a point, in texels from its corner, and the divisor; `relative`: to the camera.
struct Place {
  Real2 texel{0.0L};
  Real w = 0.0L;
};
[[nodiscard]] Place exact_place(const Real4x4& clip_from_relative, int width, int height, const Real3& point);

/// The double matrix, moved to the camera without rounding.
[[nodiscard]] Real4x4 relative_matrix(const glm::dmat4& clip_from_world, const glm::dvec3& eye);

}  // namespace gnomon::stress
