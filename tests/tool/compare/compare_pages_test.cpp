// Are pages measured beside maps by `gnomon compare`, by every policy, against the same rays?
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "compare/sweep.hpp"
#include "gnomon/pages.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

std::vector<std::string> page_sweep(const fs::path& out, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"compare", "builtin:hangar", "--warps",   "none",     "--cascades",
                                     "1",       "--map-sizes",    "256",       "--frames", "1",
                                     "--size",  "96x54",          "--rounds",  "1",        "--context",
                                     "osmesa",  "--out",          out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

double wrong(const report::Row& row) {
  return row.errors.false_lit + row.errors.false_shadow;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ComparePages, every_policy_is_measured_beside_the_map_of_as_many_texels) {
  const TemporaryFolder folder;
  const Finished finished = run_gnomon(
      page_sweep(folder.path(), {"--filters", "hard,pcf,savsm", "--pages", "all", "--page-sizes", "64"}));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(finished.err.find("--pages skips savsm: sums up the texels of whole maps"), std::string::npos)
      << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path());
  const std::size_t policies = all_page_policies().size();
  ASSERT_EQ(rows.size(), 3u + 2u * policies);
  for (const report::Row& row : rows) {
    if (row.technique.pages.empty()) continue;
    SCOPED_TRACE(row.technique.name());
    const report::Row& map = row.technique.filter == rows[0].technique.filter ? rows[0] : rows[1];
    ASSERT_EQ(map.technique.filter, row.technique.filter);
    EXPECT_EQ(row.plan_status, "ok");
    EXPECT_EQ(row.technique.page_texels, 64);
    EXPECT_EQ(row.errors.pixels, map.errors.pixels);
    EXPECT_GT(row.costs.maps, 3);
    EXPECT_LE(row.costs.texels, map.costs.texels);
    EXPECT_GT(row.costs.texels, map.costs.texels / 4);
    EXPECT_GT(row.costs.map_bytes, 4 * row.costs.texels) << "the tables count";
    EXPECT_LT(wrong(row), 1.5 * wrong(map) + 0.02);
    EXPECT_GT(row.times.total_ms.median, 0.0);
    EXPECT_GT(row.times.plan_ns.median, 0.0);
    EXPECT_GT(row.aliasing.p95, 0.05);
    EXPECT_EQ(row.aliasing.pixels, map.aliasing.pixels);
    EXPECT_TRUE(fs::exists(folder.path() / row.pictures.heat));
    ASSERT_TRUE(row.expected_wrong);
    if (row.technique.filter == "hard") {
      EXPECT_NEAR(*row.expected_wrong, wrong(row), 0.05 * wrong(row));
    }
  }
  // What the whole of it is for: as many texels, smaller ones where they show.
  for (const report::Row& row : rows) {
    if (row.technique.pages == "resolution") {
      EXPECT_LT(row.aliasing.p95, rows[0].aliasing.p95);
    }
  }
  const std::string chart = text_of(folder.path() / "charts/error_time_scene0.svg");
  for (const PagePolicy* policy : all_page_policies()) {
    EXPECT_NE(chart.find("pages " + std::string(policy->name)), std::string::npos) << policy->name;
  }
  EXPECT_NE(text_of(folder.path() / "summary.csv").find(",\"queried\",64,0"), std::string::npos);
}

TEST(ComparePages, a_pool_that_could_hold_a_page_for_each_point_leaves_few_holes_between_them) {
  const TemporaryFolder folder;
  const Finished finished =
      run_gnomon(page_sweep(folder.path(), {"--filters", "hard", "--map-sizes", "512,2048", "--pages", "all",
                                            "--page-sizes", "64"}));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  std::map<std::string, double> wrong_of;  // of the smaller pool, by policy
  int compared = 0;
  for (const report::Row& row : report::read_rows(folder.path())) {
    if (row.technique.map_size == 512) wrong_of[row.technique.pages] = wrong(row);
    if (row.technique.map_size != 2048 || row.technique.pages.empty()) continue;
    EXPECT_LT(wrong(row), 2.5 * wrong_of.at(row.technique.pages)) << row.technique.pages;
    ++compared;
  }
  EXPECT_EQ(compared, static_cast<int>(all_page_policies().size()));
}

