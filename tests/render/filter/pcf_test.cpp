// Percentage-closer filtering: kernels of every width, the same on GPU and CPU.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "filter_harness.hpp"

namespace gnomon::render {
namespace {

/// Sums of at most 100 terms with weights up to 1, then one division, in float.
constexpr double kSumRounding = 100.0 * 6e-8;
constexpr double kWeights = 1e-12;  ///< weights added in double make up 1 to this
constexpr double kRadii[] = {0.0, 1.0, 2.0, 3.0, 4.0, 1.25};

FilterSettings box_of(double radius) {
  FilterSettings settings = default_settings(filters::pcf);
  settings.radius = radius;
  return settings;
}
double see(FilterLookup lookup, double radius) {
  lookup.box = glm::dvec2(radius + 0.5);
  return filters::pcf.reference.visibility({}, lookup, box_of(radius));
}

/// Dark left of column 8, lit from it on.
FilterLookup edge_at_8(double x, const FilterSettings& settings) {
  FilterLookup lookup;
  lookup.map_depth = [](int column, int) { return column < 8 ? 0.25 : 0.75; };
  lookup.box = glm::dvec2(settings.radius + 0.5);
  lookup.disc = glm::dmat2(settings.radius + 0.5);
  lookup.position = {x, 5.2};
  lookup.depth = 0.5;
  return lookup;
}

TEST(PcfFilter, keeps_a_slanted_plane_lit_with_the_hardware_s_2_x_2_too) {
  for (const double radius : kRadii) {
    for (const glm::dvec2& gradient : {glm::dvec2(0.0), glm::dvec2(1e-3, 0.0), glm::dvec2(-2e-3, 5e-3)}) {
      for (const double x : {8.0, 8.3, 8.5, 8.97}) {
        FilterLookup lookup;
        lookup.position = {x, 5.2};
        lookup.depth = 0.5;
        lookup.depth_gradient = gradient;
        lookup.map_depth = [&](int column, int row) {
          constexpr double kRounding = 1e-9;
          return 0.5 + glm::dot(gradient, glm::dvec2(column + 0.5, row + 0.5) - lookup.position) + kRounding;
        };
        EXPECT_NEAR(see(lookup, radius), 1.0, kWeights) << radius << " " << x;
      }
    }
  }
}

TEST(PcfFilter, is_all_or_nothing_where_all_texels_agree) {
  for (const double radius : kRadii) {
    EXPECT_NEAR(see(edge_at_8(30.3, box_of(radius)), radius), 1.0, kWeights);
    EXPECT_EQ(see(edge_at_8(-20.7, box_of(radius)), radius), 0.0);
  }
}

TEST(PcfFilter, ramps_linearly_over_the_kernels_width_at_an_edge) {
  for (const double radius : kRadii) {
    const double width = 2.0 * radius + 1.0;
    for (double x = 8.0 - width / 2.0; x <= 8.0 + width / 2.0; x += 0.17) {
      const double expected = 0.5 + (x - 8.0) / width;
      EXPECT_NEAR(see(edge_at_8(x, box_of(radius)), radius), expected, kWeights) << x << " " << width;
    }
  }
}

TEST(PcfFilter, does_not_shadow_a_plane_with_itself_however_wide_the_kernel) {
  FilterLookup lookup;
  const glm::dvec2 gradient{0.011, -0.007};
  lookup.map_depth = [&](int x, int y) {
    return 0.3 + gradient.x * (x + 0.5) + gradient.y * (y + 0.5) + 1e-12;
  };
  lookup.depth_gradient = gradient;
  for (const double radius : {kRadii[1], kRadii[4]}) {
    for (double x = 20.0; x < 21.0; x += 0.13) {
      lookup.position = {x, 20.4};
      lookup.depth = 0.3 + gradient.x * x + gradient.y * 20.4;
      EXPECT_NEAR(see(lookup, radius), 1.0, kWeights);
    }
  }
}

TEST(PcfFilter, is_lit_where_the_receivers_plane_goes_on_behind_the_far_plane) {
  FilterLookup lookup;
  lookup.map_depth = [](int, int) { return 1.0; };
  lookup.position = {8.3, 8.4};
  lookup.depth = 0.99;
  lookup.depth_gradient = {0.02, 0.01};
  for (const double radius : kRadii) EXPECT_NEAR(see(lookup, radius), 1.0, kWeights);
}

TEST(PcfFilter, returns_the_same_on_gpu_and_cpu_for_every_width) {
  for (const auto& [width, height] : {std::pair{64, 64}, std::pair{48, 83}}) {
    const TestMap map = random_map(width, height, 3);
    const std::vector<Question> questions = random_questions(map, 2048, 4);
    for (const double radius : kRadii) {
      const std::vector<float> gpu = ask_shader(box_of(radius), map, questions);
      const std::vector<double> cpu = ask_reference(box_of(radius), map, questions);
      // The hardware's bilinear weights have at least 8 bits.
      const double bound = radius == 0.0 ? 2.0 / 256.0 : kSumRounding;
      double between = 0.0;
      for (std::size_t i = 0; i < gpu.size(); ++i) {
        ASSERT_NEAR(gpu[i], cpu[i], bound)
            << i << " radius " << radius << ": " << questions[i].position.x << " " << questions[i].position.y;
        between += cpu[i] > 0.0 && cpu[i] < 1.0 ? 1.0 : 0.0;
      }
      EXPECT_GT(between, 500.0);
    }
  }
}

TEST(PcfFilter, reads_no_further_than_it_says) {
  for (const double radius : kRadii) {
    PlanOptions options;
    set_margin(box_of(radius), options);
    const double reach = options.filter.texels;
    FilterLookup lookup = edge_at_8(0.0, box_of(radius));
    lookup.map_depth = [&](int x, int) {
      EXPECT_LE(std::abs(x + 0.5 - lookup.position.x), reach);
      return 1.0;
    };
    for (double x = 30.0; x < 31.0; x += 0.09) {
      lookup.position = {x, 10.0};
      EXPECT_NEAR(see(lookup, radius), 1.0, kWeights);
    }
  }
}

TEST(PcfFilter, returns_the_same_on_gpu_and_cpu_for_discs_of_samples) {
  const TestMap map = random_map(48, 83, 5);
  const std::vector<Question> questions = random_questions(map, 2048, 6);
  for (const char* text : {"pcf:pattern=1,radius=3", "pcf:pattern=2,radius=4,samples=32",
                           "pcf:pattern=1,radius=2,samples=8,rotate=0"}) {
    const FilterSettings settings = settings_from(text);
    const std::vector<float> gpu = ask_shader(settings, map, questions);
    const std::vector<double> cpu = ask_reference(settings, map, questions);
    // A sample's place is rounded to about 1e-5 texels: so much a bilinear weight may be off, and one
    // comparison in a hundred thousand falls out the other way.
    const double bound = 1e-4;
    int off = 0;
    double between = 0.0;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
      off += std::abs(gpu[i] - cpu[i]) > bound ? 1 : 0;
      between += cpu[i] > 0.0 && cpu[i] < 1.0 ? 1.0 : 0.0;
    }
    EXPECT_LE(off, 2) << text;
    EXPECT_GT(between, 500.0) << text;
  }
}

TEST(PcfFilter, covers_the_pixel_and_is_plain_where_the_pixel_is_narrower) {
  const FilterSettings settings = settings_from("pcf:footprint=1");
  const auto lit = [&](double x, const glm::dvec2& pixel) {
    FilterLookup lookup = edge_at_8(x, settings);
    lookup.pixel = pixel;
    return settings.filter->reference.visibility({}, lookup, settings);
  };
  for (double x = 1.0; x <= 15.0; x += 0.17) {
    EXPECT_EQ(lit(x, {1.5, 0.7}), see(edge_at_8(x, settings), 1.0)) << x;
    // A ramp as wide as the pixel, whatever the pixel is along the edge.
    EXPECT_NEAR(lit(x, {6.0, 0.2}), std::clamp(0.5 + (x - 8.0) / 12.0, 0.0, 1.0), kWeights) << x;
    EXPECT_NEAR(lit(x, {6.0, 9.0}), std::clamp(0.5 + (x - 8.0) / 12.0, 0.0, 1.0), kWeights) << x;
  }
}

TEST(PcfFilter, returns_the_same_on_gpu_and_cpu_over_pixels_of_every_width) {
  const TestMap map = random_map(48, 83, 9);
  std::vector<Question> questions = random_questions(map, 2048, 10);
  for (std::size_t i = 0; i < questions.size(); ++i)
    questions[i].pixel = {static_cast<float>(i % 7) * 0.75f, static_cast<float>(i % 5) * 1.25f};
  for (const char* text : {"pcf:footprint=1", "pcf:footprint=1,radius=0", "pcf_tent:footprint=1",
                           "pcf:footprint=1,pattern=1,radius=2"}) {
    const FilterSettings settings = settings_from(text);
    const std::vector<float> gpu = ask_shader(settings, map, questions);
    const std::vector<double> cpu = ask_reference(settings, map, questions);
    // The hardware's bilinear weights where the kernel stays 2 x 2, rounded places of a disc's samples.
    const double bound = settings.radius == 0.0 ? 2.0 / 256.0 : 1e-4;
    int off = 0;
    for (std::size_t i = 0; i < gpu.size(); ++i) off += std::abs(gpu[i] - cpu[i]) > bound ? 1 : 0;
    EXPECT_LE(off, 2) << text;
  }
}

TEST(PcfFilter, stretches_a_disc_to_the_pixel) {
  // Over an edge, the samples' spread along x is that of a disc with the box's variance.
  const FilterSettings settings = settings_from("pcf:footprint=1,pattern=1,radius=1,samples=64,rotate=0");
  constexpr double kPixel = 6.0, kRadius = kPixel / 0.86602540378443865;
  double low = 8.0, high = 8.0;
  for (double x = 0.0; x <= 16.0; x += 0.05) {
    FilterLookup lookup = edge_at_8(x, settings);
    lookup.pixel = {kPixel, 0.0};
    const double lit = settings.filter->reference.visibility({}, lookup, settings);
    if (lit < 0.1) low = x;
    if (lit < 0.9) high = x;
  }
  // A disc's chord: a tenth of it lies beyond 0.687 of its radius.
  EXPECT_NEAR(high - low, 2.0 * 0.687 * kRadius, 0.5);
}

TEST(PcfFilter, spreads_its_discs_evenly) {
  // Over an edge through the middle, half of the samples are lit at every angle, but for a sample or two.
  for (const char* text : {"pcf:pattern=1,radius=6,samples=32", "pcf:pattern=2,radius=6,samples=32"}) {
    const FilterSettings settings = settings_from(text);
    double mean = 0.0;
    for (double angle = 0.0; angle < 6.28; angle += 0.1) {
      FilterLookup lookup = edge_at_8(8.0, settings);
      lookup.rotation = angle;
      const double lit = settings.filter->reference.visibility({}, lookup, settings);
      EXPECT_NEAR(lit, 0.5, 4.0 / 32.0) << text << " " << angle;
      mean += lit / 63.0;
    }
    EXPECT_NEAR(mean, 0.5, 0.5 / 32.0) << text;
  }
}

}  // namespace
}  // namespace gnomon::render
