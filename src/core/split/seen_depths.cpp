// Which part of a depth range shows a surface, and slices that skip what shows none.
// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010; slices that skip depths
// without samples are this project's.
#include "split/seen_depths.hpp"

#include <array>
#include <cmath>

#include "geometry/vector.hpp"
#include "gnomon/split.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {
namespace {

/// Depths that one bin stands for, with the safety on both sides.
DepthRange range_of(const VisibleDepths& depths, int bin) noexcept {
  const double first = bin == 0 ? 0.0 : depth_bin_begin(bin);
  const double last = bin == kDepthBins - 1 ? depths.max : depth_bin_begin(bin + 1);
  return {max_of(first, depths.min) * (1.0 - kDepthSafety), min_of(last, depths.max) * (1.0 + kDepthSafety)};
}

}  // namespace

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

namespace {

/// Puts slices no longer than `ratio` over what is visible, each beginning at the first visible depth after
/// the one before it. Writes where they end; returns how many it takes, or one more than there is room for.
std::size_t put_slices(const VisibleDepths& depths, DepthRange cover, double ratio,
                       std::span<double> ends) noexcept {
  std::size_t count = 0;
  double at = cover.begin;
  // From the end on there is nothing, though a range of no length is not empty.
  while (at < cover.end) {
    const DepthRange left = seen_between(depths, at, cover.end);
    if (left.empty()) break;
    if (count == ends.size()) return count + 1;
    at = min_of(left.begin * ratio, cover.end);
    ends[count++] = at;
  }
  return count;
}

}  // namespace

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
    (put_slices(depths, cover, elementary::exp(middle), trial_ends) <= ends.size() ? enough : too_little) =
        middle;
  }
  const std::size_t count = put_slices(depths, cover, elementary::exp(enough), ends);
  edges[0] = cover.begin;
  for (std::size_t i = count; i < ends.size(); ++i) ends[i] = cover.end;
  ends[ends.size() - 1] = cover.end;
}

}  // namespace gnomon
