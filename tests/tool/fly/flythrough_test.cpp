// What does the flythrough program write?
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flythrough_program.hpp"

namespace flythrough_test {
namespace {

TEST_F(Flythrough, lets_the_filter_store_less_within_a_bound_and_says_so) {
  const std::string flight = "builtin:hangar --frames 1 --size 96x64 --map-size 128 --filter esm:c=80 ";
  const auto told = [&](const std::string& more) {
    const Outcome outcome = run(flight + more);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    std::ifstream csv(out() / "frames.csv");
    const std::string text{std::istreambuf_iterator<char>(csv), {}};
    return text.find("esm:format=unorm16,c=80 suffices for esm") != std::string::npos;
  };
  EXPECT_TRUE(told("--filter-precision 0.5"));
  EXPECT_FALSE(told("--filter-precision 0"));
}

TEST_F(Flythrough, prints_its_version_and_its_options) {
  const Outcome version = run("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_NE(version.out.find("flythrough"), std::string::npos);
  const Outcome help = run("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* option : {"--frames",
                             "--size",
                             "--out",
                             "--context",
                             "--cascades",
                             "--split",
                             "--lambda",
                             "--warp",
                             "--compare-warps",
                             "--filter",
                             "--map-size",
                             "--stable",
                             "--light",
                             "--light-elevation-deg",
                             "--light-azimuth-deg",
                             "--path",
                             "--resolution",
                             "--blocker-distance",
                             "--transition",
                             "--budget-ms",
                             "--target-error",
                             "--cost-model",
                             "--fit",
                             "--history",
                             "--visible-depths",
                             "--prune",
                             "--map-memory-mib",
                             "--max-triangles"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  }
}

TEST_F(Flythrough, draws_a_frame_under_several_warps_side_by_side) {
  const char* scene = "builtin:fence --frames 1 --size 96x64 --map-size 128 --cascades 1";
  ASSERT_EQ(run(scene).code, 0);
  EXPECT_FALSE(fs::exists(out() / "frame_0000_warps.png"));
  const Outcome outcome = run(std::string(scene) + " --compare-warps none,auto");
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_GT(fs::exists(out() / "frame_0000_warps.png") ? fs::file_size(out() / "frame_0000_warps.png") : 0,
            100u);
}

TEST_F(Flythrough, writes_the_shadow_alone_with_alpha) {
  const Outcome outcome = run(std::string(kOneFrame) + "--shadow-only");
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("frame_0000_shadow.png"), std::string::npos) << outcome.out;
  for (const char* other : {"frame_0000_image.png", "frame_0000_heat.png", "contact_sheet.png"})
    EXPECT_FALSE(fs::exists(out() / other)) << other;
  const std::string png = text_of(out() / "frame_0000_shadow.png");
  // The header's colour type: 6 is red, green, blue and alpha.
  ASSERT_GT(png.size(), 33u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png[25], 6);
  const Outcome both = run(std::string(kOneFrame) + "--shadow-only --compare-warps none,auto");
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.error.find("--compare-warps"), std::string::npos) << both.error;
}

TEST_F(Flythrough, chooses_maps_that_keep_to_a_share_of_misclassified_pixels) {
  const auto texels_and_error = [this](double error) {
    const Outcome outcome =
        run("builtin:fence --frames 1 --size 96x64 --target-error " + std::to_string(error));
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("technique: "), std::string::npos);
    EXPECT_NE(outcome.out.find("a fifth better: "), std::string::npos) << outcome.out;
    std::ifstream csv(out() / "frames.csv");
    std::string head, row;
    std::getline(csv, head);
    std::getline(csv, row);
    const std::vector<std::string> names = fields_of(head), values = fields_of(row);
    const auto number = [&](const char* name) {
      const auto at = std::find(names.begin(), names.end(), name) - names.begin();
      return std::atof(values.at(static_cast<std::size_t>(at)).c_str());
    };
    return std::pair(number("texels"), number("m_p50"));
  };
  const auto [few, coarse] = texels_and_error(0.06);
  const auto [many, fine] = texels_and_error(0.02);
  EXPECT_LT(fine, coarse);
  EXPECT_LT(few, many);
}

