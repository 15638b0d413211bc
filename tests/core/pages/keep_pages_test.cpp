// Which pages does a pool keep: over cameras that move, casters that move, and pools that are too small?
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <vector>

#include "gnomon/pages.hpp"

namespace gnomon::test {
namespace {

/// A street that a camera goes down, and a pool.
struct Street {
  Light light = DirectionalLight{{0.3, -1, 0.2}};
  std::vector<Box> boxes = {
      {{-20, -1, -400}, {20, 0, 10}}, {{-20, 0, -300}, {-10, 30, -250}}, {{3, 0, -40}, {5, 6, -38}}};
  PageOptions options;
  std::vector<PageSlot> slots = std::vector<PageSlot>(2048);
  std::vector<std::uint32_t> table = std::vector<std::uint32_t>(page_table_size(2048));
  std::vector<KeptPage> kept = std::vector<KeptPage>(2048);
  std::vector<std::byte> memory = std::vector<std::byte>(page_memory(2048, 1 << 14));

  Street() {
    options.plan.fit = Fit::stable;
    options.page_texels = 64;
    options.capacity = 2048;
  }
  [[nodiscard]] PagePlan plan(double forward) {
    const Camera camera =
        perspective_camera({0, 5, -forward}, {0, -0.1, -1}, {0, 1, 0}, 1.0, 1.5, 0.5, 250, 960, 640);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 8000; ++i) points.push_back({-4.0 + i % 9, 0.0, -forward - 8.0 - 0.02 * i});
    return plan_pages({.camera = camera, .points_world = points}, light, {boxes, boxes}, options, memory);
  }
  KeptPages keep(const PagePlan& plan, std::span<const Box> moved = {}) {
    return keep_pages(plan, moved, slots, table, kept);
  }
};

void expect_each_page_in_its_slot(const Street& street, const PagePlan& plan) {
  std::set<std::uint32_t> taken;
  for (std::size_t i = 0; i < plan.pages.size(); ++i) {
    const std::uint32_t slot = street.kept[i].slot;
    EXPECT_TRUE(taken.insert(slot).second) << "two pages in slot " << slot;
    ASSERT_LT(slot, street.slots.size());
    EXPECT_EQ(street.slots[slot].clip_from_world, page_map(plan, plan.pages[i]).clip_from_world);
    EXPECT_EQ(street.slots[slot].texels, plan.slot_texels());
  }
}

TEST(KeepPages, the_first_plan_is_drawn_whole_and_the_same_again_not_at_all) {
  Street street;
  const PagePlan plan = street.plan(0.0);
  ASSERT_GT(plan.pages.size(), 50u);
  const KeptPages first = street.keep(plan);
  EXPECT_TRUE(first.fits);
  EXPECT_EQ(first.drawn, plan.pages.size());
  expect_each_page_in_its_slot(street, plan);
  const KeptPages again = street.keep(plan);
  EXPECT_EQ(again.kept, plan.pages.size());
  EXPECT_EQ(again.drawn, 0u);
  expect_each_page_in_its_slot(street, plan);
}

TEST(KeepPages, a_camera_that_goes_down_the_street_draws_few_pages) {
  for (const PagePolicy* policy : {&page_policies::resolution, &page_policies::clipmap}) {
    Street street;
    street.options.policy = policy;
    std::uint64_t kept = 0, all = 0;
    for (int frame = 0; frame < 60; ++frame) {
      const PagePlan plan = street.plan(0.1 * frame);
      ASSERT_EQ(plan.status, PlanStatus::ok);
      const KeptPages result = street.keep(plan);
      ASSERT_TRUE(result.fits);
      expect_each_page_in_its_slot(street, plan);
      if (frame == 0) continue;
      kept += result.kept;
      all += plan.pages.size();
    }
    EXPECT_GT(kept, all * 9 / 10) << policy->name;
    EXPECT_LT(kept, all) << policy->name << ": the camera moves";
  }
}

TEST(KeepPages, a_page_that_comes_back_is_still_there) {
  Street street;
  (void)street.keep(street.plan(0.0));
  (void)street.keep(street.plan(60.0));
  const PagePlan back = street.plan(0.0);
  EXPECT_EQ(street.keep(back).kept, back.pages.size());
}

TEST(KeepPages, a_page_of_another_size_at_the_same_place_is_another) {
  Street street;
  const PagePlan plan = street.plan(0.0);
  (void)street.keep(plan);
  for (PageSlot& slot : street.slots) slot.texels *= 2;
  EXPECT_EQ(street.keep(plan).kept, 0u);
}

TEST(KeepPages, a_fit_that_follows_the_view_keeps_nothing_once_the_camera_moves) {
  Street street;
  street.options.plan.fit = Fit::tight;
  (void)street.keep(street.plan(0.0));
  EXPECT_EQ(street.keep(street.plan(0.1)).kept, 0u);
}

/// Brute force: a corner of the box, or a point on a fine grid in it, lands on the page.
bool lands_on(const ShadowMap& map, const Box& box) {
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps * kSteps * kSteps; ++i) {
    const glm::dvec3 share{i % kSteps, i / kSteps % kSteps, i / kSteps / kSteps % kSteps};
    const glm::dvec3 p = box.min + (box.max - box.min) * share / (kSteps - 1.0);
    const glm::dvec4 clip = map.clip_from_world * glm::dvec4(p, 1.0);
    if (clip.w > 0.0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w) return true;
  }
  return false;
}

