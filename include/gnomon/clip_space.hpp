// Which clip space does the graphics API expect? The core computes in OpenGL's and converts once, last.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>

namespace gnomon {

enum class NdcDepth : std::uint8_t { minus_one_to_one, zero_to_one };
/// Handedness of the world's coordinates: with x to the right and y up, z points towards the viewer (right)
/// or away (left).
enum class Handedness : std::uint8_t { right, left };
/// Where the first row in memory of what was drawn lies, and with it v = 0 of a texture.
enum class FirstRow : std::uint8_t {
  y_minus_one,  ///< at ndc y = -1: OpenGL (the bottom), Vulkan (the top, its y grows downwards)
  y_plus_one,   ///< at ndc y = +1: Direct3D, Metal, WebGPU (the top)
};

/// Shadow-map clip space: x right and y up as the light sees the scene, depth growing away from the light,
/// unless said otherwise.
///
/// Clip space itself has no handedness to choose: every API looks along +z with x to the right. Only worlds
/// differ. The core computes for a right-handed one. Coordinates of a left-handed world (Unity, most Direct3D
/// engines) go in as they are, and everything in a plan is in these coordinates, too. The core then plans for
/// the mirror image of that world: sizes, distances, errors and the set of texels are those of the world
/// itself. The mirroring is put right in two places:
/// - Handedness::left here turns x of the map round. A map then shows what the light sees, not its mirror
///   image, and front faces keep the winding they have. It is x because up and depth mean the same in both
///   worlds.
/// - An off-axis Camera counts its image edges to the core's right, which is left: give {left, right} as
///   {-right, -left}. A symmetric camera needs nothing.
struct ClipSpace {
  NdcDepth ndc_depth = NdcDepth::minus_one_to_one;  ///< range of depths after the division by w
  bool reversed_z = false;                          ///< depth grows towards the light instead
  bool y_down = false;                              ///< y grows downwards in clip space (Vulkan)
  Handedness handedness = Handedness::right;        ///< of the caller's world
  FirstRow first_row = FirstRow::y_minus_one;  ///< no part of clip space, but of reading what was drawn there
  /// Equal in all members.
  bool operator==(const ClipSpace&) const = default;
};

inline constexpr ClipSpace kOpenGl{};
inline constexpr ClipSpace kOpenGlZeroToOne{NdcDepth::zero_to_one};  ///< after glClipControl
inline constexpr ClipSpace kVulkan{NdcDepth::zero_to_one, false, true};
inline constexpr ClipSpace kDirect3D{NdcDepth::zero_to_one, false, false, Handedness::right,
                                     FirstRow::y_plus_one};
inline constexpr ClipSpace kMetal = kDirect3D;

/// The matrix that takes OpenGL clip space to `target`: multiply it onto the left of a clip_from_... matrix,
/// such as the viewer's own from clip_from_view.
[[nodiscard]] glm::dmat4 clip_from_gl_clip(const ClipSpace& target) noexcept;

/// The matrix that takes `source` clip space to where the map is read. After the division by w, x and y are
/// texture coordinates. (0, 0) is at the first texel of the first row, 1 at the far edges. z is the depth as
/// a depth buffer holds it, in [0, 1]. For OpenGL, that is with the default glDepthRange.
[[nodiscard]] glm::dmat4 texture_from_clip(const ClipSpace& source) noexcept;

}  // namespace gnomon
