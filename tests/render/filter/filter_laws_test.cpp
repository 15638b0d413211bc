// What every filter must do, whatever it stores: each law runs over the registry, over every format and blur.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "filter/filter_harness.hpp"

namespace gnomon::render {
namespace {

constexpr int kSide = 40;  ///< texels: wide enough that the widest kernel here leaves an undisturbed middle

/// Every filter as it is by default, and with other formats and kernels.
std::vector<FilterSettings> variants() {
  std::vector<FilterSettings> all;
  for (const Filter* filter : all_filters()) {
    FilterSettings settings = default_settings(*filter);
    all.push_back(settings);
    for (const double radius : {0.0, 1.0, 3.0, 2.25}) {
      settings.radius = radius;
      all.push_back(settings);
    }
    settings.radius = 2.0;
    settings.blur = BlurShape::gauss;
    if (!filter->info.formats.empty()) all.push_back(settings);
    settings.blur = BlurShape::box;
    for (const TexelFormat format : filter->info.formats) {
      FilterSettings other = settings;
      other.format = format;
      settle_options(other);
      if (format != settings.format) all.push_back(other);
    }
  }
  for (const char* text : {"power_cdf:layers=4,radius=2", "power_cdf:layers=3,radius=1,format=unorm16"})
    all.push_back(settings_from(text));
  return all;
}

TestMap map_of(double (*depth)(int x, int y)) {
  TestMap map{kSide, kSide, {}};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) map.depth.push_back(static_cast<float>(depth(x, y)));
  }
  return map;
}

/// Questions across the middle row, all at one depth.
std::vector<Question> across(float depth) {
  std::vector<Question> questions;
  for (float x = 10.0f; x <= 30.0f; x += 0.125f) questions.push_back({{x, 20.3f}, depth, {}, 0.7f});
  return questions;
}

TEST(FilterLaws, a_surface_as_deep_as_the_map_is_lit_and_one_behind_it_is_dark) {
  for (const FilterSettings& settings : variants()) {
    const Filter& filter = *settings.filter;
    for (const float stored : {0.0f, 0.125f, 0.5f, 0.875f, 1.0f}) {
      TestMap map{kSide, kSide, std::vector<float>(kSide * kSide, stored)};
      const auto contact = static_cast<float>(std::max(filter.reference.contact, 1e-5));
      std::vector<Question> lit = across(stored), dark = across(stored + contact);
      for (const float answer : ask_shader(settings, map, lit)) {
        ASSERT_GE(answer, 1.0 - filter.reference.tolerance) << to_string(settings) << " at " << stored;
      }
      if (stored + contact > 1.0f) continue;
      for (const float answer : ask_shader(settings, map, dark)) {
        ASSERT_LE(answer, filter.reference.tolerance) << to_string(settings) << " behind " << stored;
      }
    }
  }
}

TEST(FilterLaws, visibility_never_falls_on_the_way_out_of_a_shadow) {
  const TestMap edge = map_of([](int x, int) { return x < 20 ? 0.25 : 0.75; });
  for (const FilterSettings& settings : variants()) {
    const std::vector<float> answers = ask_shader(settings, edge, across(0.5f));
    // What formats and weights round; the answer itself may be off by much more.
    const double rounding = 1e-5 + 16.0 * rounding_of(settings.format);
    float most = 0.0f;
    for (const float answer : answers) {
      ASSERT_GE(answer, most - rounding) << to_string(settings);
      most = std::max(most, answer);
    }
    EXPECT_LE(answers.front(), settings.filter->reference.tolerance) << to_string(settings);
    EXPECT_GE(answers.back(), 1.0 - settings.filter->reference.tolerance) << to_string(settings);
  }
}

TEST(FilterLaws, gpu_and_cpu_return_the_same_visibility_between_0_and_1) {
  for (const FilterSettings& settings : variants()) {
    const TestMap map = random_map(kSide, kSide + 3, 7);
    const std::vector<Question> questions = random_questions(map, 512, 8, 1);
    const std::vector<float> gpu = ask_shader(settings, map, questions);
    const Reference reference(settings, map);
    int lit = 0, dark = 0;
    int off = 0;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
      ASSERT_TRUE(gpu[i] >= 0.0f && gpu[i] <= 1.0f + 1e-5f) << to_string(settings) << ": " << gpu[i];
      const double cpu = reference.answer(questions[i]);
      ASSERT_TRUE(cpu >= 0.0 && cpu <= 1.0 + 1e-9) << to_string(settings) << ": " << cpu;
      if (std::abs(gpu[i] - cpu) > reference.bound(questions[i])) {
        ++off;
        if (off == 3) {
          ADD_FAILURE() << to_string(settings) << " question " << i << ": GPU " << gpu[i] << ", CPU " << cpu
                        << " +- " << reference.bound(questions[i]);
        }
      }
      ++(cpu > 0.5 ? lit : dark);
    }
    EXPECT_GT(lit, 5) << to_string(settings);
    EXPECT_GT(dark, 5) << to_string(settings);
  }
}

