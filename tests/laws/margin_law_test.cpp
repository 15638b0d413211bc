// Does the map's rim hold every kernel, whether given in texels or in world units, under any warp and fit?
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// Rounding of a position in the map, in texels.
constexpr double kTexel = 1e-3;

/// How many texels beyond the map's edge a kernel of `radius_world` round p reaches, by the map's own
/// derivative at p: what a shader that follows the Jacobian reads.
double beyond_the_edge(const ShadowMap& map, const glm::dvec3& light_direction, const glm::dvec3& p,
                       double radius_world) {
  const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
  double worst = -1e300;
  for (int axis = 0; axis < 2; ++axis) {
    glm::dvec3 gradient;
    for (int column = 0; column < 3; ++column) {
      gradient[column] =
          (map.clip_from_world[column][axis] - clip[axis] / clip.w * map.clip_from_world[column].w) / clip.w;
    }
    const glm::dvec3 across = gradient - light_direction * glm::dot(gradient, light_direction);
    const double half = 0.5 * (axis == 0 ? map.width : map.height);
    const double reach = half * (std::abs(clip[axis] / clip.w) + glm::length(across) * radius_world);
    worst = std::max(worst, reach - half);
  }
  return worst;
}

TEST(MarginLaw, no_kernel_in_world_units_reads_outside_its_map) {
  std::uint64_t judged = 0, wide = 0;
  for_all(600, [&] {
    Case c = draw_case({.max_depth_ratio = 1e4, .max_boxes = 6});
    const Fit fits[] = {Fit::tight, Fit::rotated, Fit::stable, Fit::warped_stable};
    c.options.fit = fits[pick(4)];
    c.options.filter.texels = 0.0;
    c.options.filter.world = c.camera.far_depth * std::pow(10.0, between(-5.0, -1.0));
    const ShadowPlan plan = c.plan();
    Random random(3);
    for (const glm::dvec3& p : visible_points(c, random, 3, 6)) {
      const ShadowMap* map = map_for(plan, depth_of(c.camera, p));
      // A rim of a quarter is as wide as it gets: the kernel is too wide for the map.
      if (map == nullptr || 4 * map->filter_margin_texels >= map->width) continue;
      wide += map->filter_margin_texels > 2;
      const double out = beyond_the_edge(*map, plan.light_direction, p, c.options.filter.world);
      require(out <= kTexel, "texels beyond the edge", out, "margin", map->filter_margin_texels, "cascade",
              map->cascade, to_string(c.options.fit), map->warp->name);
      ++judged;
    }
  });
  EXPECT_GT(judged, of_all_draws(500));
  EXPECT_GT(wide, of_all_draws(100));
}

}  // namespace
}  // namespace gnomon::test
