// Do the maps hold what the camera sees, and what shadows it?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/travel.hpp"
#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

/// Fewer points are the rounding of an edge; boxes only stand for surfaces.
bool matters(std::size_t points, std::size_t of, bool guessed) {
  const double share = static_cast<double>(points) / static_cast<double>(std::max<std::size_t>(of, 1));
  return points >= 3 && share > (guessed ? 0.005 : 0.002);
}
/// The same of one map that serves few points: of its own.
bool matters_there(std::size_t points, std::size_t of_map) {
  return points >= 5 && 20 * points > of_map;
}

/// Points of one fault, by map.
struct Faulty {
  std::vector<std::size_t> points;
  double worst = 0.0;
  std::size_t worst_point = 0;
  void add(std::size_t point, double size) {
    points.push_back(point);
    if (points.size() > 1 && !(size > worst)) return;
    worst = size;
    worst_point = point;
  }
};

std::optional<glm::dvec2> pixel_of(const LightLooks& looks, const Faulty& faulty) {
  if (faulty.points.empty()) return std::nullopt;
  return looks.seen->pixels[faulty.worst_point];
}

bool in_range(double depth) {
  return depth >= -kRim && depth <= 1.0 + kRim;
}

/// How the points that no map serves are missed.
struct Missed {
  Faulty outside, disagreed, gap;
  std::vector<Faulty> cut;          // by map
  std::vector<std::size_t> served;  // by map: points that it is to serve
  std::size_t counted = 0, cut_count = 0, cut_in_other_range = 0;
};

/// Depth of the point if the matrix were of the other depth range.
double other_depth(double z, const ClipSpace& space) {
  ClipSpace other = space;
  other.ndc_depth =
      space.ndc_depth == NdcDepth::zero_to_one ? NdcDepth::minus_one_to_one : NdcDepth::zero_to_one;
  return depth_of(z, other);
}

void add_cut(const Capture& capture, const LightLooks& looks, std::size_t map, std::size_t point,
             Missed& missed) {
  const Look& look = looks.of[map][point];
  const double depth = depth_of(look.clip.z, capture.clip_space);
  // Along the light's ray: depth under a perspective is no length.
  const glm::dvec3 position = looks.seen->points[point];
  const glm::dvec3 way = travel_at(looks.source(), position);
  const double off =
      way_to_depth(looks.map_at(map), capture.clip_space, position, way, depth < 0.0 ? 0.0 : 1.0);
  missed.cut[map].add(point, std::abs(off));
  ++missed.cut_count;
  if (in_range(other_depth(look.clip.z, capture.clip_space))) ++missed.cut_in_other_range;
}

Missed missed_by(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken) {
  Missed missed;
  missed.cut.resize(looks.map.size());
  missed.served.resize(looks.map.size());
  const bool by_depth = looks.frame->selection == MapSelection::view_depth;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0) continue;
    ++missed.counted;
    const int chosen = looks.chosen[p], holding = looks.holding[p];
    if (by_depth && chosen < 0) {
      missed.gap.add(p, looks.seen->depths[p]);
      continue;
    }
    if (chosen >= 0) {
      const auto at = static_cast<std::size_t>(chosen);
      ++missed.served[at];
      if (broken[at]) continue;
      const Look& look = looks.of[at][p];
      if (look.inside() && in_range(depth_of(look.clip.z, capture.clip_space))) continue;
      if (holding >= 0) {
        missed.disagreed.add(p, looks.seen->depths[p]);
      } else if (look.inside()) {
        add_cut(capture, looks, at, p, missed);
      } else {
        missed.outside.add(p, looks.seen->depths[p]);
      }
      continue;
    }
    // No map holds it: one that shows it across the light cuts it along it.
    bool cut = false, all_broken = true;
    for (std::size_t i = 0; i < looks.map.size() && !cut; ++i) {
      all_broken = all_broken && broken[i];
      if (broken[i] || !looks.of[i][p].inside()) continue;
      add_cut(capture, looks, i, p, missed);
      cut = true;
    }
    if (!cut && !all_broken) missed.outside.add(p, looks.seen->depths[p]);
  }
  return missed;
}

std::string share_text(std::size_t points, std::size_t of) {
  return percent(static_cast<double>(points) / static_cast<double>(std::max<std::size_t>(of, 1)));
}

