// Which warp a map of a light with a position gets: perspective shadow maps in post-projective light space,
// where the light's rays are parallel.
// Based on: Wimmer, Scherzer, "Robust Shadow Mapping with Light-Space Perspective Shadow Maps", ShaderX4,
// 2006 (axis and reference point); the search over the exact error is this project's.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "slope_error.hpp"
#include "vector.hpp"

namespace gnomon {
namespace {

// Directions tried on each side of the view's own, one tan(turn / 2) apart: 22.6 degrees, up to a right
// angle.
constexpr int kDirections = 4;
constexpr double kTurn = 0.2;

/// A warp by what it does to the body: how much longer the far end's texels are than the near end's.
struct Candidate {
  glm::dvec2 axis;
  double stretch;  // 1 + kappa * length
  double centre;
};

WarpChoice choice_of(const Candidate& c, std::span<const WarpInput::Point> body) noexcept {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const WarpInput::Point& p : body) {
    const double u = p.x * c.axis.x + p.y * c.axis.y;
    low = min_of(low, u);
    high = max_of(high, u);
  }
  // A body without length along the axis has nothing to warp.
  constexpr double kFlat = 1e-9;
  const double length = high - low;
  WarpChoice choice;
  choice.axis = c.axis;
  choice.centre = c.centre;
  choice.kappa = length > kFlat ? (c.stretch - 1.0) / length : 0.0;
  return choice;
}

double across(const glm::dvec2& axis, const glm::dvec2& p) noexcept {
  return p.x * axis.y - p.y * axis.x;
}

/// Turned by twice the angle whose tangent is `t`, without sine or cosine.
glm::dvec2 turned(const glm::dvec2& v, double t) noexcept {
  const double scale = 1.0 / (1.0 + t * t), c = (1.0 - t * t) * scale, s = 2.0 * t * scale;
  return {v.x * c - v.y * s, v.x * s + v.y * c};
}

class Search {
 public:
  Search(SlopeError& error, const SlopeWarpSearch& search) noexcept : error_(error), search_(search) {}

  void offer(const Candidate& c) noexcept {
    const double value = error_.value(choice_of(c, search_.body), search_.body);
    if (!(value < best_value_)) return;
    best_value_ = value;
    best_ = c;
  }
  /// Stretches of 1.5, 2, 3, 5, 9 ... along one axis, through the point nearest to the viewer.
  void along(const glm::dvec2& axis) noexcept {
    const double centre = across(axis, search_.nearest);
    for (double gain = 0.5; gain <= search_.most_stretch - 1.0 && gain < kMostGain; gain *= 2.0) {
      offer({axis, 1.0 + gain, centre});
    }
  }
  /// The best candidate under turned axes.
  void turn_round() noexcept {
    const Candidate c = best_;
    for (const double side : {kTurn, -kTurn}) {
      glm::dvec2 axis = c.axis;
      for (int i = 0; i < kDirections; ++i) {
        axis = turned(axis, side);
        offer({axis, c.stretch, across(axis, search_.nearest)});
      }
    }
  }
  /// Steps around the best candidate, halved until they are too small to matter.
  void refine(bool turning, int rounds) noexcept {
    double turn = 0.1, factor = 1.4, shift = 0.25 * extent();
    for (int round = 0; round < rounds; ++round) {
      const double before = best_value_;
      const Candidate c = best_;
      offer({c.axis, min_of(1.0 + (c.stretch - 1.0) * factor, search_.most_stretch), c.centre});
      offer({c.axis, 1.0 + (c.stretch - 1.0) / factor, c.centre});
      offer({best_.axis, best_.stretch, best_.centre + shift});
      offer({best_.axis, best_.stretch, best_.centre - shift});
      if (turning) {
        offer({turned(best_.axis, turn), best_.stretch, best_.centre});
        offer({turned(best_.axis, -turn), best_.stretch, best_.centre});
      }
      if (best_value_ < before) continue;
      turn *= 0.5;
      shift *= 0.5;
      factor = 1.0 + (factor - 1.0) * 0.5;
    }
  }
  [[nodiscard]] FoundWarp result(double unwarped) const noexcept {
    const double ratio = best_value_ / unwarped;
    return {choice_of(best_, search_.body), std::isfinite(ratio) ? ratio : 1.0};
  }

 private:
  static constexpr double kMostGain = 1e4;

  [[nodiscard]] double extent() const noexcept {
    double low_x = search_.body[0].x, high_x = low_x, low_y = search_.body[0].y, high_y = low_y;
    for (const WarpInput::Point& p : search_.body) {
      low_x = min_of(low_x, p.x);
      high_x = max_of(high_x, p.x);
      low_y = min_of(low_y, p.y);
      high_y = max_of(high_y, p.y);
    }
    return max_of(high_x - low_x, high_y - low_y);
  }

  SlopeError& error_;
  const SlopeWarpSearch& search_;
  Candidate best_{{0.0, 1.0}, 1.0, 0.0};
  double best_value_ = std::numeric_limits<double>::infinity();
};

}  // namespace

FoundWarp find_slope_warp(SlopeError& error, const SlopeWarpSearch& s, const Warp& warp) noexcept {
  const double unwarped = error.value(s.unwarped, s.body);
  Search search(error, s);
  search.offer({s.view_axis, min_of(s.published, s.most_stretch), across(s.view_axis, s.nearest)});
  if (!warp.drop_without_gain) return search.result(unwarped);
  search.along(s.view_axis);
  search.refine(false, 8);
  if (&warp == &warps::optimal) {
    search.turn_round();
    search.refine(true, 10);
  }
  return search.result(unwarped);
}

}  // namespace gnomon
