// Where do the cascades divide what is seen, so that the picture shows the least error?
#include "split/seen_splits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/first_hits.hpp"
#include "geometry/vector.hpp"
#include "split/optimal.hpp"

namespace gnomon {
namespace {

/// Depths in ascending order, and the sums of their inverses.
class SeenDepths {
 public:
  SeenDepths(std::span<const double> depths, double least, double most) noexcept {
    for (const double depth : depths) {
      if (depth >= least && depth <= most && count_ < depth_.size()) depth_[count_++] = depth;
    }
    std::sort(depth_.begin(), depth_.begin() + static_cast<std::ptrdiff_t>(count_));
    for (std::size_t i = 0; i < count_; ++i) inverse_[i + 1] = inverse_[i] + 1.0 / depth_[i];
  }
  [[nodiscard]] std::span<const double> all() const noexcept { return {depth_.data(), count_}; }

  /// Errors at the points between two depths, added up, under one map for them.
  [[nodiscard]] double cost(double begin, double end) const noexcept {
    // What a warp leaves of an error that does not depend on the map's length.
    constexpr double kLeft = 0.2;
    const std::size_t first = index(begin), beyond = index(end);
    if (first >= beyond) return 0.0;
    const double length = depth_[beyond - 1] - depth_[first];
    return kLeft * static_cast<double>(beyond - first) + length * (inverse_[beyond] - inverse_[first]);
  }

 private:
  /// Of the first depth that is not below `depth`.
  [[nodiscard]] std::size_t index(double depth) const noexcept {
    const auto end = depth_.begin() + static_cast<std::ptrdiff_t>(count_);
    return static_cast<std::size_t>(std::lower_bound(depth_.begin(), end, depth) - depth_.begin());
  }

  std::array<double, SeenPoints::kMost> depth_;
  std::array<double, SeenPoints::kMost + 1> inverse_{};
  std::size_t count_ = 0;
};

}  // namespace

void split_seen(std::span<const double> depths, bool known, std::span<double> edges) noexcept {
  if (edges.size() < 3 || !(edges.front() > 0.0)) return;
  const SeenDepths seen(depths, edges.front(), edges.back());
  if (seen.all().size() < 2 || !(seen.all().front() < seen.all().back())) return;
  // Only depths that show something are divided; the outer maps reach up to the ends. Guesses end at the
  // first few boxes: surfaces may lie as far as the end.
  const double begin = edges.front(), end = edges.back();
  const double least = seen.all().front();
  const double most = known ? seen.all().back() : std::sqrt(seen.all().back() * end);
  const auto last = edges.size() - 1;
  for (std::size_t i = 0; i <= last; ++i)
    edges[i] =
        i == last ? most
                  : least * elementary::pow(most / least, static_cast<double>(i) / static_cast<double>(last));
  if (known) {
    const auto cost = [&](double a, double b) { return seen.cost(a, b); };
    const auto both = [](double a, double b) { return a + b; };
    search_splits(edges, cost, both);
    refine_splits(edges, cost, both);
  }
  edges.front() = begin;
  edges.back() = end;
}

}  // namespace gnomon
