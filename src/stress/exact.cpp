// The numbers that the core's doubles are held against, in long double: 64 bits of mantissa on x86, 113 on
// most others.
#include "exact.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gnomon::stress {
namespace {

struct HalfSpace {
  Real3 normal;
  Real offset;
  [[nodiscard]] Real at(const Real3& p) const { return glm::dot(normal, p) + offset; }
};

HalfSpace half_space(const Real3& normal, Real offset) {
  const Real length = std::sqrt(glm::dot(normal, normal));
  return {normal / length, offset / length};
}

std::vector<HalfSpace> visible_half_spaces(const Camera& camera, const Box& receiver, double begin,
                                           double end) {
  const Real3 forward = glm::normalize(Real3(camera.forward));
  const Real3 right = glm::normalize(glm::cross(forward, Real3(camera.up)));
  const Real3 up = glm::cross(right, forward);
  std::vector<HalfSpace> all{half_space(forward, -Real(begin)), half_space(-forward, Real(end))};
  const Real sides[4] = {camera.left, camera.right, camera.bottom, camera.top};
  for (int i = 0; i < 4; ++i) {
    const Real3 axis = i < 2 ? right : up;
    const Real sign = i % 2 == 0 ? 1.0L : -1.0L;
    // axis . p >= left (of the depth, where the camera is a perspective one).
    all.push_back(camera.orthographic ? half_space(axis * sign, -sides[i] * sign)
                                      : half_space((axis - forward * sides[i]) * sign, 0.0L));
  }
  for (int i = 0; i < 3; ++i) {
    Real3 axis(0.0L);
    axis[i] = 1.0L;
    all.push_back({axis, Real(camera.position[i]) - receiver.min[i]});
    all.push_back({-axis, Real(receiver.max[i]) - camera.position[i]});
  }
  return all;
}

}  // namespace

std::vector<Real3> visible_vertices(const Camera& camera, const Box& receiver, double begin, double end) {
  const std::vector<HalfSpace> planes = visible_half_spaces(camera, receiver, begin, end);
  // Planes closer to parallel meet nowhere that matters: their edge is one of the others', too.
  constexpr Real kParallel = 1e-14L;
  // Of the vertex's own distance: far above this arithmetic's rounding, far below a double's.
  constexpr Real kTouching = 1e-17L;
  std::vector<Real3> vertices;
  for (std::size_t a = 0; a < planes.size(); ++a) {
    for (std::size_t b = a + 1; b < planes.size(); ++b) {
      const Real3 edge = glm::cross(planes[a].normal, planes[b].normal);
      for (std::size_t c = b + 1; c < planes.size(); ++c) {
        const Real det = glm::dot(edge, planes[c].normal);
        if (!(std::abs(det) > kParallel)) continue;
        const Real3 p =
            (glm::cross(planes[b].normal, planes[c].normal) * -planes[a].offset +
             glm::cross(planes[c].normal, planes[a].normal) * -planes[b].offset - edge * planes[c].offset) /
            det;
        const Real tolerance = kTouching * std::sqrt(glm::dot(p, p)) / std::min(std::abs(det), 1.0L);
        bool inside = true;
        for (std::size_t i = 0; i < planes.size() && inside; ++i)
          inside = i == a || i == b || i == c || planes[i].at(p) >= -tolerance;
        if (inside) vertices.push_back(p);
      }
    }
  }
  return vertices;
}

double condition_number(const Real4x4& matrix) {
  Real4x4 m = matrix;
  constexpr int kSweeps = 30;  // convergence is quadratic: six are the rule
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool turned = false;
    for (int i = 0; i < 3; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        const Real a = glm::dot(m[i], m[i]), b = glm::dot(m[j], m[j]), c = glm::dot(m[i], m[j]);
        if (!(std::abs(c) > 1e-18L * std::sqrt(a) * std::sqrt(b))) continue;
        turned = true;
        const Real zeta = (b - a) / (2.0L * c);
        const Real t = (zeta >= 0.0L ? 1.0L : -1.0L) / (std::abs(zeta) + std::sqrt(1.0L + zeta * zeta));
        const Real cosine = 1.0L / std::sqrt(1.0L + t * t), sine = cosine * t;
        const Real4 left = m[i] * cosine - m[j] * sine;
        m[j] = m[i] * sine + m[j] * cosine;
        m[i] = left;
      }
    }
    if (!turned) break;
  }
  Real low = std::numeric_limits<Real>::infinity(), high = 0.0L;
  for (int i = 0; i < 4; ++i) {
    const Real length = std::sqrt(glm::dot(m[i], m[i]));
    low = std::min(low, length);
    high = std::max(high, length);
  }
  return low > 0.0L ? static_cast<double>(high / low) : std::numeric_limits<double>::infinity();
}

Place exact_place(const Real4x4& clip_from_relative, int width, int height, const Real3& point) {
  const Real4 clip = clip_from_relative * Real4(point, 1.0L);
  return {{(clip.x / clip.w * 0.5L + 0.5L) * width, (clip.y / clip.w * 0.5L + 0.5L) * height}, clip.w};
}

Real4x4 relative_matrix(const glm::dmat4& clip_from_world, const glm::dvec3& eye) {
  Real4x4 m(clip_from_world);
  m[3] = m * Real4(Real3(eye), 1.0L);
  return m;
}

}  // namespace gnomon::stress
