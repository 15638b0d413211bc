// The page and its files, as text: hashes, escapes, charts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "chart.hpp"
#include "charts.hpp"
#include "front_table.hpp"
#include "gnomon/report/csv.hpp"
#include "gnomon/report/page.hpp"
#include "gnomon/report/rows_file.hpp"
#include "latex.hpp"
#include "reported.hpp"
#include "sample_rows.hpp"
#include "summary.hpp"
#include "text.hpp"
#include "waterfall.hpp"

namespace gnomon::report {
namespace {

namespace fs = std::filesystem;

TEST(FrontTable, has_the_front_by_time_and_behind_it_the_best_of_each_other_filter) {
  std::vector<Row> rows(4, sample_row(0));
  const auto set = [](Row& row, const char* filter, int cascades, double wrong, double ms) {
    row.technique.filter = filter;
    row.technique.cascades = cascades;
    row.errors.false_lit = wrong;
    row.errors.false_shadow = 0.0;
    row.times.total_ms.median = ms;
  };
  set(rows[0], "hard", 4, 0.01, 20.0);
  set(rows[1], "hard", 1, 0.04, 10.0);
  set(rows[2], "a|b", 1, 0.03, 30.0);
  set(rows[3], "a|b", 4, 0.02, 40.0);
  const std::string text = front_tables(summarize(rows));
  const std::size_t first = text.find("1 x 1024 / hard | yes | 4 % |"),
                    second = text.find("4 x 1024 / hard | yes | 1 % |"),
                    behind = text.find("4 x 1024 / a\\|b |  | 2 % |");
  ASSERT_NE(first, std::string::npos) << text;
  ASSERT_NE(second, std::string::npos) << text;
  ASSERT_NE(behind, std::string::npos) << text;
  EXPECT_LT(first, second);
  EXPECT_LT(second, behind);
  EXPECT_EQ(count(text, "1 x 1024 / a"), 0u) << "only the best of a filter behind the front";
}

TEST(Text, base64_and_hashes_are_those_of_the_standards) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  // FIPS 180-4's examples: the empty text, "abc", and one of two blocks.
  EXPECT_EQ(policy_hash(""), "sha256-47DEQpj8HBSa+/TImW+5JCeuQeRkm5NMpJWZG3hSuFU=");
  EXPECT_EQ(policy_hash("abc"), "sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=");
  EXPECT_EQ(policy_hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "sha256-JI1qYdIGOLjlwCaTDD5gOaM85Flk/yFn9uzt1BnbBsE=");
}

TEST(Text, what_could_end_an_element_cannot) {
  EXPECT_EQ(escaped("<a b=\"c\">&'"), "&lt;a b=&quot;c&quot;&gt;&amp;&#39;");
  EXPECT_EQ(escaped(std::string("a\0b\x1b", 4)), "a b ");
  EXPECT_EQ(for_script("\"</script><!--\""), "\"\\u003c/script>\\u003c!--\"");
  EXPECT_EQ(csv_field("a,\"b\"\n"), "\"a,\"\"b\"\"\n\"");
}

TEST(Text, no_spreadsheet_takes_a_name_for_a_formula) {
  for (const std::string name : {"=cmd()", "+1", "-1", "@SUM(A1)", "\t=1", "\r=1"})
    EXPECT_EQ(csv_field(name), "\"'" + name + "\"");
  for (const std::string name : {"", "a=b", "1-2", "'", "hard"})
    EXPECT_EQ(csv_field(name), "\"" + name + "\"");
}

TEST(Text, short_numbers_stay_short) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(0.012345), "0.0123");
  EXPECT_EQ(short_number(12345.6), "12346");
  EXPECT_EQ(short_number(999.4), "999");
  EXPECT_EQ(short_number(999.7), "1000");
  EXPECT_EQ(short_number(1.0 / 0.0), "\xE2\x88\x9E");
  EXPECT_EQ(exact_number(0.1), "0.1");
  EXPECT_EQ(exact_number(1.0 / 0.0), "");
}

