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

}  // namespace
}  // namespace gnomon::test
