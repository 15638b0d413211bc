// What divides the receivers among maps, by name, and where a warp stops to pay.
#include "gnomon/partition.hpp"

#include <array>

#include "lanes/elementary.hpp"

namespace gnomon {
namespace {

constexpr std::array<std::string_view, 5> kPartitionNames = {
    "view_depth", "frustum_faces", "separating_plane", "tetrahedron", "receiver_clusters"};

}  // namespace

std::string_view to_string(Partition partition) noexcept {
  return kPartitionNames[static_cast<std::size_t>(partition)];
}

bool partition_from_name(std::string_view name, Partition& partition) noexcept {
  for (std::size_t i = 0; i < kPartitionNames.size(); ++i) {
    if (kPartitionNames[i] != name) continue;
    partition = static_cast<Partition>(i);
    return true;
  }
  return false;
}

double separating_share(double kappa, double length) noexcept {
  const double reach = kappa * length;
  // ((1 + reach)^(2/3) - 1) / reach, exact where the reach is small.
  return reach > 0.0 ? elementary::expm1(2.0 / 3.0 * elementary::log1p(reach)) / reach : 2.0 / 3.0;
}

}  // namespace gnomon
