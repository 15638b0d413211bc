// Summed-area variance shadow maps: the bound's golden rows, and sums that stay exact on large maps.
#include <gtest/gtest.h>

#include <cmath>

#include "filter/filter_block.hpp"
#include "filter/variance.hpp"
#include "filter_harness.hpp"
#include "golden_filters.hpp"

namespace gnomon::render {
namespace {

constexpr double kGolden = 1e-9;  ///< golden rows are computed in double

TEST(SavsmFilter, agrees_with_the_golden_rows_of_the_bound) {
  const FilterSettings settings = settings_from("savsm:bleed=0,floor=0,slope=0");
  for (const GoldenRow& row : golden_rows()) {
    const StoredTexel sum = mean_over(row.kernel, settings);
    const double mean = 2.0 * sum[0] - 1.0;  // the sums hold depths in [0, 1]
    EXPECT_NEAR(chebyshev(mean, std::max(sum[1] - mean * mean, 0.0), 2.0 * row.depth - 1.0),
                row.answer("vsm"), kGolden)
        << row.kernel.name << row.depth;
  }
}

TEST(SavsmFilter, keeps_more_bits_than_sums_over_the_whole_map_could) {
  // A sum over all of the map that fits 32 bits leaves 10 of them at 2048 x 2048. Only a kernel's must fit.
  for (const nlohmann::json& row : golden_filters().at("savsm")) {
    FilterSettings settings = settings_from("savsm");
    for (const double radius : {1.0, 3.0, 32.0}) {
      settings.radius = radius;
      const double bits = std::log2(static_cast<double>(filter_block(settings, {}).sums.x));
      EXPECT_GT(bits, 19.0);
      EXPECT_GT(bits, row.at("uint32_left_bits").get<double>());
      // No kernel of ones overflows 32 bits.
      const double side = std::ceil(2.0 * radius + 1.0) + 1.0;
      EXPECT_LT(std::exp2(bits) * side * side, 4294967296.0);
    }
  }
}

TEST(SavsmFilter, returns_the_same_in_all_corners_of_a_map_of_2048_texels) {
  // The same 32 x 32 depths in every corner, everything else in between: sums wrap round many times.
  constexpr int kSide = 2048, kPatch = 32;
  const TestMap patch = random_map(kPatch, kPatch, 31);
  TestMap map{kSide, kSide, std::vector<float>(static_cast<std::size_t>(kSide) * kSide, 0.9375f)};
  for (int y = 0; y < kPatch; ++y) {
    for (int x = 0; x < kPatch; ++x) {
      for (const auto& [left, low] :
           {std::pair{0, 0}, {kSide - kPatch, 0}, {0, kSide - kPatch}, {kSide - kPatch, kSide - kPatch}}) {
        map.depth[static_cast<std::size_t>(low + y) * kSide + static_cast<std::size_t>(left + x)] =
            static_cast<float>(patch.at(x, y));
      }
    }
  }
  const FilterSettings settings = settings_from("savsm:radius=3");
  const std::vector<Question> questions = random_questions(patch, 256, 32, 6);
  std::vector<Question> everywhere = questions;
  for (const glm::vec2 corner :
       {glm::vec2(kSide - kPatch, 0), glm::vec2(0, kSide - kPatch), glm::vec2(kSide - kPatch)}) {
    for (Question q : questions) {
      q.position += corner;
      everywhere.push_back(q);
    }
  }
  const std::vector<float> answers = ask_shader(settings, map, everywhere);
  const Reference reference(settings, patch);
  for (std::size_t i = 0; i < everywhere.size(); ++i) {
    const Question& q = questions[i % questions.size()];
    // Places are rounded to 1e-4 texels at 2048.
    ASSERT_NEAR(answers[i], reference.answer(q), reference.bound(q) + 1e-3) << i;
  }
}

TEST(SavsmFilter, leaves_a_flat_surface_lit_far_from_the_tables_origin) {
  constexpr int kSide = 512;
  const TestMap map{kSide, kSide, std::vector<float>(static_cast<std::size_t>(kSide) * kSide, 0.7f)};
  for (const char* text : {"savsm:radius=0", "savsm:radius=3", "savsm:radius=24"}) {
    std::vector<Question> questions;
    for (float at = 40.0f; at < 470.0f; at += 7.3f) questions.push_back({{at, 500.0f - at}, 0.7f, {}, 0.0f});
    for (const float lit : ask_shader(settings_from(text), map, questions)) {
      ASSERT_GE(lit, 1.0f - 1e-3f) << text;
    }
  }
}

}  // namespace
}  // namespace gnomon::render