TEST(Axis, of_nothing_zeros_and_one_value) {
  Axis axis;
  axis.fit({});
  EXPECT_LT(axis.low, axis.high);
  axis.fit({0.0, -1.0, 2.0, 1.0 / 0.0});
  EXPECT_LT(axis.low, 2.0);
  EXPECT_GT(axis.high, 2.0);
  EXPECT_NEAR(axis.place(2.0), 0.5, 1e-12);
  EXPECT_EQ(axis.place(0.0), 0.0);
  EXPECT_EQ(axis.place(1.0 / 0.0), 1.0);
  EXPECT_FALSE(axis.ticks().empty());
}

TEST(Axis, ticks_lie_within_and_are_neither_few_nor_many) {
  for (const bool logarithmic : {false, true}) {
    for (double high = 0.02; high < 1e6; high *= 1.7) {
      Axis axis{"", logarithmic};
      axis.fit({0.01, high});
      const std::vector<double> ticks = axis.ticks();
      EXPECT_GE(ticks.size(), 2u) << high;
      EXPECT_LE(ticks.size(), 14u) << high;
      for (const double tick : ticks) {
        EXPECT_GE(tick, axis.low * (1 - 1e-9));
        EXPECT_LE(tick, axis.high * (1 + 1e-9));
      }
    }
  }
}

TEST(Axis, of_many_decades_leaves_some_out) {
  Axis axis{"", true};
  axis.fit({1e-18, 1e9});
  EXPECT_GE(axis.ticks().size(), 6u);
  EXPECT_LE(axis.ticks().size(), 14u);
}

TEST(Summary, gathers_frames_and_scenes) {
  std::vector<Row> rows(4, sample_row());
  rows[0].scene = rows[1].scene = "a";
  rows[2].scene = rows[3].scene = "b";
  const double times[] = {1, 3, 8, 8}, errors[] = {0.1, 0.3, 0.4, 0.4};
  for (std::size_t i = 0; i < 4; ++i) {
    rows[i].frame = static_cast<int>(i % 2);
    rows[i].times.total_ms.median = times[i];
    rows[i].errors.false_lit = errors[i];
    rows[i].errors.false_shadow = 0.0;
  }
  const Summary summary = summarize(rows);
  ASSERT_EQ(summary.scenes, (std::vector<std::string>{"all scenes", "a", "b"}));
  const std::size_t wrong = measure_index("wrong"), total = measure_index("total_ms");
  EXPECT_DOUBLE_EQ(summary.cells[1][0].values[wrong], 0.2);
  EXPECT_DOUBLE_EQ(summary.cells[1][0].values[total], 2.0);
  EXPECT_DOUBLE_EQ(summary.cells[0][0].values[wrong], 0.3);
  EXPECT_DOUBLE_EQ(summary.cells[0][0].values[total], 4.0);
}

TEST(Summary, takes_the_worst_frame_where_frames_bound_and_keeps_them_in_order) {
  std::vector<Row> rows(3, sample_row());
  const int frames[] = {2, 0, 1};
  const double m[] = {1.0, 5.0, 3.0};
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i].frame = frames[i];
    rows[i].aliasing.p95 = m[i];
    rows[i].costs.map_bytes = (i + 1) << 20;
  }
  const Summary summary = summarize(rows);
  const std::vector<double>& values = summary.cells[1][0].values;
  EXPECT_EQ(values[measure_index("m_p95")], 5.0);
  EXPECT_EQ(values[measure_index("map_mib")], 3.0);
  EXPECT_EQ(summary.rows_of[1], (std::vector<std::size_t>{1, 2, 0}));
}

