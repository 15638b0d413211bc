// Do texels keep their place over the world from one frame to the next?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

bool same_light(const Light& a, const Light& b) {
  if (a.index() != b.index()) return false;
  constexpr double kRounding = 1e-9;
  const auto same = [](const glm::dvec3& p, const glm::dvec3& q) {
    return glm::length(p - q) <= kRounding * std::max(glm::length(p), 1.0);
  };
  if (const auto* sun = std::get_if<DirectionalLight>(&a))
    return same(sun->direction, std::get<DirectionalLight>(b).direction);
  if (const auto* spot = std::get_if<SpotLight>(&a)) {
    const auto& other = std::get<SpotLight>(b);
    return same(spot->position, other.position) && same(spot->direction, other.direction) &&
           spot->outer_radians == other.outer_radians;
  }
  return same(std::get<PointLight>(a).position, std::get<PointLight>(b).position);
}

constexpr std::size_t kEnough = 20;  // points

/// How the texels of one map move between two frames.
struct Motion {
  double drift = 0.0;   // texels off a whole number of them: the median over points
  double growth = 1.0;  // of a texel's side
  std::size_t points = 0;
};

Motion motion_of(const Capture& capture, const LightLooks& before, const CapturedMap& now, const Light& light,
                 std::size_t map) {
  Motion motion;
  std::vector<double> drifts, growths;
  // A map that serves a few points moves over all that it holds.
  const auto serves = [&](std::size_t p) {
    return before.counts[p] != 0 && before.chosen[p] == static_cast<int>(map);
  };
  std::size_t served = 0;
  for (std::size_t p = 0; p < before.counts.size(); ++p) served += serves(p) ? 1 : 0;
  if (served == 0) return motion;
  for (std::size_t p = 0; p < before.counts.size(); ++p) {
    if (before.counts[p] == 0 || (served >= kEnough && !serves(p))) continue;
    const Look& was = before.of[map][p];
    const Look is = look_at(now, capture.clip_space, light, before.seen->points[p]);
    if (!was.inside() || !is.inside()) continue;
    const double a = texel_side(was), b = texel_side(is);
    if (a > 0.0 && b > 0.0) growths.push_back(b / a);
    const glm::dvec2 moved = is.texel - was.texel;
    const glm::dvec2 off = glm::abs(moved - glm::round(moved));
    drifts.push_back(std::max(off.x, off.y));
  }
  motion.points = drifts.size();
  motion.drift = quantile(drifts);
  motion.growth = growths.empty() ? 1.0 : quantile(growths);
  return motion;
}

}  // namespace

void check_motion(const Capture& capture, const LightLooks& before, const LightLooks& now,
                  const BrokenMaps& broken, FindingList& out) {
  const auto light = static_cast<std::size_t>(now.light);
  if (before.map.size() != now.map.size() || light >= before.frame->lights.size() ||
      !same_light(before.frame->lights[light], now.frame->lights[light]))
    return;
  for (std::size_t i = 0; i < now.map.size(); ++i) {
    const CapturedMap &was = before.map_at(i), &is = now.map_at(i);
    if (broken[i] || was.width != is.width || was.height != is.height) continue;
    const Motion motion = motion_of(capture, before, is, now.frame->lights[light], i);
    if (motion.points < kEnough) continue;
    // A twentieth of a texel: edges do not move by what one sees.
    constexpr double kDrifts = 0.05, kJumps = 1.03;
    const double jump = std::max(motion.growth, 1.0 / motion.growth);
    if (jump > kJumps) {
      Finding finding = finding_of(FindingKind::density_jump, now, i, jump, "times");
      finding.what = "Texels of " + map_name(now, i) + " become " + digits(motion.growth) +
                     " times as long from one frame to the next.";
      finding.change = "Keep the map's extent: fit what does not follow the view's turn, in steps.";
      out.add(finding);
    } else if (motion.drift > kDrifts) {
      Finding finding = finding_of(FindingKind::swimming, now, i, motion.drift, "texels");
      finding.what = "Edges in " + map_name(now, i) + " are not stable: its texels move over the world by " +
                     digits(motion.drift) + " of a texel from one frame to the next.";
      finding.change = "Move the map in whole texels, and keep its extent while the camera turns.";
      out.add(finding);
    }
  }
}

}  // namespace gnomon::judge
