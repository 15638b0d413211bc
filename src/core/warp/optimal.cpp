// The best projective map of the light plane for this body: axis, strength, centre and turn searched
// together. Based on: the error measure of Lloyd et al., "Warping and Partitioning for Low Error Shadow
// Maps", 2006. The search is this project's: LiSPSM's strength along the view is the start, a simplex walks
// from there on the objective itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/elementary.hpp"
#include "geometry/vector.hpp"
#include "warp/plane_error.hpp"

namespace gnomon::warps {
namespace {

// Angle of the axis, logarithm of kappa times length, centre over length, angle of the turn.
constexpr std::size_t kDimensions = 4;
using Position = std::array<double, kDimensions>;
// First step along each: about as far as the best warps lie from LiSPSM's.
constexpr Position kFirstStep = {0.35, -0.5, -0.06, 0.05};
constexpr int kSimplexSteps = 28;
// A warp that gains less is not worth its sampling noise.
constexpr double kLeastGain = 0.02;

class Search {
 public:
  explicit Search(const WarpInput& input) noexcept
      : error_(input),
        length_(input.y_max - input.y_min),
        pivot_(input.centre, input.light.perspective ? input.y_min : 0.0),
        unwarped_(input.unwarped) {}

  [[nodiscard]] WarpChoice choice(const Position& p) const noexcept {
    const double strength = elementary::exp(clamp_to(p[1], kWeakest, kStrongest));
    const double cosine = elementary::cos(p[3]), sine = elementary::sin(p[3]);
    return {strength / length_,
            {elementary::sin(p[0]), elementary::cos(p[0])},
            pivot_.x * elementary::cos(p[0]) - pivot_.y * elementary::sin(p[0]) + p[2] * length_,
            {cosine, sine},
            {-sine, cosine}};
  }
  [[nodiscard]] double value(const Position& p) noexcept { return error_.value(choice(p)); }
  [[nodiscard]] double without() noexcept { return error_.value(unwarped_); }

 private:
  static constexpr double kWeakest = -7.0, kStrongest = 21.0;  // kappa times length from 0.001 to 1e9
  PlaneError error_;
  double length_;
  glm::dvec2 pivot_;  // point of the light plane that the axis turns about: the eye, or the nearest point
  WarpChoice unwarped_;
};

struct Corner {
  Position at;
  double value;
};

Position combine(const Position& a, double by, const Position& b, double with) noexcept {
  Position p;
  for (std::size_t i = 0; i < kDimensions; ++i) p[i] = a[i] * by + b[i] * with;
  return p;
}

/// Nelder and Mead's simplex, a fixed number of evaluations.
Corner walk(Search& search, const Corner& start, int evaluations) noexcept {
  std::array<Corner, kDimensions + 1> simplex;
  simplex[0] = start;
  for (std::size_t i = 0; i < kDimensions; ++i) {
    Position p = start.at;
    p[i] += kFirstStep[i];
    simplex[i + 1] = {p, search.value(p)};
  }
  evaluations -= static_cast<int>(kDimensions);
  const auto by_value = [](const Corner& a, const Corner& b) { return a.value < b.value; };
  while (evaluations > 0) {
    std::sort(simplex.begin(), simplex.end(), by_value);
    Position centre{};
    for (std::size_t i = 0; i < kDimensions; ++i)
      centre = combine(centre, 1.0, simplex[i].at, 1.0 / kDimensions);
    Corner& worst = simplex.back();
    const auto tried = [&](double reach) {
      const Position p = combine(centre, 1.0 + reach, worst.at, -reach);
      --evaluations;
      return Corner{p, search.value(p)};
    };
    const Corner reflected = tried(1.0);
    if (reflected.value < simplex[0].value) {
      const Corner expanded = tried(2.0);
      worst = expanded.value < reflected.value ? expanded : reflected;
    } else if (reflected.value < simplex[kDimensions - 1].value) {
      worst = reflected;
    } else {
      const Corner contracted = tried(reflected.value < worst.value ? 0.5 : -0.5);
      if (contracted.value < worst.value) {
        worst = contracted;
      } else {
        for (std::size_t i = 1; i <= kDimensions; ++i) {
          simplex[i].at = combine(simplex[0].at, 0.5, simplex[i].at, 0.5);
          simplex[i].value = search.value(simplex[i].at);
          --evaluations;
        }
      }
    }
  }
  return *std::min_element(simplex.begin(), simplex.end(), by_value);
}

/// The same warp, as many times stronger by a fixed factor as still lowers the value.
Corner stronger(Search& search, Corner best) noexcept {
  constexpr double kFactor = 1.0;  // of the logarithm: 2.72
  constexpr int kMostTimes = 3;
  for (int i = 0; i < kMostTimes; ++i) {
    Corner next = best;
    next.at[1] += kFactor;
    next.value = search.value(next.at);
    if (!(next.value < best.value)) break;
    best = next;
  }
  return best;
}

WarpChoice choose(const WarpInput& input) noexcept {
  const double length = input.y_max - input.y_min;
  if (input.flat() || !(length > 0.0)) return input.unwarped;
  Search search(input);
  const double without = search.without();
  // Where LiSPSM's own search finds nothing, a warp as strong as the body is deep is a fair start.
  const double kappa = lispsm.choose(input).kappa;
  Corner start{{0.0, elementary::log(kappa > 0.0 ? kappa * length : 1.0), 0.0, 0.0}, 0.0};
  start.value = search.value(start.at);
  // A percentile forgives the few worst points and so takes stronger warps than the maxima LiSPSM goes by.
  if (input.objective == Objective::p95) start = stronger(search, start);
  const Corner best = walk(search, start, kSimplexSteps);
  const bool gains = best.value < without * (1.0 - kLeastGain);
  WarpChoice choice = gains ? search.choice(best.at) : input.unwarped;
  choice.gain_ratio = gains ? best.value / without : 1.0;
  return choice;
}

}  // namespace

const Warp optimal{"optimal", "perspective along any axis, searched for the objective", choose, true};

}  // namespace gnomon::warps
