// Which strength of a warp along the view is best for a body's vertices, by the simplified error of
// warp_error? Sixteen strengths at a time.
#pragma once

#include <array>
#include <cstddef>

#include "gnomon/extend/warp.hpp"
#include "lanes/lanes.hpp"
#include "warp/plane_map.hpp"

namespace gnomon {

struct AlongViewBest {
  double kappa, value;  ///< value: as WarpError::value
};

class AlongView {
 public:
  /// A body without points yet. `centre`: as WarpInput::centre.
  AlongView(Objective objective, double centre) noexcept;
  explicit AlongView(const WarpInput& input) noexcept;
  /// A vertex; dropped where there is no more room.
  void add(double x, double y, double depth) noexcept;
  /// The weakest of the best strengths; 0 where no warp is better.
  [[nodiscard]] AlongViewBest best() noexcept;
  /// The best strength and its value, to some hundredths: in a fraction of the time.
  [[nodiscard]] AlongViewBest quick() noexcept;
  /// Without a warp.
  [[nodiscard]] double unwarped() noexcept;

 private:
  static constexpr std::size_t kAtOnce = kFloatLanes;
  using Strengths = std::array<double, kAtOnce>;
  /// value_ for these strengths.
  void find(const Strengths& kappa) noexcept;
  void begin() noexcept;
  [[nodiscard]] AlongViewBest coarse() noexcept;
  /// Closer in each round.
  [[nodiscard]] AlongViewBest refined(AlongViewBest best) noexcept;
  [[nodiscard]] double weakest_as_good(const AlongViewBest& best) noexcept;
  using QuickStrengths = FloatLanes;
  /// The points: x over the largest, y over the length, the nearest depth over theirs; and how much wider
  /// than long the body is.
  struct Shares {
    std::array<float, kMaxBodyPoints> x, y, per_depth;
    float wider;
  };
  void find_quick(const Shares& shares, const QuickStrengths& reach, QuickStrengths& value) const noexcept;

  std::size_t strengths_;  // kAtOnce, but not known when this is compiled: as in lane_range
  Objective objective_;
  double centre_, y_min_ = 0.0, length_ = 0.0, nearest_ = 0.0, farthest_ = 0.0;
  std::size_t count_ = 0;
  std::array<double, kMaxBodyPoints> x_, y_, per_depth_;
  alignas(64) Strengths value_;
};

}  // namespace gnomon
