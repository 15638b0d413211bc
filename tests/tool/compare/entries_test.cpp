// `gnomon compare --entry` and `--exact`: techniques of others by the same errors, and rays that are kept.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "compare/exact_results.hpp"
#include "compare/mask_file.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

using nlohmann::json;

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The small sweep with its masks, once for all tests.
const fs::path& with_masks() {
  static const TemporaryFolder folder;
  static const fs::path out = [] {
    const fs::path path = folder.path() / "out";
    const Finished finished = spawn_gnomon(small_sweep(path, {"--write-masks"}));
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return path;
  }();
  return out;
}

/// Two techniques beside entries, on the frames of the small sweep.
Finished beside(const fs::path& out, const std::vector<std::string>& entries,
                const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"compare",     "builtin:fence", "--warps",  "none", "--cascades", "1",
                                 "--filters",   "hard",          "--frames", "2",    "--size",     "64x36",
                                 "--map-sizes", "128",           "--rounds", "1",    "--context",  "osmesa",
                                 "--out",       out.string(),    "--entry"};
  words.insert(words.end(), entries.begin(), entries.end());
  words.insert(words.end(), more.begin(), more.end());
  return spawn_gnomon(words);
}

TEST(Entries, masks_written_by_gnomon_have_the_errors_of_the_rows_they_came_from) {
  const std::vector<report::Row> sources = report::read_rows(with_masks());
  const TemporaryFolder folder;
  std::vector<std::string> entries;
  for (int i = 0; i < 4; ++i)
    entries.push_back("t" + std::to_string(i) + "=" +
                      (with_masks() / "masks" / ("technique" + std::to_string(i))).string());
  const Finished finished = beside(folder.path() / "out", entries);
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path() / "out");
  ASSERT_EQ(rows.size(), 10u);
  int compared = 0, twinkles = 0;
  for (const report::Row& row : rows) {
    if (row.technique.entry.empty()) continue;
    EXPECT_TRUE(row.is_masks());
    const auto number = static_cast<std::size_t>(row.technique.entry[1] - '0');
    const report::Row& source = sources.at(4 * static_cast<std::size_t>(row.frame) + number);
    ASSERT_EQ(source.frame, row.frame);
    ++compared;
    EXPECT_EQ(row.errors.pixels, source.errors.pixels);
    EXPECT_EQ(row.errors.false_lit, source.errors.false_lit);
    EXPECT_EQ(row.errors.false_shadow, source.errors.false_shadow);
    EXPECT_EQ(row.undecided_pixels, source.undecided_pixels);
    EXPECT_EQ(row.flips, source.flips);
    EXPECT_TRUE(row.pixel == source.pixel);
    EXPECT_EQ(row.times.total_ms, source.times.total_ms);
    EXPECT_EQ(row.truth, "none");
    twinkles += source.pixel->twinkle > 0.0 && source.flips != source.pixel->twinkle ? 1 : 0;
  }
  EXPECT_EQ(compared, 8);
  EXPECT_GT(twinkles, 0) << "both kinds of motion must show";
}

TEST(Entries, what_others_do_not_hand_in_is_not_measured) {
  const TemporaryFolder folder;
  const fs::path given = folder.path() / "given";
  fs::create_directories(given);
  std::ofstream list(given / "masks.jsonl");
  const std::string lines = content_of(with_masks() / "masks/technique0/masks.jsonl");
  for (std::size_t begin = 0, end; (end = lines.find('\n', begin)) != std::string::npos; begin = end + 1) {
    json line = json::parse(lines.substr(begin, end - begin));
    fs::copy(with_masks() / "masks/technique0" / line["mask"].get<std::string>(), given);
    for (const char* key : {"mask_before", "mask_moved", "ms"}) line.erase(key);
    list << line.dump() << "\n";
  }
  list.close();
  const Finished finished = beside(folder.path() / "out", {"lean=" + given.string()});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  int found = 0;
  for (const report::Row& row : report::read_rows(folder.path() / "out")) {
    if (row.technique.entry != "lean") continue;
    ++found;
    EXPECT_GT(row.errors.pixels, 0u);
    EXPECT_TRUE(std::isnan(row.flips));
    EXPECT_TRUE(std::isnan(row.pixel->twinkle));
    EXPECT_EQ(row.times.total_ms.median, 0.0);
  }
  EXPECT_EQ(found, 2);
  EXPECT_NE(content_of(folder.path() / "out/fronts.md").find("lean / masks"), std::string::npos)
      << "it has an error, and no place on a front";
}

