// What a map of a light with a position is made of while it is laid, and which casters it needs.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>

#include "light_map.hpp"
#include "light_positional.hpp"

namespace gnomon {

/// One map in the making.
struct Draft {
  const PositionalLight& light;
  const LightFrustum& frustum;
  const Polytope& body;
  SlopeBody slopes;
  PlaneMap plane;
  double rim;  // share of a side that no receiver falls into
  double near_distance, far_distance;
  double m_at_full_size = 0.0;  // bound of m before pruning
  /// The rim as a share of what it surrounds.
  [[nodiscard]] double margin() const noexcept { return rim / (1.0 - 2.0 * rim); }
};

/// What a caster must reach to shadow anything in the map, relative to the camera: the map's own sides, which
/// meet in the light, its far plane, and the faces round all lit receivers that have the light on their inner
/// side. Whatever lies inside these has every caster between it and the light inside them, too, so that a map
/// serves each point it holds, also those of a neighbouring face's body.
struct Reach {
  std::array<Plane, kMaxCullPlanes> plane;
  int count = 0;
  void add(const Plane& p) noexcept {
    if (count < kMaxCullPlanes) plane[static_cast<std::size_t>(count++)] = p;
  }
};
/// `m`: OpenGL clip space from points relative to the camera. All planes are moved out by `slack`.
[[nodiscard]] Reach reach_of(const Draft& d, const glm::dmat4& m, double slack) noexcept;

/// Nearest distance from the light that a caster has inside; infinity where none is.
[[nodiscard]] double nearest_caster(const Draft& d, const Reach& reach) noexcept;

}  // namespace gnomon
