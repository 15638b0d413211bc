// What must hold of every page plan, over random cameras, lights and visible points.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "gnomon/pages.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

// Rounding of needs to float, and of a point's place in two matrices.
constexpr double kRounding = 1.0 + 1e-6;

/// A case, what is visible in it, and how pages are planned.
struct Scene {
  Case input;
  Light light;
  std::vector<glm::dvec3> points;
  PageOptions options;

  [[nodiscard]] PagePlan plan(std::span<std::byte> memory) const {
    return plan_pages({.camera = input.camera, .points_world = points}, light, input.bounds(), options,
                      memory);
  }
};

Light drawn_light(const Case& c) {
  if (chance(0.6)) return DirectionalLight{c.light};
  const glm::dvec3 at =
      point_at(c.camera, between(-1, 1), between(-1, 1), between(c.camera.near_depth, c.camera.far_depth)) -
      c.light * between(0.1, 1.0) * c.camera.far_depth;
  if (chance(0.5)) return PointLight{at, 4.0 * c.camera.far_depth};
  return SpotLight{at, c.light, between(0.3, 1.3), 4.0 * c.camera.far_depth};
}

Scene draw_scene() {
  Scene s;
  CaseLimits limits;
  limits.max_depth_ratio = 1e3;
  limits.max_boxes = 8;
  s.input = draw_case(limits);
  s.light = drawn_light(s.input);
  Random random(static_cast<std::uint64_t>(pick(1 << 20)));
  s.points = visible_points(s.input, random, 8, 32);
  s.options.policy = &page_policies::resolution;
  s.options.page_texels = 64 << pick(3);
  s.options.levels_per_octave = 1 + pick(4);
  s.options.trials = 1 + pick(3);
  s.options.target_m = std::exp2(between(-2.0, 4.0));
  s.options.plan.fit = chance(0.4) ? Fit::stable : Fit::tight;
  s.options.plan.filter.texels = pick(5);
  return s;
}

/// Whether the light's range holds the point: others are dark, and served by chance alone.
bool in_range(const Light& light, const glm::dvec3& point) {
  const auto holds = [&](const auto& local) {
    return local == nullptr || glm::distance(local->position, point) <= local->range;
  };
  return holds(std::get_if<PointLight>(&light)) && holds(std::get_if<SpotLight>(&light));
}

constexpr int kCapacity = 1 << 14;

/// Calls `check` on random scenes that need pages; returns how many there were.
template <typename Check>
int over_scenes(int cases, Check&& check) {
  int checked = 0;
  for_all(cases, [&] {
    const Scene scene = draw_scene();
    if (scene.points.empty()) return;
    std::vector<std::byte> memory(page_memory(kCapacity, scene.points.size()));
    const PagePlan plan = scene.plan(memory);
    require(plan.status != PlanStatus::invalid_input, "refused", plan.invalid_field);
    if (plan.status != PlanStatus::ok) return;
    ++checked;
    check(scene, plan);
  });
  return checked;
}

TEST(PagesLaw, every_visible_point_is_served_and_meets_the_target_above_the_deepest_level) {
  const int checked = over_scenes(400, [](const Scene& scene, const PagePlan& plan) {
    std::uint64_t served = 0, above = 0;
    for (const glm::dvec3& point : scene.points) {
      const int page = page_serving(plan, point);
      if (page < 0) continue;
      ++served;
      const ShadowMap& level = plan.levels[plan.pages[static_cast<std::size_t>(page)].level];
      const PointAliasing m = measure_perspective(level, scene.input.camera, point);
      require(m.status == PointAliasing::Status::ok, "not on its level");
      above += std::max(m.m_s, m.m_t) > plan.target_m * kRounding;
    }
    require(served >= plan.points, "served", served, "of", plan.points);
    require(plan.points + plan.points_outside == scene.points.size(), "counted", plan.points,
            plan.points_outside);
    // Points beyond a local light's reach have no page of their own; some lie in one of another point.
    require(above <= plan.points_capped + plan.points_outside, "above the target", above, "capped",
            plan.points_capped, "outside", plan.points_outside);
    require(plan.target_m >= scene.options.target_m, "finer than asked for");
  });
  EXPECT_GT(checked, of_all_draws(150));
}

TEST(PagesLaw, directional_light_leaves_no_receiver_out) {
  int checked = 0;
  over_scenes(300, [&](const Scene& scene, const PagePlan& plan) {
    if (!std::holds_alternative<DirectionalLight>(scene.light)) return;
    ++checked;
    require(plan.points_outside == 0, "outside", plan.points_outside);
  });
  EXPECT_GT(checked, of_all_draws(50));
}

