// Where along the view one shadow map ends and the next begins.
// Based on: Zhang, Sun, Xu, Lun, "Parallel-Split Shadow Maps", 2006; Lloyd et al., "Warping and Partitioning
// for Low Error Shadow Maps", 2006 (pseudo-near plane).
#include "gnomon/options.hpp"
#include "gnomon/study/formulas.hpp"

#include <array>
#include <cmath>

#include "geometry/vector.hpp"
#include "lanes/elementary.hpp"

namespace gnomon {
namespace {

constexpr std::array<std::string_view, 7> kSchemeNames = {
    "uniform", "logarithmic", "practical", "pseudo_near", "optimal", "auto", "given"};

constexpr std::array<std::string_view, 3> kSelectionNames = {"view_depth", "first_holding", "finest"};

double logarithmic_edge(double n, double f, double t) noexcept {
  return n * elementary::pow(f / n, t);
}

constexpr std::array<std::string_view, 5> kPartitionNames = {
    "view_depth", "frustum_faces", "separating_plane", "tetrahedron", "receiver_clusters"};

}  // namespace

std::string_view to_string(SplitScheme scheme) noexcept {
  return kSchemeNames[static_cast<std::size_t>(scheme)];
}

bool split_scheme_from_name(std::string_view name, SplitScheme& scheme) noexcept {
  for (std::size_t i = 0; i < kSchemeNames.size(); ++i) {
    if (kSchemeNames[i] != name) continue;
    scheme = static_cast<SplitScheme>(i);
    return true;
  }
  return false;
}

std::string_view to_string(MapSelection selection) noexcept {
  return kSelectionNames[static_cast<std::size_t>(selection)];
}

bool map_selection_from_name(std::string_view name, MapSelection& selection) noexcept {
  for (const MapSelection option : {MapSelection::view_depth, MapSelection::finest}) {
    if (to_string(option) != name) continue;
    selection = option;
    return true;
  }
  return false;
}

void split_depths(double n, double f, const SplitOptions& options, std::span<double> edges) noexcept {
  if (edges.empty()) return;
  const auto last = edges.size() - 1;
  const double lambda = std::isnan(options.lambda) ? 0.5 : clamp_to(options.lambda, 0.0, 1.0);
  // n > 0 guards pow; a pseudo-near plane outside [n, f) means the near plane itself.
  const double hint = options.pseudo_near;
  const double pseudo = hint >= n && hint < f ? hint : n;
  edges[0] = n;
  for (std::size_t i = 1; i < last; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(last);
    const double even = n + (f - n) * t;
    double edge = even;
    if (options.scheme == SplitScheme::given) {
      edge = i <= options.given.size() ? options.given[i - 1] : f;
    } else if (n > 0.0 && f > n) {
      switch (options.scheme) {
        case SplitScheme::uniform:
        case SplitScheme::given:
          break;
        case SplitScheme::optimal:
        case SplitScheme::automatic:
        case SplitScheme::logarithmic:
          edge = logarithmic_edge(n, f, t);
          break;
        case SplitScheme::pseudo_near:
          edge = logarithmic_edge(pseudo, f, t);
          break;
        case SplitScheme::practical:
          edge = lambda * logarithmic_edge(n, f, t) + (1.0 - lambda) * even;
          break;
      }
    }
    edges[i] = clamp_to(edge, edges[i - 1], f);
  }
  edges[last] = f;
}

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
