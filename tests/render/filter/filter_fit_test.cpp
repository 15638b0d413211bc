// Does a filter keep its answers where it stores less, on maps that one can see through and on random ones?
#include "gnomon/render/filter_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace gnomon::render {
namespace {

constexpr int kSide = 64;

/// A slanted ground with boxes of one height each over it, in depths from 0.1 to 0.95.
DrawnDepths street(std::uint64_t seed, int boxes) {
  Random random(seed);
  DrawnDepths map{{}, kSide, kSide, 1.5, 0.002};
  const double slope = random.between(0.0, 0.002);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) map.depths.push_back(static_cast<float>(0.8 + slope * x));
  for (int i = 0; i < boxes; ++i) {
    const int left = random.pick(kSide), top = random.pick(kSide), side = 2 + random.pick(16);
    const double depth = random.between(0.1, 0.7);
    for (int y = top; y < std::min(top + side, kSide); ++y)
      for (int x = left; x < std::min(left + side, kSide); ++x) {
        float& texel = map.depths[static_cast<std::size_t>(y * kSide + x)];
        texel = std::min(texel, static_cast<float>(depth));
      }
  }
  return map;
}

FilterSettings settings_of(const char* text) {
  return parse_filter(text).settings;
}

TEST(FilterFit, maps_without_depths_and_filters_that_store_none_decide_nothing) {
  DrawnDepths empty{std::vector<float>(16, 1.0f), 4, 4, 1.5, 0.0};
  for (const Filter* filter : all_filters()) {
    const FilterSettings full = default_settings(*filter);
    for (const std::vector<DrawnDepths>& maps : {std::vector<DrawnDepths>{}, std::vector{empty}}) {
      const FilterFit fit = fit_filter(full, maps);
      EXPECT_EQ(fit.receivers, 0) << filter->info.name;
      EXPECT_FALSE(fit.saves()) << filter->info.name;
      EXPECT_EQ(to_string(fit.settings), to_string(full));
      EXPECT_EQ(describe(fit, full), "");
    }
    if (filter->info.formats.empty()) {
      EXPECT_EQ(fit_filter(full, std::vector{street(1, 8)}).receivers, 0) << filter->info.name;
    }
  }
}

TEST(FilterFit, one_flat_depth_needs_one_layer) {
  const std::vector<DrawnDepths> flat{{std::vector<float>(kSide * kSide, 0.4f), kSide, kSide, 1.5, 0.01}};
  const FilterFit fit = fit_filter(settings_of("lvsm:layers=8"), flat);
  EXPECT_EQ(fit.settings.value("layers"), 1.0);
  EXPECT_EQ(fit.channels, 2);
  EXPECT_EQ(fit.full_channels, 16);
  EXPECT_LE(fit.error, 0.5 / 255);
  EXPECT_NE(describe(fit, settings_of("lvsm:layers=8")).find("lvsm:layers=1"), std::string::npos);
}

TEST(FilterFit, results_stay_within_the_bound_and_a_looser_bound_takes_no_more_bytes) {
  int saving = 0, kept = 0;
  for (const Filter* filter : all_filters()) {
    const FilterSettings full = default_settings(*filter);
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const std::vector<DrawnDepths> maps{street(seed, static_cast<int>(seed) * 3)};
      double bytes = 1e9;
      for (const double bound : {0.5 / 255, 4.0 / 255, 1.0}) {
        const FilterFit fit = fit_filter(full, maps, {.bound = bound});
        EXPECT_LE(fit.error, bound) << filter->info.name << ' ' << seed;
        EXPECT_LE(fit.bytes, bytes) << filter->info.name << ": a looser bound takes no more";
        bytes = fit.bytes;
        (fit.saves() ? saving : kept) += 1;
      }
    }
  }
  EXPECT_GT(saving, 20);
  EXPECT_GT(kept, 20);
}

TEST(FilterFit, settings_of_the_fewest_bytes_stay) {
  int kept = 0;
  for (const Filter* filter : all_filters()) {
    for (const TexelFormat format : filter->info.formats) {
      FilterSettings full = default_settings(*filter);
      full.format = format;
      const FilterFit fit = fit_filter(full, std::vector{street(1, 6)}, {.bound = 1.0});
      if (fit.saves()) continue;
      EXPECT_EQ(to_string(fit.settings), to_string(full));
      ++kept;
    }
  }
  EXPECT_GT(kept, 3);
}

TEST(FilterFit, exceptions_let_so_many_receivers_differ_by_more) {
  const std::vector<DrawnDepths> maps{street(1, 9)};
  const FilterSettings full = settings_of("lvsm:layers=8");
  const FilterFit strict = fit_filter(full, maps), lax = fit_filter(full, maps, {.exceptions = 0.5});
  EXPECT_EQ(strict.exceeding, 0.0);
  EXPECT_LT(lax.bytes, strict.bytes);
  EXPECT_GT(lax.exceeding, 0.0);
  EXPECT_LE(lax.exceeding, 0.5);
  EXPECT_GT(lax.error, 0.5 / 255);
}

TEST(FilterFit, a_simpler_filter_takes_over_the_options_that_it_shares) {
  const FilterSettings full = settings_of("evsm4:c=30,bleed=0.2,radius=2");
  const FilterFit fit = fit_filter(full, std::vector{street(1, 9)}, {.bound = 1.0});
  EXPECT_EQ(fit.settings.filter->info.name, "evsm2");
  EXPECT_EQ(fit.settings.radius, 2.0);
  EXPECT_EQ(fit.settings.value("bleed"), 0.2);
}

TEST(FilterFit, the_same_maps_give_the_same_settings) {
  const std::vector<DrawnDepths> maps{street(3, 9), street(4, 2)};
  for (const Filter* filter : all_filters()) {
    const FilterFit a = fit_filter(default_settings(*filter), maps),
                    b = fit_filter(default_settings(*filter), maps);
    EXPECT_EQ(to_string(a.settings), to_string(b.settings));
    EXPECT_EQ(a.error, b.error);
  }
}

}  // namespace
}  // namespace gnomon::render
