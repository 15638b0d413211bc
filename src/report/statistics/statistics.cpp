// Medians with their confidence, and which of many choices nothing else beats.
// Based on: Efron, Bootstrap Methods: Another Look at the Jackknife, 1979.
#include "gnomon/report/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace gnomon::report {
namespace {

double middle_of(std::vector<double>& values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  if (values.size() % 2 == 1) return *half;
  return 0.5 * (*half + *std::max_element(values.begin(), half));
}

/// 1 for the least; equal values share the mean of theirs.
std::vector<double> ranks_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) { return values[x] < values[y]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t beyond = first + 1;
    while (beyond < order.size() && values[order[beyond]] == values[order[first]]) ++beyond;
    for (std::size_t i = first; i < beyond; ++i)
      ranks[order[i]] = 0.5 * static_cast<double>(first + beyond + 1);
    first = beyond;
  }
  return ranks;
}

}  // namespace

double median(std::span<const double> values) {
  if (values.empty()) return 0.0;
  std::vector<double> copy(values.begin(), values.end());
  return middle_of(copy);
}

Estimate estimate(std::span<const double> values) {
  Estimate result;
  result.median = result.low = result.high = median(values);
  if (values.size() < 2) return result;
  constexpr std::size_t kResamples = 1000;  // the interval's ends are then good to about 1 % of confidence
  constexpr std::size_t kTail = kResamples / 40;  // 2.5 % on either side
  std::mt19937 random(1);
  std::vector<double> medians(kResamples), sample(values.size());
  for (double& m : medians) {
    // Not std::uniform_int_distribution, whose numbers differ between standard libraries.
    for (double& value : sample) value = values[random() % values.size()];
    m = middle_of(sample);
  }
  std::sort(medians.begin(), medians.end());
  result.low = medians[kTail];
  result.high = medians[kResamples - 1 - kTail];
  return result;
}

double geometric_mean(std::span<const double> values, double floor) {
  if (values.empty()) return 0.0;
  double sum = 0.0;
  for (const double value : values) sum += std::log(value > 0.0 ? value : floor);
  return std::exp(sum / static_cast<double>(values.size()));
}

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  const std::vector<double> ranks_a = ranks_of(a), ranks_b = ranks_of(b);
  const double middle = 0.5 * static_cast<double>(a.size() + 1);
  double together = 0.0, spread_a = 0.0, spread_b = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    together += (ranks_a[i] - middle) * (ranks_b[i] - middle);
    spread_a += (ranks_a[i] - middle) * (ranks_a[i] - middle);
    spread_b += (ranks_b[i] - middle) * (ranks_b[i] - middle);
  }
  return together / std::sqrt(spread_a * spread_b);
}

SignTest sign_test(std::span<const double> first, std::span<const double> second) {
  SignTest test;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
    if (!std::isfinite(first[i]) || !std::isfinite(second[i])) continue;
    test.less += first[i] < second[i] ? 1 : 0;
    test.more += first[i] > second[i] ? 1 : 0;
  }
  const auto count = static_cast<double>(test.less + test.more);
  if (count == 0.0) return test;
  // Twice the tail of the binomial distribution at the rarer side.
  double tail = 0.0;
  for (std::size_t i = 0; i <= std::min(test.less, test.more); ++i) {
    const auto k = static_cast<double>(i);
    tail += std::exp(std::lgamma(count + 1.0) - std::lgamma(k + 1.0) - std::lgamma(count - k + 1.0) -
                     count * std::log(2.0));
  }
  test.chance = std::min(2.0 * tail, 1.0);
  return test;
}

std::vector<std::size_t> pareto_front(std::span<const Choice> choices) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (std::isfinite(choices[i].cost) && std::isfinite(choices[i].error)) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (choices[a].cost != choices[b].cost) return choices[a].cost < choices[b].cost;
    return choices[a].error < choices[b].error;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (front.empty() || choices[i].error < choices[front.back()].error) front.push_back(i);
  }
  return front;
}

}  // namespace gnomon::report
