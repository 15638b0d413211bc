// The error of plans and of foreign maps, for C.
#include "c/convert.hpp"
#include "geometry/usable.hpp"

namespace gnomon::c {
namespace {

gnomon_point_error from_error(const PointAliasing& e) noexcept {
  return {static_cast<std::int32_t>(e.status),
          0,
          e.m_max,
          e.m_min,
          e.m_s,
          e.m_t,
          e.m_area,
          e.anisotropy,
          e.perspective_max,
          e.perspective_s,
          e.perspective_t,
          e.projection};
}

}  // namespace
}  // namespace gnomon::c

using namespace gnomon;
using namespace gnomon::c;

extern "C" {

int32_t gnomon_measure(const gnomon_plan* plan, const gnomon_view* view, const gnomon_scene* scene,
                       const gnomon_measure_options* options, gnomon_stats* stats,
                       const char** invalid_field) {
  ShadowPlan p;
  Measured m;
  const char* fault = to_plan(plan, p);
  if (fault == nullptr) fault = to_measured(view, scene, options, stats, m);
  if (fault != nullptr) return refuse(fault, invalid_field);
  if (m.options.map >= p.map_count && p.map_count > 0) return refuse("measure_options.map", invalid_field);
  place_origin(m.view.camera, p);
  gnomon_stats all;
  set_defaults(all);
  from_stats(measure(p, m.view, m.bounds, m.options), all);
  write(all, stats);
  return done(invalid_field);
}

int32_t gnomon_measure_points(const gnomon_map* map, const gnomon_camera* camera, const double* points,
                              const double* normals, int64_t count, gnomon_point_error* errors,
                              const char** invalid_field) {
  ShadowMap record;
  View view;
  std::span<const glm::dvec3> list, facing;
  const char* fault = to_map(map, record);
  if (fault == nullptr) fault = to_camera(camera, view.camera);
  if (fault == nullptr) fault = fault_of_view(view, {});
  if (fault == nullptr && count < 0) fault = "count";
  if (fault == nullptr) fault = to_points(points, count, "points", list);
  if (fault == nullptr && normals != nullptr) fault = to_points(normals, count, "normals", facing);
  if (fault == nullptr && errors == nullptr && count > 0) fault = "errors";
  if (fault != nullptr) return refuse(fault, invalid_field);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!usable(list[i])) return refuse("points", invalid_field);
    if (normals != nullptr && !usable(facing[i])) return refuse("normals", invalid_field);
  }
  // In blocks: results of C++ are no results of C, and need room.
  constexpr std::size_t kBlock = 64;
  std::array<PointAliasing, kBlock> found;
  for (std::size_t begin = 0; begin < list.size(); begin += kBlock) {
    const auto part = list.subspan(begin, kBlock < list.size() - begin ? kBlock : list.size() - begin);
    if (normals != nullptr) {
      measure_points(record, view.camera, part, facing.subspan(begin, part.size()), found);
    } else {
      measure_perspectives(record, view.camera, part, found);
    }
    for (std::size_t i = 0; i < part.size(); ++i) errors[begin + i] = from_error(found[i]);
  }
  return done(invalid_field);
}

}  // extern "C"
