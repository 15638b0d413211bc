// Rows survive JSON, kills and shards.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <limits>

#include "file.hpp"
#include "gnomon/report/rows_file.hpp"
#include "sample_rows.hpp"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> lines_of(const std::vector<Row>& rows) {
  std::vector<std::string> lines;
  for (const Row& row : rows) lines.push_back(to_json_line(row));
  return lines;
}

TEST(Rows, come_back_from_json_as_they_were) {
  const Row row = sample_row(7);
  const std::string line = to_json_line(row);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(to_json_line(row_from_json(line, "here")), line);
  EXPECT_EQ(row_from_json(line, "here").technique, row.technique);
}

TEST(Rows, lengths_of_lists_come_back_where_there_are_lists) {
  Row row = sample_row();
  EXPECT_EQ(to_json_line(row).find("\"lists\""), std::string::npos);
  row.costs.lists = {2.5, 17, 40};
  const Row back = row_from_json(to_json_line(row), "here");
  EXPECT_EQ(back.costs.lists.mean, 2.5);
  EXPECT_EQ(back.costs.lists.p99, 17u);
  EXPECT_EQ(back.costs.lists.most, 40u);
}

TEST(Rows, what_a_plan_was_expected_to_misclassify_comes_back_where_it_is_known) {
  Row row = sample_row();
  EXPECT_FALSE(row_from_json(to_json_line(row), "here").expected_wrong);
  row.expected_wrong = 0.0125;
  EXPECT_EQ(row_from_json(to_json_line(row), "here").expected_wrong, row.expected_wrong);
}

