// Is a map's matrix what it is said to be: of its light, its convention, and not written the other way round?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/travel.hpp"
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

/// A captured map with the matrix written the other way round.
CapturedMap transposed(const CapturedMap& map) {
  CapturedMap out = map;
  out.clip_from_world = glm::transpose(map.clip_from_world);
  return out;
}

/// What the points say of a map's orientation.
struct Orientation {
  std::size_t count = 0, behind = 0, reversed = 0, mirrored = 0;
  double degrees = 0.0;  // off the light's ray: the median
};

/// Points that tell a map's orientation: those that the light lights. A sun's rays are the same at all, and a
/// spot's map shows what lies beside its cone as well.
std::vector<glm::dvec3> telling_points(const LightLooks& looks, std::size_t map) {
  const Light& light = looks.source();
  std::vector<glm::dvec3> points;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    // A face of a cube says nothing of what lies behind it.
    if (looks.counts[p] != 0 && (looks.of[map][p].inside() || !std::holds_alternative<PointLight>(light)))
      points.push_back(looks.seen->points[p]);
  }
  if (!points.empty()) return points;
  if (std::holds_alternative<DirectionalLight>(light)) {
    if (perspective_axes(looks.map_at(map)).perspective) return looks.seen->points;
    points.push_back(looks.frame->camera.position);
  } else {
    for (std::size_t p = 0; p < looks.seen->points.size(); ++p) {
      if (looks.of[map][p].inside()) points.push_back(looks.seen->points[p]);
    }
  }
  return points;
}

