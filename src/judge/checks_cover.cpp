// Do the maps hold what the camera sees, and what shadows it?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

/// Fewer points are the rounding of an edge; boxes only stand for surfaces.
bool matters(std::size_t points, std::size_t of, bool guessed) {
  const double share = static_cast<double>(points) / static_cast<double>(std::max<std::size_t>(of, 1));
  return points >= 3 && share > (guessed ? 0.01 : 0.002);
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
  std::vector<Faulty> cut;  // by map
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
  const double off = depth < 0.0 ? -depth : depth - 1.0;
  missed.cut[map].add(point, off / std::max(std::abs(look.depth_per_world), 1e-300));
  ++missed.cut_count;
  if (in_range(other_depth(look.clip.z, capture.clip_space))) ++missed.cut_in_other_range;
}

Missed missed_by(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken) {
  Missed missed;
  missed.cut.resize(looks.map.size());
  double begin = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < looks.map.size(); ++i) begin = std::min(begin, looks.map_at(i).begin);
  const bool by_depth = looks.frame->selection == MapSelection::view_depth;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0) continue;
    ++missed.counted;
    const int chosen = looks.chosen[p], holding = looks.holding[p];
    if (by_depth && chosen < 0) {
      if (looks.seen->depths[p] > begin) missed.gap.add(p, looks.seen->depths[p]);
      continue;
    }
    if (chosen >= 0) {
      const auto at = static_cast<std::size_t>(chosen);
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
    Finding finding = finding_of(FindingKind::depth_convention, looks, -1,
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
    if (!matters(cut.points.size(), missed.counted, guessed)) continue;
    Finding finding = finding_of(FindingKind::receivers_cut, looks, static_cast<int>(i), share(cut), "share",
                                 pixel_of(looks, cut));
    finding.what = share_text(cut.points.size(), missed.counted) + " of the lit surfaces lie in " +
                   map_name(looks, i) + " but beyond its depths, by up to " + digits(cut.worst) +
                   " world units.";
    finding.change = "Move the map's near or far plane out by that much.";
    out.add(finding);
  }
  if (matters(missed.outside.points.size(), missed.counted, guessed)) {
    Finding finding = finding_of(FindingKind::receivers_outside, looks, -1, share(missed.outside), "share",
                                 pixel_of(looks, missed.outside));
    finding.what = share_text(missed.outside.points.size(), missed.counted) +
                   " of the lit surfaces are in no map: they get no shadow.";
    finding.change = "Fit the maps round all that the camera sees up to the shadows' end.";
    out.add(finding);
  }
  if (matters(missed.disagreed.points.size(), missed.counted, guessed)) {
    Finding finding = finding_of(FindingKind::selection_disagrees, looks, -1, share(missed.disagreed),
                                 "share", pixel_of(looks, missed.disagreed));
    finding.what = "For " + share_text(missed.disagreed.points.size(), missed.counted) +
                   " of the lit surfaces, the map of their view depth does not hold them, and another does.";
    finding.change = "Choose by the same depths that the maps were fitted to, or by what each map holds.";
    out.add(finding);
  }
  if (missed.gap.points.size() >= 3) {
    Finding finding = finding_of(FindingKind::gap_between_maps, looks, -1, share(missed.gap), "share",
                                 pixel_of(looks, missed.gap));
    finding.what = share_text(missed.gap.points.size(), missed.counted) +
                   " of the lit surfaces are at view depths between two maps.";
    finding.change = "Let each map begin where the one before it ends.";
    out.add(finding);
  }
}

/// Where a ray of unit length enters a box from outside; infinite where it does not.
double entry_of(const Box& box, const glm::dvec3& origin, const glm::dvec3& ray) {
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    if (ray[i] == 0.0) {
      if (origin[i] < box.min[i] || origin[i] > box.max[i]) return std::numeric_limits<double>::infinity();
      continue;
    }
    const double a = (box.min[i] - origin[i]) / ray[i], b = (box.max[i] - origin[i]) / ray[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave && enter > 0.0 ? enter : std::numeric_limits<double>::infinity();
}

void check_casters(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                   FindingList& out) {
  const Light& light = looks.frame->lights[static_cast<std::size_t>(looks.light)];
  std::vector<Faulty> cut(looks.map.size());
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
    // Where the ray to the light meets the near plane.
    const glm::dvec3 point = looks.seen->points[p], back = -travel_at(light, point);
    const glm::dmat4& m = map.clip_from_world;
    const double near_z = capture.clip_space.reversed_z                           ? 1.0
                          : capture.clip_space.ndc_depth == NdcDepth::zero_to_one ? 0.0
                                                                                  : -1.0;
    const glm::dvec4 here = m * glm::dvec4(point, 1.0), growth = m * glm::dvec4(back, 0.0);
    const double near_at = (near_z * here.w - here.z) / (growth.z - near_z * growth.w);
    if (!(near_at > 0.0)) continue;
    for (const Box& caster : looks.scene->casters) {
      const double enter = entry_of(caster, point, back);
      if (std::isfinite(enter) && enter > near_at * (1.0 + 1e-6)) {
        cut[at].add(p, enter - near_at);
        break;
      }
    }
  }
  for (std::size_t i = 0; i < cut.size(); ++i) {
    if (!matters(cut[i].points.size(), counted, false)) continue;
    Finding finding = finding_of(FindingKind::casters_cut, looks, static_cast<int>(i),
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
      Finding finding = finding_of(FindingKind::map_unseen, looks, static_cast<int>(i), texels, "texels");
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
    Finding finding =
        finding_of(FindingKind::texels_unseen, looks, static_cast<int>(i), 1.0 - share, "share");
    finding.what = percent(1.0 - share) + " of the texels of " + map_name(looks, i) +
                   " lie outside of all that the camera sees in it.";
    finding.change = "Fit the map to the visible receivers: the texels would be " + digits(std::sqrt(share)) +
                     " times as long.";
    out.add(finding);
  }
}

}  // namespace

void check_cover(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                 FindingList& out) {
  report_missed(capture, looks, missed_by(capture, looks, broken), out);
  check_casters(capture, looks, broken, out);
  check_use(looks, broken, out);
}

}  // namespace gnomon::judge