TEST(Entries, flicker_is_of_the_mask_that_moved_and_twinkling_of_the_one_before) {
  const TemporaryFolder folder;
  const fs::path given = folder.path() / "given";
  fs::copy(with_masks() / "masks/technique0", given);
  const std::string lines = content_of(given / "masks.jsonl");
  std::ofstream list(given / "masks.jsonl");
  for (std::size_t begin = 0, end; (end = lines.find('\n', begin)) != std::string::npos; begin = end + 1) {
    json line = json::parse(lines.substr(begin, end - begin));
    line["mask_moved"] = line["mask"];
    list << line.dump() << "\n";
  }
  list.close();
  ASSERT_EQ(beside(folder.path() / "out", {"still=" + given.string()}).exit_code, 0);
  double twinkling = 0.0;
  for (const report::Row& row : report::read_rows(folder.path() / "out")) {
    if (row.technique.entry != "still") continue;
    EXPECT_EQ(row.flips, 0.0);
    twinkling += row.pixel->twinkle;
  }
  EXPECT_GT(twinkling, 0.0);
}

TEST(Entries, what_is_wrong_is_named_and_the_rest_is_measured) {
  const TemporaryFolder folder;
  const auto broken = [&](const std::string& name, const auto& change) {
    const fs::path to = folder.path() / name;
    fs::copy(with_masks() / "masks/technique0", to);
    change(to);
    return name + "=" + to.string();
  };
  const auto overwrite = [](const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Finished finished = beside(
      folder.path() / "out",
      {broken("size", [&](const fs::path& f) { tool::write_mask(f / "0.pfm", std::vector<float>(4), 2, 2); }),
       broken("nan",
              [&](const fs::path& f) {
                tool::write_mask(f / "0.pfm", std::vector<float>(64 * 36, nan), 64, 36);
              }),
       broken("beyond",
              [&](const fs::path& f) {
                tool::write_mask(f / "4.pfm", std::vector<float>(64 * 36, 1.5f), 64, 36);
              }),
       broken("cut", [&](const fs::path& f) { overwrite(f / "0.pfm", "Pf\n64 36\n-1.0\nabc"); }),
       broken("lost", [&](const fs::path& f) { fs::remove(f / "4.pfm"); }),
       broken("short",
              [&](const fs::path& f) {
                const std::string lines = content_of(f / "masks.jsonl");
                overwrite(f / "masks.jsonl", lines.substr(0, lines.find('\n') + 1));
              }),
       broken("list", [&](const fs::path& f) { overwrite(f / "masks.jsonl", "{\n"); }),
       broken("out",
              [&](const fs::path& f) {
                std::string lines = content_of(f / "masks.jsonl");
                lines.replace(lines.find("\"0.pfm\""), 7, "\"../x\"");
                overwrite(f / "masks.jsonl", lines);
              }),
       "nowhere=" + (folder.path() / "nowhere").string(), "light=" GNOMON_CAPTURES "/three_csm.json",
       "spot=" GNOMON_CAPTURES "/three_spot.json"});
  EXPECT_EQ(finished.exit_code, 1);
  const char* const lines[] = {
      "entry size, builtin:fence: 0.pfm: is 2x2 pixels, and the frame is 64x36; it is not measured",
      "entry nan, builtin:fence: 0.pfm: pixel 0,0 is not a number",
      "entry beyond, builtin:fence: 4.pfm: pixel 0,0 is 1.5",
      "entry cut, builtin:fence: 0.pfm: has another number of values than pixels",
      "entry lost, builtin:fence: 4.pfm: cannot be read",
      "entry short, builtin:fence: has no mask of frame 1 of 2",
      "entry list: ",
      "entry out, builtin:fence: ../x: is no file below the entry's folder",
      "entry nowhere: ",
      "entry light, builtin:fence: its maps are of another light",
      "entry spot: "};
  for (const char* line : lines)
    EXPECT_NE(finished.err.find(line), std::string::npos) << line << "\n" << finished.err;
  EXPECT_EQ(message_lines(finished.err), std::ssize(lines)) << finished.err;
  EXPECT_EQ(report::read_rows(folder.path() / "out").size(), 2u);
  EXPECT_TRUE(fs::exists(folder.path() / "out/report.html"));
}

TEST(Entries, a_capture_has_the_misclassified_pixels_that_judge_finds) {
  const TemporaryFolder folder;
  for (const char* name : {"three_csm", "babylon_cascades"}) {
    json capture = json::parse(content_of(GNOMON_CAPTURES "/" + std::string(name) + ".json"));
    capture["frames"] = json::array({capture["frames"][3]});
    const fs::path one = folder.path() / (std::string(name) + ".json");
    std::ofstream(one) << capture.dump();
    const fs::path out = folder.path() / name;
    const Finished finished = spawn_gnomon(
        {"compare",   "builtin:street", "--capture",       one.string(), "--entry",     "it=" + one.string(),
         "--warps",   "none",           "--cascades",      "4",          "--map-sizes", "1024",
         "--filters", "hard",           "--frames",        "1",          "--rounds",    "1",
         "--size",    "960x540",        "--pixel-samples", "0",          "--context",   "osmesa",
         "--out",     out.string()});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const std::vector<report::Row> rows = report::read_rows(out);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1].technique.name(), "it / 4 x 1024 / hard");
    EXPECT_GT(rows[1].errors.false_lit + rows[1].errors.false_shadow,
              rows[0].errors.false_lit + rows[0].errors.false_shadow);
    EXPECT_LT(rows[1].errors.false_lit + rows[1].errors.false_shadow, 0.01);
    // Its reader of captures takes right-handed worlds alone.
    if (std::string(name) != "three_csm") continue;
    const Finished judged =
        spawn_gnomon({"judge", one.string(), "builtin:street", "--context", "osmesa", "--json"});
    ASSERT_EQ(judged.exit_code, 0) << judged.err;
    const json drawn = json::parse(judged.out)["lights"][0]["drawn"];
    EXPECT_EQ(drawn["pixels"], rows[1].errors.pixels);
    EXPECT_EQ(drawn["capture"]["false_light"], rows[1].errors.false_lit);
    EXPECT_EQ(drawn["capture"]["false_shadow"], rows[1].errors.false_shadow);
  }
}

