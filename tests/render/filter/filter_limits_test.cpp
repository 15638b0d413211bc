// Filters at their limits: does a number ever leave a shader that is none, and does the error stay within its
// bound where formats run out?
#include "filter_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shared_context.hpp"

namespace gnomon::render {
namespace {

constexpr int kSide = 24;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                kInfinity = std::numeric_limits<float>::infinity();

/// Every filter in each of its formats, with the strongest options that it takes.
std::vector<FilterSettings> variants() {
  (void)shared_context();
  std::vector<FilterSettings> all;
  for (const Filter* filter : all_filters()) {
    const std::string name(filter->info.name);
    all.push_back(settings_from(filter->info.has_kernel ? name + ":radius=2" : name));
    for (const TexelFormat format : filter->info.formats)
      all.push_back(settings_from(name + ":radius=2,format=" + std::string(to_string(format))));
  }
  for (const char* text :
       {"esm:c=10000", "esm:c=80,format=fp16", "evsm2:c=42", "evsm4:c=42,c_negative=42",
        "evsm4:c=42,c_negative=42,format=fp16", "convolution:order=16,format=unorm8", "vsm:floor=0",
        "savsm:floor=0", "lvsm:floor=0", "vsm:radius=32", "pcf:radius=32", "power_cdf:offset=0",
        "power_cdf:layers=4,radius=2", "power_cdf:layers=4,radius=2,format=unorm16"})
    all.push_back(settings_from(text));
  return all;
}

TestMap constant_map(float depth) {
  return {kSide, kSide, std::vector<float>(kSide * kSide, depth)};
}

/// Questions at each of these depths, over the map, its rim and far outside.
std::vector<Question> questions_at(std::initializer_list<float> depths) {
  std::vector<Question> questions;
  for (const float depth : depths) {
    for (const float at :
         {-1e6f, -40.0f, -1.0f, -0.25f, 0.0f, 0.5f, 3.0f, 12.3f, 23.5f, 24.0f, 24.5f, 60.0f, 1e6f})
      questions.push_back({{at, 11.7f}, depth, {}, 0.7f});
  }
  return questions;
}

void expect_answers_within(const FilterSettings& settings, const TestMap& map,
                           const std::vector<Question>& questions) {
  const std::vector<float> answers = ask_shader(settings, map, questions);
  for (std::size_t i = 0; i < answers.size(); ++i)
    ASSERT_TRUE(answers[i] >= 0.0f && answers[i] <= 1.0f + 1e-5f)
        << to_string(settings) << " at " << questions[i].position.x << " of depth " << questions[i].depth
        << ": " << answers[i];
}

TEST(FilterLimits, depths_of_exactly_0_and_1_and_beyond_make_visibilities_from_0_to_1) {
  for (const FilterSettings& settings : variants()) {
    for (const float stored : {0.0f, 1.0f}) {
      expect_answers_within(settings, constant_map(stored), questions_at({0.0f, 1.0f, -0.5f, 1.5f, 0.5f}));
    }
  }
}

// Mesa lets no depth in but those from 0 to 1: what is no number arrives as 0. Other drivers may keep it.
// Texels that are no number reach every filter in filter_laws_test.
TEST(FilterLimits, depths_that_are_no_number_make_visibilities_from_0_to_1) {
  TestMap map = random_map(kSide, kSide, 3);
  for (std::size_t i = 0; i < map.depth.size(); i += 3)
    map.depth[i] = i % 2 == 0 ? kNan : (i % 4 == 1 ? kInfinity : -kInfinity);
  for (const FilterSettings& settings : variants()) {
    expect_answers_within(settings, map, questions_at({0.0f, 0.5f, 1.0f}));
    expect_answers_within(settings, constant_map(kNan), questions_at({0.0f, 0.5f, 1.0f}));
    expect_answers_within(settings, constant_map(kInfinity), questions_at({0.5f}));
  }
}

TEST(FilterLimits, a_receiver_that_is_no_number_makes_visibilities_from_0_to_1) {
  for (const FilterSettings& settings : variants()) {
    std::vector<Question> questions = questions_at({kNan, kInfinity, -kInfinity});
    questions.push_back({{kNan, kNan}, 0.5f, {}, 0.0f});
    questions.push_back({{12.0f, 12.0f}, 0.5f, {kNan, kInfinity}, 0.0f});
    questions.push_back({{12.0f, 12.0f}, 0.5f, {1e30f, -1e30f}, 0.0f});
    expect_answers_within(settings, random_map(kSide, kSide, 4), questions);
  }
}

TEST(FilterLimits, receivers_outside_of_the_map_get_visibilities_from_0_to_1) {
  for (const FilterSettings& settings : variants()) {
    if (settings.radius > 8.0) continue;  // such a kernel reaches from outside into the map
    std::vector<Question> outside;
    for (const float at : {-20.0f, -1e4f, 50.0f, 1e4f}) {
      outside.push_back({{at, 11.7f}, 0.9f, {}, 0.7f});
      outside.push_back({{11.7f, at}, 0.9f, {}, 0.7f});
    }
    for (const float answer : ask_shader(settings, constant_map(0.25f), outside)) {
      // The renderer asks no filter there (map_holds); whoever does gets no number that is none.
      ASSERT_TRUE(answer >= 0.0f && answer <= 1.0f) << to_string(settings);
    }
  }
}

TEST(FilterLimits, equal_least_and_largest_depths_make_a_power_law_a_step) {
  for (const char* text : {"power_cdf:radius=2", "power_cdf:radius=2,offset=0",
                           "power_cdf:radius=2,format=fp16", "power_cdf:radius=2,layers=4"}) {
    const FilterSettings settings = settings_from(text);
    for (const float stored : {0.0f, 0.25f, 0.5f}) {
      std::vector<Question> questions;
      for (const float off : {-0.25f, -0.01f, 0.0f, 0.01f, 0.25f})
        questions.push_back({{12.0f, 12.0f}, stored + off, {}, 0.0f});
      const std::vector<float> answers = ask_shader(settings, constant_map(stored), questions);
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(answers[static_cast<std::size_t>(i)], 1.0f) << text << ' ' << stored;
      for (int i = 3; i < 5; ++i)
        EXPECT_EQ(answers[static_cast<std::size_t>(i)], 0.0f) << text << ' ' << stored;
    }
  }
}

TEST(FilterLimits, errors_stay_within_what_formats_round) {
  (void)shared_context();
  int rows = 0;
  for (const stress::FilterStrain& strain : stress::filter_strains()) {
    for (const stress::FilterRow& row : stress::sweep_filters(strain)) {
      ++rows;
      EXPECT_TRUE(row.within) << row.filter << " at " << row.axis << ' ' << row.value;
      // At a step of the answer itself rounding may fall on either side.
      EXPECT_LE(row.beyond, 0.02) << row.filter << " at " << row.axis << ' ' << row.value << ": " << row.error
                                  << " of " << row.bound;
    }
  }
  EXPECT_GT(rows, 100);
}

}  // namespace
}  // namespace gnomon::render
