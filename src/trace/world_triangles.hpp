// All triangles of a scene, placed in the world, and what of them alpha masks leave.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "gnomon/bounds.hpp"
#include "gnomon/scene/scene.hpp"

namespace gnomon::trace {

/// The texel of a row of `size` that a texture coordinate's texel stands for.
[[nodiscard]] inline int wrapped(int texel, int size, TextureWrap wrap) noexcept {
  if (wrap == TextureWrap::clamp_to_edge) return std::clamp(texel, 0, size - 1);
  const int period = wrap == TextureWrap::mirrored_repeat ? 2 * size : size;
  const int at = ((texel % period) + period) % period;
  return at < size ? at : period - 1 - at;
}

/// What a mask cuts out of a surface.
struct Cutout {
  int width = 0, height = 0;        ///< 0: no image, alpha is the same everywhere
  std::vector<std::uint8_t> alpha;  ///< rows top to bottom
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  float base_alpha = 1.0f, cutoff = 0.5f;

  /// True where the surface is there.
  [[nodiscard]] bool keeps(const glm::dvec2& texcoord) const noexcept;
};

/// Three corners per triangle, in double: placing by the instances' matrices loses nothing to speak of.
/// Opaque triangles come first, masked ones from `opaque` on.
struct WorldTriangles {
  using Corners = std::array<glm::dvec3, 3>;
  std::vector<Corners> corners;
  std::uint32_t opaque = 0;
  /// Which side of each triangle a picture shows: 1 the one that its corners turn around counter-clockwise,
  /// -1 the other, 0 both. Light is stopped by either.
  std::vector<std::int8_t> shown_side;
  std::vector<bool> casts, receives, shown;         ///< as the instances
  std::vector<std::uint32_t> instance_of;           ///< index into Scene::instances
  std::vector<std::array<glm::vec2, 3>> texcoords;  ///< of masked triangles, from `opaque` on
  std::vector<std::uint32_t> cutout_of;             ///< the same
  std::vector<Cutout> cutouts;                      ///< one per material
  Box bounds;

  explicit WorldTriangles(const Scene& scene);
  /// True where the triangle is there at these barycentric weights of corners 1 and 2.
  [[nodiscard]] bool is_there(std::uint32_t triangle, double b1, double b2) const noexcept;
};

}  // namespace gnomon::trace