TEST_F(Flythrough, chooses_among_maps_and_pages) {
  const auto fly = [&](const std::string& more) {
    return run("--frames 1 --size 192x108 --context osmesa --filter hard --page-size 64 " + more);
  };
  // Pages take fewer texels where shadows lie near and far, and one map where they lie evenly.
  const Outcome pages = fly("builtin:city --pages resolution --target-error 0.04");
  ASSERT_EQ(pages.code, 0) << pages.error;
  EXPECT_NE(pages.out.find("technique: pages of 64 for m "), std::string::npos) << pages.out;
  EXPECT_NE(pages.out.find("kept from earlier frames"), std::string::npos) << "and draws them";
  const Outcome maps = fly("builtin:hangar --pages resolution --target-error 0.06");
  ASSERT_EQ(maps.code, 0) << maps.error;
  EXPECT_EQ(maps.out.find("technique: pages"), std::string::npos) << maps.out;
  EXPECT_EQ(maps.out.find("kept from earlier frames"), std::string::npos);
  const Outcome reads = fly("builtin:fence --pages picture --target-error 0.01");
  EXPECT_EQ(reads.code, 2);
  EXPECT_NE(reads.error.find("--pages picture: reads what was drawn"), std::string::npos) << reads.error;
  const fs::path model = out() / "maps_alone.json";
  std::ofstream(model) << R"({"schema": "gnomon.cost.6", "machine": "m",
    "mean_relative_error": {"depth": 0, "prefilter": 0, "lookup": 0}, "frame_ms": 0, "ms_per_map": 0,
    "ms_per_megatexel": 1, "ms_per_kilodraw": 0, "ms_per_megatriangle": 0, "ms_per_megatexel_covered": 0,
    "ms_per_megatexel_tested": 0,
    "filters": [{"name": "hard", "prefilter_ms_per_map": 0, "prefilter_ms_per_megatexel": 0,
      "lookup_ms_per_megapixel": 1, "bytes_per_texel": 4, "error_ratio": 1, "error_power": 1,
      "kernel_texels": 0, "extent_texels": 0, "extent_world": 0}]})";
  const Outcome none =
      fly("builtin:fence --pages resolution --target-error 0.01 --cost-model " + model.string());
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.error.find("maps_alone.json: has no costs of pages"), std::string::npos) << none.error;
}

TEST_F(Flythrough, takes_transitions_between_maps_by_name_and_refuses_unknown_ones) {
  const char* scene = "builtin:fence --frames 1 --size 96x64 --map-size 128 --cascades 3 --transition ";
  std::vector<std::string> pictures;
  for (const char* transition : {"cut", "blend", "dither"}) {
    const Outcome outcome = run(std::string(scene) + transition);
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    pictures.push_back(text_of(out() / "frame_0000_image.png"));
  }
  EXPECT_NE(pictures[0], pictures[1]);
  EXPECT_NE(pictures[1], pictures[2]);
  const Outcome refused = run(std::string(scene) + "fade");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.error.find("--transition fade: wants cut, blend or dither"), std::string::npos);
}

TEST_F(Flythrough, takes_the_smallest_maps_whose_texels_the_filter_hides) {
  const auto chosen = [this](const char* filter) {
    const Outcome outcome = run(std::string("builtin:fence --frames 1 --size 96x64 --cascades 1 "
                                            "--resolution perceptual --filter ") +
                                filter);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    const std::size_t line = outcome.out.find("maps:");
    return line == std::string::npos ? 0 : std::atoi(outcome.out.c_str() + line + 5);
  };
  const int narrow = chosen("pcf:radius=0.5,unit=world"), wide = chosen("pcf:radius=1,unit=world");
  EXPECT_GT(wide, 0);
  EXPECT_GT(narrow, wide);
  EXPECT_GT(chosen("pcss:angle_deg=10 --blocker-distance 5"),
            chosen("pcss:angle_deg=10 --blocker-distance 10"));
}

