// Lists of the lights in each cluster of the view, for C.
#include <algorithm>
#include <cstddef>
#include <new>

#include "c/convert.hpp"
#include "plan/memory.hpp"

namespace gnomon::c {
namespace {

std::int32_t refuse_clusters(const char* fault, gnomon_light_clusters* clusters,
                             const char** invalid_field) noexcept {
  clusters->status = GNOMON_INVALID_INPUT;
  return refuse(fault, invalid_field);
}

const char* fault_of_rooms(const gnomon_light_clusters& clusters, std::int64_t lights) noexcept {
  if (clusters.begin == nullptr) return "light_clusters.begin";
  if (clusters.begin_room < 2) return "light_clusters.begin_room";
  if (clusters.lights == nullptr && clusters.light_room > 0) return "light_clusters.lights";
  return clusters.light_room < lights || clusters.light_room > INT32_MAX ? "light_clusters.light_room"
                                                                         : nullptr;
}

/// Any number of lights; what a list can index.
bool usable_count(std::int64_t count) noexcept {
  return count >= 0 && count <= INT32_MAX;
}

}  // namespace
}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int64_t gnomon_cluster_count(const gnomon_camera* camera, int32_t tile_pixels, int32_t depth_slices) {
  Camera c;
  if (to_camera(camera, c) != nullptr) return 0;
  return static_cast<int64_t>(cluster_count(c, {tile_pixels, depth_slices}));
}

int64_t gnomon_cluster_memory(int64_t lights, int64_t light_room) {
  if (!usable_count(lights) || !usable_count(light_room)) return 0;
  return static_cast<int64_t>(kMemorySlack + memory_of<Light>(static_cast<std::size_t>(lights)) +
                              memory_of<ClusterEntry>(static_cast<std::size_t>(light_room)));
}

int32_t gnomon_cluster_lights(const gnomon_camera* camera, const gnomon_light* lights, uint32_t light_size,
                              int64_t count, void* memory, int64_t bytes, gnomon_light_clusters* clusters,
                              const char** invalid_field) {
  gnomon_light_clusters out;
  if (const char* fault = read(clusters, out)) return refuse(fault, invalid_field);
  Camera c;
  const char* fault = to_camera(camera, c);
  if (fault == nullptr && !usable_count(count)) fault = "count";
  if (fault == nullptr && lights == nullptr && count > 0) fault = "lights";
  if (fault == nullptr && !known_size<gnomon_light>(light_size)) fault = "light_size";
  if (fault == nullptr) fault = fault_of_rooms(out, count);
  if (fault == nullptr && memory == nullptr) fault = "memory";
  if (fault == nullptr && bytes < gnomon_cluster_memory(count, out.light_room)) fault = "bytes";
  if (fault != nullptr) return refuse_clusters(fault, clusters, invalid_field);
  MemoryParts parts({static_cast<std::byte*>(memory), static_cast<std::size_t>(bytes)});
  const auto total = static_cast<std::size_t>(count), room = static_cast<std::size_t>(out.light_room);
  const std::span<Light> list = parts.take<Light>(total);
  for (std::size_t i = 0; i < total; ++i) {
    gnomon_light one;
    set_defaults(one);
    read_bytes(reinterpret_cast<const char*>(lights) + i * light_size, light_size, one);
    if (const char* bad = to_light(&one, *new (&list[i]) Light))
      return refuse_clusters(bad, clusters, invalid_field);
  }
  const std::span<ClusterEntry> work = parts.take<ClusterEntry>(room);
  const LightClusters found =
      cluster_lights(c, list, {out.tile_pixels, out.depth_slices},
                     {{out.begin, static_cast<std::size_t>(out.begin_room)}, {out.lights, room}, work});
  if (found.status == PlanStatus::invalid_input)
    return refuse_clusters(gnomon::c::field_of(found.invalid_field), clusters, invalid_field);
  out.status = GNOMON_OK;
  out.tile_pixels = found.tile_pixels;
  out.columns = found.columns;
  out.rows = found.rows;
  out.slices = found.slices;
  out.orthographic = found.orthographic ? 1 : 0;
  out.depth_scale = found.depth_scale;
  out.depth_offset = found.depth_offset;
  out.light_count = static_cast<int64_t>(found.lights.size());
  write(out, clusters);
  return done(invalid_field);
}

}  // extern "C"
