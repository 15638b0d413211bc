// Revectorized edges: lines through steps, corners that stay, the same on GPU and CPU.
#include <gtest/gtest.h>

#include <cmath>

#include "filter_harness.hpp"

namespace gnomon::render {
namespace {

constexpr double kStored = 0.25, kReceiver = 0.5;

/// Dark where `dark` says so, by texel.
template <typename Dark>
FilterLookup map_of(Dark dark, const glm::dvec2& position) {
  FilterLookup lookup;
  lookup.map_depth = [dark](int x, int y) { return dark(x, y) ? kStored : 1.0; };
  lookup.position = position;
  lookup.depth = kReceiver;
  return lookup;
}

bool lit(const FilterLookup& lookup) {
  return filters::revectorized.reference.visibility({}, lookup, default_settings(filters::revectorized)) >
         0.5;
}

/// Share of points in a square of texels on the wrong side of the line y = x slope, below which it is dark.
double wrong_share(double slope, const Filter& filter) {
  const auto dark = [slope](int x, int y) { return y + 0.5 < slope * (x + 0.5); };
  int wrong = 0, all = 0;
  for (double y = -8.0; y < 8.0; y += 0.0625) {
    for (double x = -16.0; x < 16.0; x += 0.0625) {
      const glm::dvec2 place{x + 0.03125, y + 0.03125};
      const double lit = filter.reference.visibility({}, map_of(dark, place), default_settings(filter));
      const double away = std::abs(place.y - slope * place.x) / std::sqrt(1.0 + slope * slope);
      if (away > 1.0) continue;
      ++all;
      wrong += (lit > 0.5) != (place.y >= slope * place.x) ? 1 : 0;
    }
  }
  EXPECT_GT(all, 1000);
  return 1.0 * wrong / all;
}

TEST(RevectorizedFilter, is_at_most_half_as_wrong_as_hard_comparisons_along_straight_edges) {
  for (const double slope : {0.2, 0.25, 0.37, 0.5, 0.8, 1.3, 2.0, 3.1, 5.0, -0.3, -2.5}) {
    const double hard = wrong_share(slope, filters::hard);
    EXPECT_GT(hard, 0.08) << slope;
    EXPECT_LT(wrong_share(slope, filters::revectorized), 0.5 * hard) << slope;
  }
}

TEST(RevectorizedFilter, keeps_edges_along_texels_and_corners_of_boxes) {
  const auto box = [](int x, int y) { return x >= 0 && x < 6 && y >= 0 && y < 4; };
  for (double y = -3.0; y < 7.0; y += 0.125) {
    for (double x = -3.0; x < 9.0; x += 0.125) {
      const glm::dvec2 place{x + 0.0625, y + 0.0625};
      const bool inside = box(static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
      EXPECT_EQ(lit(map_of(box, place)), !inside) << place.x << " " << place.y;
    }
  }
}

TEST(RevectorizedFilter, gives_both_sides_of_an_outline_one_line) {
  // A step of one texel over runs of four: the line through the middles of the steps, exactly.
  const auto dark = [](int x, int y) { return y < std::floor(x / 4.0); };
  for (double y = -2.0; y < 2.0; y += 0.0625) {
    for (double x = -8.0; x < 8.0; x += 0.0625) {
      const glm::dvec2 place{x + 0.03125, y + 0.03125};
      // Steps at multiples of 4, between row x / 4 - 1 and x / 4: their middles lie on x / 4 - 1/2.
      EXPECT_EQ(lit(map_of(dark, place)), place.y >= place.x / 4.0 - 0.5) << place.x << " " << place.y;
    }
  }
}

TEST(RevectorizedFilter, returns_the_same_on_gpu_and_cpu) {
  TestMap map = random_map(64, 48, 3);
  // Random texels have no runs: slanted edges have.
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if ((y + 0.5) < 0.31 * (x + 0.5) || (x > 40 && y > 30 && x + 3 * y < 180))
        map.depth[static_cast<std::size_t>(y * map.width + x)] = 0.125f;
      else if (x < 50)
        map.depth[static_cast<std::size_t>(y * map.width + x)] = 0.875f;
    }
  }
  const std::vector<Question> questions = random_questions(map, 4096, 4);
  const FilterSettings settings = default_settings(filters::revectorized);
  const FilterSettings hard = default_settings(filters::hard);
  const std::vector<float> gpu = ask_shader(settings, map, questions);
  const std::vector<double> cpu = ask_reference(settings, map, questions),
                            unlined = ask_reference(hard, map, questions);
  int moved = 0;
  for (std::size_t i = 0; i < gpu.size(); ++i) {
    ASSERT_EQ(gpu[i], static_cast<float>(cpu[i]))
        << i << ": " << questions[i].position.x << " " << questions[i].position.y;
    moved += cpu[i] != unlined[i] ? 1 : 0;
  }
  EXPECT_GT(moved, 20);
}

TEST(RevectorizedFilter, reads_no_further_than_it_says) {
  PlanOptions options;
  set_margin(default_settings(filters::revectorized), options);
  FilterLookup lookup;
  double farthest = 0.0;
  lookup.depth = kReceiver;
  lookup.map_depth = [&](int x, int y) {
    const double away =
        std::max(std::abs(x + 0.5 - lookup.position.x), std::abs(y + 0.5 - lookup.position.y));
    EXPECT_LE(away, options.filter.texels);
    farthest = std::max(farthest, away);
    return y < 10 ? kStored : 1.0;
  };
  for (double x = 30.0; x < 31.0; x += 0.09) {
    lookup.position = {x, 10.01};
    EXPECT_TRUE(lit(lookup));
  }
  EXPECT_GT(farthest, 8.0);
}

}  // namespace
}  // namespace gnomon::render
