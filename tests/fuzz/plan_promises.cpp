// What make_plan promises for every input, broken or not.
#include "plan_promises.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "fuzz.hpp"

namespace gnomon::fuzz {
namespace {

template <class Matrix>
void require_finite(const Matrix& m, const char* promise) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) require(std::isfinite(m[c][r]), promise);
  }
}

void require_plane(const glm::dvec4& plane) {
  for (int c = 0; c < 4; ++c) require(std::isfinite(plane[c]), "finite planes");
  require(std::abs(glm::length(glm::dvec3(plane)) - 1.0) < 1e-6, "planes of unit normals");
}

void check_map(const ShadowMap& map) {
  require_finite(map.clip_from_world, "a finite matrix");
  require_finite(map.clip_from_camera_relative, "a finite camera-relative matrix");
  require(map.width >= 1 && map.width <= kMaxMapSize && map.height >= 1 && map.height <= kMaxMapSize,
          "a map has a size");
  require(std::isfinite(map.depth_begin) && map.depth_begin <= map.depth_end && std::isfinite(map.depth_end),
          "a range of depths");
  require(map.warp != nullptr && std::isfinite(map.kappa), "a warp and its strength");
  require(std::isfinite(map.depth_range_world) && map.depth_range_world > 0.0, "a depth range");
  for (int c = 0; c < 2; ++c) {
    require(map.texel_world[c] >= 0.0 && std::isfinite(map.texel_world[c]), "a texel has an extent");
    require(std::isfinite(map.texel_world_max[c]), "a largest texel");
  }
  require(map.filter_margin_texels >= 0, "a margin is not negative");
  require(map.cull_plane_count >= 0 && map.cull_plane_count <= kMaxCullPlanes, "room for cull planes");
  for (int i = 0; i < map.cull_plane_count; ++i) require_plane(map.cull_planes[static_cast<std::size_t>(i)]);
  require(map.select_plane_count >= 0 && map.select_plane_count <= kMaxSelectPlanes,
          "room for select planes");
  for (int i = 0; i < map.select_plane_count; ++i)
    require_plane(map.select_planes[static_cast<std::size_t>(i)]);
  require(!std::isnan(map.m_s_max) && !std::isnan(map.m_t_max) && !std::isnan(map.storage),
          "errors are numbers");
}

void check_omissions(const ShadowPlan& plan) {
  require(plan.omission_count >= 0, "a count of omissions");
  for (const Omission& omission : plan.omitted()) {
    const OmissionText text = describe(omission);
    require(text.what.back() == '\0' && text.why.back() == '\0', "words end");
    require(text.what[0] != '\0' && text.why[0] != '\0', "an omission says what and why");
    require(!std::isnan(omission.a) && !std::isnan(omission.b), "an omission's numbers");
    require(omission.saves_texels >= 0, "an omission costs nothing");
  }
}

}  // namespace

void check_plan(const ShadowPlan& plan, const PlanOptions& options) {
  require(plan.status <= PlanStatus::invalid_input, "a status");
  require(plan.map_count >= 0 && plan.map_count <= kMaxMaps, "a count of maps");
  require((plan.status == PlanStatus::ok) == (plan.map_count > 0), "maps where the plan is ok");
  require((plan.status == PlanStatus::invalid_input) == !plan.invalid_field.empty(),
          "a field is named where the input is invalid");
  check_omissions(plan);
  if (plan.status == PlanStatus::invalid_input) return;
  for (int c = 0; c < 3; ++c) {
    require(std::isfinite(plan.origin_world[c]) && std::isfinite(plan.light_direction[c]),
            "a finite origin and direction");
  }
  std::int64_t texels = 0;
  for (const ShadowMap& map : plan.maps()) {
    check_map(map);
    require(options.resolution.texel_budget > 0 ||
                (map.width <= options.resolution.max_size && map.height <= options.resolution.max_size),
            "no side longer than asked for");
    texels += std::int64_t{map.width} * map.height;
  }
  require(options.resolution.texel_budget == 0 || texels <= options.resolution.texel_budget ||
              options.split.partition != Partition::view_depth,
          "within the budget");
}

}  // namespace gnomon::fuzz