TEST(KeepPages, a_moved_caster_costs_the_pages_under_it_and_few_more) {
  for (const Light& light :
       {Light{DirectionalLight{{0.3, -1, 0.2}}}, Light{PointLight{{2, 20, -45}, 200.0}}}) {
    Street street;
    street.light = light;
    const PagePlan plan = street.plan(0.0);
    ASSERT_EQ(plan.status, PlanStatus::ok);
    (void)street.keep(plan);
    const Box was = street.boxes[2], is{{3.5, 0, -40}, {5.5, 6, -38}};
    const std::vector<Box> moved{was, is, Box{}};
    const KeptPages result = street.keep(plan, moved);
    std::size_t under = 0;
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
      const ShadowMap map = page_map(plan, plan.pages[i]);
      const bool touched = lands_on(map, was) || lands_on(map, is);
      under += touched;
      EXPECT_LE(touched, street.kept[i].draw) << "page " << i << " is stale";
    }
    EXPECT_GT(under, 0u);
    EXPECT_GE(result.drawn, under);
    // The box's own outline under the light, not that of its bounds: planes hold a little more.
    EXPECT_LE(result.drawn, under + under / 2 + 4);
    EXPECT_LT(result.drawn, plan.pages.size() / 2);
    EXPECT_EQ(street.keep(plan).drawn, 0u) << "moved once";
  }
}

TEST(KeepPages, a_caster_that_moves_up_to_an_edge_of_a_page_is_drawn_into_it) {
  Street street;
  street.light = DirectionalLight{{0, -1, 0}};  // pages along the world's axes, their edges whole numbers
  const PagePlan plan = street.plan(0.0);
  (void)street.keep(plan);
  const std::size_t middle = plan.pages.size() / 2;
  const glm::dmat4 m = page_map(plan, plan.pages[middle]).clip_from_world;
  Box beside{{-1e3, 1, -1e3}, {1e3, 2, 1e3}};
  const int axis = m[0][0] != 0.0 ? 0 : 2;
  const double low = (-1.0 - m[3][0]) / m[axis][0], high = (1.0 - m[3][0]) / m[axis][0];
  beside.max[axis] = std::min(low, high);
  (void)street.keep(plan, {&beside, 1});
  EXPECT_TRUE(street.kept[middle].draw) << "touched";
  beside.max[axis] -= 1e-3 * std::abs(high - low);
  (void)street.keep(plan, {&beside, 1});
  EXPECT_FALSE(street.kept[middle].draw) << "beside it";
}

TEST(KeepPages, a_moving_caster_composes_the_pages_that_a_static_one_would_redraw) {
  Street by_moved, by_moving;
  const PagePlan plan = by_moved.plan(0.0);
  (void)by_moved.keep(plan);
  (void)by_moving.keep(plan);
  const std::vector<Box> moved{by_moved.boxes[2], Box{{3.5, 0, -40}, {5.5, 6, -38}}, Box{}};
  const KeptPages drawn = by_moved.keep(plan, moved);
  ASSERT_GT(drawn.drawn, 0u);
  const auto moving = [&](const PagePlan& of, std::span<const Box> boxes) {
    return keep_pages(of, {}, by_moving.slots, by_moving.table, by_moving.kept, boxes);
  };
  KeptPages composed = moving(plan, moved);
  EXPECT_EQ(composed.composed, drawn.drawn);
  EXPECT_EQ(composed.drawn, 0u);
  EXPECT_EQ(composed.kept + composed.composed, plan.pages.size());
  for (std::size_t i = 0; i < plan.pages.size(); ++i) {
    EXPECT_EQ(by_moving.kept[i].compose, by_moved.kept[i].draw) << i;
    EXPECT_FALSE(by_moving.kept[i].draw) << i;
  }
  EXPECT_EQ(moving(plan, {}).composed, 0u) << "moved once";
  // Out of the plan while it moves: composed when it comes back, once.
  const PagePlan away = by_moved.plan(150.0);
  (void)moving(away, {});
  (void)moving(away, moved);
  const PagePlan back = by_moved.plan(0.0);
  composed = moving(back, {});
  EXPECT_EQ(composed.composed, drawn.drawn);
  EXPECT_EQ(composed.drawn, 0u);
  EXPECT_EQ(moving(back, {}).composed, 0u);
  // A static caster that moves there as well empties them, and nothing of the moving one is left to do.
  const KeptPages both = keep_pages(back, moved, by_moving.slots, by_moving.table, by_moving.kept, moved);
  EXPECT_EQ(both.drawn, drawn.drawn);
  EXPECT_EQ(both.composed, 0u);
}