TEST(PagesLaw, every_page_has_a_point_and_a_place_of_its_own) {
  const int checked = over_scenes(300, [](const Scene&, const PagePlan& plan) {
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      const Page& page = plan.pages[i];
      require(page.points > 0 && page.slot < plan.pages.size(), "page", i, "points", page.points);
      require(page_at(plan, page.level, page.column, page.row) == static_cast<int>(i), "not found", i);
      const ShadowMap& level = plan.levels[page.level];
      require(page.column >= 0 && page.row >= 0 && (page.column + 1) * plan.page_texels <= level.width &&
                  (page.row + 1) * plan.page_texels <= level.height,
              "beside its level", page.column, page.row, level.width, level.height);
      require(i == 0 || plan.pages[i - 1].level <= page.level, "out of order");
    }
    for (std::size_t i = 1; i < plan.levels.size(); ++i) {
      const ShadowMap &coarse = plan.levels[i - 1], &fine = plan.levels[i];
      if (coarse.cascade != fine.cascade) continue;
      require(coarse.texel_world.x > fine.texel_world.x && coarse.texel_world.y > fine.texel_world.y,
              "not finer", coarse.texel_world.x, fine.texel_world.x);
    }
  });
  EXPECT_GT(checked, of_all_draws(120));
}

TEST(PagesLaw, larger_targets_need_no_more_pages) {
  // Levels in octaves lie in one tree, for which fewer pages are proved.
  const int checked = over_scenes(150, [](const Scene& scene, const PagePlan&) {
    Scene other = scene;
    other.options.levels_per_octave = 1;
    other.options.trials = 1;
    other.options.target_m = 0.25;
    std::size_t before = static_cast<std::size_t>(kCapacity) + 1;
    for (int i = 0; i < 12; ++i) {
      std::vector<std::byte> memory(page_memory(kCapacity, scene.points.size()));
      const PagePlan plan = other.plan(memory);
      require(plan.pages.size() <= before, "target", other.options.target_m, "pages", plan.pages.size(),
              "before", before);
      before = plan.pages.size();
      other.options.target_m *= 1.3;
    }
  });
  EXPECT_GT(checked, of_all_draws(50));
}

TEST(PagesLaw, the_pool_is_never_exceeded_and_no_point_loses_its_page) {
  int coarsened = 0;
  over_scenes(400, [&](const Scene& scene, const PagePlan& whole) {
    Scene small = scene;
    small.options.capacity = 24 + pick(40);
    if (chance(0.5)) small.options.share = between(0.4, 1.0);
    const auto policies = all_page_policies();
    small.options.policy = policies[static_cast<std::size_t>(pick(static_cast<int>(policies.size())))];
    std::vector<std::byte> memory(page_memory(small.options.capacity, scene.points.size()));
    const PagePlan plan = small.plan(memory);
    const bool directional = std::holds_alternative<DirectionalLight>(scene.light);
    // A policy may leave out what lies on the rim of a cone, and that may be all.
    if (!directional && plan.status == PlanStatus::nothing_visible) return;
    require(plan.status == PlanStatus::ok, to_string(plan.status), plan.invalid_field);
    require(plan.pages.size() <= static_cast<std::size_t>(small.options.capacity), "pages",
            plan.pages.size());
    const bool told = std::any_of(plan.omitted().begin(), plan.omitted().end(),
                                  [](const Omission& o) { return o.kind == OmissionKind::pages_coarsened; });
    require(told == (plan.target_m > small.options.target_m), "coarsened without a word");
    coarsened += told;
    std::uint64_t served = 0;
    for (const glm::dvec3& point : scene.points) served += page_serving(plan, point) >= 0;
    require(served >= plan.points, "served", served, "of", plan.points);
    require(!directional || plan.points == whole.points, "points", plan.points, "of", whole.points);
  });
  EXPECT_GT(coarsened, of_all_draws(20));
}