TEST(Rows, errors_of_whole_pixels_come_back_and_other_numbers_of_rays_are_another_measurement) {
  Row row = sample_row();
  EXPECT_FALSE(row_from_json(to_json_line(row), "here").pixel);
  row.pixel = PixelErrors{50'000, 1200, 0.0321, 0.03, 0.048, 0.0475};
  row.times.baseline_again_ms = 6.25;
  const Row back = row_from_json(to_json_line(row), "here");
  EXPECT_EQ(back.pixel, row.pixel);
  EXPECT_EQ(back.times.baseline_again_ms, 6.25);
  EXPECT_EQ(back.pixel_samples, kPixelSamples);
  EXPECT_EQ(row.key().find("pixel_samples"), std::string::npos);
  Row finer = row;
  finer.pixel_samples = 64;
  EXPECT_NE(finer.key(), row.key());
  EXPECT_EQ(row_from_json(to_json_line(finer), "here").key(), finer.key());
}

TEST(Rows, a_moving_scene_comes_back_with_its_animation_and_instant) {
  Row row = sample_row();
  EXPECT_EQ(to_json_line(row).find("\"animation"), std::string::npos);
  row.animation = "Walk";
  row.animation_time_s = 1.25;
  for (const bool left_out : {true, false}) {
    if (!left_out) row.left_out.clear();
    const Row back = row_from_json(to_json_line(row), "here");
    EXPECT_EQ(back.animation, "Walk");
    EXPECT_EQ(back.animation_time_s, 1.25);
    EXPECT_EQ(to_json_line(back), to_json_line(row));
  }
}

TEST(Rows, infinite_aliasing_and_strange_names_survive) {
  Row row = sample_row();
  row.aliasing.max = std::numeric_limits<double>::infinity();
  row.scene = "a \"b\"\n\t</script> \xff";
  const Row back = row_from_json(to_json_line(row), "here");
  EXPECT_EQ(back.aliasing.max, row.aliasing.max);
  EXPECT_EQ(back.scene,
            "a \"b\"\n\t</script> \xEF\xBF\xBD");  // what is no UTF-8 becomes the replacement character
}

TEST(Rows, a_bad_line_is_refused_with_its_place) {
  const auto message = [](const std::string& line) {
    try {
      (void)row_from_json(line, "file:3");
    } catch (const ReportError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message("{").rfind("file:3: ", 0), 0u);
  EXPECT_EQ(message("{\"schema\":\"other\"}"), "file:3: schema 'other', wanted 'gnomon.compare.1'");
  EXPECT_NE(message("{\"schema\":\"gnomon.compare.1\"}").find("index"), std::string::npos);
}

TEST(Rows, hostile_lines_are_refused_with_one_line) {
  const std::string good = to_json_line(sample_row());
  const auto refused = [](const std::string& line, const std::string& why) {
    try {
      (void)rows_from_text(line + "\n", "file");
      ADD_FAILURE() << "accepted: " << line.substr(0, 80);
    } catch (const ReportError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.rfind("file:1: ", 0), 0u) << what;
      EXPECT_NE(what.find(why), std::string::npos) << what;
      EXPECT_EQ(what.find_first_of("\n\r\x1b"), std::string::npos) << what;
      EXPECT_LT(what.size(), 500u);
    }
  };
  const auto with = [&](const std::string& key, const std::string& value) {
    const std::size_t at = good.find("\"" + key + "\":") + key.size() + 3;
    return good.substr(0, at) + value + good.substr(good.find_first_of(",}", at));
  };
  refused(with("index", "-1"), "whole number");
  refused(with("index", "1.5"), "whole number");
  refused(with("frame", "4294967296"), "whole number");
  refused(with("map_size", "1e300"), "whole number");
  refused(with("pixels", "18446744073709551616"), "whole number");
  refused(with("false_lit", "1e31"), "beyond 1e30");
  refused(with("load", "\"\\u001b[31m\\n\""), "string");
  refused(with("schema", "\"\\n\\u001b[31m\""), "schema");
  refused(std::string(100, '[') + std::string(100, ']'), "nested deeper than 32");
  refused("\"" + std::string(2 << 20, 'x') + "\"", "longer than");
  EXPECT_EQ(rows_from_text(good + "\n", "file").size(), 1u);
}

/// While it lives, no file can be made longer than this, as if the disk were full.
class FullDisk {
 public:
  explicit FullDisk(std::size_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit less{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &less);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(RowsFile, a_disk_that_fills_up_is_an_error_and_costs_one_row) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / kRowsFile;
  const std::size_t row = to_json_line(sample_row(0)).size() + 1;
  {
    RowsFile out(file);
    const FullDisk full(row + row / 2);
    out.append(sample_row(0));
    EXPECT_THROW(out.append(sample_row(1)), ReportError);
  }
  EXPECT_EQ(read_rows(file).size(), 1u);
  RowsFile(file).append(sample_row(1));
  EXPECT_EQ(read_rows(file).size(), 2u);
}

TEST(RowsFile, a_disk_that_fills_up_at_any_byte_leaves_whole_rows) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / kRowsFile;
  const std::string row = to_json_line(sample_row(0)) + "\n";
  for (std::size_t room = 0; room < 3 * row.size(); room += 97) {
    fs::remove(file);
    {
      RowsFile out(file);
      const FullDisk full(room);
      std::size_t written = 0;
      EXPECT_THROW(for (;; ++written) out.append(sample_row(0)), ReportError);
      EXPECT_EQ(written, room / row.size());
    }
    std::string whole;
    for (std::size_t i = 0; i < room / row.size(); ++i) whole += row;
    EXPECT_EQ(text_of(file), whole) << room;
  }
}

TEST(RowsFile, a_second_writer_is_refused_until_the_first_is_gone) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / kRowsFile;
  const auto refusal = [&] {
    try {
      RowsFile second(file);
    } catch (const ReportError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  {
    RowsFile first(file);
    first.append(sample_row(0));
    EXPECT_EQ(refusal(), folder.path().string() + ": in use by process " + std::to_string(::getpid()));
    const std::vector<fs::path> folders{folder.path()};
    EXPECT_THROW(merge_rows(folders, folder.path()), ReportError) << "it would write over the first's rows";
    first.append(sample_row(1));
  }
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(read_rows(file).size(), 2u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1)
      << "nothing but the rows stays";
}

TEST(ResultsLock, ends_with_its_process_and_names_it_while_it_runs) {
  const TemporaryFolder folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const ResultsLock lock(folder.path());
    (void)!::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char x = 0;
  ASSERT_EQ(::read(ready[0], &x, 1), 1);
  try {
    const ResultsLock second(folder.path());
    ADD_FAILURE() << "two processes hold one folder";
  } catch (const ReportError& error) {
    EXPECT_NE(std::string(error.what()).find("in use by process " + std::to_string(child)), std::string::npos)
        << error.what();
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_NO_THROW(ResultsLock(folder.path()));
  for (const int end : ready) ::close(end);
}

TEST(ResultsLock, a_folder_that_is_not_there_is_named) {
  try {
    const ResultsLock lock("/nowhere/at/all");
    ADD_FAILURE() << "locked nothing";
  } catch (const ReportError& error) {
    EXPECT_EQ(std::string(error.what()),
              "/nowhere/at/all/results.lock: cannot be made: No such file or directory");
  }
}

TEST(RowsFile, a_page_that_finds_no_room_leaves_the_one_before_and_nothing_else) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "page";
  write_text(file, "before");
  {
    const FullDisk full(1000);
    EXPECT_THROW(write_text(file, std::string(5000, 'x')), ReportError);
  }
  EXPECT_EQ(text_of(file), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(RowsFile, a_file_is_written_where_a_link_leads_and_in_the_place_of_nothing_that_is_no_file) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "file", link = folder.path() / "link", pipe = folder.path() / "pipe",
                 nowhere = folder.path() / "nowhere";
  write_text(file, "before");
  fs::create_symlink(file, link);
  write_text(link, "after");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(text_of(file), "after");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(write_text(pipe, "text"), ReportError);
  EXPECT_TRUE(fs::is_fifo(pipe));
  fs::create_symlink(folder.path() / "not there", nowhere);
  EXPECT_THROW(write_text(nowhere, "text"), ReportError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 4);
}

TEST(RowsFile, a_device_is_no_file_of_rows) {
  EXPECT_THROW((void)read_rows("/dev/zero"), ReportError);
}

TEST(Rows, keys_distinguish_measurements_and_times_do_not_matter) {
  Row a = sample_row(), b = sample_row();
  b.times.total_ms.median = 99.0;
  b.machine.load = 7.0;
  EXPECT_EQ(a.key(), b.key());
  EXPECT_EQ(without_times(a), without_times(b));
  b.technique.filter = "pcf";
  EXPECT_NE(a.key(), b.key());
  EXPECT_NE(without_times(a), without_times(b));
}

TEST(RowsFile, a_line_cut_short_by_a_kill_is_dropped_and_written_again) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / kRowsFile;
  {
    RowsFile out(file);
    out.append(sample_row(0));
    out.append(sample_row(1));
  }
  const std::string whole = text_of(file);
  for (const std::size_t cut : {whole.size() - 1, whole.size() - 10, whole.size() / 2 + 1}) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, cut);
    EXPECT_EQ(read_rows(file).size(), 1u) << cut;
    RowsFile(file).append(sample_row(1));
    EXPECT_EQ(text_of(file), whole) << cut;
  }
}