Orientation orientation_of(const Capture& capture, const CapturedMap& map, const Light& light,
                           const std::vector<glm::dvec3>& points) {
  Orientation o;
  const ClipSpace& space = capture.clip_space;
  const bool turned = space.y_down != (space.handedness == Handedness::left);
  std::vector<double> degrees;
  for (const glm::dvec3& point : points) {
    const Look look = look_at(map, space, light, point);
    ++o.count;
    if (!(look.w > 0.0)) {
      ++o.behind;
      continue;
    }
    const glm::dvec3 travel = travel_at(light, point);
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

Finding transposed_finding(const LightLooks& looks, std::size_t map) {
  Finding finding = finding_of(FindingKind::transposed, looks, map, 1.0, "matrix");
  finding.what =
      "The matrix of " + map_name(looks, map) + " is written the other way round: rows are columns.";
  finding.change = "Say \"matrices\": \"row_major\", or hand in the transposed matrix.";
  return finding;
}

void check_matrix(const Capture& capture, const LightLooks& looks, std::size_t map, BrokenMaps& broken,
                  FindingList& out) {
  const Light& light = looks.source();
  const std::string name = map_name(looks, map);
  if (std::holds_alternative<DirectionalLight>(light) &&
      looks_transposed(looks.map_at(map).clip_from_world)) {
    out.add(transposed_finding(looks, map));
    broken[map] = true;
    return;
  }
  const std::vector<glm::dvec3> points = telling_points(looks, map);
  const Orientation o = orientation_of(capture, looks.map_at(map), light, points);
  if (o.count == 0) return;
  if (o.degrees > kSameDirection || o.behind > o.count / 2) {
    const Orientation other = orientation_of(capture, transposed(looks.map_at(map)), light, points);
    if (other.count > 0 && other.degrees <= kSameDirection && other.behind <= other.count / 2) {
      out.add(transposed_finding(looks, map));
      broken[map] = true;
      return;
    }
  }
  const std::size_t front = o.count - o.behind;
  if (o.behind > o.count / 2) {
    Finding finding = finding_of(FindingKind::light_direction, looks, map, 180.0, "degrees");
    finding.what =
        "The frustum of " + name + " lies behind its light: w is below 0 for what the light lights.";
    finding.change = "Turn the view matrix of the light round, or give the light's direction as it travels.";
    out.add(finding);
    broken[map] = true;
    return;
  }
  if (o.degrees > kSameDirection) {
    Finding finding = finding_of(FindingKind::light_direction, looks, map, o.degrees, "degrees");
    finding.what = "The rays of " + name + " run " + digits(o.degrees) + " degrees off its light's.";
    finding.change = "Build the matrix from this frame's light, in the same space as the camera's.";
    out.add(finding);
    broken[map] = true;
    return;
  }
  const bool reversed = o.reversed > front / 2, mirrored = o.mirrored > front / 2;
  // Seen from behind, left and right change places as near and far do.
  if (reversed && mirrored && std::holds_alternative<DirectionalLight>(light)) {
    Finding finding = finding_of(FindingKind::light_direction, looks, map, 180.0, "degrees");
    finding.what = "The light of " + name + " is said to travel the other way than its map looks.";
    finding.change = "Give the direction that the light travels, not the one towards it.";
    out.add(finding);
    broken[map] = true;
    return;
  }
  if (reversed) {
    Finding finding = finding_of(FindingKind::depth_reversed, looks, map, 1.0, "matrix");
    finding.what = std::string("Depth in ") + name + " grows " +
                   (capture.clip_space.reversed_z ? "away from" : "towards") +
                   " the light: the comparison must be the other one.";
    finding.change = "Say what the engine does in clip_space.reversed_z, or turn depth and comparison round.";
    out.add(finding);
    broken[map] = true;
  }
  // Faces of cubes are mirrored by the convention of cube maps: check_cube() holds them to each other.
  if (mirrored && !std::holds_alternative<PointLight>(light)) {
    Finding finding = finding_of(FindingKind::mirrored, looks, map, 1.0, "matrix");
    finding.what = "The picture of " + name + " is a mirror image: culling removes the wrong faces.";
    finding.change =
        "Check handedness and y_down of clip_space, and the sign of x in the light's view matrix.";
    out.add(finding);
  }
}

/// A face of a point light that is mirrored where most are not, or the other way round.
void check_cube(const LightLooks& looks, const BrokenMaps& broken, FindingList& out) {
  std::vector<bool> positive;
  for (std::size_t map = 0; map < looks.map.size(); ++map) {
    const glm::dmat4& m = looks.map_at(map).clip_from_world;
    const glm::dvec3 x{m[0][0], m[1][0], m[2][0]}, y{m[0][1], m[1][1], m[2][1]}, w{m[0][3], m[1][3], m[2][3]};
    positive.push_back(glm::dot(glm::cross(x, y), w) > 0.0);
  }
  const auto count = static_cast<std::size_t>(std::count(positive.begin(), positive.end(), true));
  if (2 * count == positive.size()) return;
  const bool most = 2 * count > positive.size();
  for (std::size_t map = 0; map < positive.size(); ++map) {
    if (broken[map] || positive[map] == most) continue;
    Finding finding = finding_of(FindingKind::mirrored, looks, map, 1.0, "matrix");
    finding.what =
        "The picture of " + map_name(looks, map) + " is a mirror image of what the light's other faces show.";
    finding.change = "Check the sign of x in the face's view matrix.";
    out.add(finding);
  }
}

/// Texture coordinates in place of clip space: a local light's axis is in the middle of them.
bool has_axis_of_texture(const CapturedMap& map) {
  const PerspectiveAxes axes = perspective_axes(map);
  constexpr double kSame = 0.005;
  return axes.perspective && std::abs(axes.middle.x - 0.5) < kSame && std::abs(axes.middle.y - 0.5) < kSame;
}

/// The same of a sun: all is in 0..1 across and along its maps, and round the middle of that.
bool is_texture_space(const LightLooks& looks) {
  const std::size_t maps = looks.map.size();
  std::size_t counted = 0, within = 0;
  bool round_middle = true;
  for (std::size_t map = 0; map < maps; ++map) {
    glm::dvec2 low(1.0), high(0.0);
    std::size_t here = 0;
    for (std::size_t p = 0; p < looks.counts.size(); ++p) {
      if (looks.counts[p] == 0 || looks.chosen[p] != static_cast<int>(map)) continue;
      const glm::dvec3& at = looks.of[map][p].clip;
      ++here;
      if (!(at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x <= 1.0 && at.y <= 1.0 && at.z <= 1.0)) continue;
      ++within;
      low = glm::min(low, {at.x, at.y});
      high = glm::max(high, {at.x, at.y});
    }
    counted += here;
    constexpr std::size_t kEnoughOfMap = 500;
    const glm::dvec2 off = glm::abs(0.5 * (low + high) - 0.5);
    round_middle = round_middle && (here < kEnoughOfMap || std::max(off.x, off.y) < 0.16);
  }
  // Of sound maps, half of the points are below 0.
  constexpr std::size_t kEnough = 200;
  return counted >= kEnough && 100 * within > 98 * counted && round_middle;
}

void check_texture_space(const LightLooks& looks, BrokenMaps& broken, FindingList& out) {
  const bool sun = std::holds_alternative<DirectionalLight>(looks.source());
  const bool all = sun && is_texture_space(looks);
  for (std::size_t map = 0; map < looks.map.size(); ++map) {
    if (broken[map] || !(all || (!sun && has_axis_of_texture(looks.map_at(map))))) continue;
    Finding finding = finding_of(FindingKind::texture_space, looks, map, 1.0, "matrix");
    finding.what = sun ? "All that " + map_name(looks, map) +
                             " serves lies in 0..1 across and along it: these are texture coordinates."
                       : "The axis of " + map_name(looks, map) +
                             " is at 0.5, 0.5 and not at 0, 0: these are texture coordinates.";
    finding.change = "Hand in the matrices before they are scaled to textures (three.js: not shadow.matrix).";
    out.add(finding);
    broken[map] = true;
  }
}

/// A spot's map that looks past its cone.
void check_aim(const LightLooks& looks, BrokenMaps& broken, FindingList& out) {
  const auto* spot = std::get_if<SpotLight>(&looks.source());
  if (spot == nullptr) return;
  for (std::size_t map = 0; map < looks.map.size(); ++map) {
    const PerspectiveAxes axes = perspective_axes(looks.map_at(map));
    const double cosine = glm::dot(axes.forward, glm::normalize(spot->direction));
    if (broken[map] || !axes.perspective || cosine >= std::cos(spot->outer_radians)) continue;
    const double degrees = std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegrees;
    Finding finding = finding_of(FindingKind::light_direction, looks, map, degrees, "degrees");
    finding.what = "The axis of " + map_name(looks, map) + " is " + digits(degrees) +
                   " degrees off its light's, and so outside of its cone.";
    finding.change = "Give the direction that the spot shines in, in the same space as the matrix.";
    out.add(finding);
    broken[map] = true;
  }
}

}  // namespace

void check_matrices(const Capture& capture, const LightLooks& looks, BrokenMaps& broken, FindingList& out) {
  for (std::size_t map = 0; map < looks.map.size(); ++map) check_matrix(capture, looks, map, broken, out);
  if (std::holds_alternative<PointLight>(looks.source())) check_cube(looks, broken, out);
  check_texture_space(looks, broken, out);
  check_aim(looks, broken, out);
}

}  // namespace gnomon::judge
