// Does `gnomon scenes` list and write what it can, and say where it cannot?
#include <gtest/gtest.h>

#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

TEST(Scenes, are_listed_where_the_output_takes_them_and_written_to_files_alone) {
  EXPECT_EQ(run_gnomon({"scenes"}, "", "/dev/full").exit_code, 2);
  const TemporaryFolder folder;
  const Finished refused = run_gnomon({"scenes", "--write", "city", folder.path().string()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("cannot be written: Is a directory"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace gnomon::test