TEST(ExactResults, values_come_back_to_the_last_bit) {
  std::vector<float> many,
      few{0.0f, -1.0f, 0.0625f, -0.0f, std::numeric_limits<float>::quiet_NaN(), 1.0f, 1.0f};
  for (int i = 0; i < 5000; ++i) many.push_back(static_cast<float>(i % 1000) / 977.0f);
  for (const std::vector<float>& values : {few, many, std::vector<float>(3000, 1.0f)}) {
    const std::string bytes = tool::packed(values);
    std::vector<float> back;
    EXPECT_EQ(tool::unpack(bytes, values.size(), back), "");
    ASSERT_EQ(back.size(), values.size());
    EXPECT_EQ(std::memcmp(back.data(), values.data(), values.size() * sizeof(float)), 0);
    EXPECT_NE(tool::unpack(bytes, values.size() + 1, back), "");
    for (std::size_t at = 0; at < bytes.size(); at += 7) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
      EXPECT_NE(tool::unpack(damaged, values.size(), back), "") << at;
      EXPECT_NE(tool::unpack(bytes.substr(0, at), values.size(), back), "") << at;
    }
  }
  EXPECT_LT(tool::packed(few.size() > 0 ? std::vector<float>(32400, 1.0f) : few).size(), 400u);
}

TEST(ExactResults, rows_are_the_same_without_with_new_and_with_kept_ones) {
  const TemporaryFolder folder;
  const fs::path kept = folder.path() / "exact";
  const auto rows = [&](const std::string& name, const std::string& exact, std::string* err = nullptr) {
    const Finished finished = spawn_gnomon(small_sweep(folder.path() / name, {"--exact", exact}));
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    if (err != nullptr) *err = finished.err;
    return lasting(folder.path() / name);
  };
  const std::vector<std::string> without = rows("without", "none");
  EXPECT_FALSE(fs::exists(kept));
  EXPECT_EQ(rows("first", kept.string()), without);
  std::map<fs::path, fs::file_time_type> written;
  for (const auto& file : fs::directory_iterator(kept)) written[file.path()] = file.last_write_time();
  EXPECT_GT(written.size(), 8u);
  EXPECT_EQ(rows("second", kept.string()), without);
  for (const auto& file : fs::directory_iterator(kept))
    EXPECT_EQ(written.at(file.path()), file.last_write_time());
  // A file that is damaged is named, and made again as it was.
  const fs::path victim = written.begin()->first;
  const std::string before = content_of(victim);
  std::ofstream(victim, std::ios::binary) << before.substr(0, before.size() / 2);
  std::string err;
  EXPECT_EQ(rows("third", kept.string(), &err), without);
  EXPECT_NE(err.find(victim.filename().string() + ": is damaged; it is made again"), std::string::npos)
      << err;
  EXPECT_EQ(message_lines(err), 1) << err;
  EXPECT_EQ(content_of(victim), before);
}

}  // namespace
}  // namespace gnomon::test
