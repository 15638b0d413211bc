// Does `gnomon doctor` say what this machine and this build have?
#include <gtest/gtest.h>

#include <regex>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

TEST(Doctor, names_contexts_timers_and_packages) {
  const Finished finished = run_gnomon({"doctor"});
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  for (const char* word :
       {"context auto", "context osmesa", "context egl", "timer queries", "libembree-dev", "OpenGL 4.5"})
    EXPECT_NE(finished.out.find(word), std::string::npos) << word;
  EXPECT_EQ(run_gnomon({"doctor", "--json"}).lines().size(), 1u);
  const std::string first = finished.lines().at(0);
  EXPECT_TRUE(std::regex_search(first, std::regex(", load [0-9]+\\.[0-9]{2}$"))) << first;
}

}  // namespace
}  // namespace gnomon::test
