// Do calls of a frame on several threads give the bits that they give alone? The thread sanitizer runs this,
// too.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "gnomon/gnomon.hpp"
#include "support/seeded_input.hpp"

namespace gnomon::test {
namespace {

constexpr int kThreads = 8;

/// What one call gave, as far as threads could mix it up.
struct Given {
  std::vector<double> numbers;
  std::size_t maps = 0, pages = 0, light_maps = 0;
  bool operator==(const Given&) const = default;
};

void add(const ShadowPlan& plan, Given& given) {
  given.maps += static_cast<std::size_t>(plan.map_count);
  for (const ShadowMap& map : plan.maps()) {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 4; ++row) given.numbers.push_back(map.clip_from_world[column][row]);
    given.numbers.insert(given.numbers.end(), {map.m_max, map.m_s_max, map.texel_world.x, map.kappa});
  }
}

void add(const AliasingStats& error, Given& given) {
  given.numbers.insert(given.numbers.end(),
                       {error.p50, error.p95, error.max, static_cast<double>(error.samples)});
}

constexpr int kPages = 64;
constexpr std::size_t kSamples = 2000;  // room for places in the receivers' boxes

/// Everything that a frame may call, on one input that all threads share. `memory`: of this thread.
Given everything(const SeededInput& input, std::vector<std::byte>& memory) {
  Given given;
  const ShadowPlan plan = input.plan();
  add(plan, given);
  add(measure(plan, input.camera, input.bounds(), {8, 8, 8}), given);
  for (const ShadowMap& map : plan.maps()) {
    std::vector<std::uint32_t> list(input.casters.size());
    given.numbers.push_back(static_cast<double>(cull_casters(map, input.casters, list)));
  }
  memory.resize(std::max(page_memory(kPages, kSamples), light_memory(2, kSamples)));
  PageOptions page_options;
  page_options.plan = input.options;
  page_options.capacity = kPages;
  const PagePlan pages = plan_pages(input.camera, input.light, input.bounds(), page_options, memory);
  std::vector<PageSlot> slots(kPages);
  std::vector<KeptPage> kept(kPages);
  std::vector<std::uint32_t> table(page_table_size(kPages));
  given.pages = pages.pages.size();
  if (pages.status == PlanStatus::ok) {
    for (const Page& page : pages.pages)
      given.numbers.insert(given.numbers.end(), {double(page.level), double(page.column), double(page.row)});
    add(measure(pages, input.camera, input.bounds(), {4, 4, 4}).m, given);
    given.numbers.push_back(static_cast<double>(keep_pages(pages, {}, slots, table, kept).drawn));
  }
  const std::array<LightRequest, 2> requests{{{input.light}, {DirectionalLight{{0.3, -1.0, 0.2}}}}};
  LightOptions light_options;
  light_options.plan = input.options;
  const LightPlan lights = plan_lights(input.camera, requests, input.bounds(), light_options, memory);
  given.numbers.push_back(static_cast<double>(lights.texels));
  given.light_maps = static_cast<std::size_t>(lights.mapped);
  for (const LightMaps& maps : lights.lights)
    given.numbers.insert(given.numbers.end(), {double(maps.size), double(maps.map_count), maps.m});
  return given;
}

TEST(PlanThreads, plans_of_eight_threads_have_the_bits_of_one) {
  constexpr int kInputs = 200;
  std::vector<std::unique_ptr<SeededInput>> inputs;
  std::vector<Given> alone;
  for (int i = 0; i < kInputs; ++i) {
    inputs.push_back(std::make_unique<SeededInput>());
    seed_input(static_cast<std::uint64_t>(i), Extremes::ordinary, *inputs.back());
    choose_picture(i, *inputs.back());
  }
  // The threads first: what is set up on a first call is set up there.
  std::array<std::vector<Given>, kThreads> found;
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      std::vector<std::byte> memory;
      for (const auto& input : inputs) found[t].push_back(everything(*input, memory));
    });
  }
  for (std::thread& thread : threads) thread.join();
  Given sum;
  std::vector<std::byte> memory;
  for (const auto& input : inputs) {
    alone.push_back(everything(*input, memory));
    sum.maps += alone.back().maps;
    sum.pages += alone.back().pages;
    sum.light_maps += alone.back().light_maps;
  }
  EXPECT_GT(sum.maps, 200u);
  EXPECT_GT(sum.pages, 500u);
  EXPECT_GT(sum.light_maps, 50u);
  for (const std::vector<Given>& of_thread : found) EXPECT_EQ(of_thread, alone);
}

}  // namespace
}  // namespace gnomon::test
