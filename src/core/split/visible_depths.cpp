// Which view depths of the last frame showed a surface.
// Based on: Lauritzen, Salvi, Lefohn, "Sample Distribution Shadow Maps", 2010.
#include "gnomon/visible_depths.hpp"

#include <cmath>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {

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

namespace {

/// Moves an edge inwards by one bin after so many frames, and only while more than a bin of it is unused: a
/// depth that swings about a bin's border stays in.
void creep(int& edge, int seen, int step, int frames, int& wait) noexcept {
  if (step * (seen - edge) <= 1) {
    wait = 0;
    return;
  }
  if (++wait < frames) return;
  wait = 0;
  edge += step;
}

}  // namespace

void DepthTracker::move_edges(int first_seen, int last_seen) noexcept {
  if (first_ < 0) {
    first_ = first_seen;
    last_ = last_seen;
    return;
  }
  if (first_seen < first_) first_ = first_seen;
  if (last_seen > last_) last_ = last_seen;
  creep(first_, first_seen, 1, frames_per_bin, first_wait_);
  creep(last_, last_seen, -1, frames_per_bin, last_wait_);
}

void DepthTracker::update(const VisibleDepths& frame) noexcept {
  if (frame.empty()) return;
  const auto pixels = [&](int bin) {
    return bin >= 0 && bin < kDepthBins ? frame.count[static_cast<std::size_t>(bin)] : 0;
  };
  int first_seen = kDepthBins, last_seen = -1;
  for (int bin = 0; bin < kDepthBins; ++bin) {
    std::uint16_t& unseen = frames_unseen_[static_cast<std::size_t>(bin)];
    const bool seen = pixels(bin - 1) > 0 || pixels(bin) > 0 || pixels(bin + 1) > 0;
    if (!seen) {
      if (unseen < std::numeric_limits<std::uint16_t>::max()) ++unseen;
      continue;
    }
    unseen = 0;
    if (first_seen == kDepthBins) first_seen = bin;
    last_seen = bin;
  }
  if (last_seen < 0) return;
  const bool fresh = first_ < 0;
  move_edges(first_seen, last_seen);
  depths_ = {};
  depths_.min = depth_bin_begin(first_);
  depths_.max = depth_bin_begin(last_ + 1);
  for (int bin = first_; bin <= last_; ++bin) {
    const auto i = static_cast<std::size_t>(bin);
    const bool given_up = bin > first_seen && bin < last_seen && (fresh || frames_unseen_[i] >= hold_frames);
    if (frames_unseen_[i] > 0 && given_up) continue;
    depths_.count[i] = frame.count[i] > 0 ? frame.count[i] : 1;
  }
}

}  // namespace gnomon
