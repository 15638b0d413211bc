// Files of measure_gpu: which rows are read, what is refused, and the columns of the page.
#include "page/gpu.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gnomon/report/gpu_files.hpp"
#include "gnomon/report/page.hpp"
#include "gnomon/report/row.hpp"

namespace gnomon::report {
namespace {

std::string machine(bool software, const std::string& renderer) {
  return R"({"part":"machine","cpu":"a processor","contexts":[{"software":)" +
         std::string(software ? "true" : "false") + R"(,"renderer":")" + renderer +
         R"(","version":"4.5","timer_queries":{"trusted":)" + (software ? "false" : "true") + "}}]}\n";
}

constexpr const char* kRows =
    R"({"part":"masks","what":"maps hard sun","pixels":100,"differ":0,"visibly":0,"other_map":0,"most":0}
{"part":"masks","what":"maps vsm sun","pixels":100,"differ":9,"visibly":5,"other_map":0,"most":0.25}
{"part":"filters","filter":"pcf","kernel":3,"map_size":1024,"width":1280,"height":720,"wall_ms":{"p50":2.5,"p99":3},"timer_ms":{"p50":2.25,"p99":2.5}}
{"part":"plans","line":"| a table |"}
{"part":"masks","ended":0,"seconds":3}
{"part":"filters","filter":"pcf","ker)";

TEST(GpuRuns, a_file_without_a_machine_is_refused) {
  EXPECT_THROW((void)read_gpu_run("", "a"), ReportError);
  EXPECT_THROW((void)read_gpu_run(kRows, "a"), ReportError);
}

TEST(GpuRuns, a_row_that_lacks_a_number_or_is_nested_too_deeply_is_refused_with_its_line) {
  for (const std::string& row : {std::string(R"({"part":"masks","what":"maps"})"), std::string(40, '[')}) {
    try {
      (void)read_gpu_run(machine(true, "m") + row + "\n", "a.jsonl");
      FAIL() << row;
    } catch (const ReportError& error) {
      EXPECT_NE(std::string(error.what()).find("a.jsonl:2: "), std::string::npos) << error.what();
    }
  }
}

TEST(GpuRuns, rows_are_counted_and_a_line_that_was_cut_off_is_skipped) {
  const GpuRun run = read_gpu_run(machine(false, "Card 1") + kRows, "a");
  EXPECT_EQ(run.device, "Card 1");
  const MaskCounts& maps = run.masks.at("maps");
  EXPECT_EQ(maps.masks, 2u);
  EXPECT_EQ(maps.equal, 1u);
  EXPECT_EQ(maps.visibly, 5u);
  EXPECT_EQ(maps.most, 0.25);
  ASSERT_EQ(run.wall.size(), 1u);
  EXPECT_EQ(run.wall.begin()->second.p50, 2.5);
}

TEST(GpuRuns, the_report_of_a_folder_without_other_rows_has_a_column_for_each_file) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "gpu_report";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::vector<std::filesystem::path> files{folder / "a.jsonl", folder / "b.jsonl"};
  std::ofstream(files[0]) << machine(true, "llvmpipe") << kRows;
  std::ofstream(files[1]) << machine(false, "Card <1>") << kRows;
  EXPECT_EQ(read_gpu_runs(folder).size(), 0u);
  add_gpu_files(folder, files);
  std::ifstream page(write_report(folder));
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  EXPECT_NE(html.find("<th scope=\"col\">software</th><th scope=\"col\">Card &lt;1&gt;</th>"),
            std::string::npos);
  EXPECT_NE(html.find("1 of 2 equal; 2.5 %; 0.25"), std::string::npos);
  EXPECT_NE(html.find("<td>2.5, 3</td><td>2.5, 3; timer 2.25, 2.5</td>"), std::string::npos);
}

TEST(GpuRuns, a_table_that_no_run_has_rows_for_is_not_announced) {
  const GpuRun machine_alone = read_gpu_run(machine(false, "Card 1"), "a");
  const std::string html = gpu_section({machine_alone});
  EXPECT_NE(html.find("Card 1"), std::string::npos);
  EXPECT_EQ(html.find("<table>"), std::string::npos);
  EXPECT_EQ(html.find("Times in milliseconds"), std::string::npos);
  EXPECT_NE(gpu_section({read_gpu_run(machine(false, "Card 1") + kRows, "a")}).find("Times in milliseconds"),
            std::string::npos);
}

}  // namespace
}  // namespace gnomon::report
