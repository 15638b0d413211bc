// Page plans by hand: what is refused, what is opened, and who is told.
#include "gnomon/pages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "pages/street.hpp"
#include "support/near.hpp"

namespace gnomon::test {
namespace {

TEST(Pages, broken_options_are_refused_by_name) {
  struct Entry {
    const char* field;
    void (*change)(Street& street);
  };
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const Entry entries[] = {
      {"pages.capacity", [](Street& s) { s.options.capacity = 0; }},
      {"pages.capacity", [](Street& s) { s.options.capacity = kMaxPages + 1; }},
      {"pages.page_texels", [](Street& s) { s.options.page_texels = 100; }},
      {"pages.page_texels", [](Street& s) { s.options.virtual_texels = 64; }},
      {"pages.virtual_texels", [](Street& s) { s.options.virtual_texels = 0; }},
      {"pages.target_m", [](Street& s) { s.options.target_m = 0.0; }},
      {"pages.target_m", [](Street& s) { s.options.target_m = kNone; }},
      {"pages.share", [](Street& s) { s.options.share = 0.0; }},
      {"pages.levels_per_octave", [](Street& s) { s.options.levels_per_octave = 5; }},
      {"pages.trials", [](Street& s) { s.options.trials = 0; }},
      {"pages.reach_texels", [](Street& s) { s.options.reach_texels = -1.0; }},
      {"pages.least_light_sine", [](Street& s) { s.options.least_light_sine = 2.0; }},
      {"options.filter.texels", [](Street& s) { s.options.plan.filter.texels = 33.0; }},
      {"options.filter.world", [](Street& s) { s.options.plan.filter.world = 0.1; }},
      {"view.points_world", [](Street& s) { s.points[7].y = kNone; }},
      {"view.points_world", [](Street& s) { s.points[7].y = std::numeric_limits<double>::infinity(); }},
      {"view.normals_world",
       [](Street& s) {
         s.normals.assign(3, {0, 1, 0});
       }},
      {"view.normals_world",
       [](Street& s) {
         s.normals.assign(4000, {0, kNone, 0});
       }},
      {"history.feedback", [](Street& s) { s.feedback.assign(3999, 0); }},
      {"camera.far_depth", [](Street& s) { s.camera.far_depth = 0.1; }},
      {"light.direction",
       [](Street& s) {
         s.light = DirectionalLight{{0, 0, 0}};
       }},
  };
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  for (const Entry& entry : entries) {
    Street street;
    entry.change(street);
    const PagePlan plan = street.plan(memory);
    EXPECT_EQ(plan.status, PlanStatus::invalid_input) << entry.field;
    EXPECT_EQ(plan.invalid_field, entry.field);
    EXPECT_TRUE(plan.pages.empty());
  }
}

TEST(Pages, memory_that_is_too_small_is_refused_by_name) {
  const Street street;
  const std::size_t enough = page_memory(4096, street.points.size());
  std::vector<std::byte> memory(enough + 1);
  const auto field_of = [&](const View& view, std::span<std::byte> bytes) {
    return plan_pages(view, street.light, {street.boxes, street.boxes}, {}, bytes).invalid_field;
  };
  const View seen{.camera = street.camera, .points_world = street.points};
  EXPECT_EQ(field_of(seen, std::span(memory).first(enough)), "");
  EXPECT_EQ(field_of(seen, std::span(memory).last(enough)), "") << "it may begin anywhere";
  EXPECT_EQ(field_of(seen, std::span(memory).first(enough - 1)), "memory");
  EXPECT_EQ(field_of(seen, {}), "memory");
  const std::size_t no_sample = page_memory(4096, 0);
  EXPECT_EQ(field_of(street.camera, std::span(memory).first(no_sample)), "memory");
}

TEST(Pages, what_the_memory_holds_before_and_where_it_begins_changes_nothing) {
  Street street;
  street.options.policy = &page_policies::queried;
  const std::size_t size = page_memory(4096, street.points.size());
  std::vector<std::byte> clean(size), used(size + 3, std::byte{0xff});
  const PagePlan a = street.plan(clean), b = street.plan(std::span(used).last(size));
  ASSERT_EQ(a.status, PlanStatus::ok);
  ASSERT_EQ(a.pages.size(), b.pages.size());
  for (std::size_t i = 0; i < a.pages.size(); ++i) {
    EXPECT_EQ(a.pages[i].level, b.pages[i].level);
    EXPECT_EQ(a.pages[i].column, b.pages[i].column);
    EXPECT_EQ(a.pages[i].row, b.pages[i].row);
  }
  EXPECT_TRUE(std::equal(a.table.begin(), a.table.end(), b.table.begin(), b.table.end()));
}

TEST(Pages, a_pool_that_cannot_hold_one_page_for_each_map_is_refused) {
  Street street;
  street.light = PointLight{{0.0, 8.0, -20.0}, 300.0};
  street.options.capacity = 1;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  EXPECT_EQ(street.plan(memory).invalid_field, "pages.capacity");
  street.options.capacity = 6;
  EXPECT_EQ(street.plan(memory).status, PlanStatus::ok);
}

TEST(Pages, nothing_visible_and_no_caster_are_values) {
  Street street;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const std::vector<Box> none;
  const auto plan_with = [&](const SceneBounds& bounds) {
    return plan_pages({.camera = street.camera, .points_world = street.points}, street.light, bounds, {},
                      memory);
  };
  EXPECT_EQ(plan_with({street.boxes, none}).status, PlanStatus::nothing_visible);
  EXPECT_EQ(plan_with({none, street.boxes}).status, PlanStatus::no_caster);
  // Receivers in view, and points of another scene.
  for (glm::dvec3& point : street.points) point.x += 5000.0;
  const PagePlan beside = plan_with({street.boxes, street.boxes});
  EXPECT_EQ(beside.status, PlanStatus::nothing_visible);
  EXPECT_EQ(beside.points_outside, street.points.size());
  EXPECT_EQ(page_serving(beside, street.points[0]), -1);
  EXPECT_EQ(measure(beside, {.camera = street.camera, .points_world = street.points}, {}).m.samples, 0u);
}

TEST(Pages, one_point_takes_one_page_of_the_level_that_it_needs) {
  Street street;
  street.points = {{0.3, 0.0, -40.0}};
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  ASSERT_EQ(plan.pages.size(), 1u);
  ASSERT_EQ(plan.levels.size(), 1u);
  const PointAliasing m = measure_perspective(plan.levels[0], street.camera, street.points[0]);
  EXPECT_LE(std::max(m.m_s, m.m_t), 1.0 + 1e-6);
  // The next coarser level has texels of 2^(1/3).
  EXPECT_GT(std::max(m.m_s, m.m_t), 1.0 / std::cbrt(2.0) - 1e-6);
}

TEST(Pages, normals_bring_the_levels_that_their_surfaces_need) {
  Street street;
  street.points = {{0.3, 0.0, -40.0}};
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  // A wall that the sun grazes: pixels there are far smaller in the map than on the ground.
  const glm::dvec3 grazed = glm::normalize(glm::dvec3(-1.0, 0.0, 0.3));
  double texel[2];
  for (int i = 0; i < 2; ++i) {
    street.normals = {i == 0 ? glm::dvec3(0, 1, 0) : grazed};
    const PagePlan plan = street.plan(memory);
    ASSERT_EQ(plan.pages.size(), 1u);
    texel[i] = plan.levels[0].texel_world.x;
    const PointAliasing m = measure_point(plan.levels[0], street.camera, street.points[0], street.normals[0]);
    if (m.status == PointAliasing::Status::ok) {
      EXPECT_LE(std::max(m.m_s, m.m_t), 1.0 + 1e-6);
    }
    EXPECT_EQ(plan.points_capped, 0u);
  }
  EXPECT_NE(texel[0], texel[1]);
  // Turned from the light: any page will do, and the coarsest is enough.
  street.normals = {{0, -1, 0}};
  street.camera.position = {0, -5, 0};
  street.camera.forward = {0, 0.1, -1};
  const PagePlan dark = street.plan(memory);
  ASSERT_EQ(dark.pages.size(), 1u);
  EXPECT_EQ(dark.levels[0].width, dark.page_texels);
  // Edge-on to the light: no level resolves it, which the plan reports.
  street.normals = {glm::normalize(glm::cross(glm::dvec3(0.3, -1, 0.2), glm::dvec3(1, 0, 0)))};
  if (street.normals[0].z < 0.0) street.normals[0] = -street.normals[0];
  street.camera.position = {0, 5, 0};
  const PagePlan edge = street.plan(memory);
  ASSERT_EQ(edge.omission_count, 1);
  EXPECT_EQ(edge.omission[0].kind, OmissionKind::points_beyond_levels);
  EXPECT_STREQ(describe(edge.omission[0]).why.data(),
               "1 visible points need more texels than the deepest level has");
}

TEST(Pages, without_points_the_boxes_are_sampled) {
  Street street;
  street.points.clear();
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  street.options.target_m = 4.0;
  const PagePlan plan = street.plan(memory);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_GT(plan.points, 3000u);
  const PageStats stats = measure(plan, street.camera, SceneBounds{street.boxes, street.boxes}, {16, 9, 16});
  EXPECT_GT(stats.m.samples, 200u);
  EXPECT_LT(stats.p95_side, plan.target_m * 1.5);
}

TEST(Pages, a_small_pool_coarsens_all_levels_and_says_so) {
  Street street;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan whole = street.plan(memory);
  street.options.capacity = static_cast<int>(whole.pages.size()) / 3;
  std::vector<std::byte> small(page_memory(street.options.capacity, 1 << 14));
  const PagePlan plan = street.plan(small);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_LE(plan.pages.size(), static_cast<std::size_t>(street.options.capacity));
  EXPECT_GT(plan.pages.size(), static_cast<std::size_t>(street.options.capacity) / 2);
  EXPECT_GT(plan.target_m, 1.0);
  EXPECT_EQ(plan.points, whole.points);
  ASSERT_EQ(plan.omission_count, 1);
  EXPECT_EQ(plan.omission[0].kind, OmissionKind::pages_coarsened);
  EXPECT_EQ(plan.omission[0].b, plan.target_m);
  const PageStats stats = measure(plan, {.camera = street.camera, .points_world = street.points}, {});
  EXPECT_EQ(stats.m.outside, 0u);
  EXPECT_LE(stats.worst_side, plan.target_m * (1.0 + 1e-6));
}

TEST(Pages, a_small_pool_coarsens_by_no_eighth_of_an_octave_too_much) {
  Street street;
  street.options.trials = 1;  // of several, the pool's size decides
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const std::size_t whole = street.plan(memory).pages.size();
  for (const std::size_t part : {2u, 3u, 4u, 5u, 7u}) {
    Street other = street;
    other.options.capacity = static_cast<int>(whole / part);
    const PagePlan plan = other.plan(memory);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    other.options.capacity = street.options.capacity;
    other.options.target_m = plan.target_m * std::exp2(-0.125);
    EXPECT_GT(other.plan(memory).pages.size(), whole / part) << "the pool had room for an eighth less";
  }
}

TEST(Pages, more_trials_take_no_more_pages) {
  Street street;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  std::size_t before = 0, first = 0;
  for (const int trials : {1, 2, 4, 8, 16}) {
    street.options.trials = trials;
    const std::size_t pages = street.plan(memory).pages.size();
    if (trials == 1) first = before = pages;
    EXPECT_LE(pages, before) << trials;
    before = pages;
  }
  EXPECT_LT(before, first);
}

TEST(Pages, a_point_on_the_edges_of_pages_opens_those_on_all_sides) {
  Street street;
  street.light = DirectionalLight{{0, -1, 0}};
  street.options.plan.fit = Fit::stable;  // edges at powers of two, from the world's origin on
  street.points = {{0, 0, -64}};
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  EXPECT_EQ(street.plan(memory).pages.size(), 4u);
  street.points = {{1e-3, 0, -64}};
  EXPECT_EQ(street.plan(memory).pages.size(), 2u);
  street.points = {{1e-3, 0, -64.001}};
  EXPECT_EQ(street.plan(memory).pages.size(), 1u);
}

TEST(Pages, the_border_is_counted_beside_the_texels_inside) {
  Street street;
  street.options.page_texels = 64;
  street.options.plan.filter.texels = 2.5;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  const PageStats stats = measure(plan, {.camera = street.camera, .points_world = street.points}, {});
  EXPECT_CLOSE(stats.border_share, (70.0 * 70.0 - 64.0 * 64.0) / (64.0 * 64.0), 1e-12);
  EXPECT_CLOSE(stats.m.storage, stats.texels_per_pixel * (1.0 + stats.border_share), 1e-12);
}

TEST(Pages, the_bias_of_a_level_is_that_of_its_own_texels) {
  Street street;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  ASSERT_GT(plan.levels.size(), 2u);
  const auto in_texels = [](const ShadowMap& level, double bias) {
    return bias / std::max(level.texel_world.x, level.texel_world.y);
  };
  const ShadowMap& first = plan.levels.front();
  EXPECT_GT(first.bias_world.constant, 0.0);
  for (const ShadowMap& level : plan.levels) {
    const auto &own = level.bias_world, &other = first.bias_world;
    EXPECT_CLOSE(in_texels(level, own.constant), in_texels(first, other.constant), 1e-12);
    EXPECT_CLOSE(in_texels(level, own.slope), in_texels(first, other.slope), 1e-12);
    EXPECT_CLOSE(in_texels(level, own.normal_offset), in_texels(first, other.normal_offset), 1e-12);
  }
}

TEST(Pages, texels_are_long_where_pixels_are) {
  Street street;
  street.normals.assign(street.points.size(), {0, 1, 0});
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  const glm::dvec2 texel = plan.levels.front().texel_world;
  EXPECT_GT(std::abs(std::log2(texel.x / texel.y)), 0.5) << "the street is seen at a slant";
  double sum = 0.0;
  for (const glm::dvec3& point : street.points) {
    const Page& page = plan.pages[static_cast<std::size_t>(page_serving(plan, point))];
    const PointAliasing m = measure_point(plan.levels[page.level], street.camera, point, {0, 1, 0});
    sum += std::log2(m.m_s / m.m_t);
  }
  // In octaves: the aspect is one for all points, and chosen from a histogram in quarters.
  EXPECT_LT(std::abs(sum) / static_cast<double>(street.points.size()), 0.5);
}

TEST(Pages, no_caster_behind_a_local_light_is_drawn) {
  Street street;
  street.light = SpotLight{{0, 20, -60}, {0, -1, 0}, 0.8, 100.0};
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  // So wide that it lies across the planes of all four sides.
  const std::vector<Box> behind = {{{-500, 21, -500}, {500, 22, 500}}};
  const std::vector<Box> before = {{{-500, 18, -500}, {500, 19, 500}}};
  for (const Page& page : plan.pages) {
    EXPECT_EQ(cull_casters(page_map(plan, page), behind, {}), 0u);
    EXPECT_EQ(cull_casters(page_map(plan, page), before, {}), 1u);
  }
}

TEST(Pages, a_share_below_one_gives_up_the_pages_of_few_points) {
  Street street;
  // Clusters, and some points on their own.
  for (int i = 0; i < 60; ++i) street.points.push_back({10.0 + 0.1 * i, 20.0 - 0.2 * i, -12.0 - 2.9 * i});
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan whole = street.plan(memory);
  street.options.share = 0.95;
  std::vector<std::byte> second(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(second);
  EXPECT_LT(plan.pages.size(), whole.pages.size());
  EXPECT_GT(plan.points_coarser, 0u);
  std::size_t above = 0;
  for (const glm::dvec3& point : street.points) {
    const int page = page_serving(plan, point);
    ASSERT_GE(page, 0);
    const PointAliasing m = measure_perspective(plan.levels[plan.pages[static_cast<std::size_t>(page)].level],
                                                street.camera, point);
    above += std::max(m.m_s, m.m_t) > 1.0 + 1e-6;
  }
  EXPECT_GT(above, 0u);
  EXPECT_LE(above, plan.points_coarser);
  EXPECT_LE(static_cast<double>(plan.points_coarser), 0.05 * static_cast<double>(street.points.size()));
}

TEST(Pages, the_fallback_holds_every_place_of_the_coarsest_level) {
  Street street;
  street.points = {{0.3, 0.0, -40.0}};
  street.options.fallback = true;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  EXPECT_EQ(plan.pages.size(), 2u);
  EXPECT_EQ(page_serving(plan, {-15.0, 0.0, -120.0}), 0);
  EXPECT_EQ(page_serving(plan, street.points[0]), 1);
}

TEST(Pages, a_wider_reach_opens_the_pages_round_each_point) {
  Street street;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const std::size_t points_alone = street.plan(memory).pages.size();
  street.options.reach_texels = 64.0;
  const PagePlan plan = street.plan(memory);
  EXPECT_GT(plan.pages.size(), points_alone);
  for (const glm::dvec3& point : street.points) {
    const Page& page = plan.pages[static_cast<std::size_t>(page_serving(plan, point))];
    // 0.9 of the reach along the level's x, on the ground across the light.
    const ShadowMap& level = plan.levels[page.level];
    const double step = 0.9 * 64.0 * level.texel_world.x;
    const glm::dvec3 axis = glm::normalize(
        glm::dvec3(level.clip_from_world[0][0], level.clip_from_world[1][0], level.clip_from_world[2][0]));
    const int beside = page_serving(plan, point + axis * step);
    ASSERT_GE(beside, 0);
    EXPECT_GE(plan.pages[static_cast<std::size_t>(beside)].level, page.level);
  }
}

TEST(Pages, reach_texels_are_those_of_the_level_that_a_point_needs) {
  Street street;
  // Few points that lie apart, so that finer pages of one hold little of another's surroundings.
  street.points.clear();
  for (int i = 0; i < 400; ++i) street.points.push_back({-3.0 + 7 * i % 13 * 0.5, 0.0, -8.0 - 0.45 * i});
  street.options.reach_texels = 48.0;
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  int beside = 0;
  for (const glm::dvec3& point : street.points) {
    const auto needed = std::find_if(plan.levels.begin(), plan.levels.end(), [&](const ShadowMap& level) {
      const PointAliasing m = measure_perspective(level, street.camera, point);
      return std::max(m.m_s, m.m_t) <= plan.target_m;
    });
    ASSERT_NE(needed, plan.levels.end());
    for (int row = 0; row < 2; ++row) {
      const glm::dmat4& m = needed->clip_from_world;
      const glm::dvec3 axis = glm::normalize(glm::dvec3(m[0][row], m[1][row], m[2][row]));
      for (const double way : {-0.95, 0.95}) {
        const glm::dvec3 place =
            point + axis * (way * street.options.reach_texels * needed->texel_world[row]);
        const int page = page_serving(plan, place);
        const glm::dvec4 clip = m * glm::dvec4(place, 1.0);
        if (std::max(std::abs(clip.x), std::abs(clip.y)) > clip.w) continue;  // beside all receivers
        ASSERT_GE(page, 0);
        EXPECT_GE(plan.pages[static_cast<std::size_t>(page)].level, needed - plan.levels.begin());
        ++beside;
      }
    }
  }
  EXPECT_GT(beside, 1000);
}

TEST(Pages, a_light_inside_a_caster_is_planned_and_reported) {
  Street street;
  street.light = PointLight{{0.0, 8.0, -20.0}, 300.0};
  street.boxes.push_back({{-1.0, 7.0, -21.0}, {1.0, 9.0, -19.0}});
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  const PagePlan plan = street.plan(memory);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  EXPECT_TRUE(std::any_of(plan.omitted().begin(), plan.omitted().end(),
                          [](const Omission& o) { return o.kind == OmissionKind::depth_near_light; }));
  for (std::size_t i = 0; i < street.points.size(); i += 50)
    EXPECT_GE(page_serving(plan, street.points[i]), 0);
}

TEST(Pages, scenes_at_the_end_of_the_range_are_planned_or_refused) {
  for (const double offset : {1e12, 1e20, 9e29}) {
    for (const Fit fit : {Fit::tight, Fit::stable}) {
      Street street;
      street.options.plan.fit = fit;
      street.camera.position += offset;
      for (Box& box : street.boxes) box = {box.min + offset, box.max + offset};
      for (glm::dvec3& point : street.points) point += offset;
      std::vector<std::byte> memory(page_memory(4096, 1 << 14));
      const PagePlan plan = street.plan(memory);
      for (const Page& page : plan.pages) {
        EXPECT_GE(page.column, 0);
        EXPECT_GE(page.row, 0);
        EXPECT_TRUE(std::isfinite(page_map(plan, page).clip_from_world[3][0]));
      }
      EXPECT_LE(plan.points + plan.points_outside, street.points.size());
      EXPECT_EQ(plan.status == PlanStatus::invalid_input, !plan.invalid_field.empty());
      EXPECT_TRUE(offset >= 1e20 || plan.status == PlanStatus::ok);
    }
  }
}

TEST(Pages, a_million_points_and_a_far_plane_at_infinity_are_planned) {
  Street street;
  street.camera.far_depth = std::numeric_limits<double>::infinity();
  const std::vector<glm::dvec3> few = street.points;
  for (int copy = 0; copy < 249; ++copy) street.points.insert(street.points.end(), few.begin(), few.end());
  std::vector<std::byte> memory(page_memory(4096, street.points.size()));
  const PagePlan many = street.plan(memory);
  ASSERT_EQ(many.status, PlanStatus::ok);
  EXPECT_EQ(many.points, 1000000u);
  street.points = few;
  std::vector<std::byte> other(page_memory(4096, 1 << 14));
  EXPECT_EQ(many.pages.size(), street.plan(other).pages.size());
}

TEST(Pages, a_share_leaves_about_as_many_points_to_coarser_levels_as_it_allows_and_no_more) {
  Street street;
  // Few points to a page, so that any of them may be left.
  street.points.clear();
  for (int i = 0; i < 400; ++i) street.points.push_back({-15.0 + 7 * i % 13 * 2.5, 0.0, -8.0 - 0.45 * i});
  std::vector<std::byte> memory(page_memory(4096, 1 << 14));
  for (const double share : {0.6, 0.4, 0.2}) {
    street.options.share = share;
    const PagePlan plan = street.plan(memory);
    const double most = (1.0 - share) * static_cast<double>(plan.points);
    EXPECT_LE(static_cast<double>(plan.points_coarser), most) << share;
    EXPECT_GT(static_cast<double>(plan.points_coarser), 0.9 * most) << share;
  }
}

// The coarser pages were more than the pool holds: two thirds of the points were left without a page.
TEST(Pages, a_share_below_one_leaves_no_point_without_a_page_where_the_pool_is_full) {
  Street street;
  street.camera = perspective_camera({0, 5, 60}, {0, -0.15, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 500, 960, 640);
  street.boxes = {{{-100, 0, -100}, {100, 30, 100}}};
  street.points.clear();
  for (int i = 0; i < 400; ++i)
    street.points.push_back({-90.0 + 37 * i % 181, 0.0, -95.0 + 0.1 * (71 * i % 1500)});
  int coarser = 0, kept = 0;
  for (const PagePolicy* policy : all_page_policies()) {
    street.options.policy = policy;
    for (int capacity = 2; capacity <= 64; ++capacity) {
      for (const double share : {0.5, 0.8, 0.95}) {
        street.options.capacity = capacity;
        street.options.share = share;
        std::vector<std::byte> memory(page_memory(capacity, street.points.size()));
        const PagePlan plan = street.plan(memory);
        if (plan.status == PlanStatus::invalid_input) continue;  // less than a page for each map
        ++(plan.points_coarser > 0 ? coarser : kept);
        std::uint64_t served = 0;
        for (const glm::dvec3& point : street.points) served += page_serving(plan, point) >= 0;
        EXPECT_EQ(served, street.points.size()) << policy->name << ' ' << capacity << ' ' << share;
        EXPECT_EQ(plan.points, street.points.size());
      }
    }
  }
  EXPECT_GT(coarser, 200);
  EXPECT_GT(kept, 20);
}

}  // namespace
}  // namespace gnomon::test
