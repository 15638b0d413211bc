// Which view depths a plan covers, and where it divides them.
// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010; slices that step over depths
// without samples are this project's.
#include "plan_splits.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "elementary.hpp"
#include "split_optimal.hpp"
#include "steady.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

/// Depths that one bin stands for, with the safety on both sides.
DepthRange range_of(const VisibleDepths& depths, int bin) noexcept {
  const double first = bin == 0 ? 0.0 : depth_bin_begin(bin);
  const double last = bin == kDepthBins - 1 ? depths.max : depth_bin_begin(bin + 1);
  return {max_of(first, depths.min) * (1.0 - kDepthSafety), min_of(last, depths.max) * (1.0 + kDepthSafety)};
}

DepthRange seen_between(const VisibleDepths& depths, double begin, double end) noexcept {
  DepthRange seen{end, begin};
  if (!(begin <= end)) return seen;
  const int first = depth_bin(max_of(begin, depths.min) / (1.0 + kDepthSafety));
  const int last = depth_bin(min_of(end, depths.max) / (1.0 - kDepthSafety));
  const auto take = [&](int bin) {
    if (depths.count[static_cast<std::size_t>(bin)] == 0) return false;
    const DepthRange range = range_of(depths, bin);
    if (!(range.end > begin && range.begin < end)) return false;
    seen = {min_of(seen.begin, max_of(begin, range.begin)), max_of(seen.end, min_of(end, range.end))};
    return true;
  };
  int bin = first;
  while (bin <= last && !take(bin)) ++bin;
  for (int back = last; back > bin && !take(back); --back) {
  }
  // A single point within the last bin.
  return seen.begin < seen.end ? seen : DepthRange{end, begin};
}

void tell_unseen(const PlanContext& c, OmissionKind kind, double begin, double end) noexcept {
  // Saving less than this share of the depths is not worth a line.
  constexpr double kWorthTelling = 0.01;
  if (end > begin * (1.0 + kWorthTelling)) omit(c.plan, {kind, -1, begin, end, 0});
}

/// Depths that hold receivers, or all of the camera's.
DepthRange received_depths(const PlanContext& c, const Polytope& body) noexcept {
  const double n = c.camera.near_depth, f = c.camera.far_depth;
  const bool whole = c.options.split_range == SplitRange::camera ||
                     (c.options.split_range == SplitRange::automatic && c.stable);
  if (whole) return {n, f};
  double low = f, high = n;
  for (const Polytope::Vertex& v : body.vertices()) {
    const double depth = glm::dot(c.axes.forward, v.position);
    low = min_of(low, depth);
    high = max_of(high, depth);
  }
  // A flat scene's depth must not fall outside its own range by rounding.
  constexpr double kRounding = 1e-12;
  const double begin = clamp_to(low - kRounding * std::abs(low), n, f);
  const double end = clamp_to(high + kRounding * std::abs(high), begin, f);
  tell_unseen(c, OmissionKind::depth_without_receiver, n, begin);
  tell_unseen(c, OmissionKind::depth_without_receiver, end, f);
  return {begin, end};
}

/// Surfaces that are all no receivers, or a histogram of another scene, are as good as unknown.
const VisibleDepths* usable_depths(const PlanContext& c, DepthRange received) noexcept {
  const VisibleDepths* depths = c.options.visible_depths;
  if (depths == nullptr || depths->empty() || c.camera.orthographic) return nullptr;
  if (c.options.split_range == SplitRange::camera) return nullptr;
  return seen_between(*depths, received.begin, received.end).empty() ? nullptr : depths;
}

/// Lays slices no longer than `ratio` over what is seen, each beginning at the first depth seen after the one
/// before it. Writes where they end; returns how many it takes, or one more than there is room for.
std::size_t lay_slices(const VisibleDepths& depths, DepthRange cover, double ratio,
                       std::span<double> ends) noexcept {
  std::size_t count = 0;
  double at = cover.begin;
  while (true) {
    const DepthRange left = seen_between(depths, at, cover.end);
    if (left.empty()) return count;
    if (count == ends.size()) return count + 1;
    at = min_of(left.begin * ratio, cover.end);
    ends[count++] = at;
  }
}

/// Logarithmic slices of what is seen, with the least ratio of far to near depth: steps over depths between
/// that show nothing.
void split_seen(const VisibleDepths& depths, DepthRange cover, std::span<double> edges) noexcept {
  const std::span<double> ends = edges.subspan(1);
  // As many slices of this one always do; of the other, none.
  double enough = elementary::log(cover.end / cover.begin) / static_cast<double>(ends.size()) * (1.0 + 1e-12);
  double too_little = 0.0;
  // Halvings down to a ten-millionth: far below what a bin resolves.
  constexpr int kHalvings = 24;
  std::array<double, kMaxMaps> trial;
  const std::span<double> trial_ends{trial.data(), ends.size()};
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (enough + too_little);
    (lay_slices(depths, cover, elementary::exp(middle), trial_ends) <= ends.size() ? enough : too_little) =
        middle;
  }
  const std::size_t count = lay_slices(depths, cover, elementary::exp(enough), ends);
  edges[0] = cover.begin;
  for (std::size_t i = count; i < ends.size(); ++i) ends[i] = cover.end;
  ends[ends.size() - 1] = cover.end;
}

}  // namespace

DepthRange seen_between(const PlanContext& c, double begin, double end) noexcept {
  return c.seen == nullptr ? DepthRange{begin, end} : seen_between(*c.seen, begin, end);
}

void choose_edges(PlanContext& c, const Polytope& body, std::span<double> edges) noexcept {
  const PlanOptions& options = c.options;
  const DepthRange received = received_depths(c, body);
  c.seen = usable_depths(c, received);
  const DepthRange cover = seen_between(c, received.begin, received.end);
  tell_unseen(c, OmissionKind::depth_not_visible, received.begin, cover.begin);
  tell_unseen(c, OmissionKind::depth_not_visible, cover.end, received.end);
  const SplitScheme scheme =
      options.split == SplitScheme::automatic && c.stable ? SplitScheme::practical : options.split;
  const SplitOptions split{scheme, options.lambda, options.near_hint, options.given_splits};
  split_depths(cover.begin, cover.end, split, edges);
  const bool logarithmic = scheme == SplitScheme::logarithmic || scheme == SplitScheme::automatic ||
                           scheme == SplitScheme::optimal;
  if (logarithmic && c.seen != nullptr) split_seen(*c.seen, cover, edges);
  // What is in view would move the edges of a stable plan, and with them its grids.
  if (scheme == SplitScheme::optimal && !c.stable) optimise_splits(c, body, edges);
  // One visible depth is one slice: more of them would divide the safety round it. Over frames the number of
  // maps must not come and go with one pixel.
  const bool single = c.seen != nullptr && c.seen->min == c.seen->max && c.history == nullptr;
  if (single && scheme != SplitScheme::given) {
    for (double& edge : edges.subspan(1)) edge = cover.end;
  }
  if (c.history != nullptr && !c.stable) steady_edges(*c.history, edges);
}

}  // namespace gnomon