TEST(FilterLaws, gpu_and_cpu_store_the_same_texels) {
  std::vector<float> depths;
  std::vector<glm::vec2> slopes;
  for (int i = 0; i <= 256; ++i) {
    depths.push_back(static_cast<float>(i) / 256.0f);
    slopes.emplace_back(static_cast<float>(i % 7) / 64.0f, static_cast<float>(i % 5) / -128.0f);
  }
  for (const FilterSettings& settings : variants()) {
    if (settings.filter->reference.store == nullptr) continue;
    const std::vector<StoredTexel> gpu = stored_by_shader(settings, depths, slopes);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const StoredTexel cpu = settings.filter->reference.store(depths[i], slopes[i], settings);
      // A few operations in float; exp and sin are good to 1e-5 on every driver.
      for (int c = 0; c < settings.filter->info.channels(settings); ++c) {
        const auto channel = static_cast<std::size_t>(c);
        ASSERT_NEAR(gpu[i][channel], cpu[channel], 2e-5 * std::max(1.0, std::abs(cpu[channel])))
            << to_string(settings) << " depth " << depths[i] << " channel " << c;
      }
    }
  }
}

TEST(FilterLaws, no_texel_makes_a_visibility_that_is_not_between_0_and_1) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> kHard{0.0,   1.0,   -1.0, 0.5,      kInf, -kInf, kNan, 65504.0,  3e38,
                                  -3e38, 1e-40, 2.0,  -65504.0, 0.25, 1e-7,  1e19, 0.999999, -0.0};
  std::mt19937 random(11);
  std::vector<StoredTexel> texels;
  std::vector<Question> questions;
  for (int i = 0; i < 1024; ++i) {
    StoredTexel texel{};
    for (double& channel : texel) channel = kHard[random() % kHard.size()];
    texels.push_back(texel);
    questions.push_back({{20.0f, 20.0f}, static_cast<float>(random() % 5) / 4.0f, {}, 0.0f});
  }
  for (const FilterSettings& settings : variants()) {
    if (settings.filter->info.reads == MapRead::depth) continue;
    for (const float answer : ask_shader(settings, texels, questions)) {
      ASSERT_TRUE(answer >= 0.0f && answer <= 1.0f) << to_string(settings) << ": " << answer;
    }
    const TestMap lit{1, 1, {1.0f}};
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const double answer =
          settings.filter->reference.visibility(texels[i], lookup_of(settings, lit, questions[i]), settings);
      ASSERT_TRUE(answer >= 0.0 && answer <= 1.0) << to_string(settings) << ": " << answer;
    }
  }
}

TEST(FilterLaws, moving_the_map_by_whole_texels_moves_the_results_along) {
  // The widest default kernel reaches 12.5 texels, and stays inside of both maps.
  constexpr int kWide = 48, kRim = 16, kRight = 3, kUp = 2;
  const TestMap map = random_map(kWide, kWide, 13);
  TestMap moved = map;
  for (int y = 0; y < kWide; ++y) {
    for (int x = 0; x < kWide; ++x) {
      const auto at = static_cast<std::size_t>(y * kWide + x);
      moved.depth[at] = static_cast<float>(map.at(x - kRight, y - kUp));
      moved.silhouette[at] = glm::vec2(map.silhouette_at(x - kRight, y - kUp));
    }
  }
  const std::vector<Question> questions = random_questions(map, 256, 14, kRim);
  std::vector<Question> along = questions;
  for (Question& q : along) q.position += glm::vec2(kRight, kUp);
  for (const FilterSettings& settings : variants()) {
    const std::vector<float> here = ask_shader(settings, map, questions);
    const std::vector<float> there = ask_shader(settings, moved, along);
    const Reference reference(settings, map);
    for (std::size_t i = 0; i < here.size(); ++i) {
      // The place over the layer's size is rounded anew: to the answer that is a change of some 1e-6 texels.
      ASSERT_NEAR(here[i], there[i], reference.bound(questions[i]) + 1e-4) << to_string(settings) << " " << i;
    }
  }
}

}  // namespace
}  // namespace gnomon::render
