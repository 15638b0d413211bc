// What does an eye see of some pieces of a scene?
#include "surface_samples.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "base/random.hpp"

namespace gnomon::detail {

std::vector<SurfaceSample> surface_samples(const Scene& scene, const std::vector<Piece>& pieces,
                                           const glm::dvec3& origin, int count) {
  const auto area_of = [](const std::array<glm::dvec3, 3>& c) {
    const double area = glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
    return std::isfinite(area) ? area : 0.0;
  };
  double whole = 0.0;
  for (const Piece& piece : pieces)
    for (const std::uint32_t first : piece.triangles)
      whole += area_of(corners_of(scene, *piece.instance, first));
  std::vector<SurfaceSample> samples;
  if (!(whole > 0.0) || !std::isfinite(whole)) return samples;
  constexpr std::uint64_t kSeed = 1;
  Random random(kSeed);
  const double step = whole / count;
  double next = 0.5 * step, passed = 0.0;
  for (std::size_t index = 0; index < pieces.size(); ++index) {
    const Piece& piece = pieces[index];
    const bool two_sided = is_two_sided(scene, piece);
    for (const std::uint32_t first : piece.triangles) {
      const auto c = corners_of(scene, *piece.instance, first);
      passed += area_of(c);
      for (; next < passed; next += step) {
        const double root = std::sqrt(random.unit()), along = random.unit();
        const glm::dvec3 at =
            c[0] - origin + (c[1] - c[0]) * (root * (1.0 - along)) + (c[2] - c[0]) * (root * along);
        const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
        samples.push_back(
            {at, piece.instance->mirrored ? -normal : normal, two_sided, static_cast<std::uint32_t>(index)});
      }
    }
  }
  return samples;
}

double covered_share(const std::vector<SurfaceSample>& samples, const Camera& camera) {
  constexpr int kColumns = 32, kRows = 18;
  std::vector<bool> covered(static_cast<std::size_t>(kColumns * kRows), false);
  const CameraAxes axes = camera_axes(camera);
  for (const SurfaceSample& sample : samples) {
    const glm::dvec3 to = sample.at - camera.position;
    const double depth = glm::dot(to, axes.forward);
    if (!(depth > camera.near_depth) || (!sample.two_sided && glm::dot(to, sample.normal) > 0.0)) continue;
    const double u = (glm::dot(to, axes.right) / depth - camera.left) / (camera.right - camera.left),
                 v = (glm::dot(to, axes.up) / depth - camera.bottom) / (camera.top - camera.bottom);
    if (!(u >= 0.0 && u < 1.0 && v >= 0.0 && v < 1.0)) continue;
    covered[static_cast<std::size_t>(static_cast<int>(v * kRows) * kColumns +
                                     static_cast<int>(u * kColumns))] = true;
  }
  return static_cast<double>(std::count(covered.begin(), covered.end(), true)) / (kColumns * kRows);
}

Surroundings surroundings(const std::vector<SurfaceSample>& samples, const glm::dvec3& at) {
  constexpr int kBands = 8;       // of equal height on the sphere
  constexpr int kFirst = 3;       // the lowest that counts
  constexpr double kLevel = 0.3;  // of the distance, above and below the horizon
  constexpr double kThin =
      1.25;  // times the distance: a wall's front counts, with its back side so near before it
  struct Part {
    double front = std::numeric_limits<double>::infinity(), behind = std::numeric_limits<double>::infinity();
  };
  std::array<std::array<Part, Surroundings::kTurns>, kBands> parts;
  Surroundings result;
  std::fill(std::begin(result.free), std::end(result.free), std::numeric_limits<double>::infinity());
  result.nearest = std::numeric_limits<double>::infinity();
  for (const SurfaceSample& sample : samples) {
    const glm::dvec3 to = sample.at - at;
    const double distance = glm::length(to);
    if (!(distance > 0.0)) continue;
    const double turn = std::atan2(to.x, to.z) / (2.0 * std::numbers::pi);
    const auto column = static_cast<std::size_t>((turn < 0.0 ? turn + 1.0 : turn) * Surroundings::kTurns) %
                        Surroundings::kTurns;
    const double up = to.y / distance;
    const auto row = std::min(static_cast<std::size_t>((up + 1.0) * 0.5 * kBands), std::size_t{kBands - 1});
    Part& part = parts[row][column];
    double& nearest = glm::dot(to, sample.normal) < 0.0 ? part.front : part.behind;
    nearest = std::min(nearest, distance);
    result.nearest = std::min(result.nearest, distance);
    if (std::abs(up) < kLevel) result.free[column] = std::min(result.free[column], std::hypot(to.x, to.z));
  }
  int front = 0, behind = 0;
  for (std::size_t row = kFirst; row < kBands; ++row)
    for (const Part& part : parts[row]) {
      const bool is_front = std::isfinite(part.front) && part.front <= kThin * part.behind;
      front += is_front;
      behind += std::isfinite(part.behind) && !is_front;
    }
  constexpr double kAll = (kBands - kFirst) * Surroundings::kTurns;
  result.enclosed = front / kAll;
  result.behind = behind / kAll;
  return result;
}

}  // namespace gnomon::detail