TEST_F(Flythrough, writes_three_pictures_and_a_row_per_frame_and_a_sheet) {
  const Outcome outcome = run("builtin:fence --frames 2 --size 96x64 --map-size 128 --cascades 2");
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  for (const char* file :
       {"frame_0000_image.png", "frame_0000_heat.png", "frame_0000_cascades.png", "frame_0001_image.png",
        "frame_0001_heat.png", "frame_0001_cascades.png", "contact_sheet.png"}) {
    EXPECT_GT(fs::exists(out() / file) ? fs::file_size(out() / file) : 0, 100u) << file;
  }
  std::ifstream csv(out() / "frames.csv");
  std::string line;
  ASSERT_TRUE(std::getline(csv, line));
  const std::vector<std::string> header = fields_of(line);
  const auto column = [&header](const std::string& name) {
    return static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  };
  int rows = 0;
  while (std::getline(csv, line)) {
    const std::vector<std::string> row = fields_of(line);
    ASSERT_EQ(row.size(), header.size()) << line;
    EXPECT_EQ(row[column("frame")], std::to_string(rows));
    EXPECT_GT(std::stod(row[column("plan_ns")]), 0.0);
    EXPECT_GT(std::stod(row[column("m_p50")]), 0.0);
    EXPECT_LE(std::stod(row[column("m_p50")]), std::stod(row[column("m_p95")]));
    EXPECT_LE(std::stod(row[column("m_p95")]), std::stod(row[column("m_max")]));
    EXPECT_EQ(std::stod(row[column("texels")]) + std::stod(row[column("metric_resolution_saved_texels")]),
              std::stod(row[column("maps")]) * 128 * 128);
    ++rows;
  }
  EXPECT_EQ(rows, 2);
  // Nothing is left of the files that were written aside.
  for (const auto& entry : fs::directory_iterator(out())) EXPECT_NE(entry.path().extension(), ".part");
}

/// The column of frames.csv in all rows.
std::vector<double> column_of(const fs::path& file, const std::string& name) {
  std::ifstream csv(file);
  std::string line;
  std::getline(csv, line);
  const std::vector<std::string> header = fields_of(line);
  const auto at = static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin());
  std::vector<double> values;
  while (at < header.size() && std::getline(csv, line)) values.push_back(std::stod(fields_of(line).at(at)));
  return values;
}

TEST_F(Flythrough, reports_for_each_map_what_was_drawn_its_age_and_its_error) {
  // A stable fit plans alike with and without: looking for the depths must not draw the maps that count.
  const Outcome outcome =
      run("builtin:fence --frames 3 --size 96x64 --map-size 128 --cascades 1 --fit stable --visible-depths");
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const fs::path csv = out() / "frames.csv";
  const std::vector<double> texels = column_of(csv, "texels"), of_map = column_of(csv, "map0_texels");
  ASSERT_EQ(texels.size(), 3u);
  EXPECT_EQ(texels, of_map);
  EXPECT_EQ(texels[0], 128.0 * 128.0);
  const std::vector<double> age = column_of(csv, "map0_age");
  ASSERT_EQ(age.size(), 3u);
  EXPECT_EQ(age[0], 0.0);
  for (std::size_t i = 1; i < 3; ++i)
    EXPECT_EQ(age[i], texels[i] < 128.0 * 128.0 ? age[i - 1] + 1.0 : 0.0) << i;
  for (const double m : column_of(csv, "map0_m_bound")) EXPECT_GT(m, 0.0);
}

TEST_F(Flythrough, prints_one_line_of_json_that_says_what_the_table_says) {
  const Outcome outcome = run("builtin:fence --frames 2 --size 96x64 --map-size 128 --cascades 2 --json");
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["scene"], "builtin:fence");
  EXPECT_EQ(json["options"]["map_size"], 128);
  EXPECT_EQ(json["options"]["cascades"], 2);
  ASSERT_EQ(json["frames"].size(), 2u);
  const std::vector<double> texels = column_of(out() / "frames.csv", "texels");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(json["frames"][i]["frame"], i);
    EXPECT_EQ(json["frames"][i]["texels"].get<double>(), texels.at(i));
    EXPECT_GT(json["frames"][i]["m"]["p50"].get<double>(), 0.0);
  }
  EXPECT_EQ(json["numbers"], (out() / "frames.csv").string());
}

