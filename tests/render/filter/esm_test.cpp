// Exponential shadow maps: the golden rows, the logarithm's blur, and when the mean counts as failed.
#include <gtest/gtest.h>

#include <cmath>

#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

constexpr double kGolden = 1e-9;

TEST(EsmFilter, agrees_with_the_golden_rows_of_the_clamped_exponential) {
  for (const GoldenRow& row : golden_rows()) {
    for (const char* text :
         {"esm:c=10,fallback=0", "esm:c=80,fallback=0", "esm:c=80,fallback=0,format=fp16"}) {
      const FilterSettings settings = settings_from(text);
      FilterLookup lookup;
      // What the filter takes off for the format's rounding is given back.
      lookup.depth = row.depth + rounding_of(settings.format);
      const double lit = filters::esm.reference.visibility(mean_over(row.kernel, settings), lookup, settings);
      EXPECT_NEAR(lit, row.answer(settings.value("c") == 10.0 ? "esm10" : "esm80"), kGolden)
          << row.kernel.name << row.depth;
    }
  }
}

TEST(EsmFilter, blurs_in_the_logarithm_without_overflow_for_any_exponent) {
  for (const nlohmann::json& row : golden_filters().at("esm").at("logspace")) {
    FilterSettings settings = settings_from("esm");
    option_named(settings, "c") = row.at("c").get<double>();
    const double c = settings.value("c");
    const bool plain = reads_of(settings) == MapRead::filtered;
    const GoldenKernel kernel{"", row.at("z").get<std::vector<double>>(),
                              row.at("w").get<std::vector<double>>()};
    const double stored = mean_over(kernel, settings)[0];
    EXPECT_NEAR(plain ? 0.5 + std::log(stored) / c : stored, row.at("log_filtered_over_c").get<double>(),
                kGolden);
  }
}

TEST(EsmFilter, fades_by_the_exponential_of_the_distance) {
  for (const nlohmann::json& row : golden_filters().at("esm").at("rows")) {
    FilterSettings settings = settings_from("esm:fallback=0");
    option_named(settings, "c") = row.at("c").get<double>();
    FilterLookup lookup;
    lookup.depth = -0.5 + row.at("t").get<double>() + rounding_of(settings.format);
    const StoredTexel texel = filters::esm.reference.store(-0.5, {}, settings);
    EXPECT_NEAR(filters::esm.reference.visibility(texel, lookup, settings),
                std::min(row.at("f").get<double>(), 1.0), 1e-9);
  }
}

TEST(EsmFilter, compares_four_texels_where_a_texel_of_the_kernel_lies_behind_the_receiver) {
  // Dark left of column 8, far background right of it; the receiver half way. The mean over both is far
  // above 1.
  FilterLookup lookup;
  lookup.map_depth = [](int x, int) { return x < 8 ? 0.25 : 1.0; };
  lookup.depth = 0.5;
  lookup.depth_max = 1.0;
  lookup.position = {6.5, 5.5};
  const StoredTexel mean = filters::esm.reference.store(0.98, {}, settings_from("esm"));
  EXPECT_EQ(filters::esm.reference.visibility(mean, lookup, settings_from("esm:fallback=0")), 1.0);
  EXPECT_EQ(filters::esm.reference.visibility(mean, lookup, settings_from("esm:fallback=1")), 0.0);
  EXPECT_EQ(filters::esm.reference.visibility(mean, lookup, settings_from("esm:fallback=2")), 0.0);
  lookup.position.x = 8.0;
  EXPECT_NEAR(filters::esm.reference.visibility(mean, lookup, settings_from("esm:fallback=1")), 0.5, 1e-12);
}

