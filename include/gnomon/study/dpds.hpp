// The textbook curves dp/ds of depth, against which the metric can be held.
#pragma once

namespace gnomon {

/// The textbook curves dp/ds(z) under an overhead light, projection factor dropped, image plane at distance 1
/// (Scherzer et al. 2011, section 3 and Figure 12). Needs 0 < n <= z <= f; 0 where n == f.
namespace dpds {
/// Without a warp.
[[nodiscard]] double uniform(double z, double n, double f) noexcept;
/// With a perspective whose near plane lies at `projection_near`.
[[nodiscard]] double perspective(double z, double n, double f, double projection_near) noexcept;
/// Perspective shadow maps: the projection's near plane is the camera's.
[[nodiscard]] double psm(double z, double n, double f) noexcept;
/// Light space perspective shadow maps at their best near plane.
[[nodiscard]] double lispsm(double z, double n, double f) noexcept;
/// The logarithmic warp: constant error.
[[nodiscard]] double logarithmic(double z, double n, double f) noexcept;
}  // namespace dpds

}  // namespace gnomon
