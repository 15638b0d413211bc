// Where layers of depth end so that the depths within each vary least, weighted by the root of their number:
// exactly, over a histogram.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "filter/lvsm.hpp"

namespace gnomon::render {
namespace {

constexpr std::size_t kBins = 128;  ///< a layer is at least one of them thick
constexpr std::size_t kMaxEnds = kMaxFilterOptions;

/// How many depths lie in each bin, summed up from the first bin on, and their first two moments.
struct Sums {
  std::array<double, kBins + 1> count{}, first{}, second{};
  /// Sum of squared distances to the mean over the bins [from, to).
  [[nodiscard]] double spread(std::size_t from, std::size_t to) const noexcept {
    const double n = count[to] - count[from], sum = first[to] - first[from];
    return n > 0.0 ? second[to] - second[from] - sum * sum / n : 0.0;
  }
  [[nodiscard]] bool empty(std::size_t bin) const noexcept { return count[bin + 1] == count[bin]; }
};

Sums sums_of(std::span<const float> depths) noexcept {
  std::array<double, kBins> bins{};
  for (const float depth : depths) {
    if (depth >= 0.0f && depth < 1.0f) bins[static_cast<std::size_t>(depth * kBins)] += 1.0;
  }
  Sums sums;
  for (std::size_t i = 0; i < kBins; ++i) {
    const double middle = (static_cast<double>(i) + 0.5) / kBins;
    const double weight = std::sqrt(bins[i]);
    sums.count[i + 1] = sums.count[i] + weight;
    sums.first[i + 1] = sums.first[i] + weight * middle;
    sums.second[i + 1] = sums.second[i] + weight * middle * middle;
  }
  return sums;
}

/// The middle of the gap without depths that a border lies in; the border itself where the gap is at either
/// end of all depths, or holds another border, too.
double middle_of_gap(const Sums& sums, std::span<const std::size_t> borders, std::size_t border) noexcept {
  std::size_t low = border, high = border;
  while (low > 0 && sums.empty(low - 1)) --low;
  while (high < kBins && sums.empty(high)) ++high;
  const auto within = [&](std::size_t other) { return other >= low && other <= high; };
  const bool shared = std::count_if(borders.begin(), borders.end(), within) > 1;
  if (shared || low == 0 || high == kBins) low = high = border;
  return 0.5 * static_cast<double>(low + high) / kBins;
}

}  // namespace

void place_layers(std::span<const float> depths, std::span<double> ends) noexcept {
  for (double& end : ends) end = 0.0;
  const Sums sums = sums_of(depths);
  const std::size_t layers = ends.size() + 1;
  if (!(sums.count[kBins] > 0.0) || layers > kMaxEnds) return;
  // best[k][j]: least spread of k + 1 layers over the bins before j; from[k][j]: where the last of them
  // begins.
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::array<std::array<double, kBins + 1>, kMaxEnds> best;
  std::array<std::array<std::size_t, kBins + 1>, kMaxEnds> from{};
  for (auto& row : best) row.fill(kNever);
  for (std::size_t j = 1; j <= kBins; ++j) best[0][j] = sums.spread(0, j);
  for (std::size_t k = 1; k < layers; ++k) {
    for (std::size_t j = k + 1; j <= kBins; ++j) {
      for (std::size_t i = k; i < j; ++i) {
        const double spread = best[k - 1][i] + sums.spread(i, j);
        if (!(spread < best[k][j])) continue;
        best[k][j] = spread;
        from[k][j] = i;
      }
    }
  }
  std::array<std::size_t, kMaxEnds> border{};
  for (std::size_t k = layers - 1; k > 0; --k) border[k - 1] = from[k][k == layers - 1 ? kBins : border[k]];
  const std::span<const std::size_t> borders{border.data(), ends.size()};
  for (std::size_t k = 0; k < ends.size(); ++k) ends[k] = middle_of_gap(sums, borders, border[k]);
}

}  // namespace gnomon::render
