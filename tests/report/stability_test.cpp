// Section 5 of the page: what gnomon stress writes, and what is not from it.
#include "stability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "gnomon/report/page.hpp"
#include "gnomon/report/row.hpp"
#include "gnomon/report/rows_file.hpp"
#include "sample_rows.hpp"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

std::string axis_line(const std::string& variant, double value, const std::string& used,
                      const std::string& absolute, int maps = 1) {
  return R"({"kind":"axis","axis":"ratio","label":"far over near","log":true,"variant":")" + variant +
         R"(","value":)" + std::to_string(value) + R"(,"status":"ok","finite":true,"maps":)" +
         std::to_string(maps) + R"(,"used":")" + used +
         R"(","left_out":"warp","error_texels":1e-9,"error_ulp":4,"drift_texels":1e-9,)"
         R"("float_absolute_texels":)" +
         absolute + R"(,"float_relative_texels":1e-4,"condition":20,"condition_world":30,"jump":null})" +
         "\n";
}

const std::string kCase =
    R"({"kind":"case","row":3,"name":"n","input":"<i>near</i>","required":"refused","verdict":"holds","found":""})"
    "\n";
const std::string kFilter =
    R"({"kind":"filter","axis":"exponent","label":"c","log":true,"filter":"esm","value":80,"error":0.001,)"
    R"("bound":0.01,"beyond":0,"within":true})"
    "\n";

std::string sample_text() {
  return axis_line("optimal", 100.0, "optimal", "2.5") + axis_line("optimal", 10.0, "none", "0.1") +
         axis_line("none", 10.0, "none", "0.2") + axis_line("optimal", 1000.0, "refused", "null", 0) + kCase +
         kFilter;
}

TEST(Stability, rows_are_gathered_by_axis_and_value) {
  const Stability stability = read_stability(sample_text() + R"({"kind":"unknown"})"
                                                             "\n",
                                             "here");
  ASSERT_EQ(stability.axes.size(), 1u);
  ASSERT_EQ(stability.axes[0].rows.size(), 4u);
  EXPECT_EQ(stability.axes[0].rows[0].value, 10.0);
  EXPECT_EQ(stability.axes[0].rows[3].value, 1000.0);
  EXPECT_TRUE(std::isinf(stability.axes[0].rows[3].worst.float_absolute_texels));
  EXPECT_TRUE(std::isnan(stability.axes[0].rows[0].jump));
  EXPECT_EQ(stability.cases.size(), 1u);
  EXPECT_EQ(stability.filters.size(), 1u);
}

TEST(Stability, a_last_row_without_an_end_counts_if_it_is_whole) {
  const std::string row = kCase.substr(0, kCase.size() - 1);
  EXPECT_EQ(read_stability(row, "here").cases.size(), 1u);
  EXPECT_EQ(read_stability(kCase + row.substr(0, row.size() / 2), "here").cases.size(), 1u);
}

TEST(Stability, numbers_that_are_no_whole_ones_are_refused_where_whole_ones_belong) {
  for (const char* row : {"1e300", "1.5", "4294967296", "-18446744073709551615", "true", "null"}) {
    const std::string line = std::string(R"({"kind":"case","row":)") + row +
                             R"(,"name":"n","input":"i","required":"refused","verdict":"holds","found":""})" +
                             "\n";
    EXPECT_THROW((void)read_stability(line, "file"), ReportError) << row;
  }
}

TEST(Stability, a_row_that_lacks_something_is_refused_by_line) {
  for (const auto& [line, why] : {std::pair{"{\"kind\":\"axis\"}\n", "not a row of gnomon stress"},
                                  {"{\"kind\":\"case\",\"row\":\"three\"}\n", "row: wants a whole number"}}) {
    try {
      (void)read_stability(kCase + line, "stability.jsonl");
      FAIL() << line;
    } catch (const ReportError& error) {
      EXPECT_EQ(std::string(error.what()), std::string("stability.jsonl:2: ") + why);
    }
  }
}

TEST(StabilityChart, marks_where_floats_pass_half_a_texel_and_where_something_else_is_used) {
  const Stability stability = read_stability(sample_text(), "here");
  const std::string chart = stability_chart(stability.axes[0]).standalone();
  EXPECT_NE(chart.find("float, absolute coordinates: more than half a texel from 100"), std::string::npos);
  EXPECT_EQ(chart.find("relative to the camera: more than"), std::string::npos);
  EXPECT_NE(chart.find("at 100: optimal instead of none"), std::string::npos);
  EXPECT_NE(chart.find("at 1000: refused instead of optimal"), std::string::npos);
  EXPECT_EQ(chart.find("nan"), std::string::npos);
  EXPECT_EQ(chart.find("inf"), std::string::npos);
}

TEST(StabilityChart, names_the_last_value_where_floats_fail_and_draws_no_line_over_one_without_maps) {
  const std::string text = axis_line("none", 1.0, "none", "0.1") + axis_line("none", 10.0, "none", "2.5") +
                           axis_line("none", 100.0, "none", "0.1") +
                           axis_line("none", 1000.0, "none", "null", 0) +
                           axis_line("none", 10000.0, "none", "0.2");
  const std::string chart = stability_chart(read_stability(text, "here").axes.at(0)).standalone();
  EXPECT_NE(chart.find("more than half a texel from 10<"), std::string::npos) << chart;
  EXPECT_NE(chart.find("more than half a texel up to 10<"), std::string::npos) << chart;
  EXPECT_EQ(count(chart, "class=\"line c"), 2u * 3u) << "two pieces of each line";
}

TEST(StabilitySection, shows_axes_cases_and_filters_with_names_as_text) {
  const TemporaryFolder folder;
  RowsFile(folder.path() / kRowsFile).append(sample_row());
  std::ofstream(folder.path() / "stability.jsonl") << sample_text();
  const std::string page = text_of(write_report(folder.path()));
  EXPECT_NE(page.find("<svg id=\"stability-0\""), std::string::npos);
  EXPECT_NE(page.find("<svg id=\"filter-limits-0\""), std::string::npos);
  EXPECT_NE(page.find("&lt;i&gt;near&lt;/i&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<i>near"), std::string::npos);
  EXPECT_EQ(count(page, "<section"), 7u);
  EXPECT_TRUE(fs::exists(folder.path() / "charts/stability_0.svg"));
  EXPECT_TRUE(fs::exists(folder.path() / "charts/filter_limits_0.svg"));
}

TEST(StabilitySection, of_a_folder_without_other_results_stands_alone) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "stability.jsonl") << sample_text();
  const std::string page = text_of(write_report(folder.path()));
  EXPECT_NE(page.find("0 techniques on 0 scenes"), std::string::npos);
  EXPECT_NE(page.find("<svg id=\"stability-0\""), std::string::npos);
}

TEST(StabilitySection, of_a_folder_that_has_none_says_so) {
  const TemporaryFolder folder;
  RowsFile(folder.path() / kRowsFile).append(sample_row());
  const std::string page = text_of(write_report(folder.path()));
  EXPECT_NE(page.find("Not measured: this folder has no stability.jsonl"), std::string::npos);
}

TEST(StabilitySection, shows_lines_from_elsewhere_as_they_are) {
  const TemporaryFolder folder;
  RowsFile(folder.path() / kRowsFile).append(sample_row());
  std::ofstream(folder.path() / "stability.jsonl") << "{\"what\":\"gap\",\"value\":0.25}\n";
  const std::string page = text_of(write_report(folder.path()));
  EXPECT_NE(page.find("<td>gap</td><td>0.25</td>"), std::string::npos);
}

}  // namespace
}  // namespace gnomon::report
