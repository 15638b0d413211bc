// Do small pictures of the gallery order the filters as the filters' papers do?
#include <gtest/gtest.h>

#include "figures.hpp"
#include "render/shared_context.hpp"

namespace gnomon::tool {
namespace {

constexpr FigureSize kSmall{100, 75, 1024, 512, 2048};

TEST(FilterFigures, convolution_nears_the_truth_with_every_doubling_of_its_order) {
  const Figure figure = convolution_orders(kSmall);
  for (const char* way : {",attenuation=0,offset=1,scale=1.02", ",attenuation=0"}) {
    double before = 1.0;
    for (const int order : {1, 2, 4, 8, 16}) {
      const double error = figure.value("convolution:radius=2,order=" + std::to_string(order) + way);
      EXPECT_LT(error, before) << order << way;
      before = error;
    }
    EXPECT_LT(before, 0.5 * figure.value(std::string("convolution:radius=2,order=1") + way)) << way;
  }
}

TEST(FilterFigures, layers_and_warps_and_more_moments_bleed_less_than_two_moments) {
  const Figure figure = bleeding_bars(kSmall);
  constexpr std::size_t kLeaked = 1;
  const double two_moments = figure.value("vsm:radius=2,bleed=0", kLeaked);
  EXPECT_GT(two_moments, 0.01);
  EXPECT_LT(figure.value("lvsm:radius=2,bleed=0,format=fp32", kLeaked), 0.8 * two_moments);
  EXPECT_LT(figure.value("vsm:radius=2", kLeaked), two_moments);
  EXPECT_LT(figure.value("lvsm:radius=2", kLeaked), figure.value("vsm:radius=2", kLeaked));
  EXPECT_LT(figure.value("evsm4:radius=2", kLeaked), figure.value("vsm:radius=2", kLeaked));
  EXPECT_LT(figure.value("msm:radius=2", kLeaked), figure.value("vsm:radius=2", kLeaked));
}

TEST(FilterFigures, prefiltered_maps_shrink_where_comparisons_alias) {
  const Figure figure = minification(kSmall);
  constexpr std::size_t kFar = 2;  // 4 times the distance
  const double comparisons = figure.value("pcf:radius=1", kFar);
  EXPECT_LT(comparisons, figure.value("hard", kFar));
  EXPECT_LT(figure.value("vsm:radius=1,mipmap=1,anisotropy=16", kFar), 0.6 * comparisons);
  EXPECT_LT(figure.value("convolution:radius=1,mipmap=1,anisotropy=16", kFar), 0.6 * comparisons);
}

TEST(FilterFigures, a_trilinear_read_of_esm_is_worth_many_samples_under_a_high_sun) {
  const Figure figure = matching_samples(kSmall);
  const double esm = figure.value("esm:radius=1,mipmap=1,c=80,fallback=0");
  EXPECT_LT(esm, figure.value("pcf:pattern=1,radius=4,samples=1"));
  EXPECT_LT(esm, figure.value("pcf:pattern=1,radius=4,samples=4"));
}

/// Share of a picture's pixels that are marked as failed.
double red_share(const Image& image) {
  std::size_t red = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    red += image.rgba[i] == 230 && image.rgba[i + 1] == 30 && image.rgba[i + 2] == 30 ? 1 : 0;
  return static_cast<double>(red) / (static_cast<double>(image.rgba.size()) / 4.0);
}

TEST(FilterFigures, esm_fails_on_few_pixels_by_threshold_and_on_more_the_wider_the_blur) {
  const Figure figure = exponential_failures(kSmall);
  for (const char* scene : {"builtin:fence, ", "builtin:trees, "}) {
    EXPECT_LT(figure.value(scene + std::string("1x1")), figure.value(scene + std::string("7x7"))) << scene;
    EXPECT_LT(figure.value(scene + std::string("7x7")), 25.0) << scene;
  }
  // What is red in a picture is what its row counts, over the pixels that face the light.
  ASSERT_EQ(figure.panels.size(), 2 * figure.rows.size());
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const double percent = figure.rows[i / 2].values[i % 2];
    EXPECT_EQ(percent > 0.0, red_share(figure.panels[i].image) > 0.0) << figure.panels[i].caption;
    EXPECT_LE(100.0 * red_share(figure.panels[i].image), percent) << figure.panels[i].caption;
  }
}

TEST(FilterFigures, the_enlarged_part_is_where_pictures_differ_from_the_truth_by_most) {
  Figure figure;
  EXPECT_EQ(figure.worst_window().width, 0) << "nothing is compared";
  Panel panel;
  panel.image.width = 50;
  panel.image.height = 30;
  panel.off.assign(static_cast<std::size_t>(panel.image.width * panel.image.height), 0.01f);
  panel.off.at(20 * 50 + 42) = -1.0f;
  figure.panels.push_back(panel);
  const Figure::Window window = figure.worst_window();
  EXPECT_EQ(window.width, 10);
  EXPECT_EQ(window.height, 6);
  EXPECT_TRUE(window.x <= 42 && 42 < window.x + window.width) << window.x;
  EXPECT_TRUE(window.y <= 20 && 20 < window.y + window.height) << window.y;
}

TEST(FilterFigures, the_papers_power_law_closes_contacts_and_its_offset_serves_the_whole) {
  constexpr std::size_t kLeaked = 1;
  const Figure figure = contacts(kSmall);
  EXPECT_LT(figure.value("power_cdf:radius=2,offset=0", kLeaked),
            0.5 * figure.value("esm:radius=2", kLeaked));
  EXPECT_LT(figure.value("power_cdf:radius=2"), figure.value("power_cdf:radius=2,offset=0"));
}

TEST(FilterFigures, esm_takes_an_eighth_of_convolutions_memory) {
  EXPECT_EQ(memory_of_filters().value("esm, fp32", 1), 0.125);
}

}  // namespace
}  // namespace gnomon::tool
