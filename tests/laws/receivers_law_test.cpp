// Does every visible receiver lie inside its map, for every camera, light, fit, split and warp?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec4.hpp>

#include "support/finite.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// Rounding of a position through two matrices, relative to the map's half width: positions are up to 1e5 near
// planes away and clipped with a tolerance of 1e-13 of that distance.
constexpr double kRim = 1e-7;

TEST(ReceiversLaw, a_visible_receiver_lies_inside_its_map_and_off_the_filter_margin) {
  std::uint64_t checked = 0, planned = 0;
  for_all(2000, [&] {
    const Case c = draw_case();
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
    if (plan.status == PlanStatus::ok) ++planned;
    Random random(7);
    for (const glm::dvec3& p : visible_points(c, random, 6, 8)) {
      const double depth = depth_of(c.camera, p);
      const ShadowMap* map = map_for(plan, depth);
      if (map == nullptr) continue;
      ++checked;
      const glm::dvec4 clip = map->clip_from_world * glm::dvec4(p, 1.0);
      require(clip.w > 0.0, "w", clip.w, "at depth", depth, "of cascade", map->cascade, map->warp->name);
      const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
      const double rim_x = 1.0 - 2.0 * c.options.filter.texels / map->width;
      const double rim_y = 1.0 - 2.0 * c.options.filter.texels / map->height;
      require(std::abs(ndc.x) <= rim_x + kRim && std::abs(ndc.y) <= rim_y + kRim, "ndc", ndc.x, ndc.y,
              "beyond", rim_x, rim_y, "at depth", depth, "of cascade", map->cascade, map->warp->name);
      require(std::abs(ndc.z) <= 1.0, "ndc depth", ndc.z, "at depth", depth, "of cascade", map->cascade);
    }
  });
  // The law must not hold because nothing was looked at.
  EXPECT_GT(checked, of_all_draws(20000));
  EXPECT_GT(planned, of_all_draws(1000));
}

TEST(ReceiversLaw, every_number_of_a_map_is_finite_and_of_its_sign) {
  for_all(1500, [&] {
    const Case c = draw_case();
    RC_LOG() << c;
    const ShadowPlan plan = c.plan();
    require(plan.map_count >= 0 && plan.map_count <= c.options.cascades, "maps", plan.map_count);
    double last_end = 0.0;
    int last_cascade = -1;
    for (const ShadowMap& map : plan.maps()) {
      require(all_finite(map.clip_from_world), "clip_from_world of cascade", map.cascade);
      require(all_finite(map.clip_from_camera_relative), "clip_from_camera_relative");
      require(std::abs(glm::determinant(map.clip_from_world)) > 0.0, "singular matrix");
      require(map.warp != nullptr && map.kappa >= 0.0 && std::isfinite(map.kappa), "kappa", map.kappa);
      require(map.depth_begin <= map.depth_end && map.depth_begin >= last_end, "depths", map.depth_begin,
              map.depth_end, "after", last_end);
      require(map.cascade > last_cascade && map.cascade < c.options.cascades, "cascade", map.cascade);
      require(map.depth_range_world > 0.0 && std::isfinite(map.depth_range_world), "range",
              map.depth_range_world);
      require(map.texel_world.x > 0.0 && map.texel_world.y > 0.0, "texel", map.texel_world.x,
              map.texel_world.y);
      require(map.texel_world_max.x >= map.texel_world.x * (1.0 - 1e-9) &&
                  map.texel_world_max.y >= map.texel_world.y * (1.0 - 1e-9) &&
                  std::isfinite(map.texel_world_max.x + map.texel_world_max.y),
              "largest texel", map.texel_world_max.x, map.texel_world_max.y, "centre", map.texel_world.x,
              map.texel_world.y);
      require(map.m_s_max >= 0.0 && map.m_t_max >= 0.0 && std::isfinite(map.storage), "storage", map.storage);
      require(map.filter_margin_texels >= c.options.filter.texels, "margin", map.filter_margin_texels);
      require(map.cull_plane_count >= 4 && map.cull_plane_count <= kMaxCullPlanes, "planes",
              map.cull_plane_count);
      for (int i = 0; i < map.cull_plane_count; ++i) {
        const glm::dvec4& plane = map.cull_planes[static_cast<std::size_t>(i)];
        require(std::abs(glm::length(glm::dvec3(plane)) - 1.0) < 1e-9 && std::isfinite(plane.w), "plane", i);
      }
      require(map.snap_key.valid == (c.options.fit == Fit::stable), "snap key");
      last_end = map.depth_end;
      last_cascade = map.cascade;
    }
  });
}

}  // namespace
}  // namespace gnomon::test
