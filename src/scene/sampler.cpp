// Which value has a curve of keys at a time?
// Based on: Khronos Group, glTF 2.0 Specification (2021), appendix C.
#include "sampler.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::detail {

namespace {

constexpr std::size_t kTurnWidth = 4;

/// The evenly turning rotation between two, the short way round.
void slerp(std::span<const float> a, std::span<const float> b, double u, std::span<double> out) noexcept {
  double norm_a = 0.0, norm_b = 0.0, dot = 0.0;
  for (std::size_t i = 0; i < kTurnWidth; ++i) {
    const auto x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
    norm_a += x * x;
    norm_b += y * y;
    dot += x * y;
  }
  norm_a = std::sqrt(norm_a);
  norm_b = std::sqrt(norm_b);
  if (!(norm_a > 0.0) || !(norm_b > 0.0)) {  // one of them is no turn: whatever lies between is as good
    for (std::size_t i = 0; i < kTurnWidth; ++i) out[i] = static_cast<double>(u < 0.5 ? a[i] : b[i]);
    return;
  }
  const double side = dot < 0.0 ? -1.0 : 1.0;
  const double cosine = std::min(std::abs(dot) / (norm_a * norm_b), 1.0), angle = std::acos(cosine);
  constexpr double kStraight = 1e-6;  // radians: the arc is a line to all bits of a float
  double from = 1.0 - u, to = u;
  if (angle > kStraight) {
    const double sine = std::sin(angle);
    from = std::sin((1.0 - u) * angle) / sine;
    to = std::sin(u * angle) / sine;
  }
  for (std::size_t i = 0; i < kTurnWidth; ++i)
    out[i] = from * static_cast<double>(a[i]) / norm_a + side * to * static_cast<double>(b[i]) / norm_b;
}

}  // namespace

void sample(const AnimationSampler& sampler, double time_s, bool turns, std::span<double> out) noexcept {
  const std::size_t width = sampler.width, keys = sampler.times_s.size();
  const bool cubic = sampler.interpolation == Interpolation::cubic_spline;
  const std::size_t stride = cubic ? 3 * width : width, value = cubic ? width : 0;
  const std::span<const float> values(sampler.values);
  const auto after = static_cast<std::size_t>(
      std::upper_bound(sampler.times_s.begin(), sampler.times_s.end(), time_s,
                       [](double t, float key) { return t < static_cast<double>(key); }) -
      sampler.times_s.begin());
  const auto hold = [&](std::size_t key) {
    for (std::size_t i = 0; i < width; ++i) out[i] = static_cast<double>(values[key * stride + value + i]);
  };
  if (after == 0) return hold(0);
  if (after == keys || sampler.interpolation == Interpolation::step) return hold(after - 1);
  const auto begin = static_cast<double>(sampler.times_s[after - 1]);
  const double length = static_cast<double>(sampler.times_s[after]) - begin, u = (time_s - begin) / length;
  const std::span<const float> a = values.subspan((after - 1) * stride, stride),
                               b = values.subspan(after * stride, stride);
  if (!cubic && turns) return slerp(a, b, u, out);
  for (std::size_t i = 0; i < width; ++i) {
    const auto from = static_cast<double>(a[value + i]), to = static_cast<double>(b[value + i]);
    if (!cubic) {
      out[i] = from + (to - from) * u;
      continue;
    }
    const double leaves = length * static_cast<double>(a[2 * width + i]),
                 arrives = length * static_cast<double>(b[i]);
    const double u2 = u * u, u3 = u2 * u;
    out[i] = (2.0 * u3 - 3.0 * u2 + 1.0) * from + (u3 - 2.0 * u2 + u) * leaves + (3.0 * u2 - 2.0 * u3) * to +
             (u3 - u2) * arrives;
  }
}

}  // namespace gnomon::detail
