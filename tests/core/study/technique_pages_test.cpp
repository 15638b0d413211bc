// Are pages chosen where they are better than maps, and is what they are said to cost and to err true?
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "gnomon/study/technique.hpp"
#include "plain.hpp"

namespace gnomon::test {
namespace {

/// The same plain with pages among the techniques: pools of two sizes, which cost next to nothing to draw.
struct PlainWithPages : Plain {
  std::vector<PageOptions> pages{2};
  std::vector<glm::dvec3> points;
  std::vector<std::uint8_t> feedback;
  std::vector<std::byte> memory;
  std::vector<FilterCost> page_filters{{"hard", 0.0, 0.0, 3.0, 4.0, 0.1}};

  PlainWithPages() {
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const auto width = static_cast<std::size_t>(picture.width);
      if (depths[i] > 0.0f)
        points.push_back(point_at(picture, (static_cast<double>(i % width) + 0.5) / picture.width * 2.0 - 1.0,
                                  1.0 - (static_cast<double>(i / width) + 0.5) / picture.height * 2.0,
                                  static_cast<double>(depths[i])));
    }
    for (PageOptions& options : pages) {
      options.page_texels = 64;
      options.target_m = 0.25;
      options.fallback = true;
    }
    pages[0].capacity = 40;
    pages[1].capacity = 400;
    memory.resize(page_memory(400, points.size()));
    costs.pages.drawing = {0.1, 0.001, 0.1, 0.01, 0.4, 0.0};
    budget.alike = 0.0;
  }
  [[nodiscard]] TechniqueChoice choose_with_pages() {
    costs.pages.filters = page_filters;
    among.pages = {pages, points, feedback, memory};
    return choose();
  }
};

TEST(Technique, pages_are_taken_where_they_err_less_for_the_cost) {
  PlainWithPages plain;
  for (const int taken : {0, 1}) {
    plain.budget.texels = taken == 0 ? 40 * 66 * 66 : 0;
    plain.budget.target_error = 0.0;
    const TechniqueChoice choice = plain.choose_with_pages();
    ASSERT_EQ(choice.status, PlanStatus::ok);
    EXPECT_EQ(choice.tried, 2 + 3 * 4 * 5 * 2);
    ASSERT_EQ(choice.chosen.pages, taken);
    ASSERT_EQ(choice.pages.status, PlanStatus::ok);
    EXPECT_EQ(choice.plan.map_count, 0);
    const double share = expected_error(choice.pages, plain.shadow()).share();
    ASSERT_GT(share, 1e-4);
    EXPECT_EQ(choice.chosen.error, 0.1 * share) << "with the ratio of pages";
    const PlanWork work = planned_work(choice.pages, {plain.casters, plain.receivers}, plain.work);
    EXPECT_EQ(choice.chosen.milliseconds,
              predicted_ms(plain.costs.pages.drawing, plain.page_filters[0], work, 960.0 * 640.0 / 1e6));
    EXPECT_EQ(choice.chosen.texels, std::llround(work.megatexels * 1e6));
    EXPECT_EQ(choice.chosen.map_size, choice.pages.slot_texels());
  }
  // Dear pages are left, and their plan is none that is given out.
  plain.costs.pages.drawing.per_map = 1e6;
  plain.budget.milliseconds = 20.0;
  const TechniqueChoice maps = plain.choose_with_pages();
  ASSERT_EQ(maps.status, PlanStatus::ok);
  EXPECT_EQ(maps.chosen.pages, -1);
  EXPECT_GT(maps.plan.map_count, 0);
  EXPECT_TRUE(maps.pages.pages.empty());
  const TechniqueChoice without = static_cast<const Plain&>(plain).choose();
  EXPECT_EQ(maps.chosen.error, without.chosen.error);
}

TEST(Technique, pages_read_the_feedback_on_their_points) {
  PlainWithPages plain;
  plain.pages.resize(1);
  plain.pages[0].policy = &page_policies::edges;
  plain.pages[0].capacity = 400;
  plain.pages[0].target_m = 2.0;
  const int one[] = {1}, small[] = {256};  // maps that err more than any page
  plain.among.cascades = one;
  plain.among.map_sizes = small;
  plain.feedback.assign(plain.points.size(), 0);
  const std::size_t nowhere = plain.choose_with_pages().pages.pages.size();
  plain.feedback.assign(plain.points.size(), kShadowEdge);
  const TechniqueChoice everywhere = plain.choose_with_pages();
  ASSERT_GE(everywhere.chosen.pages, 0);
  EXPECT_GT(everywhere.pages.pages.size(), 2 * nowhere);
}

TEST(Technique, work_of_pages_is_what_culling_leaves_for_each) {
  PlainWithPages plain;
  const View view{.camera = plain.camera, .points_world = plain.points};
  const PagePlan plan =
      plan_pages(view, plain.light, {plain.casters, plain.receivers}, plain.pages[0], plain.memory);
  ASSERT_EQ(plan.status, PlanStatus::ok);
  std::size_t draws = 0;
  std::vector<std::uint32_t> kept(plain.casters.size());
  for (const Page& page : plan.pages) draws += cull_casters(page_map(plan, page), plain.casters, kept);
  ASSERT_GT(draws, 0u);
  const PlanWork work = planned_work(plan, {plain.casters, plain.receivers}, plain.work);
  EXPECT_EQ(work.maps, static_cast<double>(plan.pages.size()));
  EXPECT_NEAR(work.kilodraws, static_cast<double>(draws) / 1e3, 1e-12);
  EXPECT_NEAR(work.megatriangles, static_cast<double>(draws) / 1e3, 1e-12);
}

TEST(Technique, broken_pages_are_named) {
  PlainWithPages plain;
  const auto field = [&] {
    const TechniqueChoice choice = plain.choose_with_pages();
    EXPECT_EQ(choice.status, PlanStatus::invalid_input);
    return choice.invalid_field;
  };
  const PlainWithPages whole = plain;
  plain.page_filters.clear();
  EXPECT_EQ(field(), "cost_model.pages.filters");
  plain.page_filters = whole.page_filters;
  plain.page_filters[0].error_ratio = 0.0;
  EXPECT_EQ(field(), "cost_model.pages.filters");
  plain.page_filters = whole.page_filters;
  plain.costs.pages.drawing.per_map = -1.0;
  EXPECT_EQ(field(), "cost_model");
  plain.costs.pages.drawing = whole.costs.pages.drawing;
  plain.memory.resize(64);
  EXPECT_EQ(field(), "memory");
  plain.memory = whole.memory;
  plain.pages[1].capacity = 0;
  EXPECT_EQ(field(), "pages.capacity");
}

}  // namespace
}  // namespace gnomon::test
