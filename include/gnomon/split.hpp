// Where along the view one shadow map ends and the next begins.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "gnomon/partition.hpp"

namespace gnomon {

inline constexpr int kMaxMaps = 8;  ///< cascades of one plan; beyond 8 no published figure gains anything

/// `optimal` needs the receivers and is made by the plan: it minimises the plan's objective over the actual
/// body, and costs some hundred microseconds. It is logarithmic with Fit::stable, whose edges must not follow
/// what is in view. `automatic` is logarithmic over the receivers' depths, where that is close to the best,
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

/// How a point finds its map among the cascades of a directional light.
enum class MapSelection : std::uint8_t {
  view_depth,  ///< the cascade whose view depths hold the point
  finest,      ///< of the maps that hold the point, the one with the smallest texels there
};
[[nodiscard]] std::string_view to_string(MapSelection selection) noexcept;
/// True and `selection` set where `name` is one of view_depth, finest.
[[nodiscard]] bool map_selection_from_name(std::string_view name, MapSelection& selection) noexcept;

/// Where one cascade ends and the next begins. Directional lights only.
struct SplitOptions {
  SplitScheme scheme = SplitScheme::automatic;  ///< how depths are divided
  /// practical: blend of uniform (0) and logarithmic (1) splits; clamped to [0,1], NaN counts as 0.5.
  double lambda = 0.9;
  /// View depth, world units, from which error counts: nearer surfaces keep their shadow and do not draw
  /// texels towards the eye. Also the first split of SplitScheme::pseudo_near. 0: the near plane itself.
  double pseudo_near = 0.0;
  /// Which depths are divided: those that hold receivers, or the camera's whole range. `automatic` takes the
  /// receivers' for Fit::tight and the camera's for Fit::stable, whose grid must not depend on what is in
  /// view.
  SplitRange range = SplitRange::automatic;
  /// given: the cascades - 1 view depths between neighbouring cascades, ascending, world units. They are
  /// clamped to the depths that are divided; a cascade without any depth left is omitted. Missing ones count
  /// as the far end.
  std::array<double, kMaxMaps - 1> given = endless_splits();
  /// Width of the blend band before a cascade, as a share of the previous cascade's depths, 0..1: the cascade
  /// behind also covers it, with all casters. A wider band hides the step between their texels better and
  /// takes texels from the map behind. Partition::view_depth only.
  double overlap = 0.0;
  /// How a point finds its map; view_depth, the default, is the cheaper look-up. `finest` lowers the error
  /// where nearer maps reach behind their depths, most under a light along the view: their casters and light
  /// depths are widened to all receivers in the map, and a look-up evaluates every map. There is no blend
  /// band. Based on: Zhang, Zaprjagaev, Bentham, "Practical Cascaded Shadow Maps", ShaderX7, 2009.
  MapSelection selection = MapSelection::view_depth;
  /// Division of the receivers among the maps. Partitions other than view_depth ignore cascades and splits,
  /// but for face_slices.
  Partition partition = Partition::view_depth;
  /// Partition::frustum_faces: most slices along the view that each of the frustum's four side faces is
  /// divided into, each with a map of its own, 1..kMaxMaps; default 1: a map for each face. More slices need
  /// fewer texels for the same error and cost a pass each. `scheme` divides the depths at the face; automatic
  /// and optimal count as logarithmic. A face has fewer where another one does not lower the objective, or
  /// where the plan has kMaxMaps maps already: the face that gains the most gets the next slice, and the plan
  /// lists an omission. Based on: Lloyd et al., "Warping and Partitioning for Low Error Shadow Maps", 2006.
  int face_slices = 1;

  /// The value of `given` where none is given: infinities.
  [[nodiscard]] static constexpr std::array<double, kMaxMaps - 1> endless_splits() noexcept {
    std::array<double, kMaxMaps - 1> all{};
    for (double& depth : all) depth = std::numeric_limits<double>::infinity();
    return all;
  }
  /// Equal in all members.
  bool operator==(const SplitOptions&) const = default;
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
