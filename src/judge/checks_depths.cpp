// Do the view depths that maps serve fit the camera, each other and what is seen?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

/// View depths that no map serves, before the first map or between two.
struct Gap {
  double begin, end;
  std::size_t points = 0;
};

std::vector<Gap> gaps_of(const LightLooks& looks) {
  std::vector<std::pair<double, double>> served;
  for (std::size_t i = 0; i < looks.map.size(); ++i)
    served.emplace_back(looks.map_at(i).begin, looks.map_at(i).end);
  std::sort(served.begin(), served.end());
  std::vector<Gap> gaps;
  double reached = looks.frame->camera.near_depth;
  for (const auto& [begin, end] : served) {
    if (begin > reached) gaps.push_back({reached, begin});
    reached = std::max(reached, end);
  }
  return gaps;
}

/// Whether a lit surface reaches through the gap between two seen points of it, next to each other.
bool reaches_through(const LightLooks& looks, const Gap& gap, std::size_t& at) {
  const SeenSurfaces& seen = *looks.seen;
  if (seen.normals.empty() || !(gap.end > gap.begin * 1.001)) return false;
  constexpr double kNear = 0.25;  // of the depth
  std::vector<std::size_t> before, behind;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    const double depth = seen.depths[p];
    if (looks.counts[p] == 0 || depth < gap.begin * (1.0 - kNear) || depth > gap.end * (1.0 + kNear))
      continue;
    if (depth <= gap.begin) before.push_back(p);
    if (depth >= gap.end) behind.push_back(p);
  }
  const Camera& camera = looks.frame->camera;
  const double area = static_cast<double>(camera.width) * camera.height;
  const double spacing = 2.0 * std::sqrt(area / static_cast<double>(seen.points.size()));
  constexpr std::size_t kMostPairs = 4'000'000;
  const std::size_t step = 1 + before.size() * behind.size() / kMostPairs;
  for (std::size_t i = 0; i < before.size(); i += step) {
    const std::size_t a = before[i];
    for (const std::size_t b : behind) {
      if (glm::distance(seen.pixels[a], seen.pixels[b]) > spacing) continue;
      const glm::dvec3 way = seen.points[b] - seen.points[a];
      const bool flat = std::abs(glm::dot(way, seen.normals[a])) <= 1e-3 * glm::length(way);
      if (!flat || glm::dot(seen.normals[a], seen.normals[b]) < 0.999) continue;
      at = a;
      return true;
    }
  }
  return false;
}

void check_gaps(const LightLooks& looks, FindingList& out) {
  std::vector<Gap> gaps = gaps_of(looks);
  std::size_t counted = 0, in_gaps = 0, farthest = 0;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0) continue;
    ++counted;
    if (looks.chosen[p] >= 0) continue;
    if (in_gaps++ == 0 || looks.seen->depths[p] > looks.seen->depths[farthest]) farthest = p;
    for (Gap& gap : gaps)
      gap.points += looks.seen->depths[p] > gap.begin && looks.seen->depths[p] < gap.end ? 1 : 0;
  }
  constexpr std::size_t kEnough = 3;
  if (in_gaps < kEnough) {
    // Too narrow for the points in view.
    std::size_t at = 0;
    const auto through = std::find_if(gaps.begin(), gaps.end(),
                                      [&](const Gap& gap) { return reaches_through(looks, gap, at); });
    if (through == gaps.end()) return;
    Finding finding = finding_of(FindingKind::gap_between_maps, looks, std::nullopt,
                                 1.0 / static_cast<double>(counted), "share", looks.seen->pixels[at]);
    finding.what = "View depths " + digits(through->begin) + " to " + digits(through->end) +
                   " belong to no map, and a lit surface reaches through them.";
    finding.change = "Let each map begin where the one before it ends.";
    out.add(finding);
    return;
  }
  std::sort(gaps.begin(), gaps.end(), [](const Gap& a, const Gap& b) { return a.points > b.points; });
  const double share = static_cast<double>(in_gaps) / static_cast<double>(counted);
  Finding finding = finding_of(FindingKind::gap_between_maps, looks, std::nullopt, share, "share",
                               looks.seen->pixels[farthest]);
  finding.what = percent(share) + " of the lit surfaces are at view depths that no map serves";
  if (!gaps.empty())
    finding.what += ", mostly " + digits(gaps.front().begin) + " to " + digits(gaps.front().end);
  finding.what += ".";
  finding.change = "Let the first map begin at the near plane, and each where the one before it ends.";
  out.add(finding);
}