TEST(Summary, frames_weigh_by_their_pixels_and_scenes_of_a_few_pixels_decide_nothing) {
  std::vector<Row> rows(3, sample_row());
  rows[0].scene = rows[1].scene = "large";
  rows[2].scene = "small";
  const double errors[] = {0.01, 0.31, 0.9};
  const std::uint64_t pixels[] = {29'000, 1000, 143};
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i].frame = static_cast<int>(i);
    rows[i].errors.pixels = pixels[i];
    rows[i].errors.false_lit = errors[i];
    rows[i].errors.false_shadow = 0.0;
  }
  const std::size_t wrong = measure_index("wrong");
  const Summary summary = summarize(rows);
  EXPECT_DOUBLE_EQ(summary.cells[1][0].values[wrong], 0.02);
  EXPECT_DOUBLE_EQ(summary.cells[2][0].values[wrong], 0.9);
  EXPECT_DOUBLE_EQ(summary.cells[0][0].values[wrong], 0.02);
  rows.erase(rows.begin(), rows.begin() + 2);
  EXPECT_DOUBLE_EQ(summarize(rows).cells[0][0].values[wrong], 0.9) << "where no scene has more";
}

TEST(Summary, a_technique_that_misses_a_scene_is_not_among_all_scenes) {
  std::vector<Row> rows = sample_rows(2, 3);
  rows.erase(rows.begin());
  rows.erase(rows.begin() + 2);  // both frames of the first technique on the first scene
  const Summary summary = summarize(rows);
  EXPECT_EQ(std::count_if(summary.cells[0].begin(), summary.cells[0].end(),
                          [](const Cell& c) { return c.measured; }),
            2);
}

TEST(Page, of_no_rows_says_so_and_stands) {
  const Reported reported({});
  EXPECT_NE(reported.page.find("0 techniques on 0 scenes"), std::string::npos);
  EXPECT_EQ(count(reported.page, "<section"), 7u);
}

TEST(Page, counts_in_singular_and_plural) {
  EXPECT_NE(Reported(sample_rows(1, 1)).page.find("1 technique on 1 scene, "), std::string::npos);
  EXPECT_NE(Reported({sample_row()}).page.find(", 1 measurement;"), std::string::npos);
  EXPECT_NE(Reported(sample_rows(2, 3)).page.find("3 techniques on 2 scenes, "), std::string::npos);
}

TEST(Page, names_rows_and_techniques_that_it_dropped) {
  const std::string whole = Reported(sample_rows(2, 3)).page;
  EXPECT_EQ(count(whole, "note warning") + count(whole, "Dropped from"), 0u);
  TemporaryFolder folder;
  RowsFile(folder.path() / kRowsFile).append(sample_row());
  std::ofstream(folder.path() / kRowsFile, std::ios::app) << "{\"scene\":\"cut";
  std::vector<std::string> warnings;
  EXPECT_NE(text_of(write_report(folder.path(), &warnings)).find("a row is not whole and was skipped"),
            std::string::npos);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[1].find("1 of 1 technique lacks frames"), std::string::npos);
  std::vector<Row> rows = sample_rows(2, 3);
  const Technique first = rows.front().technique;
  std::erase_if(rows, [&](const Row& row) { return row.scene == "scene0" && row.technique == first; });
  EXPECT_NE(Reported(rows).page.find("Dropped from \"all scenes\": 1 technique that"), std::string::npos);
}

TEST(Page, shows_shares_as_percent_and_writes_them_as_shares) {
  std::vector<Row> rows{sample_row()};
  rows[0].errors.false_lit = 0.0123;
  rows[0].errors.false_shadow = 0.0;
  const Reported reported(rows);
  EXPECT_NE(reported.page.find("data-v=\"0.0123\">1.23 %<"), std::string::npos);
  EXPECT_NE(text_of(reported.folder.path() / "charts/wrong_scene0.svg").find(": 1.23 %<"), std::string::npos);
  EXPECT_NE(text_of(reported.folder.path() / "summary.csv").find(",0.0123,"), std::string::npos);
}

TEST(Page, holds_every_technique_of_every_scene_and_of_all_together) {
  const Reported reported(sample_rows(2, 5));
  EXPECT_EQ(count(reported.page, "<tr class=\"row"), 15u);
  EXPECT_EQ(count(reported.page, "<section"), count(reported.page, "</section>"));
  EXPECT_NE(text_of(reported.folder.path() / "charts/error_time_all.svg").find("<svg"), std::string::npos);
  // A head and a line per scene, all together included, and technique.
  EXPECT_EQ(count(text_of(reported.folder.path() / "summary.csv"), "\n"), 16u);
  EXPECT_EQ(count(text_of(reported.folder.path() / "frames.csv"), "\n"), 21u);
}

