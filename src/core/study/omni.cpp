// All directions round a point light on a few flat maps: where a direction lands, and how large a texel is.
// Based on: Brabec, Annen, Seidel, "Shadow Mapping for Hemispherical and Omnidirectional Light Sources", 2002
// (paraboloids); Liao, "Shadow Mapping for Omnidirectional Light Using Tetrahedron Mapping", GPU Pro, 2010.
#include "gnomon/study/omni.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/vector.hpp"
#include "measure/metric_kernel.hpp"

namespace gnomon {
namespace {

/// A flat face: the point at slopes (x, y) from `centre`, along two axes across it.
struct Face {
  glm::dvec3 right, up, centre;
};

constexpr std::array<Face, 6> kCube = {{{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
                                        {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
                                        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                        {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                        {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};

// Faces of a regular tetrahedron in a cube: their centres are four of its corners, over sqrt(3); a face's own
// corners are the opposites of the other three, at a slope of 2 sqrt(2) from its centre.
constexpr double kSqrt2 = 1.4142135623730951, kSqrt3 = 1.7320508075688772, kSqrt6 = 2.4494897427831781;
constexpr std::array<glm::dvec3, 4> kCorner = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
// The triangle's rectangle in slopes: from -sqrt(6) to sqrt(6), and from -sqrt(2) to 2 sqrt(2).
constexpr double kHalfWidth = kSqrt6, kHalfHeight = 1.5 * kSqrt2, kMiddle = 0.5 * kSqrt2;

Face tetrahedron_face(int map) noexcept {
  const auto k = static_cast<std::size_t>(map);
  const glm::dvec3 centre = kCorner[k] / kSqrt3;
  // Upwards is the corner opposite of the next face; across the centre it is this long.
  constexpr double kLength = 2.0 * kSqrt2 / 3.0;
  const glm::dvec3 up = (-kCorner[(k + 1) % 4] / kSqrt3 - centre / 3.0) / kLength;
  return {glm::cross(centre, up), up, centre};
}

int cube_face(const glm::dvec3& d) noexcept {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  if (x >= y && x >= z) return d.x >= 0.0 ? 0 : 1;
  if (y >= z) return d.y >= 0.0 ? 2 : 3;
  return d.z >= 0.0 ? 4 : 5;
}

int nearest_corner(const glm::dvec3& d) noexcept {
  int best = 0;
  for (int k = 1; k < 4; ++k) {
    if (glm::dot(kCorner[static_cast<std::size_t>(k)], d) >
        glm::dot(kCorner[static_cast<std::size_t>(best)], d))
      best = k;
  }
  return best;
}

int map_of(OmniMapping mapping, const glm::dvec3& d) noexcept {
  switch (mapping) {
    case OmniMapping::cube:
      return cube_face(d);
    case OmniMapping::dual_paraboloid:
      return d.z >= 0.0 ? 0 : 1;
    case OmniMapping::tetrahedron:
      break;
  }
  return nearest_corner(d);
}

/// Slopes on the face to uv: multiply and shift.
struct Scale {
  glm::dvec2 per_slope, shift;
};
Scale scale_of(OmniMapping mapping) noexcept {
  if (mapping == OmniMapping::cube) return {{1.0, 1.0}, {0.0, 0.0}};
  return {{1.0 / kHalfWidth, 1.0 / kHalfHeight}, {0.0, -kMiddle / kHalfHeight}};
}

Face face_of(OmniMapping mapping, int map) noexcept {
  return mapping == OmniMapping::cube ? kCube[static_cast<std::size_t>(map)] : tetrahedron_face(map);
}

}  // namespace

std::string_view to_string(OmniMapping mapping) noexcept {
  constexpr std::array<std::string_view, 3> kNames = {"cube", "dual_paraboloid", "tetrahedron"};
  return kNames[static_cast<std::size_t>(mapping)];
}

int omni_map_count(OmniMapping mapping) noexcept {
  constexpr std::array<int, 3> kCounts = {6, 2, 4};
  return kCounts[static_cast<std::size_t>(mapping)];
}

OmniPoint omni_from_direction(OmniMapping mapping, const glm::dvec3& direction) noexcept {
  const glm::dvec3 d = safe_normalize(direction, {0.0, 0.0, 1.0});
  const int map = map_of(mapping, d);
  if (mapping == OmniMapping::dual_paraboloid) {
    const double inverse = 1.0 / (1.0 + std::abs(d.z));
    return {map, {d.x * inverse, d.y * inverse}};
  }
  const Face face = face_of(mapping, map);
  const Scale scale = scale_of(mapping);
  const double inverse = 1.0 / glm::dot(face.centre, d);
  return {map, glm::dvec2(glm::dot(face.right, d), glm::dot(face.up, d)) * inverse * scale.per_slope +
                   scale.shift};
}

glm::dvec3 direction_from_omni(OmniMapping mapping, const OmniPoint& point) noexcept {
  const glm::dvec2 uv = point.uv;
  if (mapping == OmniMapping::dual_paraboloid) {
    const double square = glm::dot(uv, uv), sign = point.map == 0 ? 1.0 : -1.0;
    return glm::dvec3(2.0 * uv.x, 2.0 * uv.y, sign * (1.0 - square)) / (1.0 + square);
  }
  const Face face = face_of(mapping, point.map);
  const Scale scale = scale_of(mapping);
  const glm::dvec2 slope = (uv - scale.shift) / scale.per_slope;
  return safe_normalize(face.right * slope.x + face.up * slope.y + face.centre, face.centre);
}

OmniJacobian omni_jacobian(OmniMapping mapping, int map, const glm::dvec3& d) noexcept {
  if (mapping == OmniMapping::dual_paraboloid) {
    const double length = std::sqrt(glm::dot(d, d)), sign = map == 0 ? 1.0 : -1.0;
    const double inverse = 1.0 / (length + sign * d.z);
    const glm::dvec3 of_sum = d / length + glm::dvec3(0.0, 0.0, sign);
    return {(glm::dvec3(1.0, 0.0, 0.0) - of_sum * (d.x * inverse)) * inverse,
            (glm::dvec3(0.0, 1.0, 0.0) - of_sum * (d.y * inverse)) * inverse};
  }
  const Face face = face_of(mapping, map);
  const Scale scale = scale_of(mapping);
  const double inverse = 1.0 / glm::dot(face.centre, d);
  const double x = glm::dot(face.right, d) * inverse, y = glm::dot(face.up, d) * inverse;
  return {(face.right - face.centre * x) * (inverse * scale.per_slope.x),
          (face.up - face.centre * y) * (inverse * scale.per_slope.y)};
}

glm::dvec2 omni_size(OmniMapping mapping, double texels) noexcept {
  if (mapping != OmniMapping::tetrahedron) {
    return glm::dvec2(std::sqrt(texels / omni_map_count(mapping)));
  }
  // Two triangles share a rectangle: four of them have half the texels that their rectangles count.
  const double rectangle = texels / 2.0;
  const double height = std::sqrt(rectangle * kHalfHeight / kHalfWidth);
  return {height * kHalfWidth / kHalfHeight, height};
}

glm::dmat4 tetrahedron_clip_from_light(int face_index, double n, double f) noexcept {
  const Face face = tetrahedron_face(face_index);
  const Scale scale = scale_of(OmniMapping::tetrahedron);
  const glm::dvec3 row_x = face.right * scale.per_slope.x;
  const glm::dvec3 row_y = face.up * scale.per_slope.y + face.centre * scale.shift.y;
  const double depth = (f + n) / (f - n);
  glm::dmat4 m(0.0);
  for (int column = 0; column < 3; ++column) {
    m[column] = {row_x[column], row_y[column], face.centre[column] * depth, face.centre[column]};
  }
  m[3][2] = -2.0 * (f / (f - n)) * n;
  return m;
}

PointAliasing omni_aliasing(OmniMapping mapping, double texels, const glm::dvec3& light_position,
                            const Camera& camera, const glm::dvec3& point) noexcept {
  const glm::dvec3 offset = point - light_position;
  if (!(largest_component(offset) > 0.0)) return outside_map();
  const glm::dvec2 half = omni_size(mapping, texels) * 0.5;
  const OmniJacobian gradient = omni_jacobian(mapping, map_of(mapping, offset), offset);
  const TexelJacobian texel{gradient.u * half.x, gradient.v * half.y, 0.0, 0.0, 1.0};
  const ViewPoint view = view_point(camera, camera_axes(camera), point);
  return perspective_aliasing(texel, view, safe_normalize(offset, {0.0, -1.0, 0.0}));
}

}  // namespace gnomon
