// Are texels where they are seen, and is each point read from the finest map that is there for it?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

/// What the camera reads of one map.
struct Use {
  std::size_t served = 0;
  Extent texels;
  double deepest = 0.0;       // view depth
  std::vector<double> sides;  // of texels, world units
};

void report_unseen(const LightLooks& looks, std::size_t map_index, const Use& use, FindingList& out) {
  const CapturedMap& map = looks.map_at(map_index);
  const glm::dvec2 size = use.texels.high - use.texels.low + 2.0 * map.filter_texels;
  const double share = std::min(1.0, size.x / map.width) * std::min(1.0, size.y / map.height);
  // A map that turns with no view is as wide as its depths are long; a local light's as wide as its cone.
  constexpr double kNearlyNone = 0.005, kLeastUsed = 0.08, kTimesSlice = 1.5;
  const double deepest = std::isfinite(map.end) ? map.end : use.deepest;
  const bool sun = std::holds_alternative<DirectionalLight>(looks.source());
  const bool wide = sun && share < kLeastUsed &&
                    std::min(map.width, map.height) - 2.0 * map.filter_texels >
                        kTimesSlice * 2.0 * slice_radius(*looks.frame, map, deepest) / quantile(use.sides);
  if (!wide && !(share < kNearlyNone)) return;
  Finding finding = finding_of(FindingKind::texels_unseen, looks, map_index, 1.0 - share, "share");
  finding.what = percent(1.0 - share) + " of the texels of " + map_name(looks, map_index) +
                 " lie outside of all that the camera sees in it.";
  finding.change = "Fit the map to the visible receivers: the texels would be " + digits(std::sqrt(share)) +
                   " times as long.";
  out.add(finding);
}

/// A spot's map that is much wider than its cone.
void check_cone(const LightLooks& looks, std::size_t map_index, FindingList& out) {
  const auto* spot = std::get_if<SpotLight>(&looks.source());
  if (spot == nullptr) return;
  const PerspectiveAxes axes = perspective_axes(looks.map_at(map_index));
  if (!axes.perspective || spot->outer_radians > 1.4) return;
  const double cone = std::tan(spot->outer_radians), widest = 1.0 / std::min(axes.focal.x, axes.focal.y);
  const double share = std::min(1.0, cone * axes.focal.x) * std::min(1.0, cone * axes.focal.y);
  constexpr double kWide = 1.5, kWholeAngle = 360.0 / std::numbers::pi;
  if (!(widest > kWide * cone)) return;
  Finding finding = finding_of(FindingKind::texels_unseen, looks, map_index, 1.0 - share, "share");
  finding.what = percent(1.0 - share) + " of the texels of " + map_name(looks, map_index) +
                 " lie outside of its light's cone.";
  finding.change = "Give the map a field of view of " + digits(kWholeAngle * spot->outer_radians) +
                   " degrees in place of " + digits(kWholeAngle * std::atan(widest)) + ".";
  out.add(finding);
}

/// Points of the map `from` that the map `to` holds with finer texels, although it is there for others.
struct Coarser {
  std::size_t first = 0;      // of the points
  std::vector<double> times;  // by point
};

bool is_finer(const Capture& capture, const LightLooks& looks, std::size_t from, std::size_t to,
              std::size_t point, double& times) {
  const Look &has = looks.of[from][point], &could = looks.of[to][point];
  const double depth = depth_of(could.clip.z, capture.clip_space);
  const CapturedMap& map = looks.map_at(to);
  const double rim = 1.0 - 2.0 * (map.filter_texels + 1.0) / std::min(map.width, map.height);
  if (!(could.w > 0.0) || depth < 0.0 || depth > 1.0 || std::abs(could.clip.x) > rim ||
      std::abs(could.clip.y) > rim)
    return false;
  // A map of fewer texels is coarse by choice: check_steps() has it.
  constexpr double kTimes = 1.6;
  const double fewer = std::min(1.0, static_cast<double>(looks.map_at(from).width) / map.width);
  times = texel_side(has) / texel_side(could);
  return times * fewer > kTimes;
}