TEST(PagesLaw, a_page_as_a_map_shows_its_own_texels_and_its_border_holds_the_kernel) {
  const int checked = over_scenes(200, [](const Scene& scene, const PagePlan& plan) {
    require(plan.border_texels >= scene.options.plan.filter.texels, "border", plan.border_texels);
    for (const glm::dvec3& point : scene.points) {
      const int index = page_serving(plan, point);
      if (index < 0) continue;
      const Page& page = plan.pages[static_cast<std::size_t>(index)];
      const ShadowMap map = page_map(plan, page);
      const ShadowMap& level = plan.levels[page.level];
      const auto texel = [&](const ShadowMap& m) {
        const glm::dvec4 clip = m.clip_from_world * glm::dvec4(point, 1.0);
        return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(m.width, m.height);
      };
      const glm::dvec2 own = texel(map);
      const glm::dvec2 from_level = texel(level) -
                                    glm::dvec2(page.column, page.row) * double(plan.page_texels) +
                                    double(plan.border_texels);
      const double slack = 1e-7 * level.width;  // far from the origin, places are rounded
      require(glm::length(own - from_level) <= slack, "texel", own.x, own.y, "on the level", from_level.x,
              from_level.y);
      const double least = plan.border_texels - slack, most = map.width - plan.border_texels + slack;
      require(own.x >= least && own.y >= least && own.x <= most && own.y <= most, "in the border", own.x,
              own.y);
    }
  });
  EXPECT_GT(checked, of_all_draws(80));
}

TEST(PagesLaw, culling_keeps_every_caster_between_the_light_and_a_served_point) {
  int casters_met = 0;
  over_scenes(200, [&](const Scene& scene, const PagePlan& plan) {
    const auto& casters = scene.input.casters;
    std::vector<std::uint32_t> kept(casters.size());
    for (std::size_t i = 0; i < scene.points.size(); i += 7) {
      const glm::dvec3& point = scene.points[i];
      const int index = in_range(scene.light, point) ? page_serving(plan, point) : -1;
      if (index < 0) continue;
      const ShadowMap map = page_map(plan, plan.pages[static_cast<std::size_t>(index)]);
      const glm::dvec3 way =
          map.light_world.w == 0.0 ? glm::dvec3(map.light_world) : glm::dvec3(map.light_world) - point;
      kept.resize(casters.size());
      kept.resize(cull_casters(map, casters, kept));
      for (std::size_t k = 0; k < casters.size(); ++k) {
        if (casters[k].empty()) continue;
        // Inside by more than rounding, so that the ray meets the box for certain.
        constexpr double kGraze = 1e-9;
        const glm::dvec3 eye = scene.input.camera.position;
        const double size = glm::length(casters[k].min - eye) + scene.input.camera.far_depth;
        const glm::dvec3 inset = glm::min(glm::dvec3(kGraze * size), 0.5 * (casters[k].max - casters[k].min));
        const Crossing crossing = cross({casters[k].min + inset, casters[k].max - inset}, point, way);
        if (!crossing.hits || !(crossing.leave > crossing.enter)) continue;
        if (map.light_world.w != 0.0 && crossing.enter > 1.0) continue;
        ++casters_met;
        require(std::find(kept.begin(), kept.end(), k) != kept.end(), "caster", k, "of page", index, "enter",
                crossing.enter, "leave", crossing.leave, "light", map.light_world.w);
      }
    }
  });
  EXPECT_GT(casters_met, of_all_draws(300));
}

TEST(PagesLaw, the_same_input_gives_the_same_bits) {
  const int checked = over_scenes(100, [](const Scene& scene, const PagePlan& plan) {
    // What was there before plays no part.
    std::vector<std::byte> memory(page_memory(kCapacity, scene.points.size()), std::byte{7});
    const PagePlan again = scene.plan(memory);
    require(again.pages.size() == plan.pages.size() && again.levels.size() == plan.levels.size(), "sizes");
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      const Page &a = plan.pages[i], &b = again.pages[i];
      require(a.level == b.level && a.column == b.column && a.row == b.row && a.slot == b.slot, "page", i);
    }
    for (std::size_t i = 0; i < plan.levels.size(); ++i)
      require(plan.levels[i].clip_from_world == again.levels[i].clip_from_world, "level", i);
  });
  EXPECT_GT(checked, of_all_draws(40));
}

