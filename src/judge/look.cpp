// What does one map make of the surfaces in view? The numbers that all checks read, once for each frame.
#include "judge/look.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/travel.hpp"
#include "geometry/matrix.hpp"

namespace gnomon::judge {
namespace {

void fill_texel(const glm::dvec3& travel, Look& look) {
  // A texel's sides lie across the light: the dual of the gradients there.
  const glm::dvec3 x = look.along_x - travel * glm::dot(travel, look.along_x);
  const glm::dvec3 y = look.along_y - travel * glm::dot(travel, look.along_y);
  const double xx = glm::dot(x, x), xy = glm::dot(x, y), yy = glm::dot(y, y);
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0.0)) return;
  look.texel_x = (x * yy - y * xy) / determinant;
  look.texel_y = (y * xx - x * xy) / determinant;
}

}  // namespace

bool Look::inside() const noexcept {
  return w > 0.0 && std::abs(clip.x) <= 1.0 + kRim && std::abs(clip.y) <= 1.0 + kRim;
}

double depth_of(double z, const ClipSpace& space) noexcept {
  const double depth = space.ndc_depth == NdcDepth::zero_to_one ? z : 0.5 * z + 0.5;
  return space.reversed_z ? 1.0 - depth : depth;
}

bool in_range(double depth) noexcept {
  return depth >= -kRim && depth <= 1.0 + kRim;
}

double way_to_depth(const CapturedMap& map, const ClipSpace& space, const glm::dvec3& point,
                    const glm::dvec3& way, double depth) noexcept {
  const double along = space.reversed_z ? 1.0 - depth : depth;
  const double z = space.ndc_depth == NdcDepth::zero_to_one ? along : 2.0 * along - 1.0;
  const glm::dvec4 here = map.clip_from_world * glm::dvec4(point, 1.0);
  const glm::dvec4 growth = map.clip_from_world * glm::dvec4(way, 0.0);
  return (z * here.w - here.z) / (growth.z - z * growth.w);
}

Look look_at(const CapturedMap& map, const ClipSpace& space, const Light& light, const glm::dvec3& point) {
  Look look;
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(point, 1.0);
  look.w = clip.w;
  if (!(std::abs(clip.w) > 0.0)) return look;
  look.clip = glm::dvec3(clip) / clip.w;
  const TexelGrid grid{map.width, map.height};
  look.texel = grid.place({look.clip.x, look.clip.y}).texel;
  const TexelJacobian texel = texel_jacobian(map.clip_from_world, grid, point);
  look.along_x = texel.x;
  look.along_y = texel.y;
  const glm::dvec3 travel = travel_at(light, point);
  fill_texel(travel, look);
  const glm::dmat4& m = map.clip_from_world;
  const glm::dvec3 z_row{m[0][2], m[1][2], m[2][2]}, w_row{m[0][3], m[1][3], m[2][3]};
  const double z_growth = glm::dot(travel, (z_row - w_row * look.clip.z) / clip.w);
  const double scale = space.ndc_depth == NdcDepth::zero_to_one ? 1.0 : 0.5;
  look.depth_per_world = z_growth * scale * (space.reversed_z ? -1.0 : 1.0);
  return look;
}

PerspectiveAxes perspective_axes(const CapturedMap& map) noexcept {
  const glm::dmat4& m = map.clip_from_world;
  const glm::dvec3 x{m[0][0], m[1][0], m[2][0]}, y{m[0][1], m[1][1], m[2][1]}, w{m[0][3], m[1][3], m[2][3]};
  PerspectiveAxes axes;
  const double length = glm::length(w);
  if (!(length > 0.0)) return axes;
  axes.perspective = true;
  axes.forward = w / length;
  axes.middle = glm::dvec2(glm::dot(x, axes.forward), glm::dot(y, axes.forward)) / length;
  const auto focal = [&](const glm::dvec3& row, double middle) {
    return glm::length(row - middle * w) / length;
  };
  axes.focal = {focal(x, axes.middle.x), focal(y, axes.middle.y)};
  return axes;
}

