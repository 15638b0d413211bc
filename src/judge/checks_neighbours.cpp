// Do maps fit together: texels where one ends and the next begins, places in an atlas, kernels at rims?
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "judge/checks.hpp"

namespace gnomon::judge {
namespace {

/// Texels of neighbouring cascades at the same points, near the depth where they meet.
void check_steps(const LightLooks& looks, const BrokenMaps& broken, FindingList& out) {
  if (looks.selection() != MapSelection::view_depth) return;
  std::vector<std::size_t> order(looks.map.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return looks.map_at(a).begin < looks.map_at(b).begin; });
  // Texels grow as the slices of the view do. What grows more has maps that do not fit their slices.
  constexpr double kMost = 16.0, kStep = 6.0, kTimesSlices = 2.5;
  const auto& depths = looks.seen->depths;
  const double deepest = depths.empty() ? 0.0 : *std::max_element(depths.begin(), depths.end());
  constexpr double kNear = 0.25;  // of the depth
  for (std::size_t k = 0; k + 1 < order.size(); ++k) {
    const std::size_t near = order[k], far = order[k + 1];
    if (broken[near] || broken[far]) continue;
    const double edge = looks.map_at(far).begin;
    std::vector<double> ratios;
    for (std::size_t p = 0; p < looks.counts.size(); ++p) {
      if (looks.counts[p] == 0 || std::abs(looks.seen->depths[p] - edge) > kNear * std::abs(edge)) continue;
      const double a = texel_side(looks.of[near][p]), b = texel_side(looks.of[far][p]);
      if (a > 0.0 && b > 0.0) ratios.push_back(b / a);
    }
    constexpr std::size_t kEnough = 5;
    const double ratio = quantile(ratios), size = std::max(ratio, 1.0 / ratio);
    if (ratios.size() < kEnough) continue;
    const double slices = slice_radius(*looks.frame, looks.map_at(far), deepest) /
                          slice_radius(*looks.frame, looks.map_at(near), deepest);
    const bool odd = size > kStep && std::max(ratio / slices, slices / ratio) > kTimesSlices;
    if (!odd && !(size > kMost)) continue;
    Finding finding = finding_of(FindingKind::density_step, looks, far, size, "times");
    finding.what = "Texels of " + map_name(looks, far) + " are " + digits(ratio) +
                   " times as long as those of " + map_name(looks, near) + " where they meet, at depth " +
                   digits(edge) + ".";
    finding.change =
        odd ? "Fit both maps to their depths with as many texels: " + digits(slices) +
                  " times is what the depths make of it."
            : "Divide the depths more evenly: each end over the one before it by the same factor.";
    out.add(finding);
  }
}

bool overlap(const TexelRect& a, const TexelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

void check_atlas(const Capture& capture, const LightLooks& looks, FindingList& out) {
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    const CapturedMap& map = looks.map_at(i);
    if (map.atlas.empty()) continue;
    const bool outside = capture.atlas_width > 0 && (map.atlas.x + map.atlas.width > capture.atlas_width ||
                                                     map.atlas.y + map.atlas.height > capture.atlas_height);
    if (outside || map.atlas.width != map.width || map.atlas.height != map.height) {
      Finding finding = finding_of(FindingKind::atlas_outside, looks, i, 1.0, "rectangle");
      finding.what = outside ? "The rectangle of " + map_name(looks, i) + " reaches out of the atlas."
                             : "The rectangle of " + map_name(looks, i) + " is " +
                                   std::to_string(map.atlas.width) + " x " +
                                   std::to_string(map.atlas.height) + " texels, the map " +
                                   std::to_string(map.width) + " x " + std::to_string(map.height) + ".";
      finding.change = "Give each map a rectangle of its own size inside of the atlas.";
      out.add(finding);
    }
    // Every pair once, over the maps of all lights.
    for (std::size_t j = looks.map[i] + 1; j < looks.frame->maps.size(); ++j) {
      const CapturedMap& other = looks.frame->maps[j];
      if (other.atlas.empty() || !overlap(map.atlas, other.atlas)) continue;
      Finding finding = finding_of(FindingKind::atlas_overlap, looks, i, 1.0, "pair");
      finding.what = "The rectangles of maps " + std::to_string(looks.map[i]) + " and " + std::to_string(j) +
                     " overlap.";
      finding.change = "Give each map a rectangle of its own.";
      out.add(finding);
    }
  }
}

void check_rims(const LightLooks& looks, const BrokenMaps& broken, FindingList& out) {
  std::vector<std::size_t> beyond(looks.map.size(), 0), last(looks.map.size(), 0);
  std::vector<double> most(looks.map.size(), 0.0);
  std::size_t counted = 0;
  for (std::size_t p = 0; p < looks.counts.size(); ++p) {
    if (looks.counts[p] == 0 || looks.chosen[p] < 0) continue;
    ++counted;
    const auto at = static_cast<std::size_t>(looks.chosen[p]);
    const Look& look = looks.of[at][p];
    if (broken[at] || !look.inside()) continue;
    const CapturedMap& map = looks.map_at(at);
    const glm::dvec2 size{map.width, map.height};
    const glm::dvec2 rim = glm::min(look.texel, size - look.texel);
    const double off = map.filter_texels - std::min(rim.x, rim.y);
    // Half a texel is what any look-up may read beyond its own.
    if (!(off > 0.5)) continue;
    ++beyond[at];
    if (off > most[at]) {
      most[at] = off;
      last[at] = p;
    }
  }
  for (std::size_t i = 0; i < looks.map.size(); ++i) {
    const double share =
        static_cast<double>(beyond[i]) / static_cast<double>(std::max<std::size_t>(counted, 1));
    constexpr double kMatters = 0.01;
    if (beyond[i] < 3 || share < kMatters) continue;
    Finding finding = finding_of(FindingKind::filter_leaves_map, looks, i, share, "share");
    finding.pixel = looks.seen->pixels[last[i]];
    finding.what = "The filter reads beyond the border of " + map_name(looks, i) + " for " + percent(share) +
                   " of the lit surfaces, by up to " + digits(most[i]) + " texels.";
    finding.change =
        "Fit the map with a margin of " + digits(looks.map_at(i).filter_texels) + " texels on every side.";
    out.add(finding);
  }
}

}  // namespace

void check_neighbours(const Capture& capture, const LightLooks& looks, const BrokenMaps& broken,
                      FindingList& out) {
  check_steps(looks, broken, out);
  check_atlas(capture, looks, out);
  check_rims(looks, broken, out);
}

}  // namespace gnomon::judge