TEST(PagesLaw, scaling_the_world_by_a_power_of_two_changes_no_page) {
  int checked = 0;
  over_scenes(150, [&](const Scene& scene, const PagePlan& plan) {
    if (!std::holds_alternative<DirectionalLight>(scene.light)) return;
    ++checked;
    const double scale = chance(0.5) ? 0x1p-20 : 0x1p20;
    Scene scaled = scene;
    Camera& camera = scaled.input.camera;
    camera.position *= scale;
    camera.near_depth *= scale;
    camera.far_depth *= scale;
    if (camera.orthographic) {
      camera.left *= scale;
      camera.right *= scale;
      camera.bottom *= scale;
      camera.top *= scale;
    }
    for (auto* list : {&scaled.input.casters, &scaled.input.receivers}) {
      for (Box& box : *list) box = {box.min * scale, box.max * scale};
    }

    for (glm::dvec3& point : scaled.points) point *= scale;
    std::vector<std::byte> memory(page_memory(kCapacity, scene.points.size()));
    const PagePlan other = scaled.plan(memory);
    require(other.status == plan.status && other.pages.size() == plan.pages.size(), "pages",
            plan.pages.size(), "scaled", other.pages.size());
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      const Page &a = plan.pages[i], &b = other.pages[i];
      require(a.level == b.level && a.column == b.column && a.row == b.row, "page", i);
    }
  });
  EXPECT_GT(checked, of_all_draws(40));
}

TEST(PagesLaw, stable_levels_keep_their_texels_in_the_world_while_the_camera_moves) {
  int pages_shared = 0;
  over_scenes(150, [&](const Scene& scene, const PagePlan& plan) {
    if (scene.options.plan.fit != Fit::stable || !std::holds_alternative<DirectionalLight>(scene.light))
      return;
    Scene moved = scene;
    const double step = 0.01 * (scene.input.camera.far_depth - scene.input.camera.near_depth);
    moved.input.camera.position += glm::dvec3(step, 0.3 * step, -0.5 * step);
    std::vector<std::byte> memory(page_memory(kCapacity, scene.points.size()));
    const PagePlan other = moved.plan(memory);
    for (const ShadowMap& a : plan.levels) {
      for (const ShadowMap& b : other.levels) {
        if (a.snap_key.texel != b.snap_key.texel) continue;
        // Equal keys: texel (0, 0) of both lies on one grid, whole texels apart.
        const glm::dvec3 at = scene.points.front();
        const auto texel = [&](const ShadowMap& m) {
          const glm::dvec4 clip = m.clip_from_world * glm::dvec4(at, 1.0);
          return (glm::dvec2(clip) * 0.5 + 0.5) * glm::dvec2(m.width, m.height) +
                 glm::dvec2(m.snap_key.x, m.snap_key.y);
        };
        const double slack = 1e-12 * (std::abs(texel(a).x) + std::abs(texel(a).y)) + 1e-6;
        require(glm::length(texel(a) - texel(b)) <= slack, "texel", texel(a).x, texel(b).x);
        require(a.snap_key.x % plan.page_texels == 0 && b.snap_key.y % plan.page_texels == 0,
                "off the pages' grid");
        ++pages_shared;
      }
    }
  });
  EXPECT_GT(pages_shared, of_all_draws(30));
}

TEST(PagesLaw, no_page_is_kept_that_a_moved_caster_can_land_on_and_kept_ones_have_the_same_bits) {
  std::size_t landed = 0, kept = 0;
  over_scenes(250, [&](const Scene& scene, const PagePlan& plan) {
    std::vector<PageSlot> slots(plan.pages.size() + 16);
    std::vector<std::uint32_t> table(page_table_size(static_cast<int>(slots.size())));
    std::vector<KeptPage> out(slots.size());
    require(keep_pages(plan, {}, slots, table, out).drawn == plan.pages.size(), "an empty pool holds pages");
    const std::vector<Box>& casters = scene.input.casters;
    const Box moved = casters[static_cast<std::size_t>(pick(static_cast<int>(casters.size())))];
    const KeptPages again = keep_pages(plan, {&moved, 1}, slots, table, out);
    require(again.fits && again.kept + again.drawn == plan.pages.size(), "counted", again.kept, again.drawn);
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      const glm::dmat4 clip_from_world = page_map(plan, plan.pages[i]).clip_from_world;
      require(slots[out[i].slot].clip_from_world == clip_from_world, "another page in slot", out[i].slot);
      if (out[i].draw || moved.empty()) continue;
      ++kept;
      for (int sample = 0; sample < 16; ++sample) {
        const glm::dvec3 at =
            moved.min + (moved.max - moved.min) * glm::dvec3(between(0, 1), between(0, 1), between(0, 1));
        const glm::dvec4 clip = clip_from_world * glm::dvec4(at, 1.0);
        require(!(clip.w > 0.0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w), "stale page", i);
      }
    }
    landed += again.drawn;
  });
  EXPECT_GT(landed, of_all_draws(100));
  EXPECT_GT(kept, of_all_draws(1000));
}

}  // namespace
}  // namespace gnomon::test