TEST(ComparePages, local_lights_are_measured_and_a_target_opens_fewer_pages_than_the_pool_holds) {
  for (const char* light : {"spot", "point"}) {
    const TemporaryFolder folder;
    std::vector<report::Row> rows;
    for (const char* target : {"0", "4"}) {
      const fs::path out = folder.path() / target;
      const Finished finished =
          run_gnomon(page_sweep(out, {"--light", light, "--filters", "hard", "--pages", "resolution,clipmap",
                                      "--page-sizes", "64", "--page-target", target}));
      ASSERT_EQ(finished.exit_code, 0) << finished.err;
      const std::vector<report::Row> measured = report::read_rows(out);
      ASSERT_EQ(measured.size(), 3u);
      rows.insert(rows.end(), measured.begin() + 1, measured.end());
      for (const report::Row& row : measured) {
        EXPECT_EQ(row.plan_status, "ok");
        EXPECT_LT(wrong(row), std::string(target) == "0" ? 0.15 : 0.3)
            << light << ": " << row.technique.name();
      }
    }
    for (std::size_t policy : {0u, 1u}) {
      EXPECT_LT(rows[2 + policy].costs.texels, rows[policy].costs.texels) << light;
      EXPECT_GT(rows[2 + policy].aliasing.p95, rows[policy].aliasing.p95) << light;
      EXPECT_NE(rows[2 + policy].key(), rows[policy].key());
    }
  }
}

TEST(ComparePages, what_pages_cannot_do_is_refused_in_one_line) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--filters", "savsm,mssm", "--pages", "resolution"},
       "skips savsm, mssm: sums up the texels of whole maps"},
      {{"--filters", "vsm:mipmap=1", "--pages", "resolution"}, "mip-maps, which pages do not have"},
      {{"--filters", "esm:fallback=2", "--pages", "resolution"}, "reads the largest depths of whole maps"},
      {{"--filters", "pcf:radius=0.1,unit=world", "--pages", "resolution"}, "kernel in world units"},
      {{"--filters", "pcf:radius=20", "--pages", "resolution", "--page-sizes", "64"},
       "more than a quarter of a page"},
      {{"--filters", "hard", "--pages", "resoluton"}, "did you mean 'resolution'?"},
      {{"--filters", "hard", "--pages", "resolution", "--page-sizes", "96"}, "wants 64, 128 or 256"},
      {{"--filters", "hard", "--pages", "clipmap", "--light", "point"}, "fewer than 24 pages"},
      {{"--filters", "hard", "--pages", "all", "--page-target", "-1"}, "--page-target"}};
  for (const auto& [more, line] : cases) {
    const Finished finished = run_gnomon(page_sweep(out, more));
    EXPECT_EQ(finished.exit_code, 2) << line;
    EXPECT_NE(finished.err.find(line), std::string::npos) << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_FALSE(fs::exists(out));
  }
}

TEST(ComparePages, numbers_of_cascades_are_one_row_under_a_local_light) {
  tool::SweepRequest request;
  request.scenes = {"builtin:hangar"};
  request.cascades = {1, 4};
  request.pages = {&page_policies::resolution};
  for (const LightKind light : {LightKind::sun, LightKind::spot, LightKind::point}) {
    request.light.kind = light;
    const tool::Sweep sweep = tool::make_sweep(request);
    const auto by_pages = std::count_if(sweep.entries.begin(), sweep.entries.end(),
                                        [](const tool::SweepEntry& entry) { return entry.by_pages(); });
    EXPECT_EQ(by_pages, light == LightKind::sun ? 2 : 1) << to_string(light);
  }
}

}  // namespace
}  // namespace gnomon::test
