// What one map over the body between two view depths comes to, for a search over splits: no polytope is cut.
#pragma once

#include <array>
#include <cstddef>

#include "map/context.hpp"
#include "plan/cascades.hpp"

namespace gnomon {

/// The body's vertices and edges across a parallel light, and where they cross the depths that were asked
/// about.
class SplitTable {
 public:
  /// False where only cut bodies tell: a focus, or a pseudo-near depth.
  [[nodiscard]] static bool serves(const PlanContext& c) noexcept;
  SplitTable(const PlanContext& c, const ParallelScene& scene) noexcept;
  /// Error of one map over the part of the body between two depths, with LiSPSM at its best strength as the
  /// measure: every warp of this toolkit comes near it or betters it by about the same factor everywhere.
  [[nodiscard]] double cost(double begin, double end) noexcept;

 private:
  struct Point {
    double x, y, depth;
  };
  struct Cut {
    double depth = 0.0;
    std::array<Point, kMaxVertices> point;
    std::size_t count = 0;
  };
  [[nodiscard]] const Cut& cut(double depth) noexcept;

  const PlanContext& c_;
  bool warped_;
  double least_;  // depth that error counts from
  std::array<Point, kMaxVertices> vertex_;
  std::size_t vertices_ = 0;
  std::array<std::array<std::uint8_t, 2>, kMaxVertices * 3 / 2> edge_;  // nearer end first
  std::size_t edges_ = 0;
  std::array<Cut, 24> cut_;  // of the latest depths
  std::size_t cuts_ = 0, next_ = 0;
};

}  // namespace gnomon
