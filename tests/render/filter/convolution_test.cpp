// Convolution shadow maps: the series against the golden rows and the paper's limits.
#include "filter/convolution.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

/// Golden rows are computed in double; sums of 16 terms.
constexpr double kGolden = 1e-9;

/// The series for one texel `t` in front of the receiver, both well inside of the period.
double lit_at(double t, const FourierStep& step) {
  constexpr double kTexel = 0.5;
  return fourier_lit(fourier_basis(kTexel, step.order), kTexel + t, step);
}

double see(std::string_view text, double stored, double depth) {
  const FilterSettings settings = settings_from(text);
  FilterLookup lookup;
  lookup.depth = depth;
  const Filter& filter = *settings.filter;
  return filter.reference.visibility(filter.reference.store(stored, glm::dvec2(0.0), settings), lookup,
                                     settings);
}

TEST(ConvolutionFilter, sums_up_the_golden_series_for_every_order_and_attenuation) {
  std::size_t rows = 0;
  for (const nlohmann::json& row : golden_filters().at("csm")) {
    const int order = row.at("M").get<int>();
    if (order > 16) continue;
    const double t = row.at("t").get<double>();
    EXPECT_NEAR(lit_at(t, {order, 0.0}), row.at("lit").get<double>(), kGolden) << order << " " << t;
    EXPECT_NEAR(lit_at(t, {order, 0.5}), row.at("lit_att05").get<double>(), kGolden) << order << " " << t;
    EXPECT_NEAR(lit_at(t, {order, 1.0}), row.at("lit_att1").get<double>(), kGolden) << order << " " << t;
    EXPECT_NEAR(saturate(2.0 * lit_at(t, {order, 0.0})), row.at("scale2").get<double>(), kGolden) << t;
    ++rows;
  }
  EXPECT_GT(rows, 50u);
}

TEST(ConvolutionFilter, agrees_with_the_golden_kernels) {
  for (const GoldenRow& row : golden_rows()) {
    for (const auto& [order, name] : {std::pair{4, "csm4"}, std::pair{16, "csm16"}}) {
      StoredTexel mean{};
      for (std::size_t i = 0; i < row.kernel.depth.size(); ++i) {
        const StoredTexel basis = fourier_basis(row.kernel.depth[i], order);
        for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += row.kernel.weight[i] * basis[c];
      }
      EXPECT_NEAR(fourier_lit(mean, row.depth, {order, 0.0}), row.answer(name), kGolden)
          << row.kernel.name << " " << row.depth;
    }
  }
}

TEST(ConvolutionFilter, is_one_in_front_and_nothing_behind_not_the_other_way_round_as_the_paper_prints_it) {
  EXPECT_GT(lit_at(-0.5, {16, 0.0}), 0.95);
  EXPECT_LT(lit_at(0.5, {16, 0.0}), 0.05);
  EXPECT_NEAR(lit_at(0.0, {16, 0.0}), 0.5, 1e-12);
}

TEST(ConvolutionFilter, is_fully_lit_at_the_golden_offsets_and_peaks_at_half_a_step) {
  for (const nlohmann::json& row : golden_filters().at("csm_offsets")) {
    const int order = row.at("M").get<int>();
    if (order > 16) continue;
    EXPECT_NEAR(lit_at(-row.at("first_lit1").get<double>(), {order, 0.0}), 1.0, kGolden);
    EXPECT_NEAR(fourier_half_step(order), row.at("first_peak").get<double>(), 1e-15);
    EXPECT_NEAR(lit_at(-fourier_half_step(order), {order, 0.0}), row.at("peak").get<double>(), kGolden);
  }
}

TEST(ConvolutionFilter, leaves_lit_what_stands_anywhere_in_front_of_an_empty_map) {
  // The series repeats itself at a difference of 2, and is half lit at 1: depths must keep away from it.
  for (const char* text : {"convolution", "convolution:order=8", "convolution:order=4,attenuation=0"}) {
    for (double depth = 0.0; depth <= 1.0; depth += 1.0 / 512) {
      EXPECT_GE(see(text, 1.0, depth), 0.94) << text << " " << depth;  // ringing of order 4: 0.946
    }
  }
}

TEST(ConvolutionFilter, is_dark_everywhere_behind_the_step) {
  // Ripples of order 8 are 0.015, which the scale doubles.
  for (const auto& [text, order] : {std::pair{"convolution", 16}, std::pair{"convolution:order=8", 8}}) {
    // The attenuated step ends four half steps behind its middle, of the range that is left of the period.
    const double begin = 4.0 * fourier_half_step(order) / (1.0 - 3.5 * fourier_half_step(order));
    for (double depth = begin; depth <= 1.0; depth += 1.0 / 512) {
      EXPECT_LE(see(text, 0.0, depth), 0.035) << text << " " << depth;
    }
  }
}

