// Sets of boxes, and which boxes a map needs.
#include <cstdlib>
#include <limits>

#include "c/convert.hpp"
#include "c/memory.hpp"
#include "geometry/usable.hpp"

namespace gnomon::c {
namespace {

const char* fault_of_boxes(std::span<const Box> boxes, const char* name) noexcept {
  for (const Box& box : boxes) {
    if (!usable(box)) return name;
  }
  return nullptr;
}

const char* to_indices(std::uint32_t* indices, std::int64_t room, const std::int64_t* found,
                       std::span<std::uint32_t>& to) noexcept {
  if (room < 0) return "room";
  if (indices == nullptr && room > 0) return "indices";
  if (found == nullptr) return "found";
  to = {indices, static_cast<std::size_t>(room)};
  return nullptr;
}

/// A set that its boxes fit into; nullptr where there is no memory.
gnomon_caster_set* new_set(std::span<const Box> boxes) noexcept {
  auto* set = new_object<gnomon_caster_set>();
  if (set == nullptr) return nullptr;
  const std::size_t blocks = CasterSet::block_count(boxes.size()),
                    indices = CasterSet::index_count(boxes.size());
  set->blocks = new_array<CasterBlock>(blocks);
  set->indices = new_array<std::uint32_t>(indices);
  if (set->blocks == nullptr || set->indices == nullptr) {
    gnomon_caster_set_destroy(set);
    return nullptr;
  }
  set->set = CasterSet(boxes, {set->blocks, blocks}, {set->indices, indices});
  return set;
}

}  // namespace
}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int32_t gnomon_caster_set_create(const double* boxes, int64_t count, gnomon_caster_set** set,
                                 const char** invalid_field) {
  if (set == nullptr) return refuse("set", invalid_field);
  *set = nullptr;
  std::span<const Box> list;
  if (const char* fault = to_boxes({boxes, count, "boxes", "count"}, list))
    return refuse(fault, invalid_field);
  if (list.size() > std::numeric_limits<std::uint32_t>::max()) return refuse("count", invalid_field);
  if (const char* fault = fault_of_boxes(list, "boxes")) return refuse(fault, invalid_field);
  *set = new_set(list);
  return done(invalid_field, *set != nullptr ? GNOMON_OK : GNOMON_OUT_OF_MEMORY);
}

void gnomon_caster_set_destroy(gnomon_caster_set* set) {
  if (set == nullptr) return;
  std::free(set->blocks);
  std::free(set->indices);
  std::free(set);
}

int64_t gnomon_caster_set_count(const gnomon_caster_set* set) {
  return set != nullptr ? static_cast<int64_t>(set->set.size()) : 0;
}

int32_t gnomon_caster_set_refit(gnomon_caster_set* set, const double* boxes, int64_t count,
                                const char** invalid_field) {
  if (set == nullptr) return refuse("set", invalid_field);
  std::span<const Box> list;
  if (const char* fault = to_boxes({boxes, count, "boxes", "count"}, list))
    return refuse(fault, invalid_field);
  if (list.size() != set->set.size()) return refuse("count", invalid_field);
  if (const char* fault = fault_of_boxes(list, "boxes")) return refuse(fault, invalid_field);
  set->set.refit(list);
  return done(invalid_field);
}

int32_t gnomon_caster_set_update(gnomon_caster_set* set, int64_t index, const double box[6],
                                 const char** invalid_field) {
  if (set == nullptr) return refuse("set", invalid_field);
  if (index < 0 || index >= gnomon_caster_set_count(set)) return refuse("index", invalid_field);
  if (box == nullptr) return refuse("box", invalid_field);
  const Box bounds{to_vector(box), to_vector(box + 3)};
  if (!usable(bounds)) return refuse("box", invalid_field);
  set->set.update(static_cast<std::uint32_t>(index), bounds);
  return done(invalid_field);
}

int32_t gnomon_cull(const gnomon_map* map, const double* casters, int64_t count, uint32_t* indices,
                    int64_t room, int64_t* found, const char** invalid_field) {
  ShadowMap record;
  if (const char* fault = to_map(map, record)) return refuse(fault, invalid_field);
  std::span<const Box> list;
  std::span<std::uint32_t> out;
  if (const char* fault = to_boxes({casters, count, "casters", "count"}, list))
    return refuse(fault, invalid_field);
  if (const char* fault = fault_of_boxes(list, "casters")) return refuse(fault, invalid_field);
  if (const char* fault = to_indices(indices, room, found, out)) return refuse(fault, invalid_field);
  *found = static_cast<int64_t>(cull_casters(record, list, out));
  return done(invalid_field);
}

int32_t gnomon_cull_set(const gnomon_map* map, const gnomon_caster_set* set, uint32_t* indices, int64_t room,
                        int64_t* found, const char** invalid_field) {
  ShadowMap record;
  if (const char* fault = to_map(map, record)) return refuse(fault, invalid_field);
  if (set == nullptr) return refuse("set", invalid_field);
  std::span<std::uint32_t> out;
  if (const char* fault = to_indices(indices, room, found, out)) return refuse(fault, invalid_field);
  *found = static_cast<int64_t>(set->set.cull(record, out));
  return done(invalid_field);
}

int32_t gnomon_cull_planes(const double* planes, int32_t plane_count, const gnomon_caster_set* set,
                           uint32_t* indices, int64_t room, int64_t* found, const char** invalid_field) {
  if (plane_count < 0 || plane_count > GNOMON_MAX_CULL_PLANES) return refuse("plane_count", invalid_field);
  if (planes == nullptr && plane_count > 0) return refuse("planes", invalid_field);
  if (set == nullptr) return refuse("set", invalid_field);
  std::array<glm::dvec4, kMaxCullPlanes> list;
  for (int32_t i = 0; i < plane_count; ++i) {
    const double* p = planes + 4 * i;
    if (!usable(p[0]) || !usable(p[1]) || !usable(p[2]) || !usable(p[3]))
      return refuse("planes", invalid_field);
    list[static_cast<std::size_t>(i)] = {p[0], p[1], p[2], p[3]};
  }
  std::span<std::uint32_t> out;
  if (const char* fault = to_indices(indices, room, found, out)) return refuse(fault, invalid_field);
  *found = static_cast<int64_t>(
      set->set.cull(std::span<const glm::dvec4>(list.data(), static_cast<std::size_t>(plane_count)), out));
  return done(invalid_field);
}

}  // extern "C"
