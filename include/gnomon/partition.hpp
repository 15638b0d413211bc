// How are the visible receivers of a light divided among its maps?
#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon {

enum class Partition : std::uint8_t {
  view_depth,        ///< cascades along the view (split.hpp)
  frustum_faces,     ///< a map for each face of the camera's frustum that the light enters by, or leaves by:
                     ///< whichever set lowers the objective; up to 5, whatever the number of cascades, and up
                     ///< to kMaxMaps with SplitOptions::face_slices
  separating_plane,  ///< two maps, parted by a plane parallel to the light where the warped map's texels grow
                     ///< beyond those of a uniform one: warped before it, uniform behind
  tetrahedron,  ///< point lights: four maps in place of a cube's six, a triangle of directions each; fewer
                ///< passes and longer texels (up to 9 times a texel's area in the corners, a cube's 5.2).
                ///< Based on: Liao, "Shadow Mapping for Omnidirectional Light Using Tetrahedron Mapping",
                ///< GPU Pro, 2010
  receiver_clusters,  ///< groups of receiver boxes with room between them, parted by planes along the axes of
                      ///< the world and across the view: as many maps as PlanOptions::cascades. Islands side
                      ///< by side get maps of their own, which cascades never give them. Based on: Forsyth,
                      ///< "Extremely Practical Shadows", 2006, with planes in place of marks on objects
};
// frustum_faces, separating_plane and receiver_clusters divide the receivers of directional lights, and only
// where that lowers the objective; else one map takes all (receiver_clusters: as many cascades, where they
// are better), and the plan lists an omission. Fit::stable, whose grid must not follow the view, keeps
// view_depth, and a PlanHistory does not steady the parts. Every other partition leaves a point light the
// faces of a cube. Spot lights have one cone or a cube.

/// True for the partitions that divide what a directional light lights other than by view depth.
[[nodiscard]] constexpr bool divides_parallel(Partition partition) noexcept {
  return partition == Partition::frustum_faces || partition == Partition::separating_plane ||
         partition == Partition::receiver_clusters;
}

[[nodiscard]] std::string_view to_string(Partition partition) noexcept;
/// True and `partition` set where `name` is one of view_depth, frustum_faces, separating_plane,
/// tetrahedron, receiver_clusters.
[[nodiscard]] bool partition_from_name(std::string_view name, Partition& partition) noexcept;

/// Share of a warped map's length, from its near end, up to which its texels are smaller than those of a
/// uniform map over the same body with equal widths at the far end: w = 1 + kappa u* = (1 + kappa
/// length)^(2/3) (texel areas grow with w^3). Needs kappa >= 0 and length >= 0; 2/3 where nothing is warped.
/// Based on: Mikkelsen, "Separating-plane perspective shadow mapping", 2007.
[[nodiscard]] double separating_share(double kappa, double length) noexcept;

}  // namespace gnomon
