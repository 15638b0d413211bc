// Soft shadows by distance: penumbras as wide as the light makes them, the same on GPU and CPU.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

/// An occluder over x < 0 at `away` world units from a receiver in the middle of a depth range of 10; 10
/// texels per world unit.
FilterLookup edge(double x, double away) {
  FilterLookup lookup;
  lookup.map_depth = [away](int column, int) { return column < 0 ? 0.8 - away / 10.0 : 1.0; };
  lookup.position = {x, 0.3};
  lookup.depth = 0.8;
  lookup.disc = glm::dmat2(32.5);
  lookup.texels_per_world = glm::dmat2(10.0);
  lookup.ray = {lookup.depth, 1.0, 0.1, 0.0};
  return lookup;
}

double penumbra_texels(double away, const FilterSettings& settings) {
  double begin = 0.0, end = 0.0;
  for (double x = -30.0; x <= 30.0; x += 0.05) {
    double lit = 0.0;
    for (int turn = 0; turn < 16; ++turn) {
      FilterLookup lookup = edge(x, away);
      lookup.rotation = turn * 0.4;
      lit += filters::pcss.reference.visibility({}, lookup, settings) / 16.0;
    }
    if (lit < 0.02) begin = x;
    if (lit < 0.98) end = x;
  }
  return end - begin;
}

TEST(PcssFilter, is_lit_without_blockers_and_dark_under_nothing_but_blockers) {
  const FilterSettings settings = settings_from("pcss:angle_deg=10,radius=32");
  EXPECT_EQ(filters::pcss.reference.visibility({}, edge(60.0, 4.0), settings), 1.0);
  EXPECT_EQ(filters::pcss.reference.visibility({}, edge(-60.0, 4.0), settings), 0.0);
}

TEST(PcssFilter, has_penumbras_as_wide_as_the_lights_angle_times_the_distance) {
  const FilterSettings settings = settings_from("pcss:angle_deg=10,radius=32,samples=64,search_samples=64");
  for (const double away : {2.0, 4.0, 6.0}) {
    const double expected = 2.0 * std::tan(5.0 * std::numbers::pi / 180.0) * away * 10.0;
    // A texel of the bilinear comparisons, and the samples' own spacing of a tenth of the disc.
    EXPECT_NEAR(penumbra_texels(away, settings), expected, 1.0 + 0.15 * expected) << away;
  }
  EXPECT_LT(penumbra_texels(0.1, settings), 3.0);
}

TEST(PcssFilter, widens_by_the_papers_formula_for_local_lights) {
  // The golden rows give the penumbra's full width for a light of that width, by distances from the light.
  int checked = 0;
  for (const nlohmann::json& row : golden_filters().at("pcss")) {
    const double receiver = row.at("dr").get<double>(), blocker = row.at("db").get<double>();
    const double size = row.at("light").get<double>();
    FilterSettings settings = settings_from("pcss:radius=32,samples=64,search_samples=64");
    option_named(settings, "light_radius") = 0.5 * size;
    FilterLookup lookup = edge(0.0, receiver - blocker);
    lookup.map_depth = [&](int column, int) { return column < 0 ? 0.8 - (receiver - blocker) / 10.0 : 1.0; };
    lookup.light_distance = receiver;
    const double half_width = 0.5 * row.at("w_penumbra").get<double>() * 10.0;  // texels
    // Contacts have no penumbra, and kernels end at 32 texels.
    if (half_width == 0.0 || half_width > 32.0) continue;
    ++checked;
    const auto lit_at = [&](double x) {
      lookup.position.x = x;
      return filters::pcss.reference.visibility({}, lookup, settings);
    };
    EXPECT_LT(lit_at(-half_width - 1.6), 0.02) << receiver << " " << blocker;
    EXPECT_GT(lit_at(half_width + 1.6), 0.98) << receiver << " " << blocker;
    if (half_width < 2.0) continue;
    EXPECT_GT(lit_at(-0.6 * half_width), 0.02) << receiver << " " << blocker;
    EXPECT_LT(lit_at(0.6 * half_width), 0.98) << receiver << " " << blocker;
  }
  EXPECT_GE(checked, 2);
}

TEST(PcssFilter, returns_nearly_always_the_same_on_gpu_and_cpu) {
  const TestMap map = random_map(48, 47, 5);
  const std::vector<Question> questions = random_questions(map, 1024, 6, 2);
  const FilterSettings settings = settings_from("pcss:radius=4,angle_deg=8");
  const std::vector<float> gpu = ask_shader(settings, map, questions);
  const std::vector<double> cpu = ask_reference(settings, map, questions);
  int off = 0;
  for (std::size_t i = 0; i < gpu.size(); ++i) off += std::abs(gpu[i] - cpu[i]) > 1e-3 ? 1 : 0;
  EXPECT_LE(off, 5) << "a search sample's texel is found by floor(): one in thousands falls into the next";
}

}  // namespace
}  // namespace gnomon::render