TEST(KeepPages, a_page_out_of_the_plan_goes_stale_as_well) {
  Street street;
  const PagePlan plan = street.plan(0.0);
  (void)street.keep(plan);
  (void)street.keep(street.plan(60.0));
  const Box everywhere{{-1e3, -1e3, -1e3}, {1e3, 1e3, 1e3}};
  const PagePlan beyond = street.plan(60.0);
  EXPECT_EQ(street.keep(beyond, {&everywhere, 1}).drawn, beyond.pages.size());
  const PagePlan back = street.plan(0.0);
  const KeptPages result = street.keep(back);
  const PagePlan again = street.plan(0.0);
  EXPECT_GT(result.drawn, back.pages.size() / 2) << "what lay in the pool unseen is stale";
  EXPECT_EQ(street.keep(again).drawn, 0u);
}

TEST(KeepPages, the_longest_unused_slots_are_taken_first) {
  Street street;
  const PagePlan first = street.plan(0.0);
  street.slots.assign(first.pages.size() + 8, {});
  (void)street.keep(first);
  PagePlan far = street.plan(100.0);
  ASSERT_LE(far.pages.size(), street.slots.size());
  const KeptPages result = street.keep(far);
  EXPECT_TRUE(result.fits);
  expect_each_page_in_its_slot(street, far);
  // Eight slots were empty: they go first, and hold pages now.
  for (std::size_t slot = first.pages.size(); slot < street.slots.size(); ++slot)
    EXPECT_EQ(street.slots[slot].used, 2u);
}

TEST(KeepPages, a_pool_or_memory_that_is_too_small_is_refused_unchanged) {
  Street street;
  const PagePlan plan = street.plan(0.0);
  std::vector<PageSlot> few(plan.pages.size() - 1);
  EXPECT_FALSE(keep_pages(plan, {}, few, street.table, street.kept).fits);
  EXPECT_EQ(few[0].used, 0u);
  EXPECT_FALSE(keep_pages(plan, {}, street.slots, std::span(street.table).first(100), street.kept).fits);
  EXPECT_FALSE(keep_pages(plan, {}, street.slots, street.table, std::span(street.kept).first(3)).fits);
  EXPECT_FALSE(keep_pages(plan, {}, {}, {}, {}).fits);
  const PagePlan none;
  EXPECT_TRUE(keep_pages(none, {}, street.slots, street.table, street.kept).fits);
}

TEST(KeepPages, casters_from_outside_leave_the_depths_of_the_pages_alone) {
  Street street;
  const PagePlan before = street.plan(0.0);
  (void)street.keep(before);
  // No higher towards the light than what stands there.
  street.boxes.push_back({{-20, 20, -300}, {-19, 24, -299}});
  const PagePlan after = street.plan(0.0);
  EXPECT_EQ(street.keep(after).kept, after.pages.size());
}

TEST(KeepPages, kept_pages_keep_their_slots_where_the_pool_has_no_room_beside_them) {
  Street street;
  const std::size_t pages = std::max(street.plan(0.0).pages.size(), street.plan(2.0).pages.size());
  street.slots.assign(pages, {});
  (void)street.keep(street.plan(0.0));
  const PagePlan moved = street.plan(2.0);
  const KeptPages result = street.keep(moved);
  ASSERT_GT(result.kept, 0u);
  ASSERT_GT(result.drawn, 0u);
  expect_each_page_in_its_slot(street, moved);
}

}  // namespace
}  // namespace gnomon::test
