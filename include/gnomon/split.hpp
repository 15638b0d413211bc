// Where along the view one shadow map ends and the next begins.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace gnomon {

/// `optimal` needs the receivers and is made by the plan: it minimises the plan's objective over the actual
/// body, and costs some hundred microseconds; with Fit::stable, whose edges must not follow what is in view,
/// it is logarithmic. `automatic` is logarithmic over the receivers' depths, where that is close to the best,
/// and practical with Fit::stable, whose range begins at the near plane. split_depths() treats both as
/// logarithmic. `given` takes the caller's own depths.
enum class SplitScheme : std::uint8_t {
  uniform,
  logarithmic,
  practical,
  pseudo_near,
  optimal,
  automatic,
  given
};
enum class SplitRange : std::uint8_t { automatic, receivers, camera };

[[nodiscard]] std::string_view to_string(SplitScheme scheme) noexcept;
/// True and `scheme` set where `name` is one of uniform, logarithmic, practical, pseudo_near, optimal, auto,
/// given.
[[nodiscard]] bool split_scheme_from_name(std::string_view name, SplitScheme& scheme) noexcept;

struct SplitOptions {
  SplitScheme scheme = SplitScheme::practical;
  double lambda = 0.9;       ///< practical: 0 uniform ... 1 logarithmic; clamped to [0,1], NaN counts as 0.5
  double pseudo_near = 0.0;  ///< pseudo_near: depth of the first split; clamped to [near_depth, far_depth)
  /// given: the inner borders, ascending, each clamped to [near_depth, far_depth]; missing ones count as
  /// far_depth.
  std::span<const double> given = {};
};

/// Fills `edges` (N + 1 of them for N maps) with the borders, ascending; the first is exactly `near_depth`,
/// the last exactly `far_depth`. Needs near_depth <= far_depth; logarithmic shares need near_depth > 0 and
/// fall back to uniform where it is not. Equal depths give equal edges.
///
/// logarithmic: n (f/n)^(i/m); uniform: n + (f-n) i/m; practical: their blend (Zhang et al. 2006,
/// parallel-split shadow maps; Scherzer et al. 2011, section 4.3); pseudo_near: n, then p (f/p)^(i/m) for i
/// >= 1 (Lloyd et al. 2006).
void split_depths(double near_depth, double far_depth, const SplitOptions& options,
                  std::span<double> edges) noexcept;

}  // namespace gnomon