TEST(ConvolutionFilter, rings_less_where_it_is_attenuated) {
  const auto ringing = [](double attenuation) {
    double most = 0.0;
    for (double t = 0.04; t < 0.5; t += 0.001) most = std::max(most, std::abs(lit_at(t, {16, attenuation})));
    return most;
  };
  EXPECT_GT(ringing(0.0), 0.05);
  EXPECT_LT(ringing(1.0), 0.02);
}

TEST(ConvolutionFilter, is_off_by_no_more_than_the_papers_bound_in_8_bits) {
  // 2 sqrt(2) sum 1 / c_k times half a step of the bases, whose range is 2.
  double bound = 0.0;
  for (int k = 1; k <= 16; ++k) bound += 2.0 * std::sqrt(2.0) / (3.14159265358979 * (2 * k - 1)) / 255.0;
  EXPECT_LE(bound, 8.5e-3);
  const FilterSettings settings = settings_from("convolution:format=unorm8,scale=1");
  for (double stored = 0.0; stored <= 1.0; stored += 1.0 / 97) {
    const StoredTexel exact = filters::convolution.reference.store(stored, {}, settings);
    StoredTexel rounded = exact;
    for (double& channel : rounded) channel = rounded_to(TexelFormat::unorm8, channel);
    for (double depth = 0.0; depth <= 1.0; depth += 1.0 / 61) {
      FilterLookup lookup;
      lookup.depth = depth;
      EXPECT_NEAR(filters::convolution.reference.visibility(rounded, lookup, settings),
                  filters::convolution.reference.visibility(exact, lookup, settings), bound);
    }
  }
}

TEST(ConvolutionFilter, averages_without_bleeding_where_two_occluders_overlap) {
  // Depths 0.2 and 0.6 half and half, the receiver at 0.8: the truth is 0, the bound of two moments is 0.2.
  const FilterSettings settings = settings_from("convolution:attenuation=1,offset=1,scale=1.02");
  const GoldenKernel kernel{"", {0.2, 0.6}, {0.5, 0.5}};
  FilterLookup lookup;
  lookup.depth = 0.8;
  EXPECT_LE(filters::convolution.reference.visibility(mean_over(kernel, settings), lookup, settings), 0.03);
  lookup.depth = 0.4;
  EXPECT_NEAR(filters::convolution.reference.visibility(mean_over(kernel, settings), lookup, settings), 0.5,
              0.03);
}

TEST(ConvolutionFilter, keeps_lit_surfaces_lit_and_shows_no_ripples_by_default) {
  for (double behind = 0.1; behind <= 0.9; behind += 0.01)
    EXPECT_LT(see("convolution:format=fp32", 0.05, 0.05 + behind), 0.016) << behind;
  for (const double depth : {0.0, 0.3, 0.8})
    EXPECT_GT(see("convolution:format=fp32", depth, depth), 0.999) << depth;
  EXPECT_LT(see("convolution:format=fp32,offset=0,scale=1", 0.3, 0.3), 0.6);
}

TEST(ConvolutionFilter, widens_its_step_to_the_fall_off_and_never_narrows_it) {
  const FilterSettings asked = settings_from("convolution:format=fp32,falloff_world=4");
  const MapDepths shallow{10.0, 0.01}, deep{1000.0, 0.01};
  const auto lit = [&](const MapDepths& depths, double behind_world) {
    const FilterSettings settings = settings_for_map(asked, depths);
    FilterLookup lookup;
    lookup.depth = 0.2 + behind_world / depths.range_world;
    return filters::convolution.reference.visibility(
        filters::convolution.reference.store(0.2, glm::dvec2(0.0), settings), lookup, settings);
  };
  EXPECT_GT(lit(shallow, 1.0), 0.3);  // by itself the series would have faded
  EXPECT_LT(settings_for_map(settings_from("convolution"), shallow).value("widening"), 1e-12);
  EXPECT_EQ(settings_for_map(asked, deep).value("widening"), 0.0);
  EXPECT_EQ(settings_for_map(asked, MapDepths{}).value("widening"), 0.0);
}

TEST(ConvolutionFilter, returns_the_same_on_gpu_and_cpu_for_every_order) {
  const TestMap map = random_map(24, 19, 21);
  const std::vector<Question> questions = random_questions(map, 256, 22, 4);
  for (const int order : {1, 2, 3, 5, 8, 16}) {
    const FilterSettings settings =
        settings_from("convolution:format=fp32,radius=2,order=" + std::to_string(order));
    const std::vector<float> gpu = ask_shader(settings, map, questions);
    const Reference reference(settings, map);
    for (std::size_t i = 0; i < gpu.size(); ++i) {
      ASSERT_NEAR(gpu[i], reference.answer(questions[i]), reference.bound(questions[i])) << order << " " << i;
    }
  }
}

}  // namespace
}  // namespace gnomon::render