TEST_F(Flythrough, keeps_pages_from_frame_to_frame_and_counts_them) {
  // Steps of a metre: most pages stay in view.
  const fs::path path = folder_ / "steps.json";
  std::ofstream(path) << R"({"fov_y_deg": 60, "near": 0.1, "far": 200, "keys": [)"
                         R"({"position": [0, 2, 12], "target": [0, 1, 0]},)"
                         R"({"position": [0, 2, 11], "target": [0, 1, -1]}]})";
  const std::string flight =
      "builtin:hangar --frames 3 --size 96x64 --pages clipmap --page-size 64 --path " + path.string();
  const Outcome outcome = run(flight + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["pages"]["policy"], "clipmap");
  const std::vector<double> resident = column_of(out() / "frames.csv", "pages"),
                            drawn = column_of(out() / "frames.csv", "pages_drawn"),
                            kept = column_of(out() / "frames.csv", "pages_kept");
  ASSERT_EQ(resident.size(), 3u);
  EXPECT_EQ(kept[0], 0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(resident[i], 8.0);
    EXPECT_EQ(resident[i], drawn[i] + kept[i]);
    EXPECT_EQ(json["frames"][i]["pages"]["resident"].get<double>(), resident[i]);
    EXPECT_EQ(json["frames"][i]["pages"]["kept"].get<double>(), kept[i]);
    EXPECT_EQ(json["frames"][i]["maps"], 0);
    EXPECT_GT(json["frames"][i]["m"]["p50"].get<double>(), 0.0);
  }
  EXPECT_GT(kept[1] + kept[2], 0.5 * (resident[1] + resident[2]));
  EXPECT_NEAR(json["summary"]["share_kept"].get<double>(), (kept[1] + kept[2]) / (resident[1] + resident[2]),
              1e-12);
  for (const char* kind : {"image", "heat", "levels", "kept"})
    EXPECT_TRUE(fs::exists(out() / (std::string("frame_0002_") + kind + ".png"))) << kind;
  // A fit that follows the view keeps none, and the summary says what would.
  const std::string tight = "builtin:hangar --frames 2 --size 96x64 --pages resolution --page-size 64";
  const Outcome moving = run(tight);
  ASSERT_EQ(moving.code, 0) << moving.error;
  EXPECT_NE(moving.out.find("0.0 % kept from earlier frames; --fit stable"), std::string::npos) << moving.out;
}

TEST_F(Flythrough, draws_a_scene_without_triangles) {
  const fs::path scene = folder_ / "empty.gltf";
  std::ofstream(scene) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]})";
  const Outcome outcome = run(scene.string() + " --frames 2 --size 64x32 --map-size 64");
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("0 triangles"), std::string::npos) << outcome.out;
  EXPECT_TRUE(fs::exists(out() / "frame_0001_image.png"));
  const Outcome pages = run(scene.string() + " --frames 1 --size 64x32 --pages resolution");
  EXPECT_EQ(pages.code, 0) << pages.error;
}

TEST_F(Flythrough, draws_the_same_in_four_processes_at_once) {
  std::string command;
  for (const char* name : {"a", "b", "c", "d"}) {
    command += "env -u DISPLAY " FLYTHROUGH " --out " + (folder_ / name).string() + " " + kOneFrame +
               " > /dev/null 2>&1 & ";
  }
  ASSERT_EQ(std::system((command + "wait").c_str()), 0);
  const std::string first = text_of(folder_ / "a/frame_0000_image.png");
  EXPECT_GT(first.size(), 100u);
  for (const char* name : {"b", "c", "d"})
    EXPECT_EQ(text_of(folder_ / name / "frame_0000_image.png"), first) << name;
}

}  // namespace
}  // namespace flythrough_test
