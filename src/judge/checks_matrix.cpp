// Is a map's matrix what it is said to be: of its light, its convention, and not written the other way round?
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// A light's matrix is rounded, and so is its direction.
constexpr double kSameDirection = 1.0;  // degrees

/// A parallel projection's last row is 0 0 0 1; where its last column is, it was written the other way round.
bool looks_transposed(const glm::dmat4& m) {
  const auto unit = [](double a, double b, double c, double d) {
    return a == 0.0 && b == 0.0 && c == 0.0 && std::abs(d - 1.0) < 1e-6;
  };
  return unit(m[3][0], m[3][1], m[3][2], m[3][3]) && !unit(m[0][3], m[1][3], m[2][3], m[3][3]);
}

/// What the points say of a map's orientation.
struct Orientation {
  std::size_t count = 0, behind = 0, reversed = 0, mirrored = 0;
  double degrees = 0.0;  // off the light's ray: the median
};

Orientation orientation_of(const Capture& capture, const LightLooks& looks, std::size_t map) {
  Orientation o;
  const Light& light = looks.frame->lights[static_cast<std::size_t>(looks.light)];
  const ClipSpace& space = capture.clip_space;
  const bool turned = space.y_down != (space.handedness == Handedness::left);
  std::vector<double> degrees;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    const Look& look = looks.of[map][p];
    // A face of a cube says nothing of what lies behind it.
    if (looks.counts[p] == 0 || (!look.inside() && std::holds_alternative<PointLight>(light))) continue;
    ++o.count;
    if (!(look.w > 0.0)) {
      ++o.behind;
      continue;
    }
    const glm::dvec3 travel = travel_at(light, looks.seen->points[p]);
    const glm::dvec3 axis = glm::cross(look.along_x, look.along_y);
    const double length = glm::length(axis);
    if (!(length > 0.0)) continue;
    const double along = glm::dot(axis, travel) / length;
    degrees.push_back(std::acos(std::min(1.0, std::abs(along))) * kDegrees);
    if (look.depth_per_world < 0.0) ++o.reversed;
    if ((along > 0.0) != turned) ++o.mirrored;
  }
  o.degrees = quantile(degrees);
  return o;
}

void check_matrix(const Capture& capture, const LightLooks& looks, std::size_t map, BrokenMaps& broken,
                  FindingList& out) {
  const Light& light = looks.frame->lights[static_cast<std::size_t>(looks.light)];
  const std::string name = map_name(looks, map);
  if (std::holds_alternative<DirectionalLight>(light) &&
      looks_transposed(looks.map_at(map).clip_from_world)) {
    Finding finding = finding_of(FindingKind::transposed, looks, static_cast<int>(map), 1.0, "matrix");
    finding.what = "The matrix of " + name + " is written the other way round: its last column is 0 0 0 1.";
    finding.change = "Say \"matrices\": \"row_major\", or hand in the transposed matrix.";
    out.add(finding);
    broken[map] = true;
    return;
  }
  const Orientation o = orientation_of(capture, looks, map);
  if (o.count == 0) return;
  const std::size_t front = o.count - o.behind;
  if (o.behind > o.count / 2) {
    Finding finding =
        finding_of(FindingKind::light_direction, looks, static_cast<int>(map), 180.0, "degrees");
    finding.what =
        "The frustum of " + name + " lies behind its light: w is below 0 for what the light lights.";
    finding.change = "Turn the view matrix of the light round, or give the light's direction as it travels.";
    out.add(finding);
    broken[map] = true;
    return;
  }
  if (o.degrees > kSameDirection) {
    Finding finding =
        finding_of(FindingKind::light_direction, looks, static_cast<int>(map), o.degrees, "degrees");
    finding.what = "The rays of " + name + " run " + digits(o.degrees) + " degrees off its light's.";
    finding.change = "Build the matrix from this frame's light, in the same space as the camera's.";
    out.add(finding);
    broken[map] = true;
    return;
  }
  if (o.reversed > front / 2) {
    Finding finding = finding_of(FindingKind::depth_reversed, looks, static_cast<int>(map), 1.0, "matrix");
    finding.what = std::string("Depth in ") + name + " grows " +
                   (capture.clip_space.reversed_z ? "away from" : "towards") +
                   " the light: the comparison must be the other one.";
    finding.change = "Say what the engine does in clip_space.reversed_z, or turn depth and comparison round.";
    out.add(finding);
    broken[map] = true;
  }
  // Faces of cubes are mirrored by the convention of cube maps.
  if (o.mirrored > front / 2 && !std::holds_alternative<PointLight>(light)) {
    Finding finding = finding_of(FindingKind::mirrored, looks, static_cast<int>(map), 1.0, "matrix");
    finding.what = "The picture of " + name + " is a mirror image: culling removes the wrong faces.";
    finding.change =
        "Check handedness and y_down of clip_space, and the sign of x in the light's view matrix.";
    out.add(finding);
  }
}

}  // namespace

void check_matrices(const Capture& capture, const LightLooks& looks, BrokenMaps& broken, FindingList& out) {
  for (std::size_t map = 0; map < looks.map.size(); ++map)
    check_matrix(capture, looks, static_cast<int>(map), broken, out);
}

}  // namespace gnomon::judge
