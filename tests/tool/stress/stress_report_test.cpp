// From gnomon stress to section 5 of a page.
#include <gtest/gtest.h>

#include <fstream>

#include "process.hpp"

namespace gnomon::test {
namespace {

TEST(StressReport, is_made_of_what_gnomon_stress_wrote) {
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "stress").string();
  ASSERT_EQ(run_gnomon({"stress", "--cases", "--axis", "fov", "distance", "--samples", "4", "--out", out})
                .exit_code,
            0);
  const Finished run = run_gnomon({"report", out});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::ifstream in(out + "/report.html", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(page.find("<svg id=\"stability-1\""), std::string::npos);
  EXPECT_EQ(page.find("<svg id=\"stability-2\""), std::string::npos);
  EXPECT_NE(page.find("Extreme cases"), std::string::npos);
  EXPECT_EQ(page.find("Not measured here"), std::string::npos);
}

TEST(StressReport, shows_filters_at_their_limits_as_the_program_does) {
  const TemporaryFolder folder;
  const Finished run = run_gnomon({"stress", "--filters", "--out", folder.path().string()});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::vector<std::string> lines = run.lines();
  ASSERT_GT(lines.size(), 12u) << "a head, a rule, and a line for each parameter of each filter";
  EXPECT_TRUE(lines[0].starts_with("| parameter | filter |")) << lines[0];
  for (std::size_t i = 2; i < lines.size(); ++i) EXPECT_TRUE(lines[i].ends_with("| yes |")) << lines[i];
  ASSERT_EQ(run_gnomon({"report", folder.path().string()}).exit_code, 0);
  std::ifstream in(folder.path() / "report.html", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(page.find("Filters at their limits"), std::string::npos);
  const std::string chart = "<svg id=\"filter-limits-";
  EXPECT_NE(page.find(chart + std::to_string(lines.size() - 3)), std::string::npos)
      << "a chart for each line";
  EXPECT_EQ(page.find(chart + std::to_string(lines.size() - 2)), std::string::npos);
}

}  // namespace
}  // namespace gnomon::test
