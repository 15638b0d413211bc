// Does planning and measuring work without the heap?
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "allocations.hpp"
#include "gnomon/study/technique.hpp"
#include "support/property.hpp"
#include "support/random_case.hpp"

namespace gnomon::test {
namespace {

template <typename T>
const T& any() noexcept;
static_assert(noexcept(make_plan(any<View>(), any<Light>(), any<SceneBounds>(), any<PlanOptions>())));
static_assert(noexcept(measure(any<ShadowPlan>(), any<View>(), any<SceneBounds>(), any<MeasureOptions>())));
static_assert(noexcept(measure_point(any<ShadowMap>(), any<Camera>(), any<glm::dvec3>(), any<glm::dvec3>())));
static_assert(noexcept(measure_points(any<ShadowMap>(), any<Camera>(), {}, {}, {})));
static_assert(noexcept(measure_perspectives(any<ShadowMap>(), any<Camera>(), {}, {})));
static_assert(noexcept(choose_technique(any<View>(), any<ShadowPicture>(), any<Light>(), any<SceneBounds>(),
                                        {}, {}, {}, any<CostModel>(), any<PlanOptions>())));
static_assert(noexcept(describe(any<Omission>())));

TEST(Allocation, the_counter_counts) {
  const std::uint64_t before = tool::allocation_count();
  auto* number = new std::vector<int>(5);
  EXPECT_EQ(tool::allocation_count() - before, 2u);
  delete number;
}

TEST(Allocation, planning_culling_measuring_and_describing_allocate_nothing) {
  for_all(1000, [&] {
    const Case c = draw_case();
    std::vector<std::uint32_t> list(c.casters.size());
    const std::uint64_t before = tool::allocation_count();
    const ShadowPlan plan = make_plan(c.camera, DirectionalLight{c.light}, c.bounds(), c.options);
    for (const ShadowMap& map : plan.maps()) (void)cull_casters(map, c.casters, list);
    const AliasingStats stats = measure(plan, c.camera, c.bounds(), {4, 4, 8});
    for (const Omission& omission : plan.omitted()) (void)describe(omission);
    const std::uint64_t allocated = tool::allocation_count() - before;
    require(allocated == 0, "allocations", allocated, "samples", stats.samples);
  });
}

TEST(Allocation, choosing_a_technique_allocates_nothing) {
  constexpr FilterCost kFilter{"hard"};
  CostModel costs;
  costs.filters = {&kFilter, 1};
  int tried = 0;
  for_all(10, [&] {
    const Case c = draw_case();
    std::array<float, 64> mask{}, depths{};
    depths.fill(static_cast<float>(c.camera.far_depth * 0.5));
    for (std::size_t i = 0; i < mask.size(); i += 3) mask[i] = 1.0f;
    Camera picture = c.camera;
    picture.width = picture.height = 8;
    const std::uint64_t before = tool::allocation_count();
    const TechniqueChoice choice =
        choose_technique(c.camera, {picture, mask, depths}, DirectionalLight{c.light}, c.bounds(), {}, {}, {},
                         costs, c.options);
    const std::uint64_t allocated = tool::allocation_count() - before;
    require(allocated == 0, "allocations", allocated, "tried", choice.tried);
    tried += choice.tried;
  });
  EXPECT_GT(tried, 0);
}

TEST(Allocation, pages_are_planned_measured_and_found_without_the_heap) {
  std::vector<std::byte> memory(page_memory(256, 4096));
  std::vector<PageSlot> slots(512);
  std::vector<std::uint32_t> slot_table(page_table_size(512));
  std::vector<KeptPage> kept(256);
  std::size_t opened = 0;
  for (const PagePolicy* policy : all_page_policies()) {
    for_all(20, [&] {
      const Case c = draw_case();
      Random random(7);
      const std::vector<glm::dvec3> points = visible_points(c, random, 8, 16);
      PageOptions options;
      options.policy = policy;
      options.capacity = 256;
      options.share = 0.9;
      const std::uint64_t before = tool::allocation_count();
      const PagePlan plan = plan_pages({.camera = c.camera, .points_world = points},
                                       DirectionalLight{c.light}, c.bounds(), options, memory);
      const PageStats stats = measure(plan, {.camera = c.camera, .points_world = points}, {});
      const KeptPages first = keep_pages(plan, {}, slots, slot_table, kept);
      const KeptPages second = keep_pages(plan, c.casters, slots, slot_table, kept);
      for (const Page& page : plan.pages) opened += page_map(plan, page).width > 0;
      const std::uint64_t after = tool::allocation_count();
      require(after == before, "allocations", after - before, "samples", stats.m.samples);
      require(first.fits && second.fits, "the pool is too small");
    });
  }
  EXPECT_GT(opened, 100u);
}

TEST(Allocation, many_lights_are_planned_without_the_heap) {
  int mapped = 0;
  for_all(50, [&] {
    const Case c = draw_case();
    Random random(7);
    std::vector<glm::dvec3> points = visible_points(c, random, 8, 16);
    std::vector<LightRequest> lights{{DirectionalLight{c.light}}};
    for (const glm::dvec3& point : points) lights.push_back({PointLight{point, c.camera.far_depth * unit()}});
    std::vector<LightState> states(lights.size());
    LightHistory history{states, 0, {}};
    std::vector<std::byte> memory(light_memory(lights.size(), points.size()));
    const std::uint64_t before = tool::allocation_count();
    for (int frame = 0; frame < 2; ++frame) {
      const LightPlan plan =
          plan_lights({.camera = c.camera, .points_world = points}, lights, c.bounds(), {}, memory, &history);
      for (const LightMaps& maps : plan.lights) (void)describe(maps, {});
      mapped += plan.mapped;
    }
    const std::uint64_t after = tool::allocation_count();
    require(after == before, "allocations", after - before);
  });
  EXPECT_GT(mapped, 100);
}

}  // namespace
}  // namespace gnomon::test
