// Filters at their limits: depth ranges, kernels, exponents and map sizes at which numbers run out.
#include "filter_limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::stress {
namespace {

using render::FilterSettings;
using render::Question;
using render::TestMap;
using Trial = FilterStrain::Trial;

constexpr int kQuestions = 200;
constexpr unsigned kMapSeed = 5, kQuestionSeed = 6;

std::string with(const std::string& filter, const char* key, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%s=%.9g", key, value);
  return filter + (filter.find(':') == std::string::npos ? ":" : ",") + text;
}

/// Random depths over the whole range, asked where every kernel stays inside.
Trial plain_trial(const std::string& filter, int side) {
  Trial trial{render::settings_from(filter), render::random_map(side, side, kMapSeed), {}};
  const int rim = std::min(side / 2 - 2, static_cast<int>(std::ceil(trial.settings.radius)) + 2);
  trial.questions = render::random_questions(trial.map, kQuestions, kQuestionSeed, rim);
  return trial;
}

/// All depths within `range` round the middle: what is left of a map whose range a far caster stretches.
Trial at_depth_range(const std::string& filter, double range) {
  Trial trial = plain_trial(with(filter, "radius", 2), 40);
  const auto squeeze = [range](float& depth) {
    depth = static_cast<float>(0.5 + range * (static_cast<double>(depth) - 0.5));
  };
  for (float& depth : trial.map.depth) squeeze(depth);
  for (Question& q : trial.questions) {
    squeeze(q.depth);
    q.depth_gradient *= static_cast<float>(range);
  }
  return trial;
}

Trial at_kernel(const std::string& filter, double radius) {
  return plain_trial(with(filter, "radius", radius), 88);
}

Trial at_exponent(const std::string& filter, double exponent) {
  return plain_trial(with(with(filter, "radius", 2), "c", exponent), 40);
}

Trial at_order(const std::string& filter, double order) {
  return plain_trial(with(with(filter, "radius", 2), "order", order), 40);
}

/// Asked at the far corner, where a summed-area table has added up the most.
Trial at_map_size(const std::string& filter, double side) {
  Trial trial = plain_trial(with(filter, "radius", 2), static_cast<int>(side));
  const auto corner = static_cast<float>(side - 10.0);
  for (Question& q : trial.questions)
    q.position = glm::vec2(corner) + glm::vec2(std::fmod(q.position.x, 6.0f), std::fmod(q.position.y, 6.0f));
  return trial;
}

std::vector<double> powers(double base, int first, int last) {
  std::vector<double> all;
  for (int i = first; i <= last; ++i) all.push_back(std::pow(base, i));
  return all;
}

const std::vector<FilterStrain>& strains() {
  static const std::vector<FilterStrain> all{
      {"depth_range",
       "depths in use, of the map's range",
       powers(8.0, -7, 0),
       {"vsm", "vsm:floor=0", "vsm:format=unorm16", "savsm", "savsm:floor=0", "msm", "msm:format=unorm16",
        "esm", "esm:format=fp16", "evsm4", "evsm4:format=fp16", "convolution", "lvsm", "power_cdf"},
       at_depth_range},
      {"kernel",
       "radius of the kernel, texels",
       {0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0},
       {"vsm", "vsm:format=unorm16", "savsm", "msm", "esm", "evsm4", "convolution", "power_cdf"},
       at_kernel},
      {"exponent",
       "exponent c",
       {1.0, 5.0, 10.0, 20.0, 42.0, 80.0, 88.7, 300.0, 10000.0},
       {"esm", "esm:format=fp16"},
       at_exponent},
      {"exponent",
       "exponent c",
       {0.5, 2.0, 5.0, 5.54, 10.0, 20.0, 42.0},
       {"evsm2", "evsm4", "evsm4:format=fp16"},
       at_exponent},
      {"order",
       "terms of the series",
       {1.0, 2.0, 4.0, 8.0, 16.0},
       {"convolution:format=unorm8", "convolution:format=fp16"},
       at_order},
      {"map_size",
       "texels along a side",
       powers(2.0, 5, 8),
       {"vsm", "msm", "msm:format=unorm16"},
       at_map_size},
      {"map_size", "texels along a side", powers(2.0, 5, 11), {"savsm"}, at_map_size},
  };
  return all;
}

/// Where rounding may take the answer across a step of its own, any answer is as good.
double bound_of(const render::Reference& exact, const Question& question) {
  constexpr double kStep = 0.5;
  // Between the extremes of rounding, at which the bound looks, an answer may be a little farther off.
  constexpr double kBetween = 1.05;
  const double bound = kBetween * exact.bound(question);
  return bound > kStep ? 1.0 : bound;
}

FilterRow row_at(const FilterStrain& strain, const std::string& filter, double value) {
  const Trial trial = strain.at(filter, value);
  FilterRow row;
  row.axis = strain.name;
  row.label = strain.label;
  row.filter = filter;
  row.value = value;
  const std::vector<float> answers = render::ask_shader(trial.settings, trial.map, trial.questions);
  const render::Reference exact(trial.settings, trial.map, render::Storing::exact);
  int beyond = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const double answer = answers[i];
    if (!(answer >= 0.0 && answer <= 1.0 + 1e-5)) row.within = false;
    const double error = std::abs(answer - exact.answer(trial.questions[i]));
    const double bound = bound_of(exact, trial.questions[i]);
    beyond += error > bound ? 1 : 0;
    row.error = std::max(row.error, error);
    row.bound = std::max(row.bound, bound);
  }
  row.beyond = static_cast<double>(beyond) / static_cast<double>(answers.size());
  return row;
}

}  // namespace

std::span<const FilterStrain> filter_strains() {
  return strains();
}

std::vector<FilterRow> sweep_filters(const FilterStrain& strain, const std::function<void()>& step) {
  std::vector<FilterRow> rows;
  for (const std::string& filter : strain.filters) {
    for (const double value : strain.values) rows.push_back(row_at(strain, filter, value));
    if (step) step();
  }
  return rows;
}

}  // namespace gnomon::stress