TEST(Page, draws_the_time_to_an_error_of_a_filter_that_has_one_technique_alone) {
  const Reported reported({sample_row()});
  const std::string chart = text_of(reported.folder.path() / "charts/time_to_error_all.svg");
  const std::size_t path = chart.find("<path class=\"line");
  ASSERT_NE(path, std::string::npos) << chart;
  // From the error that it reaches to the end of the axis: two places.
  const std::size_t data = chart.find(" d=\"", path) + 4;
  double from_x = 0.0, from_y = 0.0, to_x = 0.0, to_y = 0.0;
  ASSERT_EQ(std::sscanf(chart.c_str() + data, "M%lf,%lfL%lf,%lf", &from_x, &from_y, &to_x, &to_y), 4)
      << chart.substr(data, 60);
  EXPECT_GT(from_x, to_x + 10.0);
  EXPECT_EQ(from_y, to_y);
  EXPECT_EQ(count(chart, "class=\"mark "), 1u);
}

TEST(Page, loads_nothing_and_lets_only_its_own_script_run) {
  const std::string page = Reported(sample_rows(1, 3)).page;
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find("unsafe"), std::string::npos);
  for (const char* way_out : {"http://", "https://", "src=\"/", "@import", "url("}) {
    // The namespace of SVG is a name, and nobody goes there.
    EXPECT_EQ(count(page, way_out), std::string(way_out) == "http://" ? 1u : 0u) << way_out;
  }
  const std::size_t begin = page.rfind("<script>") + 8, end = page.rfind("</script>");
  EXPECT_NE(page.find(policy_hash(page.substr(begin, end - begin))), std::string::npos);
  EXPECT_EQ(count(page, " style=\""), 0u);
  EXPECT_EQ(count(page, ".mark.again,.key.again{"), 1u) << "colours that come again";
}

