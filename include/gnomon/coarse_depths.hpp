// Which view depths can show a surface, where no depth buffer of an earlier frame is there to read? A coarse
// depth buffer of occluders, drawn on the CPU.
// Based on: Hasselgren, Andersson, Akenine-Möller, "Masked Software Occlusion Culling", 2016; the visible
// depth range from occlusion culling: Scherzer, Wimmer, Purgathofer, "A Survey of Real-Time Hard Shadow
// Mapping Methods", 2011.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "gnomon/bounds.hpp"
#include "gnomon/camera.hpp"
#include "gnomon/visible_depths.hpp"

namespace gnomon {

/// A tile is a square of so many pixels along each side.
inline constexpr int kCoarseTilePixels = 8;

/// Triangles of one object. Vertices are read through `indices`, three for each triangle and all in range.
struct CoarseMesh {
  std::span<const glm::vec3> positions;    ///< object space
  std::span<const std::uint32_t> indices;  ///< a multiple of three
  glm::dmat4 world_from_object{1.0};       ///< affine
  bool occludes = true;                    ///< false: has holes (alpha-masked) and hides nothing
  bool double_sided = false;               ///< true: back faces are drawn, too
  bool mirrored = false;                   ///< the transform turns the winding round
};

/// Knowledge of one tile; scratch memory of coarse_depths().
struct CoarseTile {
  std::uint64_t covered = 0;                                ///< pixels of the layer that is being filled
  float layer = 0.0f;                                       ///< farthest depth of that layer
  float farthest = std::numeric_limits<float>::infinity();  ///< nothing behind it shows in any pixel
};
/// Tiles that coarse_depths() needs for the camera's image: 32 400 of 16 bytes for 1920 x 1080. 0 where the
/// image has no pixels.
[[nodiscard]] std::size_t coarse_tile_count(const Camera& camera) noexcept;

/// Depths that may show a surface of `meshes`, or anything within `boxes`. Never skips the depth of a pixel
/// that shows one: triangles hide what lies behind tiles whose every pixel centre they cover, and what is
/// within a tile of such an edge counts as visible. Boxes hide nothing, and count from their nearest to their
/// farthest depth. The counts are of tiles, not of pixels. Empty, which make_plan takes for unknown: nothing
/// is in view, `tiles` has fewer than coarse_tile_count(), or the camera has no image or a
/// near plane that is not in front of it.
///
/// Time grows with triangles and with the tiles that each covers: docs/performance.md. A camera of the same
/// view and fewer pixels takes less, and may then miss what shows in less than one of them. Pure; allocates
/// nothing.
[[nodiscard]] VisibleDepths coarse_depths(const Camera& camera, std::span<const CoarseMesh> meshes,
                                          std::span<const Box> boxes, std::span<CoarseTile> tiles) noexcept;

}  // namespace gnomon