TEST(EsmFilter, lights_a_slanted_plane_by_its_own_mean_and_calls_it_no_failure) {
  // A plane whose depths rise by 0.002 a texel under a kernel of 9 x 9: the mean is 1.08 of the middle's.
  const FilterSettings settings = settings_from("esm:radius=4,c=80");
  FilterLookup lookup;
  lookup.map_depth = [](int, int) { return 0.0; };  // what a comparison would call dark
  lookup.depth_gradient = {0.002, 0.0};
  lookup.box = {4.5, 4.5};
  for (const double lit_columns : {9.0, 4.0}) {
    StoredTexel sum = filters::esm.reference.nothing(settings);
    for (int i = 0; i < 9; ++i) {
      const double depth = i < lit_columns ? 0.5 + 0.002 * (i - 4) : 0.1;
      filters::esm.reference.join(sum, filters::esm.reference.store(depth, {}, settings), 1.0 / 9.0,
                                  settings);
    }
    lookup.depth = 0.5;
    const double lit = filters::esm.reference.visibility(sum, lookup, settings);
    // Of the columns those in front count less, by the plane's fall.
    EXPECT_NEAR(lit, lit_columns / 9.0, lit_columns == 9.0 ? 0.01 : 0.2) << lit_columns;
  }
}

TEST(EsmFilter, classifies_by_the_largest_depth_alike_on_gpu_and_cpu) {
  const TestMap map = random_map(40, 43, 21);
  const std::vector<Question> questions = random_questions(map, 512, 22, 6);
  for (const char* text :
       {"esm:fallback=2,radius=1", "esm:fallback=2,radius=3", "esm:fallback=2,radius=0,c=20"}) {
    const FilterSettings settings = settings_from(text);
    const std::vector<float> gpu = ask_shader(settings, map, questions);
    const Reference reference(settings, map);
    for (std::size_t i = 0; i < gpu.size(); ++i) {
      ASSERT_NEAR(gpu[i], reference.answer(questions[i]), reference.bound(questions[i])) << text << " " << i;
    }
  }
}

TEST(EsmFilter, stores_the_bare_exponential_where_floats_hold_it_and_its_logarithm_beyond) {
  for (const char* text : {"esm", "esm:c=160", "esm:c=80"})
    EXPECT_EQ(reads_of(settings_from(text)), MapRead::filtered) << text;
  for (const char* text : {"esm:c=160.1", "esm:c=80,format=fp16", "esm:c=80,format=unorm16"})
    EXPECT_EQ(reads_of(settings_from(text)), MapRead::joined) << text;
  for (const double depth : {0.0, 1.0}) {
    // A kernel of 65 x 65 texels adds up to no infinity; no texel is 0.
    const double stored = filters::esm.reference.store(depth, {}, settings_from("esm:c=160"))[0];
    EXPECT_LT(stored * 65.0 * 65.0, 3.4e38);
    EXPECT_GT(stored, 1.2e-38);
  }
}

TEST(EsmFilter, fades_over_the_same_length_in_maps_of_any_depth_range) {
  const FilterSettings asked = settings_from("esm:c=10000,falloff_world=0.5,falloff_kernel=0,fallback=0");
  for (const double range : {5.0, 40.0, 300.0}) {
    const FilterSettings settings = settings_for_map(asked, {range, 0.01});
    FilterLookup lookup;
    lookup.depth = 0.25 + 0.5 / range + rounding_of(settings.format);  // half a unit behind the texel
    const StoredTexel texel = filters::esm.reference.store(0.25, {}, settings);
    EXPECT_NEAR(filters::esm.reference.visibility(texel, lookup, settings), 0.05, 1e-6) << range;
  }
  // By the kernel: the longer of both counts. No exponent above the one asked for, none below 1.
  EXPECT_NEAR(
      settings_for_map(settings_from("esm:falloff_world=1,falloff_kernel=4"), {100.0, 0.5}).value("c"),
      0.5 * 299.573, 1e-3);
  EXPECT_EQ(settings_for_map(settings_from("esm:c=50"), {1e6, 1e-6}).value("c"), 50.0);
  EXPECT_EQ(settings_for_map(settings_from("esm:falloff_world=1000"), {1.0, 0.0}).value("c"), 1.0);
  for (const MapDepths& unknown : {MapDepths{}, MapDepths{0.0, 1.0}, MapDepths{std::nan(""), 1.0}})
    EXPECT_EQ(settings_for_map(settings_from("esm:c=50,falloff_world=1"), unknown).value("c"), 50.0);
}

TEST(EsmFilter, keeps_its_exponent_within_what_16_bits_hold) {
  EXPECT_EQ(settings_from("esm:c=500").value("c"), 500.0);
  EXPECT_EQ(settings_from("esm:c=500,format=fp16").value("c"), 80.0);
}

}  // namespace
}  // namespace gnomon::render
