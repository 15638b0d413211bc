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

/// Points of one map that are in it, but before its near plane or behind its far one.
struct Cut {
  Faulty points;
  double before = 0.0, behind = 0.0;  // world units, along the light
};

/// How the points that no map serves are missed.
struct Missed {
  Faulty outside, disagreed;
  std::vector<Cut> cut;             // by map
  std::vector<std::size_t> served;  // by map: points that it is to serve
  std::vector<std::size_t> pairs;   // by the chosen map, then by the one that holds the point
  std::vector<double> reach;  // of points outside, from the middle of the map nearest to them: 1 is its rim
  std::vector<std::size_t> nearest;  // by map: for how many of them it is that
  std::size_t counted = 0, cut_count = 0, cut_in_other_range = 0;
  double least_z = 0.0;  // of those cut
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
      std::abs(way_to_depth(looks.map_at(map), capture.clip_space, position, way, depth < 0.0 ? 0.0 : 1.0));
  Cut& cut = missed.cut[map];
  cut.points.add(point, off);
  double& side = depth < 0.0 ? cut.before : cut.behind;
  side = std::max(side, off);
  ++missed.cut_count;
  missed.least_z = std::min(missed.least_z, look.clip.z);
  if (in_range(other_depth(look.clip.z, capture.clip_space))) ++missed.cut_in_other_range;
}

void add_outside(const LightLooks& looks, std::size_t point, Missed& missed) {
  missed.outside.add(point, looks.seen->depths[point]);
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  const int chosen = looks.chosen[point];
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    const Look& look = looks.of[i][point];
    if ((chosen >= 0 && static_cast<std::size_t>(chosen) != i) || !(look.w > 0.0)) continue;
    const double reach = std::max(std::abs(look.clip.x), std::abs(look.clip.y));
    if (!(reach < least)) continue;
    least = reach;
    nearest = i;
  }
  if (!std::isfinite(least)) return;
  missed.reach.push_back(least);
  ++missed.nearest[nearest];
}

Missed missed_by(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken) {
  Missed missed;
  const std::size_t maps = looks.map.size();
  missed.cut.resize(maps);
  missed.served.resize(maps);
  missed.nearest.resize(maps);
  missed.pairs.resize(maps * maps);
  // Another map holds them: by map those that the chosen one does not show, and those that it cuts.
  std::vector<std::size_t> beside(maps, 0);
  std::vector<std::vector<std::size_t>> cut_and_held(maps);
  const auto disagree = [&](std::size_t at, std::size_t p) {
    missed.disagreed.add(p, looks.seen->depths[p]);
    ++missed.pairs[at * maps + static_cast<std::size_t>(looks.holding[p])];
  };
  const bool by_depth = looks.selection() == MapSelection::view_depth;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0) continue;
    ++missed.counted;
    const int chosen = looks.chosen[p], holding = looks.holding[p];
    if (by_depth && chosen < 0) continue;  // check_depths() has it
    if (chosen >= 0) {
      const auto at = static_cast<std::size_t>(chosen);
      ++missed.served[at];
      if (broken[at]) continue;
      const Look& look = looks.of[at][p];
      if (look.inside() && in_range(depth_of(look.clip.z, capture.clip_space))) continue;
      if (holding >= 0 && look.inside()) {
        cut_and_held[at].push_back(p);
      } else if (holding >= 0) {
        ++beside[at];
        disagree(at, p);
      } else if (look.inside()) {
        add_cut(capture, looks, at, p, missed);
      } else {
        add_outside(looks, p, missed);
      }
      continue;
    }
    // No map holds it: one that shows it across the light cuts it along it.
    bool cut = false, all_broken = true;
    for (std::size_t i = 0; i < maps && !cut; ++i) {
      all_broken = all_broken && broken[i];
      if (broken[i] || !looks.of[i][p].inside()) continue;
      add_cut(capture, looks, i, p, missed);
      cut = true;
    }
    if (!cut && !all_broken) add_outside(looks, p, missed);
  }
  // A map of other depths shows some and cuts some; one whose planes are wrong shows all.
  for (std::size_t at = 0; at < maps; ++at) {
    for (const std::size_t p : cut_and_held[at]) {
      if (beside[at] > cut_and_held[at].size()) {
        disagree(at, p);
      } else {
        add_cut(capture, looks, at, p, missed);
      }
    }
  }
  return missed;
}

std::string share_text(std::size_t points, std::size_t of) {
  return percent(static_cast<double>(points) / static_cast<double>(std::max<std::size_t>(of, 1)));
}

/// Depths of clip space that are of the other range, and not cut by a plane.
bool is_other_range(const Capture& capture, const LightLooks& looks, const Missed& missed) {
  // Planes that cut that deep would be seen at once.
  constexpr double kDeep = -0.3;
  return missed.cut_count > 0 && missed.cut_in_other_range * 10 > missed.cut_count * 9 &&
         missed.least_z < kDeep && !camera_fits(capture, looks);
}