void report_missed(const Capture& capture, const LightLooks& looks, const Missed& missed, FindingList& out) {
  const auto share = [&](const Faulty& faulty) {
    return static_cast<double>(faulty.points.size()) /
           static_cast<double>(std::max<std::size_t>(missed.counted, 1));
  };
  const bool guessed = looks.seen->guessed;
  const bool other_range = missed.cut_count > 0 && missed.cut_in_other_range * 10 > missed.cut_count * 9;
  if (other_range && matters(missed.cut_count, missed.counted, guessed)) {
    const Faulty* most = &missed.cut.front();
    for (const Faulty& cut : missed.cut) {
      if (cut.points.size() > most->points.size()) most = &cut;
    }
    Finding finding = finding_of(FindingKind::depth_convention, looks, std::nullopt,
                                 static_cast<double>(missed.cut_count) / static_cast<double>(missed.counted),
                                 "share", pixel_of(looks, *most));
    const bool zero = capture.clip_space.ndc_depth == NdcDepth::zero_to_one;
    finding.what = share_text(missed.cut_count, missed.counted) +
                   " of the lit surfaces have depths that fit " + (zero ? "-1..1" : "0..1") + " and not " +
                   (zero ? "0..1" : "-1..1") + ".";
    finding.change = zero ? "Convert the matrix from OpenGL's depths, or say minus_one_to_one in clip_space."
                          : "Say zero_to_one in clip_space, or build the matrix for -1..1.";
    out.add(finding);
  }
  for (std::size_t i = 0; i < missed.cut.size() && !other_range; ++i) {
    const Faulty& cut = missed.cut[i];
    if (!matters(cut.points.size(), missed.counted, guessed) &&
        !matters_there(cut.points.size(), missed.served[i]))
      continue;
    Finding finding =
        finding_of(FindingKind::receivers_cut, looks, i, share(cut), "share", pixel_of(looks, cut));
    finding.what = share_text(cut.points.size(), missed.counted) + " of the lit surfaces lie in " +
                   map_name(looks, i) + " but beyond its depths, by up to " + digits(cut.worst) +
                   " world units.";
    finding.change = "Move the map's near or far plane out by that much.";
    out.add(finding);
  }
  if (matters(missed.outside.points.size(), missed.counted, guessed)) {
    Finding finding = finding_of(FindingKind::receivers_outside, looks, std::nullopt, share(missed.outside),
                                 "share", pixel_of(looks, missed.outside));
    finding.what = share_text(missed.outside.points.size(), missed.counted) +
                   " of the lit surfaces are in no map: they get no shadow.";
    finding.change = "Fit the maps round all that the camera sees up to the shadows' end.";
    out.add(finding);
  }
  if (matters(missed.disagreed.points.size(), missed.counted, guessed)) {
    Finding finding = finding_of(FindingKind::selection_disagrees, looks, std::nullopt,
                                 share(missed.disagreed), "share", pixel_of(looks, missed.disagreed));
    finding.what = "For " + share_text(missed.disagreed.points.size(), missed.counted) +
                   " of the lit surfaces, the map of their view depth does not hold them, and another does.";
    finding.change = "Choose by the same depths that the maps were fitted to, or by what each map holds.";
    out.add(finding);
  }
  if (missed.gap.points.size() >= 3) {
    Finding finding = finding_of(FindingKind::gap_between_maps, looks, std::nullopt, share(missed.gap),
                                 "share", pixel_of(looks, missed.gap));
    finding.what = share_text(missed.gap.points.size(), missed.counted) +
                   " of the lit surfaces are at view depths before the first map or between two.";
    finding.change = "Let the first map begin at the near plane, and each where the one before it ends.";
    out.add(finding);
  }
}

/// From a point to the light; infinite to a sun.
double distance_to(const Light& light, const glm::dvec3& point) {
  if (std::holds_alternative<DirectionalLight>(light)) return std::numeric_limits<double>::infinity();
  return glm::length(position_of(light) - point);
}

void check_casters(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                   FindingList& out) {
  const Light& light = looks.source();
  std::vector<Faulty> cut(looks.map.size());
  std::vector<std::size_t> served(looks.map.size(), 0);
  std::size_t counted = 0;
  // Every point against every caster: a few points of very many casters tell as much.
  constexpr std::size_t kMostTests = 20'000'000;
  const std::size_t casters = std::max<std::size_t>(looks.scene->casters.size(), 1);
  const std::size_t step = 1 + looks.counts.size() * casters / kMostTests;
  for (std::size_t p = 0; p < looks.counts.size(); p += step) {
    if (looks.counts[p] == 0 || looks.chosen[p] < 0) continue;
    const auto at = static_cast<std::size_t>(looks.chosen[p]);
    const CapturedMap& map = looks.map_at(at);
    const Look& look = looks.of[at][p];
    if (broken[at] || map.clamps_depth || !look.inside() || !(look.depth_per_world > 0.0)) continue;
    ++counted;
    ++served[at];
    const glm::dvec3 point = looks.seen->points[p], back = -travel_at(light, point);
    const double near_at = way_to_depth(map, capture.clip_space, point, back, 0.0);
    if (!(near_at > 0.0)) continue;
    const double light_at = distance_to(light, point);
    for (const Box& caster : looks.scene->casters) {
      const BoxCrossing crossing = crossing_of(caster, point, back);
      if (crossing.enter <= crossing.leave && crossing.enter > near_at * (1.0 + 1e-6) &&
          crossing.enter < light_at) {
        cut[at].add(p, std::min(crossing.leave, light_at) - near_at);
        break;
      }
    }
  }
  for (std::size_t i = 0; i < cut.size(); ++i) {
    if (!matters(cut[i].points.size(), counted, false) && !matters_there(cut[i].points.size(), served[i]))
      continue;
    Finding finding = finding_of(FindingKind::casters_cut, looks, i,
                                 static_cast<double>(cut[i].points.size()) / static_cast<double>(counted),
                                 "share", pixel_of(looks, cut[i]));
    finding.what = "Casters of " + share_text(cut[i].points.size(), counted) +
                   " of the lit surfaces stand before the near plane of " + map_name(looks, i) +
                   ", by up to " + digits(cut[i].worst) + " world units: their shadows are missing.";
    finding.change = "Move the near plane towards the light by that much, or clamp depths while drawing.";
    out.add(finding);
  }
}