TEST(RowsFile, torn_lines_are_skipped_with_one_warning_and_other_bad_ones_refused) {
  const std::string row = to_json_line(sample_row(0)) + "\n";
  const auto read = [](const std::string& text) {
    std::vector<std::string> warnings;
    const std::size_t rows = rows_from_text(text, "file", &warnings).size();
    EXPECT_LE(warnings.size(), 1u);
    return std::to_string(rows) + (warnings.empty() ? "" : " " + warnings[0]);
  };
  const std::string half = row.substr(0, row.size() / 2);
  EXPECT_EQ(read(row + row), "2");
  EXPECT_EQ(read(row + half), "1 file:2: a row is not whole and was skipped");
  EXPECT_EQ(read(half + row + row), "1 file:1: a row is not whole and was skipped")
      << "two rows run together";
  EXPECT_EQ(read(row + half + "\n" + row + row.substr(100) + std::string(50, '\0')),
            "2 file:2: the first of 3 rows that are not whole and were skipped");
  EXPECT_EQ(read(half), "0 file:1: a row is not whole and was skipped") << "killed in the first row";
  EXPECT_EQ(rows_from_text(row + half + "\n", "file").size(), 1u) << "nobody wants the warnings";
  EXPECT_THROW((void)read(row + "{}\n"), ReportError) << "whole, and no row";
  EXPECT_THROW((void)read("name,value\n1,2\n"), ReportError) << "no file of rows at all";
}