double slice_radius(const CapturedFrame& frame, const CapturedMap& map, double deepest) noexcept {
  const Camera& camera = frame.camera;
  const double begin = std::max(map.begin, camera.near_depth);
  const double end = std::min({map.end, deepest, camera.far_depth});
  std::array<glm::dvec3, 8> corners{};
  glm::dvec3 middle(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double depth = (i & 1) != 0 ? end : begin, scale = camera.orthographic ? 1.0 : depth;
    corners[i] = {scale * ((i & 2) != 0 ? camera.left : camera.right),
                  scale * ((i & 4) != 0 ? camera.bottom : camera.top), depth};
    middle += corners[i] / 8.0;
  }
  double radius = 0.0;
  for (const glm::dvec3& corner : corners) radius = std::max(radius, glm::length(corner - middle));
  return radius;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

namespace {

/// Whether a caster's box lies on the way from the light to the point. Not one whose surface the point lies
/// on. True where no casters are known.
bool caster_reaches(const CapturedScene& scene, const Light& light, const glm::dvec3& point) {
  if (scene.casters.empty()) return true;
  const glm::dvec3 back = -travel_at(light, point);
  const double light_at = distance_to(light, point);
  constexpr double kSurface = 1e-6;  // of a box's diagonal
  return std::any_of(scene.casters.begin(), scene.casters.end(), [&](const Box& caster) {
    const BoxCrossing crossing = crossing_of(caster, point, back);
    return crossing.enter <= crossing.leave && crossing.enter < light_at &&
           crossing.leave > kSurface * glm::length(caster.max - caster.min);
  });
}

}  // namespace

std::size_t step_over_casters(std::size_t points, const CapturedScene& scene) noexcept {
  constexpr std::size_t kMostTests = 20'000'000;
  return 1 + points * std::max<std::size_t>(scene.casters.size(), 1) / kMostTests;
}

LightLooks looks_of(const Capture& capture, const CapturedFrame& frame, const CapturedScene& scene,
                    const SeenSurfaces& seen, int light) {
  LightLooks looks{&frame, &scene, &seen, light, {}, {}, {}, {}, {}, {}};
  for (std::size_t i = 0; i < frame.maps.size(); ++i) {
    if (frame.maps[i].light == light) looks.map.push_back(i);
  }
  const Light& source = frame.lights[static_cast<std::size_t>(light)];
  double end = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    end = std::max(end, looks.map_at(i).end);
    std::vector<Look>& of = looks.of.emplace_back();
    of.reserve(seen.points.size());
    for (const glm::dvec3& point : seen.points)
      of.push_back(look_at(looks.map_at(i), capture.clip_space, source, point));
  }
  const auto holds = [&](const Look& look) {
    return look.inside() && in_range(depth_of(look.clip.z, capture.clip_space));
  };
  // Surfaces within a few degrees of the light's ray are dark by shading alone.
  constexpr double kFaces = 0.05;
  const std::size_t step = step_over_casters(seen.points.size(), scene);
  std::size_t unserved = 0;
  bool reached = true;  // of the last unserved point that was tested
  for (std::size_t p = 0; p < seen.points.size(); ++p) {
    const glm::dvec3& point = seen.points[p];
    const glm::dvec3 travel = travel_at(source, point);
    bool lit = seen.normals.empty() || glm::dot(seen.normals[p], travel) < -kFaces;
    if (const auto* spot = std::get_if<SpotLight>(&source)) {
      lit = lit && glm::length(point - spot->position) <= spot->range &&
            glm::dot(travel, glm::normalize(spot->direction)) >= std::cos(spot->outer_radians);
    } else if (const auto* bulb = std::get_if<PointLight>(&source)) {
      lit = lit && glm::length(point - bulb->position) <= bulb->range;
    }
    looks.lit.push_back(lit ? 1 : 0);
    looks.counts.push_back(lit && seen.depths[p] <= end ? 1 : 0);
    int chosen = -1, holding = -1;
    for (std::size_t i = 0; i < looks.map.size(); ++i) {
      const Look& look = looks.of[i][p];
      if (holding < 0 && holds(look)) holding = static_cast<int>(i);
      const CapturedMap& map = looks.map_at(i);
      if (looks.selection() == MapSelection::view_depth && chosen < 0 && seen.depths[p] >= map.begin &&
          seen.depths[p] <= map.end)
        chosen = static_cast<int>(i);
    }
    // Finest of those that hold it.
    if (looks.selection() == MapSelection::finest && holding >= 0) {
      double most = 0.0;
      for (std::size_t i = 0; i < looks.map.size(); ++i) {
        const Look& look = looks.of[i][p];
        const double density = glm::length(glm::cross(look.along_x, look.along_y));
        if (!holds(look) || !(density > most)) continue;
        most = density;
        chosen = static_cast<int>(i);
      }
    }
    if (looks.selection() == MapSelection::first_holding) chosen = holding;
    looks.chosen.push_back(chosen);
    looks.holding.push_back(holding);
    // Depths at which no caster can shadow anything need no map: a plan may omit it.
    const bool by_depth = looks.selection() == MapSelection::view_depth;
    if (looks.counts[p] == 0 || !by_depth || chosen >= 0) continue;
    if (unserved++ % step == 0) reached = caster_reaches(scene, source, point);
    looks.counts[p] = reached ? 1 : 0;
  }
  return looks;
}

}  // namespace gnomon::judge
