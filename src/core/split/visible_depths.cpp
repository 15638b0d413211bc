// Which view depths of the last frame showed a surface, and slices that skip what shows none.
// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010.
#include "split/visible_depths.hpp"

#include <array>
#include <cmath>

#include "geometry/vector.hpp"
#include "gnomon/options.hpp"
#include "gnomon/view.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {
namespace {

/// Depths that one bin stands for, with the safety on both sides.
DepthRange range_of(const VisibleDepths& depths, int bin) noexcept {
  const double first = bin == 0 ? 0.0 : depth_bin_begin(bin);
  const double last = bin == kDepthBins - 1 ? depths.max : depth_bin_begin(bin + 1);
  return {max_of(first, depths.min) * (1.0 - kDepthSafety), min_of(last, depths.max) * (1.0 + kDepthSafety)};
}

/// Puts slices no longer than `ratio` over what is visible, each beginning at the first visible depth after
/// the one before it. Writes where they end; returns how many it takes, or one more than there is room for.
std::size_t put_slices(const VisibleDepths& depths, DepthRange cover, double ratio,
                       std::span<double> ends) noexcept {
  std::size_t count = 0;
  double at = cover.begin;
  // From the end on there is nothing, though a range of no length is not empty.
  while (at < cover.end) {
    const DepthRange left = visible_range(depths, at, cover.end);
    if (left.empty()) break;
    if (count == ends.size()) return count + 1;
    at = min_of(left.begin * ratio, cover.end);
    ends[count++] = at;
  }
  return count;
}

/// Moves an edge inwards by one bin after so many frames, and only while more than a bin of it is unused: a
/// depth that swings about a bin's border stays in.
void creep(int& edge, int visible, int step, int frames, int& wait) noexcept {
  if (step * (visible - edge) <= 1) {
    wait = 0;
    return;
  }
  if (++wait < frames) return;
  wait = 0;
  edge += step;
}

}  // namespace

int depth_bin(double depth) noexcept {
  const double bin = std::floor((elementary::log2(depth) - kLowestDepthExponent) * kDepthBinsPerDoubling);
  return static_cast<int>(clamp_to(bin, 0.0, kDepthBins - 1.0));
}

double depth_bin_begin(int bin) noexcept {
  return elementary::exp2(kLowestDepthExponent + static_cast<double>(bin) / kDepthBinsPerDoubling);
}

void VisibleDepths::add(double depth) noexcept {
  if (!(depth > 0.0 && depth < std::numeric_limits<double>::infinity())) return;
  std::uint32_t& pixels = count[static_cast<std::size_t>(depth_bin(depth))];
  if (pixels < std::numeric_limits<std::uint32_t>::max()) ++pixels;
  min = min_of(min, depth);
  max = max_of(max, depth);
}

void VisibleDepths::add(std::span<const float> depths) noexcept {
  for (const float depth : depths) add(static_cast<double>(depth));
}

VisibleDepths visible_between(double min, double max) noexcept {
  VisibleDepths depths;
  if (!(min > 0.0 && min <= max && max < std::numeric_limits<double>::infinity())) return depths;
  depths.min = min;
  depths.max = max;
  for (int bin = depth_bin(min); bin <= depth_bin(max); ++bin)
    depths.count[static_cast<std::size_t>(bin)] = 1;
  return depths;
}

void DepthTracker::move_edges(int first_visible, int last_visible) noexcept {
  if (first_ < 0) {
    first_ = first_visible;
    last_ = last_visible;
    return;
  }
  if (first_visible < first_) first_ = first_visible;
  if (last_visible > last_) last_ = last_visible;
  creep(first_, first_visible, 1, frames_per_bin, first_wait_);
  creep(last_, last_visible, -1, frames_per_bin, last_wait_);
}

void DepthTracker::clear() noexcept {
  DepthTracker none;
  none.frames_per_bin = frames_per_bin;
  none.hold_frames = hold_frames;
  *this = none;
}

void DepthTracker::update(const VisibleDepths& frame) noexcept {
  if (frame.empty()) return;
  const auto pixels = [&](int bin) {
    return bin >= 0 && bin < kDepthBins ? frame.count[static_cast<std::size_t>(bin)] : 0;
  };
  int first_visible = kDepthBins, last_visible = -1;
  for (int bin = 0; bin < kDepthBins; ++bin) {
    std::uint16_t& unseen = frames_unseen_[static_cast<std::size_t>(bin)];
    const bool visible = pixels(bin - 1) > 0 || pixels(bin) > 0 || pixels(bin + 1) > 0;
    if (!visible) {
      if (unseen < std::numeric_limits<std::uint16_t>::max()) ++unseen;
      continue;
    }
    unseen = 0;
    if (first_visible == kDepthBins) first_visible = bin;
    last_visible = bin;
  }
  if (last_visible < 0) return;
  const bool fresh = first_ < 0;
  move_edges(first_visible, last_visible);
  depths_ = {};
  depths_.min = depth_bin_begin(first_);
  depths_.max = depth_bin_begin(last_ + 1);
  for (int bin = first_; bin <= last_; ++bin) {
    const auto i = static_cast<std::size_t>(bin);
    const bool given_up =
        bin > first_visible && bin < last_visible && (fresh || frames_unseen_[i] >= hold_frames);
    if (frames_unseen_[i] > 0 && given_up) continue;
    depths_.count[i] = frame.count[i] > 0 ? frame.count[i] : 1;
  }
}

DepthRange visible_range(const VisibleDepths& depths, double begin, double end) noexcept {
  DepthRange visible{end, begin};
  if (!(begin <= end)) return visible;
  const int first = depth_bin(max_of(begin, depths.min) / (1.0 + kDepthSafety));
  const int last = depth_bin(min_of(end, depths.max) / (1.0 - kDepthSafety));
  const auto take = [&](int bin) {
    if (depths.count[static_cast<std::size_t>(bin)] == 0) return false;
    const DepthRange range = range_of(depths, bin);
    if (!(range.end > begin && range.begin < end)) return false;
    visible = {min_of(visible.begin, max_of(begin, range.begin)),
               max_of(visible.end, min_of(end, range.end))};
    return true;
  };
  int bin = first;
  while (bin <= last && !take(bin)) ++bin;
  for (int back = last; back > bin && !take(back); --back) {
  }
  // A single point within the last bin.
  return visible.begin < visible.end ? visible : DepthRange{end, begin};
}

void split_visible(const VisibleDepths& depths, DepthRange cover, std::span<double> edges) noexcept {
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
