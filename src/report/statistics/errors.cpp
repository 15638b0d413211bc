// How wrong a shadow mask is, and in which way.
#include "gnomon/report/errors.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::report {
namespace {

constexpr float kHalf = 0.5f;
constexpr float kQuarter = 0.25f;
constexpr float kTenth = 0.1f;  // what shows on a surface of one brightness

double share(double part, std::uint64_t whole) noexcept {
  return whole > 0 ? part / static_cast<double>(whole) : 0.0;
}

}  // namespace

MaskErrors mask_errors(std::span<const float> mask, std::span<const float> hard,
                       std::span<const float> soft) noexcept {
  MaskErrors errors;
  std::uint64_t false_lit = 0, false_shadow = 0, soft_pixels = 0, too_dark = 0, too_light = 0;
  double error = 0.0, leaking = 0.0, darkening = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (hard[i] >= 0.0f) {
      ++errors.pixels;
      false_lit += hard[i] < kHalf && mask[i] > kHalf ? 1 : 0;
      false_shadow += hard[i] > kHalf && mask[i] <= kHalf ? 1 : 0;
    }
    if (soft[i] < 0.0f) continue;
    ++soft_pixels;
    error += std::abs(static_cast<double>(mask[i]) - static_cast<double>(soft[i]));
    if (soft[i] == 0.0f) {
      ++errors.deep_pixels;
      leaking += static_cast<double>(mask[i]);
      too_light += mask[i] > kTenth ? 1 : 0;
    } else if (soft[i] == 1.0f) {
      ++errors.open_pixels;
      darkening += 1.0 - static_cast<double>(mask[i]);
      too_dark += mask[i] < 1.0f - kTenth ? 1 : 0;
    }
  }
  errors.false_lit = share(static_cast<double>(false_lit), errors.pixels);
  errors.false_shadow = share(static_cast<double>(false_shadow), errors.pixels);
  errors.too_dark = share(static_cast<double>(too_dark), errors.pixels);
  errors.too_light = share(static_cast<double>(too_light), errors.pixels);
  errors.mean_error = share(error, soft_pixels);
  errors.leaking = share(leaking, errors.deep_pixels);
  errors.darkening = share(darkening, errors.open_pixels);
  return errors;
}

std::vector<float> uniform_truth(std::span<const float> truth, int width, int reach) {
  const int height = width > 0 ? static_cast<int>(truth.size() / static_cast<std::size_t>(width)) : 0;
  const auto at = [&](int x, int y) {
    return truth[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  };
  std::vector<float> uniform(truth.begin(), truth.end());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      bool same = true;
      for (int v = std::max(0, y - reach); same && v <= std::min(height - 1, y + reach); ++v) {
        for (int u = std::max(0, x - reach); same && u <= std::min(width - 1, x + reach); ++u)
          same = at(u, v) == at(x, y);
      }
      if (!same)
        uniform[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            -1.0f;
    }
  }
  return uniform;
}

double excess_flips(std::span<const float> before, std::span<const float> after,
                    std::span<const float> truth_before, std::span<const float> truth_after) noexcept {
  std::uint64_t judged = 0, flips = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (truth_before[i] < 0.0f || truth_after[i] < 0.0f) continue;
    ++judged;
    const bool truth_flips = std::abs(truth_after[i] - truth_before[i]) > kHalf;
    flips += std::abs(after[i] - before[i]) > kHalf && !truth_flips ? 1 : 0;
  }
  return share(static_cast<double>(flips), judged);
}

PixelErrors pixel_errors(std::span<const float> mask, std::span<const float> light,
                         std::span<const std::uint8_t> several) noexcept {
  PixelErrors errors;
  double all = 0.0, one = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (light[i] < 0.0f) continue;
    const double error = std::abs(static_cast<double>(mask[i]) - static_cast<double>(light[i]));
    ++errors.pixels;
    all += error;
    if (several[i] != 0)
      ++errors.several;
    else
      one += error;
  }
  errors.error = share(all, errors.pixels);
  errors.one_surface = share(one, errors.pixels - errors.several);
  return errors;
}

double twinkling(std::span<const float> before, std::span<const float> after,
                 std::span<const float> light_before, std::span<const float> light_after) noexcept {
  std::uint64_t compared = 0, twinkles = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (light_before[i] < 0.0f || light_after[i] < 0.0f) continue;
    ++compared;
    const float beyond = std::abs(after[i] - before[i]) - std::abs(light_after[i] - light_before[i]);
    twinkles += beyond > kQuarter ? 1 : 0;
  }
  return share(static_cast<double>(twinkles), compared);
}

PixelAliasing pixel_aliasing(std::span<const float> m) {
  std::vector<float> values;
  values.reserve(m.size());
  std::copy_if(m.begin(), m.end(), std::back_inserter(values), [](float value) { return value > 0.0f; });
  PixelAliasing result;
  result.pixels = values.size();
  if (values.empty()) return result;
  const auto quantile = [&values](double q) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
  };
  result.p50 = quantile(0.50);
  result.p95 = quantile(0.95);
  result.max = quantile(1.0);
  const auto above = std::count_if(values.begin(), values.end(), [](float value) { return value > 1.0f; });
  result.share_undersampled = share(static_cast<double>(above), result.pixels);
  return result;
}

}  // namespace gnomon::report
