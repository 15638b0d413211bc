// What the graphics API expects of clip space. The core computes in OpenGL's and converts once, last.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>

namespace gnomon {

enum class NdcDepth : std::uint8_t { minus_one_to_one, zero_to_one };

/// Shadow-map clip space: x right, y up, depth growing away from the light, unless said otherwise.
struct ClipSpace {
  NdcDepth ndc_depth = NdcDepth::minus_one_to_one;
  bool reversed_z = false;  ///< depth grows towards the light instead
  bool y_down = false;      ///< y grows downwards in clip space (Vulkan)
  bool operator==(const ClipSpace&) const = default;
};

inline constexpr ClipSpace kOpenGl{};
inline constexpr ClipSpace kOpenGlZeroToOne{NdcDepth::zero_to_one, false, false};  ///< after glClipControl
inline constexpr ClipSpace kVulkan{NdcDepth::zero_to_one, false, true};
inline constexpr ClipSpace kDirect3D{NdcDepth::zero_to_one, false, false};
inline constexpr ClipSpace kMetal{NdcDepth::zero_to_one, false, false};

/// The matrix that takes OpenGL clip space to `target`: multiply it onto the left of a clip_from_... matrix.
[[nodiscard]] glm::dmat4 clip_from_gl_clip(const ClipSpace& target) noexcept;

}  // namespace gnomon
