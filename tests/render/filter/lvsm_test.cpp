// Layered variance shadow maps against the golden rows and sums worked out by hand.
#include "filter/lvsm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "filter/variance.hpp"
#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

constexpr double kGolden = 1e-9;  ///< golden rows are computed in double

/// Chebyshev's bound of one layer over the kernel.
double bound_in(const DepthBand& layer, const GoldenKernel& kernel, double depth) {
  double mean = 0.0, second = 0.0;
  for (std::size_t i = 0; i < kernel.depth.size(); ++i) {
    const double warped = layer.warped(kernel.depth[i]);
    mean += kernel.weight[i] * warped;
    second += kernel.weight[i] * warped * warped;
  }
  return chebyshev(mean, std::max(second - mean * mean, 0.0), layer.warped(depth));
}

GoldenKernel five() {
  const nlohmann::json& kernel = golden_filters().at("kernels").at("five");
  return {"five", kernel.at("z").get<std::vector<double>>(), kernel.at("w").get<std::vector<double>>()};
}

/// Layer i of `count` even ones.
DepthBand even_layer(int i, int count, double overlap) {
  FilterSettings settings = default_settings(filters::lvsm);
  option_named(settings, "layers") = count;
  option_named(settings, "overlap") = overlap;
  return layer_of(i, settings);
}

double see(std::string_view text, const GoldenKernel& kernel, double depth) {
  const FilterSettings settings = settings_from(text);
  FilterLookup lookup;
  lookup.depth = depth;
  return filters::lvsm.reference.visibility(mean_over(kernel, settings), lookup, settings);
}

TEST(LvsmFilter, agrees_with_the_golden_rows_of_single_layers) {
  EXPECT_GT(golden_filters().at("lvsm").size(), 8u);
  for (const nlohmann::json& row : golden_filters().at("lvsm")) {
    const auto edges = row.at("edges").get<std::vector<double>>();
    const auto i = row.at("layer").get<std::size_t>();
    const double depth = row.at("d").get<double>();
    EXPECT_NEAR(bound_in({edges[i], edges[i + 1]}, five(), depth), row.at("lit").get<double>(), kGolden)
        << i << " " << depth;
  }
}

TEST(LvsmFilter, is_a_bound_in_every_layer_so_that_the_least_of_them_is_one) {
  EXPECT_GT(golden_rows().size(), 8u);
  for (const GoldenRow& row : golden_rows()) {
    for (int count = 1; count <= 8; ++count) {
      for (const double overlap : {0.0, 0.25, 1.0}) {
        for (int i = 0; i < count; ++i) {
          EXPECT_GE(bound_in(even_layer(i, count, overlap), row.kernel, row.depth),
                    row.answer("pcf") - kGolden)
              << row.kernel.name << " " << row.depth << " " << i << "/" << count;
        }
      }
    }
  }
}

TEST(LvsmFilter, covers_all_depths_with_layers_that_overlap_as_requested) {
  EXPECT_EQ(even_layer(0, 1, 0.5).begin, 0.0);
  EXPECT_EQ(even_layer(0, 1, 0.5).end, 1.0);
  for (int i = 1; i < 4; ++i) {
    EXPECT_NEAR(even_layer(i - 1, 4, 0.25).end - even_layer(i, 4, 0.25).begin, 2.0 * 0.25 / 4, 1e-15);
    EXPECT_LT(even_layer(i, 4, 0.0).begin, even_layer(i, 4, 0.0).end);
  }
  EXPECT_EQ(even_layer(3, 4, 1.0).end, 1.0);
}

TEST(LvsmFilter, says_something_just_behind_a_layers_beginning_where_layers_overlap) {
  // The paper's rule without overlap answers 1 at the beginning of the last of four layers; 0.1 is right.
  EXPECT_NEAR(bound_in({0.75, 1.0}, five(), 0.75), 1.0, kGolden);
  EXPECT_LT(see("lvsm:bleed=0,slope=0,format=fp32,overlap=0.25", five(), 0.75), 0.5);
}

TEST(LvsmFilter, does_not_shadow_a_plane_with_itself_at_a_layers_end) {
  // The kernel's depths rise by 0.01 a texel; all of four layers' ends are crossed.
  const FilterSettings settings = settings_from("lvsm:format=fp32,radius=3");
  for (double middle = 0.05; middle < 0.95; middle += 0.003) {
    GoldenKernel kernel;
    for (int i = -3; i <= 3; ++i) {
      kernel.depth.push_back(middle + 0.01 * i);
      kernel.weight.push_back(1.0 / 7.0);
    }
    FilterLookup lookup;
    lookup.depth = middle;
    lookup.depth_gradient = {0.01, 0.0};
    lookup.box = glm::dvec2(3.5);
    EXPECT_GE(filters::lvsm.reference.visibility(mean_over(kernel, settings), lookup, settings), 0.999)
        << middle;
  }
}

TEST(LvsmFilter, is_vsm_with_one_layer) {
  const FilterSettings vsm = settings_from("vsm:bleed=0.1,format=fp32");
  for (const GoldenRow& row : golden_rows()) {
    FilterLookup lookup;
    lookup.depth = row.depth;
    EXPECT_NEAR(see("lvsm:layers=1,bleed=0.1,format=fp32", row.kernel, row.depth),
                filters::vsm.reference.visibility(mean_over(row.kernel, vsm), lookup, vsm), 1e-12);
  }
}