void report_cut(const Capture& capture, const LightLooks& looks, const Missed& missed, FindingList& out) {
  const bool guessed = looks.seen->guessed;
  const auto share = [&](std::size_t points) {
    return static_cast<double>(points) / static_cast<double>(std::max<std::size_t>(missed.counted, 1));
  };
  const bool other_range = is_other_range(capture, looks, missed);
  if (other_range && matters(missed.cut_count, missed.counted, guessed)) {
    const Cut* most = &missed.cut.front();
    for (const Cut& cut : missed.cut) {
      if (cut.points.points.size() > most->points.points.size()) most = &cut;
    }
    Finding finding = finding_of(FindingKind::depth_convention, looks, std::nullopt, share(missed.cut_count),
                                 "share", pixel_of(looks, most->points));
    // No depth of 0..1 is outside of -1..1: the range said is 0..1.
    finding.what = share_text(missed.cut_count, missed.counted) +
                   " of the lit surfaces have depths that fit -1..1 and not 0..1.";
    finding.change =
        "Convert the matrix from OpenGL's depths, or say minus_one_to_one in clip_space. If 0..1 is right, a "
        "plane cuts "
        "them: move it by up to " +
        digits(most->points.worst) + " world units.";
    out.add(finding);
  }
  for (std::size_t i = 0; i < missed.cut.size() && !other_range; ++i) {
    const Cut& cut = missed.cut[i];
    const std::size_t points = cut.points.points.size();
    if (!matters(points, missed.counted, guessed) && !matters_there(points, missed.served[i])) continue;
    Finding finding =
        finding_of(FindingKind::receivers_cut, looks, i, share(points), "share", pixel_of(looks, cut.points));
    const bool both = cut.before > 0.0 && cut.behind > 0.0;
    const std::string where = both               ? "outside of its near and far planes"
                              : cut.before > 0.0 ? "before its near plane"
                                                 : "behind its far plane";
    finding.what = share_text(points, missed.counted) + " of the lit surfaces lie in " + map_name(looks, i) +
                   " but " + where + ", by up to " + digits(cut.points.worst) + " world units.";
    finding.change = both ? "Move the near plane " + digits(cut.before) +
                                " towards the light and the far plane " + digits(cut.behind) +
                                " away from it, in world units."
                          : (cut.before > 0.0 ? "Move the near plane towards the light by that much."
                                              : "Move the far plane away from the light by that much.");
    out.add(finding);
  }
}

void report_outside(const LightLooks& looks, const Missed& missed, FindingList& out) {
  const std::size_t points = missed.outside.points.size();
  if (!matters(points, missed.counted, looks.seen->guessed)) return;
  Finding finding = finding_of(FindingKind::receivers_outside, looks, std::nullopt,
                               static_cast<double>(points) / static_cast<double>(missed.counted), "share",
                               pixel_of(looks, missed.outside));
  finding.what =
      share_text(points, missed.counted) + " of the lit surfaces are in no map: they get no shadow.";
  finding.change = "Fit the maps round all that the camera sees up to the shadows' end";
  const double reach = quantile(missed.reach, 1.0);
  constexpr double kTold = 100.0;
  if (reach > 1.0 && reach < kTold) {
    const auto most = std::max_element(missed.nearest.begin(), missed.nearest.end()) - missed.nearest.begin();
    finding.change += ": the farthest is " + digits(reach) + " times as far from the middle of " +
                      map_name(looks, static_cast<std::size_t>(most)) + " as its border";
  }
  finding.change += ".";
  out.add(finding);
}

void report_disagreed(const LightLooks& looks, const Missed& missed, FindingList& out) {
  const std::size_t points = missed.disagreed.points.size();
  if (!matters(points, missed.counted, looks.seen->guessed)) return;
  const auto most = static_cast<std::size_t>(std::max_element(missed.pairs.begin(), missed.pairs.end()) -
                                             missed.pairs.begin());
  const std::size_t chosen = most / looks.map.size(), holding = most % looks.map.size();
  Finding finding = finding_of(FindingKind::selection_disagrees, looks, std::nullopt,
                               static_cast<double>(points) / static_cast<double>(missed.counted), "share",
                               pixel_of(looks, missed.disagreed));
  finding.what =
      "For " + share_text(points, missed.counted) +
      " of the lit surfaces, the map of their view depth does not hold them, and another does: mostly " +
      map_name(looks, chosen) + " and " + map_name(looks, holding) + ".";
  finding.change = "Choose by the same depths that the maps were fitted to, or by what each map holds.";
  out.add(finding);
}

void check_casters(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                   FindingList& out) {
  const Light& light = looks.source();
  std::vector<Faulty> cut(looks.map.size());
  std::vector<std::size_t> served(looks.map.size(), 0);
  std::size_t counted = 0;
  const std::size_t step = step_over_casters(looks.counts.size(), *looks.scene);
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

}  // namespace

void check_cover(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                 FindingList& out) {
  const Missed missed = missed_by(capture, looks, broken);
  report_cut(capture, looks, missed, out);
  report_outside(looks, missed, out);
  report_disagreed(looks, missed, out);
  check_casters(capture, looks, broken, out);
}

}  // namespace gnomon::judge
