// Which region of last frame's map can be reused, and which strips must be redrawn?
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "gnomon/clip_space.hpp"
#include "gnomon/plan.hpp"

namespace gnomon {

/// Texels [x, x + width) times [y, y + height) of a map, counted as its memory is: columns from ndc x = -1,
/// rows from ClipSpace::first_row. The rectangle for glScissor, vkCmdSetScissor, RSSetScissorRects or
/// setScissorRect.
struct TexelRect {
  int x = 0, y = 0, width = 0, height = 0;  ///< texels
  /// True where it holds no texel.
  [[nodiscard]] bool empty() const noexcept { return width <= 0 || height <= 0; }
  /// Equal in all members.
  bool operator==(const TexelRect&) const = default;
};

enum class ReuseKind : std::uint8_t {
  none,  ///< another grid, depth range, light or size, or nothing of the old map is in the new one: draw it
         ///< whole
  identical,  ///< every texel holds
  scrolled,   ///< `kept` holds once moved; `strip` is new
};

/// How to make the current map from the previous one. Copy texel (x, y) of the old map to (x + shift_x, y +
/// shift_y) of the new one wherever that lies in `kept`; or address the texture modulo its size and copy
/// nothing. Then draw the strips. `kept` and the strips cover the map without overlap, whatever the kind.
struct MapReuse {
  ReuseKind kind = ReuseKind::none;  ///< how much of the old map holds
  int shift_x = 0, shift_y = 0;      ///< texels
  TexelRect kept;                    ///< in the current map; empty for none
  std::array<TexelRect, 2> strip;    ///< to be drawn; the first strip_count are used
  int strip_count = 0;               ///< none: 1, the whole map; identical: 0; scrolled: 1 or 2
};

/// Compares two maps planned with the same clip space, `clip_space`. Maps of Fit::stable scroll; any others,
/// those of local lights among them, are reusable only while their matrix is equal bit by bit: while nothing
/// moves, or while Fit::warped_stable keeps it.
///
/// Guarantees the texel-to-world mapping only; unchanged casters are the caller's responsibility. Casters
/// must not have moved, and both frames must have drawn all casters over the map's rectangle
/// (rectangle_planes) with depth clamp. cull_planes is not enough: it omits casters that the old view did not
/// need, and the new one may.
[[nodiscard]] MapReuse reuse(const ShadowMap& previous, const ShadowMap& current,
                             const ClipSpace& clip_space = {}) noexcept;

/// The map with clip_from_camera_relative for an eye at `new_origin`, world space; everything else unchanged.
/// For a map kept from an earlier frame: its matrix then takes points relative to the new eye. Computed from
/// clip_from_world, so that any number of moves lose nothing: within 1e-3 texel of it a thousand kilometres
/// from the origin.
[[nodiscard]] ShadowMap rebased(const ShadowMap& map, const glm::dvec3& new_origin) noexcept;

/// Planes round everything that can throw a shadow into a rectangle of the map: its four sides and the map's
/// far plane, open towards the light (draw with depth clamp). To be given to CasterSet::cull. As
/// ShadowMap::cull_planes: dot(xyz, p_world) + w >= 0 inside, unit normals. `clip_space` is the plan's.
[[nodiscard]] std::array<glm::dvec4, 5> rectangle_planes(const ShadowMap& map, const TexelRect& rectangle,
                                                         const ClipSpace& clip_space = {}) noexcept;

}  // namespace gnomon
