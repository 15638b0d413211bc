// Divides the receivers by the plane where warping ends: one warped map before it, an unwarped one behind.
// Based on: Mikkelsen, "Separating-plane perspective shadow mapping", 2007.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "gnomon/extend/warp.hpp"
#include "gnomon/study/formulas.hpp"
#include "lanes/elementary.hpp"
#include "map/gain.hpp"
#include "plan/partition/part.hpp"

namespace gnomon::partition {
namespace {

/// A body parted by a plane across the direction that its warp grows in.
struct Separation {
  glm::dvec3 axis;
  double near_end, length;
};

/// The side before the plane at `at` of the length, warped, or the one behind it, unwarped.
Part side_part(const ParallelScene& scene, const Separation& s, double begin, double end, int side,
               double at) noexcept {
  const double border = s.near_end + s.length * at;
  Part part;
  part.begin = begin;
  part.end = end;
  part.index = side;
  part.frame = scene.space.frame;
  part.warp = side == 0 ? &scene.warp : &warps::none;
  part.plane[0] = side == 0 ? Plane{-s.axis, border} : Plane{s.axis, -border};
  part.plane_count = 1;
  return part;
}

/// Logarithm of a map's texels per area of the light plane, in the middle of the body's corners on the plane
/// at `at`.
double log_density(const PlaneMap& map, const LightFrame& frame,
                   std::span<const glm::dvec3> corners) noexcept {
  const WarpChoice& choice = map.choice;
  const double area = (map.a_max - map.a_min) * (map.b_max - map.b_min);
  const double rows = choice.row_a.x * choice.row_b.y - choice.row_a.y * choice.row_b.x;
  double sum = 0.0;
  for (const glm::dvec3& p : corners)
    sum += elementary::log(map.w(glm::dot(p, frame.x), glm::dot(p, frame.y)));
  return elementary::log(map.stretch * std::abs(rows) / area) -
         3.0 * sum / static_cast<double>(corners.size());
}

/// How many times as dense, as a logarithm, the texels of the map before the plane are there as those of the
/// map behind it, both fitted to their sides. `known` is false where one side has nothing.
double density_step(const PlanContext& c, const ParallelScene& scene, const Polytope& body,
                    const Separation& s, double begin, double end, double at, bool& known) noexcept {
  std::array<PlaneMap, 2> map;
  std::array<glm::dvec3, kMaxVertices> corners;
  std::size_t count = 0;
  const double border = s.near_end + s.length * at;
  for (int side = 0; side < 2; ++side) {
    Part part = side_part(scene, s, begin, end, side, at);
    Polytope inside = body;
    clip(inside, part.plane[0]);
    if (inside.empty()) {
      known = false;
      return 0.0;
    }
    if (side == 0) {
      // Corners that the cut has made.
      constexpr double kOnPlane = 1e-9;
      for (const Polytope::Vertex& v : inside.vertices()) {
        if (std::abs(glm::dot(s.axis, v.position) - border) <= kOnPlane * s.length)
          corners[count++] = v.position;
      }
    }
    narrow_depths(c, inside, part);
    map[static_cast<std::size_t>(side)] = focused_plane(c, request_of(part, inside));
  }
  known = count > 0;
  const std::span<const glm::dvec3> on_plane{corners.data(), count};
  return known ? log_density(map[0], scene.space.frame, on_plane) -
                     log_density(map[1], scene.space.frame, on_plane)
               : 0.0;
}

/// Where along the length both maps' texels are as dense as each other: the nearer the plane, the denser the
/// first map's and the sparser the second's. Below 0: nowhere, as the first map's best warp changes at once.
[[gnu::noinline]] double balanced_share(const PlanContext& c, const ParallelScene& scene,
                                        const Polytope& body, const Separation& s, double begin, double end,
                                        double first) noexcept {
  constexpr int kSteps = 24;
  constexpr double kEqual = 0.02;  // of the logarithm: 2 % of the density
  double low = 0.0, high = 1.0, at = first;
  for (int i = 0; i < kSteps; ++i) {
    bool known = false;
    const double step = density_step(c, scene, body, s, begin, end, at, known);
    if (!known) break;
    if (std::abs(step) <= kEqual) return at;
    (step > 0.0 ? low : high) = at;
    // Lengths count by their ratio near the viewer, and by their difference far from him.
    at = low > 0.0 ? std::sqrt(low * high) : 0.5 * high;
    if (high < 4.0 * low) at = 0.5 * (low + high);
  }
  return -1.0;
}

}  // namespace

void separated_parts(const PlanContext& c, const ParallelScene& scene, const Polytope& body, double begin,
                     double end, Parts& parts) noexcept {
  const PlaneMap map = focused_plane(c, request_for(scene, body, begin, end));
  if (!(map.choice.kappa > 0.0)) return;
  const LightFrame& frame = scene.space.frame;
  const Separation s{frame.x * map.choice.axis.x + frame.y * map.choice.axis.y, map.u_min, map.length};
  const double at =
      balanced_share(c, scene, body, s, begin, end, separating_share(map.choice.kappa, map.length));
  parts.no_balance = at < 0.0;
  if (parts.no_balance) return;
  for (int side = 0; side < 2; ++side) add_part(c, body, side_part(scene, s, begin, end, side, at), parts);
}

}  // namespace gnomon::partition