/// The camera's near plane under the other range of clip depths, if the matrix was read by the wrong one.
double other_near(const Camera& camera, NdcDepth said) {
  const double n = camera.near_depth, f = camera.far_depth;
  if (said == NdcDepth::zero_to_one) return std::isfinite(f) ? n * f / (2.0 * f - n) : 0.5 * n;
  return std::isfinite(f) ? 2.0 * f * n / (f + n) : 2.0 * n;
}

/// Depths from the first map's begin to the last one's end.
struct Served {
  double begin = std::numeric_limits<double>::infinity(), end = -std::numeric_limits<double>::infinity();
};

Served served_by(const LightLooks& looks) {
  Served served;
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    served.begin = std::min(served.begin, looks.map_at(i).begin);
    served.end = std::max(served.end, looks.map_at(i).end);
  }
  return served;
}

constexpr double kSameDepth = 1e-3;

/// The first map begins where the camera's near plane would be under the other range of depths.
void check_camera(const Capture& capture, const LightLooks& looks, FindingList& out) {
  const Camera& camera = looks.frame->camera;
  const ClipSpace& space = capture.camera_clip_space;
  const double begin = served_by(looks).begin, other = other_near(camera, space.ndc_depth);
  if (camera.orthographic || space.reversed_z || !std::isfinite(begin) ||
      std::abs(begin - other) > kSameDepth * other)
    return;
  const bool zero = space.ndc_depth == NdcDepth::zero_to_one;
  const std::string said = zero ? "zero_to_one" : "minus_one_to_one",
                    not_said = zero ? "minus_one_to_one" : "zero_to_one";
  Finding finding =
      finding_of(FindingKind::depth_convention, looks, std::nullopt,
                 std::max(begin, camera.near_depth) / std::min(begin, camera.near_depth), "times");
  finding.what = "The camera's near plane is at " + digits(camera.near_depth) + " as " + said + ", and at " +
                 digits(other) + " as " + not_said + ", where the first map begins.";
  finding.change =
      "Say " + not_said + " in clip_space, or in camera_clip_space where only the camera has it.";
  out.add(finding);
}

/// Lit surfaces in view, none of which is at the depths that the maps serve.
bool serves_nothing(const LightLooks& looks, FindingList& out) {
  std::size_t lit = 0;
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (std::size_t p = 0; p < looks.lit.size(); ++p) {
    if (looks.lit[p] == 0) continue;
    if (looks.chosen[p] >= 0) return false;
    ++lit;
    nearest = std::min(nearest, looks.seen->depths[p]);
    farthest = std::max(farthest, looks.seen->depths[p]);
  }
  if (lit < 3) return false;
  const Served served = served_by(looks);
  Finding finding = finding_of(FindingKind::gap_between_maps, looks, std::nullopt, 1.0, "share");
  finding.what = "No lit surface is at the view depths that the maps serve (" + digits(served.begin) +
                 " to " + digits(served.end) + "): they are at " + digits(nearest) + " to " +
                 digits(farthest) + ".";
  finding.change = "Give depths in world units, from the eye forward, and a camera that looks at the scene.";
  out.add(finding);
  return true;
}

}  // namespace

bool camera_fits(const Capture& capture, const LightLooks& looks) {
  const Camera& camera = looks.frame->camera;
  const ClipSpace &own = capture.camera_clip_space, &maps = capture.clip_space;
  if (own.ndc_depth != maps.ndc_depth || own.reversed_z != maps.reversed_z || camera.orthographic)
    return false;
  // Read by the other range, a reversed matrix ends at twice its near plane.
  if (own.reversed_z) return camera.far_depth > 4.0 * camera.near_depth;
  return std::abs(served_by(looks).begin - camera.near_depth) <= kSameDepth * camera.near_depth;
}

bool check_depths(const Capture& capture, const LightLooks& looks, FindingList& out) {
  if (looks.map.empty() || looks.selection() != MapSelection::view_depth) return true;
  check_camera(capture, looks, out);
  if (serves_nothing(looks, out)) return false;
  check_gaps(looks, out);
  return true;
}

}  // namespace gnomon::judge
