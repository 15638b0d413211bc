// Which lights can light a pixel? Lists of lights for tiles of the image, parted along view depth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "gnomon/camera.hpp"
#include "gnomon/light.hpp"
#include "gnomon/plan.hpp"

namespace gnomon {

/// Most slices of ClusterOptions.
inline constexpr int kMostDepthSlices = 256;
/// Most clusters of an image: with more, tiles are taken twice as wide.
inline constexpr std::size_t kMostClusters = std::size_t{1} << 22;

/// Options of cluster_lights.
struct ClusterOptions {
  int tile_pixels = 64;   ///< side of a tile, pixels, at least 1. Smaller: shorter lists, more of them
  int depth_slices = 48;  ///< parts of the view depth, 1..kMostDepthSlices. More: shorter lists
  /// Equal in all members.
  bool operator==(const ClusterOptions&) const = default;
};

/// One light in one cluster. Working memory of cluster_lights.
struct ClusterEntry {
  std::uint32_t cluster;  ///< index of the cluster
  std::uint32_t light;    ///< index of the light
};

/// Memory that cluster_lights writes to; the caller's. `begin` and `lights` are as long-lived as the result.
struct ClusterMemory {
  std::span<std::uint32_t> begin;   ///< at least cluster_count() + 1
  std::span<std::uint32_t> lights;  ///< at least as many as lights. More: finer clusters, if they need it
  std::span<ClusterEntry> work;     ///< at least as many as lights; entries up to the shorter one are used
};

/// The lists of cluster_lights.
struct LightClusters {
  PlanStatus status = PlanStatus::invalid_input;  ///< ok, or invalid_input
  std::string_view invalid_field;                 ///< for invalid_input: which, e.g. "clusters.tile_pixels"
  int columns = 0, rows = 0, slices = 0;          ///< clusters along the image's sides and along depth
  int tile_pixels = 0;  ///< of these clusters: larger than the option where the memory holds no finer ones
  /// Slice of a surface: floor(depth_scale * log2(view depth) + depth_offset), of the view depth itself for
  /// an orthographic camera, clamped to 0..slices - 1.
  double depth_scale = 0.0;
  double depth_offset = 0.0;  ///< see depth_scale
  bool orthographic = false;  ///< of the camera
  /// Cluster (column, row, slice) has the lights lights[begin[i]] .. lights[begin[i + 1] - 1] in ascending
  /// order; i = (slice * rows + row) * columns + column. Row 0 is the lowest of the image.
  std::span<const std::uint32_t> begin;
  std::span<const std::uint32_t> lights;  ///< indices into the lights of the call
};

/// Clusters of an image with these options, before any of them is widened. 0 for options or sizes out of
/// range.
[[nodiscard]] std::size_t cluster_count(const Camera& camera, const ClusterOptions& options) noexcept;

/// Lists the lights that can light a surface in each cluster of the view. Pure, allocates nothing, never
/// throws.
///
/// A light is missing from a cluster only where its range, or its cone, does not reach into it: shading by
/// the lists gives the same light as shading by all lights, as long as a light is zero beyond its range and
/// cone. Suns are in every list. A light whose range is zero or less lights nothing.
///
/// Lists have any length. Where the memory does not hold all of them, tiles become twice as wide and slices
/// half as many until it does; a single cluster of all lights always fits.
///
/// Slices are even in the logarithm of depth, over the last thousandfold of the depths that local lights
/// reach (orthographic: even in depth). The last one holds everything beyond.
///
/// Based on: Olsson, Billeter, Assarsson, "Clustered Deferred and Forward Shading", 2012.
[[nodiscard]] LightClusters cluster_lights(const Camera& camera, std::span<const Light> lights,
                                           const ClusterOptions& options,
                                           const ClusterMemory& memory) noexcept;

/// Index of the cluster of a pixel, counted from the lower left corner, at a view depth. Both are clamped to
/// the clusters. `clusters` must be of status ok.
[[nodiscard]] std::size_t cluster_at(const LightClusters& clusters, int pixel_x, int pixel_y,
                                     double view_depth) noexcept;

}  // namespace gnomon
