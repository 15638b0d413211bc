// Which biases of an engine's own kind do what a map's bias does?
#pragma once

#include <cstdint>

#include "gnomon/shadow_map.hpp"

namespace gnomon {

/// The ways in which engines move a depth off the surface.
enum class BiasWay : std::uint8_t {
  /// While the map is drawn or read: a constant, and a factor times the growth of depth over a texel.
  /// glPolygonOffset, rasterizer states of Direct3D, Vulkan and Metal, OGRE's material depth bias.
  rasterizer,
  /// A constant, and a move along the normal before the look-up. three.js (bias, normalBias), Babylon.js,
  /// Unity, Godot.
  normal_offset,
};

/// A bias in an engine's units. All of it is towards the light.
struct EngineBias {
  double depth = 0.0;         ///< of the map's depth, 0..1
  double slope_factor = 0.0;  ///< times the larger growth of depth over a texel, along the map's x or y
  double normal_world = 0.0;  ///< along the normal, world units
};

/// The bias that keeps planes from shadowing themselves under a kernel of this radius, texels. It has the
/// constant and the slope of the options, at any angle. A plane's depth grows over a texel along x and along
/// y, and an engine takes the larger: the factor is twice the radius. Along the normal, a move of h is one of
/// h / cos(angle) along the light. Thus a texel's diagonal times the radius suffices at every angle, and is
/// more than needed at small ones. `depth` is right where the map's w is constant: parallel light without a
/// warp. Elsewhere it holds in the middle of the map. A map without a depth range: all 0.
/// Based on: Holbert, "Normal Offset Shadows", 2011; glPolygonOffset as OpenGL 4.5 defines it.
[[nodiscard]] EngineBias engine_bias(const ShadowMap& map, const BiasOptions& bias, BiasWay way,
                                     double kernel_radius_texels) noexcept;

/// `depth` in the units of rasterizer states. One is the step of a normalized integer of so many bits. With 0
/// bits it is the largest step of single precision below 1.
[[nodiscard]] double rasterizer_units(double depth, int depth_bits) noexcept;

}  // namespace gnomon