/// Maps in the wrong order: a nearer one has longer texels than a farther one that holds the same.
void check_order(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                 FindingList& out) {
  const MapSelection selection = looks.selection();
  if (selection == MapSelection::finest) return;
  const std::size_t maps = looks.map.size();
  // Texels of a perspective map are not in order by their map.
  std::vector<bool> compared(maps);
  for (std::size_t i = 0; i < maps; ++i)
    compared[i] = !broken[i] && !perspective_axes(looks.map_at(i)).perspective;
  std::vector<Coarser> coarser(maps * maps);
  std::size_t counted = 0;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0 || looks.chosen[p] < 0) continue;
    ++counted;
    const auto from = static_cast<std::size_t>(looks.chosen[p]);
    if (!compared[from] || !looks.of[from][p].inside()) continue;
    for (std::size_t to = 0; to < maps; ++to) {
      const bool later = selection == MapSelection::view_depth
                             ? looks.map_at(to).begin > looks.map_at(from).begin
                             : to > from;
      double times = 0.0;
      if (!later || !compared[to] || !is_finer(capture, looks, from, to, p, times)) continue;
      Coarser& c = coarser[from * maps + to];
      if (c.times.empty()) c.first = p;
      c.times.push_back(times);
    }
  }
  const auto most = std::max_element(coarser.begin(), coarser.end(), [](const Coarser& a, const Coarser& b) {
    return a.times.size() < b.times.size();
  });
  constexpr std::size_t kEnough = 20;
  if (most == coarser.end() || most->times.size() < kEnough || 10 * most->times.size() < counted) return;
  const auto at = static_cast<std::size_t>(most - coarser.begin());
  const std::size_t from = at / maps, to = at % maps;
  const double share = static_cast<double>(most->times.size()) / static_cast<double>(counted);
  Finding finding = finding_of(FindingKind::selection_disagrees, looks, from, share, "share",
                               looks.seen->pixels[most->first]);
  finding.what = "For " + percent(share) + " of the lit surfaces, " + map_name(looks, from) +
                 " is chosen, whose texels are " + digits(quantile(most->times)) +
                 " times as long as those of " + map_name(looks, to) + ", which holds them too.";
  finding.change =
      selection == MapSelection::view_depth
          ? "Give both maps the depths that they were fitted to, or fit " + map_name(looks, from) +
                " to its own."
          : "List maps from the finest to the coarsest, or choose the finest that holds a point.";
  out.add(finding);
}

}  // namespace

void check_use(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken, FindingList& out) {
  std::size_t counted = 0;
  std::vector<Use> uses(looks.map.size());
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0) continue;
    ++counted;
    if (looks.chosen[p] < 0) continue;
    const auto at = static_cast<std::size_t>(looks.chosen[p]);
    const Look& look = looks.of[at][p];
    if (!look.inside()) continue;
    Use& use = uses[at];
    ++use.served;
    use.texels.low = glm::min(use.texels.low, look.texel);
    use.texels.high = glm::max(use.texels.high, look.texel);
    use.deepest = std::max(use.deepest, looks.seen->depths[p]);
    use.sides.push_back(texel_side(look));
  }
  // Fewer points do not show how far the seen surfaces reach.
  constexpr std::size_t kEnough = 200, kEnoughForNone = 1000, kEnoughOfMap = 50;
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    if (broken[i]) continue;
    check_cone(looks, i, out);
    const CapturedMap& map = looks.map_at(i);
    const double texels = static_cast<double>(map.width) * map.height;
    if (uses[i].served == 0 && counted >= kEnoughForNone) {
      Finding finding = finding_of(FindingKind::map_unseen, looks, i, texels, "texels");
      finding.what = "Nothing that the camera sees reads " + map_name(looks, i) + ": " +
                     digits(texels * 1e-6) + " million texels are drawn for nothing.";
      finding.change = "Skip the map in such frames, or divide the depths that show something.";
      out.add(finding);
    }
    if (uses[i].served >= kEnoughOfMap && counted >= kEnough) report_unseen(looks, i, uses[i], out);
  }
  check_order(capture, looks, broken, out);
}

}  // namespace gnomon::judge