TEST(RowsFile, a_file_that_cannot_be_opened_is_named) {
  EXPECT_THROW(RowsFile("/nowhere/at/all.jsonl"), ReportError);
  EXPECT_THROW((void)read_rows("/nowhere/at/all.jsonl"), ReportError);
}

TEST(Merge, shards_are_the_whole_row_for_row) {
  const TemporaryFolder folder;
  const std::vector<Row> rows = sample_rows(2, 5);
  std::vector<fs::path> shards;
  for (std::size_t shard = 0; shard < 3; ++shard) {
    shards.push_back(folder.path() / std::to_string(shard));
    fs::create_directories(shards.back());
    RowsFile out(shards.back() / kRowsFile);
    for (const Row& row : rows) {
      if (row.index % 3 == shard) out.append(row);
    }
  }
  shards.push_back(shards[1]);  // once more: a row counts once
  const fs::path out = folder.path() / "whole";
  EXPECT_EQ(merge_rows(shards, out), rows.size());
  EXPECT_EQ(lines_of(read_rows(out)), lines_of(rows));
}

TEST(Merge, rows_from_before_files_were_hashed_join_others) {
  const TemporaryFolder folder;
  std::vector<fs::path> shards;
  const char* const hashes[] = {"0123456789abcdef", "", "fedcba9876543210"};
  for (std::size_t i = 0; i < 3; ++i) {
    shards.push_back(folder.path() / std::to_string(i));
    fs::create_directories(shards.back());
    Row row = sample_row(i);
    row.scene_hash = hashes[i];
    RowsFile(shards.back() / kRowsFile).append(row);
  }
  EXPECT_EQ(merge_rows(std::span(shards).first(2), folder.path() / "out"), 2u);
  EXPECT_THROW(merge_rows(shards, folder.path() / "none"), ReportError) << "the scene has changed";
}

TEST(Merge, pictures_come_along) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "a/pictures");
  const std::string picture = "\x89PNG\r\n\x1a\npicture";
  std::ofstream(folder.path() / "a/pictures/x.png", std::ios::binary) << picture;
  Row row = sample_row();
  row.pictures.mask = "pictures/x.png";
  RowsFile(folder.path() / "a" / kRowsFile).append(row);
  const std::vector<fs::path> shards{folder.path() / "a"};
  merge_rows(shards, folder.path() / "out");
  EXPECT_EQ(text_of(folder.path() / "out/pictures/x.png"), picture);
}

TEST(Merge, a_picture_outside_of_its_folder_is_refused) {
  const TemporaryFolder folder;
  for (const char* name : {"../x.png", "/etc/passwd", "a/../../x.png"}) {
    fs::create_directories(folder.path() / "a");
    fs::remove(folder.path() / "a" / kRowsFile);
    Row row = sample_row();
    row.pictures.mask = name;
    RowsFile(folder.path() / "a" / kRowsFile).append(row);
    const std::vector<fs::path> shards{folder.path() / "a"};
    EXPECT_THROW(merge_rows(shards, folder.path() / "out"), ReportError) << name;
  }
}

}  // namespace
}  // namespace gnomon::report