TEST(Page, what_is_drawn_from_the_frame_before_is_taken_off_the_frame_drawn_alone) {
  std::vector<Row> rows = sample_rows(1, 1);
  for (Row& row : rows) {
    row.costs.texels = 500'000;
    row.left_out = {{"moved", "copies", 400'000, "scrolled_maps", 0},
                    {"fine", "m", 500'000, "metric_resolution", 0}};
  }
  const std::string text = waterfalls(rows);
  EXPECT_EQ(count(text, "Without rules 1 million texels"), 1u) << text;
  const std::size_t alone = text.find("<td>50&nbsp;%</td>"), after = text.find("<td>10&nbsp;%</td>");
  ASSERT_NE(alone, std::string::npos) << text;
  ASSERT_NE(after, std::string::npos) << text;
  EXPECT_LT(alone, after) << "last, whichever row told it first";
}

TEST(Page, filters_of_one_plan_count_it_once) {
  std::vector<Row> rows(3, sample_row(0));
  rows[1].technique.filter = "pcf";
  rows[2].technique.map_size *= 2;
  for (Row& row : rows) row.left_out = {{"fine", "m", 500'000, "metric_resolution", 0}};
  rows[0].costs.texels = rows[1].costs.texels = 500'000;
  rows[2].costs.texels = 2'500'000;
  const std::string text = waterfalls(rows);
  EXPECT_EQ(count(text, "Without rules 2 million texels"), 1u) << text;  // the mean of 1 and 3
}

// What people may call a scene: the page shows it and keeps its elements, and tables take it for text.
TEST(Page, no_name_of_a_row_becomes_markup_or_a_formula) {
  const std::string evil = "</script><img src=x onerror=alert(1)>\"'><!--", formula = "=cmd|'/c calc'!A1";
  std::vector<Row> rows = sample_rows(1, 3);
  for (Row& row : rows) {
    row.scene = evil;
    row.technique.warp = row.technique.split = row.technique.fit = row.technique.filter = evil;
    row.truth = row.plan_status = row.light = evil;
    row.left_out = {{evil, evil, 1}};
    row.machine = {evil, evil, evil, evil, evil, true, 2, 0.5};
  }
  rows.back().technique.filter = formula;
  TemporaryFolder folder;
  RowsFile file(folder.path() / kRowsFile);
  for (const Row& row : rows) file.append(row);
  std::ofstream(folder.path() / "stability.jsonl") << R"({"</script><img src=x onerror=1>":"<!--"})"
                                                   << "\n";
  const std::string page = text_of(write_report(folder.path()));
  EXPECT_EQ(count(page, "<img src=x"), 0u);
  EXPECT_EQ(count(page, "<!--"), 0u);
  EXPECT_EQ(count(page, "</script>"), 2u);
  EXPECT_GT(count(page, "&lt;img src=x"), 5u) << "the name is shown";
  for (const auto& entry : fs::directory_iterator(folder.path() / "charts"))
    EXPECT_EQ(count(text_of(entry.path()), "<img"), 0u) << entry.path();
  for (const char* table : {"summary.csv", "frames.csv"}) {
    const std::string text = text_of(folder.path() / table);
    EXPECT_EQ(count(text, "\"=cmd"), 0u) << table;
    EXPECT_GT(count(text, "\"'=cmd"), 0u) << table;
  }
}

// Numbers that a row may hold but no measurement has: steps between ticks must not vanish or overflow.
TEST(Page, of_extreme_numbers_stands) {
  for (const double value : {5e-324, 1e-300, 1e29, -1e30}) {
    std::vector<Row> rows = sample_rows(1, 2);
    for (Row& row : rows) {
      row.errors.false_lit = row.flips = value;
      row.times.total_ms.median = value;
      row.frame = value < 0.0 ? std::numeric_limits<int>::min() : std::numeric_limits<int>::max();
    }
    EXPECT_EQ(count(Reported(rows).page, "<section"), 7u) << value;
  }
}

TEST(Page, shows_nothing_but_pictures_of_its_own_folder) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "report");
  std::ofstream(folder.path() / "secret.png") << "\x89PNG\r\n\x1a\nsecret";
  std::ofstream(folder.path() / "report/text.png") << "no picture";
  fs::create_symlink("../secret.png", folder.path() / "report/link.png");
  const struct {
    const char *name, *why;
  } kCases[] = {{"link.png", "a link out of its folder"},
                {"../secret.png", "outside of its folder"},
                {"text.png", "is not a PNG"},
                {"/dev/zero", "outside of its folder"}};
  for (const auto& c : kCases) {
    fs::remove(folder.path() / "report" / kRowsFile);
    Row row = sample_row();
    row.pictures = {c.name, c.name, c.name, c.name, c.name};
    RowsFile(folder.path() / "report" / kRowsFile).append(row);
    try {
      (void)write_report(folder.path() / "report");
      ADD_FAILURE() << c.name << " was shown";
    } catch (const ReportError& error) {
      EXPECT_NE(std::string(error.what()).find(c.why), std::string::npos) << error.what();
    }
  }
}

TEST(Page, a_stability_file_that_is_no_json_is_refused_by_name) {
  const TemporaryFolder folder;
  RowsFile(folder.path() / kRowsFile).append(sample_row());
  std::ofstream(folder.path() / "stability.jsonl") << "{\"a\":1}\nnonsense\n";
  try {
    (void)write_report(folder.path());
    FAIL();
  } catch (const ReportError& error) {
    EXPECT_NE(std::string(error.what()).find("stability.jsonl:2: "), std::string::npos);
  }
}

TEST(SceneNames, are_short_where_no_other_has_the_same) {
  EXPECT_EQ(short_scene_name("../models/church/scene.gltf"), "church");
  EXPECT_EQ(short_scene_name("../models/garage/garage.gltf"), "garage");
  EXPECT_EQ(short_scene_name("builtin:fence"), "builtin:fence");
  EXPECT_EQ(short_scene_name("builtin:fence, path far.json 0123456789abcdef"), "builtin:fence, far.json");
  EXPECT_EQ(short_scene_name("builtin:fence, eye 0,1,2 target 3,4,5"),
            "builtin:fence, eye 0,1,2 target 3,4,5");
  std::vector<Row> rows(3, sample_row(0));
  rows[0].scene = "a/box.glb";
  rows[1].scene = "b/box.glb";
  rows[2].scene = "c/hall.glb";
  EXPECT_EQ(summarize(rows).titles,
            (std::vector<std::string>{"all scenes", "a/box.glb", "b/box.glb", "hall"}));
  rows[1].view = "box: another";
  EXPECT_EQ(summarize(rows).scenes[2], "box: another");
}

TEST(Latex, escapes_all_that_has_a_meaning) {
  EXPECT_EQ(latex_text("a_b 5 % & {x} \\ ~^#$"),
            "a\\_b 5 \\% \\& \\{x\\} \\textbackslash{} \\textasciitilde{}\\textasciicircum{}\\#\\$");
  EXPECT_EQ(latex_text("\xC2\xB5s\n"), "?s ");
}

TEST(Entries, without_a_time_have_an_error_and_no_mark) {
  std::vector<Row> rows = sample_rows(1, 2);
  for (int frame = 0; frame < 2; ++frame) {
    Row row = rows[static_cast<std::size_t>(frame) * 2];
    row.technique = {};
    row.technique.entry = "theirs";
    row.technique.filter = "masks";
    row.technique.cascades = row.technique.map_size = 0;
    row.times = {};
    row.truth = "none";
    row.frame = frame;
    rows.push_back(row);
  }
  rows.back().flips = std::numeric_limits<double>::quiet_NaN();
  const Row back = row_from_json(to_json_line(rows.back()), "row");
  EXPECT_TRUE(back.is_masks());
  EXPECT_TRUE(std::isnan(back.flips));
  EXPECT_NE(back.key(), rows.front().key());
  const Summary summary = summarize(rows);
  const Cell& cell = summary.cells[1].back();
  EXPECT_TRUE(std::isfinite(cell.values[measure_index("wrong")]));
  for (const char* key : {"total_ms", "ratio", "depth_ms", "mean_error", "leaking", "m_p95", "map_mib"})
    EXPECT_TRUE(std::isnan(cell.values[measure_index(key)])) << key;
  const Reported report(rows);
  EXPECT_NE(report.page.find("theirs / masks"), std::string::npos);
  EXPECT_EQ(count(error_time_chart(summary, 1).standalone(), "theirs / masks"), 0u);
}

TEST(Page, counts_repeated_rows_once_and_says_so) {
  std::vector<Row> rows = sample_rows(1, 2);
  const Reported once(rows);
  rows.push_back(rows[0]);
  const Reported twice(rows);
  EXPECT_TRUE(once.warnings.empty());
  ASSERT_EQ(twice.warnings.size(), 1u);
  EXPECT_NE(twice.warnings[0].find("results.jsonl: 1 row repeated; each counts once"), std::string::npos);
  EXPECT_EQ(text_of(twice.folder.path() / "summary.csv"), text_of(once.folder.path() / "summary.csv"));
}

TEST(Page, names_scenes_whose_techniques_lack_frames) {
  std::vector<Row> rows = sample_rows(2, 3);
  rows.pop_back();
  const std::string page = Reported(rows).page;
  EXPECT_NE(page.find("scene1: 1 of 3 techniques lacks frames ("), std::string::npos);
  EXPECT_EQ(page.find("scene0: "), std::string::npos);
}

TEST(Page, stands_without_pictures_that_are_not_there) {
  std::vector<Row> rows = sample_rows(1, 2);
  for (Row& row : rows)
    row.pictures = {"pictures/i.png", "pictures/t.png", "pictures/m.png", "pictures/d.png", "pictures/h.png"};
  const Reported reported(rows);
  ASSERT_EQ(reported.warnings.size(), 1u);
  EXPECT_NE(reported.warnings[0].find("pictures/i.png is not there; 4 rows without pictures"),
            std::string::npos);
  EXPECT_EQ(count(reported.page, "<img"), count(Reported(sample_rows(1, 2)).page, "<img"));
}

}  // namespace
}  // namespace gnomon::report