void check_use(const LightLooks& looks, const BrokenMaps& broken, FindingList& out) {
  std::size_t counted = 0;
  std::vector<std::size_t> served(looks.map.size(), 0);
  struct Extent {
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  };
  std::vector<Extent> used(looks.map.size());
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0) continue;
    ++counted;
    if (looks.chosen[p] < 0) continue;
    const auto at = static_cast<std::size_t>(looks.chosen[p]);
    const Look& look = looks.of[at][p];
    if (!look.inside()) continue;
    ++served[at];
    used[at].low = glm::min(used[at].low, look.texel);
    used[at].high = glm::max(used[at].high, look.texel);
  }
  // Fewer points do not show how far the seen surfaces reach.
  constexpr std::size_t kEnough = 200, kEnoughOfMap = 50;
  constexpr double kLeastUsed = 0.04;
  if (counted < kEnough) return;
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    if (broken[i]) continue;
    const CapturedMap& map = looks.map_at(i);
    const double texels = static_cast<double>(map.width) * map.height;
    if (served[i] == 0) {
      Finding finding = finding_of(FindingKind::map_unseen, looks, i, texels, "texels");
      finding.what = "Nothing that the camera sees reads " + map_name(looks, i) + ": " +
                     digits(texels * 1e-6) + " million texels are drawn for nothing.";
      finding.change = "Skip the map in such frames, or divide the depths that show something.";
      out.add(finding);
      continue;
    }
    if (served[i] < kEnoughOfMap) continue;
    const glm::dvec2 size = used[i].high - used[i].low + 2.0 * map.filter_texels;
    const double share = std::min(1.0, size.x / map.width) * std::min(1.0, size.y / map.height);
    if (share >= kLeastUsed) continue;
    Finding finding = finding_of(FindingKind::texels_unseen, looks, i, 1.0 - share, "share");
    finding.what = percent(1.0 - share) + " of the texels of " + map_name(looks, i) +
                   " lie outside of all that the camera sees in it.";
    finding.change = "Fit the map to the visible receivers: the texels would be " + digits(std::sqrt(share)) +
                     " times as long.";
    out.add(finding);
  }
}

/// Lit surfaces in view, none of which is at the depths that the maps serve.
bool check_depths(const LightLooks& looks, FindingList& out) {
  std::size_t lit = 0, counted = 0;
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
  for (std::size_t p = 0; p < looks.lit.size(); ++p) {
    counted += looks.counts[p] != 0 && looks.chosen[p] >= 0 ? 1 : 0;
    if (looks.lit[p] == 0) continue;
    ++lit;
    nearest = std::min(nearest, looks.seen->depths[p]);
    farthest = std::max(farthest, looks.seen->depths[p]);
  }
  if (looks.map.empty() || lit < 3 || counted > 0 || looks.frame->selection != MapSelection::view_depth)
    return true;
  double begin = std::numeric_limits<double>::infinity(), end = -begin;
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    begin = std::min(begin, looks.map_at(i).begin);
    end = std::max(end, looks.map_at(i).end);
  }
  Finding finding = finding_of(FindingKind::gap_between_maps, looks, std::nullopt, 1.0, "share");
  finding.what = "No lit surface is at the view depths that the maps serve (" + digits(begin) + " to " +
                 digits(end) + "): they are at " + digits(nearest) + " to " + digits(farthest) + ".";
  finding.change = "Give depths in world units, from the eye forward, and a camera that looks at the scene.";
  out.add(finding);
  return false;
}

}  // namespace

void check_cover(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                 FindingList& out) {
  if (!check_depths(looks, out)) return;
  report_missed(capture, looks, missed_by(capture, looks, broken), out);
  check_casters(capture, looks, broken, out);
  check_use(looks, broken, out);
}

}  // namespace gnomon::judge
