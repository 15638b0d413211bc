// Percentage-closer filtering with a tent: known weights, edges without steps, the same on GPU and CPU.
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>

#include "filter_harness.hpp"

namespace gnomon::render {
namespace {

constexpr double kRadii[] = {0.0, 1.0, 2.0, 3.0, 1.25};
constexpr double kRounding = 1e-12;

FilterSettings tent_of(double radius) {
  FilterSettings settings = default_settings(filters::pcf_tent);
  settings.radius = radius;
  return settings;
}

/// Dark left of column `edge`, lit from it on.
double lit_at(double x, double radius, int edge = 8) {
  FilterLookup lookup;
  lookup.map_depth = [edge](int column, int) { return column < edge ? 0.25 : 0.75; };
  lookup.box = glm::dvec2(radius + 0.5);
  lookup.position = {x, 5.2};
  lookup.depth = 0.5;
  return filters::pcf_tent.reference.visibility({}, lookup, tent_of(radius));
}

TEST(PcfTentFilter, has_the_weights_of_bilinear_comparisons_at_odd_numbers_of_places) {
  // 1 2 1 and 1 2 3 2 1 comparisons, each bilinear: a fraction s between two texels' centres.
  const std::array<double, 4> three = {1.0 - 0.3, 2.0 - 0.3, 1.0 + 0.3, 0.3};
  const std::array<double, 6> five = {1.0 - 0.3, 2.0 - 0.3, 3.0 - 0.3, 2.0 + 0.3, 1.0 + 0.3, 0.3};
  double dark = 0.0;
  for (int i = 0; i < 4; ++i) {
    dark += three[static_cast<std::size_t>(i)] / 4.0;
    EXPECT_NEAR(1.0 - lit_at(20.5 + 0.3, 1.0, 20 - 1 + i + 1), dark, kRounding) << i;
  }
  dark = 0.0;
  for (int i = 0; i < 6; ++i) {
    dark += five[static_cast<std::size_t>(i)] / 9.0;
    EXPECT_NEAR(1.0 - lit_at(20.5 + 0.3, 2.0, 20 - 2 + i + 1), dark, kRounding) << i;
  }
}

TEST(PcfTentFilter, is_lit_or_dark_where_all_texels_agree_and_half_lit_on_an_edge) {
  for (const double radius : kRadii) {
    EXPECT_NEAR(lit_at(30.3, radius), 1.0, kRounding);
    EXPECT_EQ(lit_at(-20.7, radius), 0.0);
    EXPECT_NEAR(lit_at(8.0, radius), 0.5, kRounding);
  }
}

TEST(PcfTentFilter, has_no_steps_over_an_edge_and_softer_ends_than_a_box) {
  for (const double radius : {1.0, 2.0, 3.0}) {
    const double base = radius + 1.0;
    double before = 0.0, steepest = 0.0, at_the_end = 0.0;
    constexpr double kStep = 1.0 / 64.0;
    for (double x = 8.0 - base - 1.0; x <= 8.0 + base + 1.0; x += kStep) {
      const double now = lit_at(x, radius), slope = (now - before) / kStep;
      EXPECT_GE(slope, -kRounding) << x;
      steepest = std::max(steepest, slope);
      if (x > 8.0 + base - 1.0) at_the_end = std::max(at_the_end, slope);
      before = now;
    }
    EXPECT_NEAR(steepest, 1.0 / base, 1e-9) << "the tent's height";
    EXPECT_LE(at_the_end, 1.0 / (base * base) + 1e-9) << "a box of the same base would have 1 / (2 base)";
  }
}

TEST(PcfTentFilter, does_not_shadow_a_plane_with_itself) {
  const glm::dvec2 gradient{0.011, -0.007};
  for (const double radius : kRadii) {
    for (double x = 20.0; x < 21.0; x += 0.13) {
      FilterLookup lookup;
      lookup.map_depth = [&](int i, int j) {
        return 0.3 + gradient.x * (i + 0.5) + gradient.y * (j + 0.5) + 1e-12;
      };
      lookup.box = glm::dvec2(radius + 0.5);
      lookup.depth_gradient = gradient;
      lookup.position = {x, 20.4};
      lookup.depth = 0.3 + gradient.x * x + gradient.y * 20.4;
      EXPECT_NEAR(filters::pcf_tent.reference.visibility({}, lookup, tent_of(radius)), 1.0, kRounding);
    }
  }
}

TEST(PcfTentFilter, has_the_variance_of_a_disc_in_world_units) {
  // The second moment of the ramp over an edge is that of the kernel along one axis: r^2 / 4 for a disc.
  const FilterSettings settings = settings_from("pcf_tent:radius=5,unit=world");
  constexpr double kRadiusTexels = 5.0, kBoxOfDisc = 0.86602540378443865, kStep = 1.0 / 16.0;
  FilterLookup lookup;
  lookup.map_depth = [](int column, int) { return column < 50 ? 0.25 : 0.75; };
  lookup.box = glm::dvec2(kBoxOfDisc * kRadiusTexels);
  lookup.depth = 0.5;
  double before = 0.0, variance = 0.0;
  for (double x = 35.0; x <= 65.0; x += kStep) {
    lookup.position = {x, 5.2};
    const double now = settings.filter->reference.visibility({}, lookup, settings);
    variance += (now - before) * (x - 0.5 * kStep - 50.0) * (x - 0.5 * kStep - 50.0);
    before = now;
  }
  constexpr double kSampled = 0.1;  // the tent's heights at texels' centres in place of the tent
  EXPECT_NEAR(variance, kRadiusTexels * kRadiusTexels / 4.0, kSampled);
}

TEST(PcfTentFilter, returns_the_same_on_gpu_and_cpu_for_every_width) {
  const TestMap map = random_map(48, 83, 3);
  const std::vector<Question> questions = random_questions(map, 2048, 4);
  for (const double radius : kRadii) {
    const std::vector<float> gpu = ask_shader(tent_of(radius), map, questions);
    const std::vector<double> cpu = ask_reference(tent_of(radius), map, questions);
    double between = 0.0;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
      ASSERT_NEAR(gpu[i], cpu[i], 1e-5) << i << " radius " << radius;
      between += cpu[i] > 0.0 && cpu[i] < 1.0 ? 1.0 : 0.0;
    }
    EXPECT_GT(between, 500.0);
  }
}

TEST(PcfTentFilter, reads_no_further_than_it_says) {
  for (const double radius : kRadii) {
    PlanOptions options;
    set_margin(tent_of(radius), options);
    FilterLookup lookup;
    lookup.box = glm::dvec2(radius + 0.5);
    lookup.depth = 0.5;
    lookup.map_depth = [&](int x, int) {
      EXPECT_LE(std::abs(x + 0.5 - lookup.position.x), options.filter.texels);
      return 1.0;
    };
    for (double x = 30.0; x < 31.0; x += 0.09) {
      lookup.position = {x, 10.0};
      EXPECT_NEAR(filters::pcf_tent.reference.visibility({}, lookup, tent_of(radius)), 1.0, kRounding);
    }
  }
}

}  // namespace
}  // namespace gnomon::render