TEST(LvsmFilter, bleeds_less_with_every_doubling_of_the_layers) {
  // Occluders at 0.2 and 0.6, the receiver close behind the second: the truth is 0.
  const GoldenKernel kernel{"", {0.2, 0.6}, {0.5, 0.5}};
  double before = 1.0;
  for (const char* text :
       {"lvsm:layers=1,bleed=0,overlap=0,format=fp32", "lvsm:layers=2,bleed=0,overlap=0,format=fp32",
        "lvsm:layers=8,bleed=0,overlap=0,format=fp32"}) {
    const double lit = see(text, kernel, 0.7);
    EXPECT_LT(lit, before) << text;
    before = lit;
  }
}

TEST(LvsmFilter, lets_nothing_through_where_the_occluders_are_in_layers_in_front) {
  const GoldenKernel kernel{"", {0.1, 0.3}, {0.5, 0.5}};
  EXPECT_GT(see("lvsm:layers=1,bleed=0,format=fp32", kernel, 0.45), 0.1);
  EXPECT_LT(see("lvsm:layers=8,bleed=0,format=fp32", kernel, 0.45), 1e-4);
}

TEST(LayerPlacement, puts_ends_in_the_middle_of_gaps_between_depths) {
  std::vector<float> depths;
  for (int i = 0; i < 1000; ++i) {
    const float within = 0.04f * static_cast<float>(i) / 1000.0f;
    for (const float cluster : {0.1f, 0.3f, 0.8f}) depths.push_back(cluster + within);
    depths.push_back(1.0f);  // nothing there: must not count
  }
  std::array<double, 2> ends{};
  place_layers(depths, ends);
  constexpr double kBin = 1.0 / 128;
  EXPECT_NEAR(ends[0], 0.5 * (0.14 + 0.3), kBin);
  EXPECT_NEAR(ends[1], 0.5 * (0.34 + 0.8), kBin);
}

TEST(LayerPlacement, leaves_every_layer_some_depth_whatever_the_map_holds) {
  const std::vector<std::vector<float>> maps{{},
                                             {1.0f},
                                             {0.0f},
                                             {0.5f},
                                             {0.5f, 0.5f, 0.5001f},
                                             {0.0f, 0.999999f},
                                             {0.2f, 0.3f, 0.9f, -1.0f, 2.0f, NAN}};
  int placed = 0;
  for (const std::vector<float>& depths : maps) {
    for (std::size_t layers = 2; layers <= 8; ++layers) {
      std::array<double, 7> ends{};
      place_layers(depths, std::span(ends).first(layers - 1));
      if (ends[0] == 0.0) continue;  // even
      ++placed;
      double before = 0.0;
      for (std::size_t i = 0; i + 1 < layers; ++i) {
        ASSERT_GE(ends[i] - before, 1.0 / 128) << layers;
        before = ends[i];
      }
      ASSERT_LE(before, 1.0 - 1.0 / 128);
    }
  }
  EXPECT_GT(placed, 7) << "of maps with more than one depth";
}

TEST(LvsmFilter, bleeds_less_where_layers_are_placed_between_the_depths_of_the_map) {
  // Two fences and a ground, all within the second of two even layers.
  const GoldenKernel kernel{"", {0.55, 0.65}, {0.5, 0.5}};
  std::vector<float> depths;
  for (int i = 0; i < 100; ++i)
    depths.insert(depths.end(), {0.55f, 0.65f, 0.8f + 0.001f * static_cast<float>(i)});
  FilterSettings settings = settings_from("lvsm:layers=2,bleed=0,format=fp32,overlap=0.1,placement=1");
  ASSERT_TRUE(filters::lvsm.hooks.adapts(settings));
  FilterLookup lookup;
  lookup.depth = 0.8;
  const double even = filters::lvsm.reference.visibility(mean_over(kernel, settings), lookup, settings);
  filters::lvsm.hooks.adapt(settings, depths);
  const double placed = filters::lvsm.reference.visibility(mean_over(kernel, settings), lookup, settings);
  EXPECT_GT(even, 0.05);
  EXPECT_LT(placed, 0.1 * even);
}

TEST(LvsmFilter, returns_the_same_on_the_gpu_where_layers_are_placed) {
  FilterSettings settings = settings_from("lvsm:placement=1,radius=2");
  const TestMap map = random_map(40, 40, 21);
  filters::lvsm.hooks.adapt(settings, map.depth);
  ASSERT_GT(settings.value("ends"), 0.0);
  const std::vector<Question> questions = random_questions(map, 256, 22, 4);
  const std::vector<float> gpu = ask_shader(settings, map, questions);
  const Reference reference(settings, map);
  int off = 0;
  for (std::size_t i = 0; i < gpu.size(); ++i)
    off += std::abs(gpu[i] - reference.answer(questions[i])) > reference.bound(questions[i]) ? 1 : 0;
  EXPECT_LE(off, 2);
}

}  // namespace
}  // namespace gnomon::render
