// The textbook curves dp/ds of depth, against which the metric can be held.
#pragma once

namespace gnomon {

/// The textbook curves dp/ds(z) under an overhead light, projection factor dropped, image plane at distance 1
/// (Scherzer et al. 2011, section 3 and Figure 12). Needs 0 < n <= z <= f; 0 where n == f.
namespace dpds {
[[nodiscard]] double uniform(double z, double n, double f) noexcept;
[[nodiscard]] double perspective(double z, double n, double f, double projection_near) noexcept;
[[nodiscard]] double psm(double z, double n, double f) noexcept;
[[nodiscard]] double lispsm(double z, double n, double f) noexcept;
[[nodiscard]] double logarithmic(double z, double n, double f) noexcept;
}  // namespace dpds

}  // namespace gnomon
