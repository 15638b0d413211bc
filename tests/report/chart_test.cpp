// Does a chart show all names of its legend, and tell their colours apart?
#include "chart.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <set>

namespace gnomon::report {
namespace {

Chart chart_of(std::size_t names) {
  Chart chart("title", {.label = "x"}, {.label = "y"});
  for (std::size_t i = 0; i < names; ++i) chart.legend_color("name " + std::to_string(i), i);
  return chart;
}

/// The last number that a pattern captures in a text.
double last_number(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  double last = -1.0;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), regex); it != std::sregex_iterator(); ++it)
    last = std::strtod((*it)[1].str().c_str(), nullptr);
  return last;
}

TEST(Chart, is_as_high_as_its_legend) {
  constexpr double kDescent = 4.0;
  for (const std::size_t names : {3u, 21u, 40u}) {
    const Chart chart = chart_of(names);
    for (const std::string& svg : {chart.standalone(), chart.embedded("id")}) {
      const double height = last_number(svg, "viewBox=\"0 0 [0-9.]+ ([0-9.]+)\"");
      EXPECT_GE(height, last_number(svg, "y=\"([0-9.]+)\">name ") + kDescent) << names;
    }
  }
}

TEST(Chart, colours_that_come_again_are_hollow) {
  std::set<std::string> classes;
  for (std::size_t color = 0; color < 2 * kColors; ++color) classes.insert(color_class(color));
  EXPECT_EQ(classes.size(), 2 * kColors);
  EXPECT_EQ(color_class(kColors), "c0 again");
  Chart chart = chart_of(kColors + 1);
  chart.line({{0.2, 0.2}, {0.5, 0.5}}, kColors, "line", "tip");
  const std::string svg = chart.standalone();
  EXPECT_NE(svg.find(".again{fill:#fff"), std::string::npos) << "files bring their own style";
  EXPECT_NE(svg.find("class=\"line c0 again\""), std::string::npos);
  EXPECT_NE(svg.find("class=\"key c0 again\""), std::string::npos);
}

TEST(Chart, long_names_are_squeezed_into_the_margin_and_longer_ones_cut) {
  Chart chart("title", {.label = "x"}, {.label = "y"});
  chart.legend_color("short", 0);
  chart.legend_color(std::string(45, 'm'), 1);
  chart.legend_mark(std::string(80, 'n'), 0);
  const std::string svg = chart.standalone();
  const double width = last_number(svg, "viewBox=\"0 0 ([0-9.]+) ");
  const std::regex squeezed("x=\"([0-9.]+)\" y=\"[0-9.]+\" textLength=\"([0-9.]+)\"");
  int count = 0;
  for (auto it = std::sregex_iterator(svg.begin(), svg.end(), squeezed); it != std::sregex_iterator();
       ++it, ++count)
    EXPECT_LE(std::strtod((*it)[1].str().c_str(), nullptr) + std::strtod((*it)[2].str().c_str(), nullptr),
              width);
  EXPECT_EQ(count, 2);
  EXPECT_NE(svg.find(">" + std::string(45, 'm') + "<"), std::string::npos);
  EXPECT_NE(svg.find(">" + std::string(49, 'n') + "\xE2\x80\xA6<"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::report
