// `gnomon compare` from outside: whole, in shards, killed and taken up again.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "gnomon/render/filter.hpp"
#include "small_sweep.hpp"

namespace gnomon::test {
namespace {

/// One frame of a scene by techniques of one map of 256 texels.
std::vector<report::Row> rows_of_one_small_map(std::vector<std::string> words) {
  const TemporaryFolder folder;
  words.insert(words.begin(), "compare");
  for (const char* word : {"--cascades", "1", "--frames", "1", "--rounds", "1", "--size", "96x54",
                           "--map-sizes", "256", "--context", "osmesa", "--out"})
    words.emplace_back(word);
  words.push_back(folder.path().string());
  const Finished finished = run_gnomon(words);
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  return finished.exit_code == 0 ? report::read_rows(folder.path()) : std::vector<report::Row>();
}

TEST(Compare, measures_every_technique_on_every_frame) {
  const std::vector<report::Row> rows = report::read_rows(whole());
  ASSERT_EQ(rows.size(), kSmallRows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const report::Row& row = rows[i];
    EXPECT_EQ(row.index, i);
    EXPECT_EQ(row.plan_status, "ok");
    EXPECT_GT(row.errors.pixels, 500u);
    EXPECT_LT(row.errors.false_lit + row.errors.false_shadow, 0.2);
    EXPECT_LT(row.errors.mean_error, 0.2);
    EXPECT_GT(row.aliasing.p95, 0.5);
    EXPECT_GT(row.times.total_ms.median, 0.0);
    EXPECT_GT(row.times.baseline_ms, 0.0);
    EXPECT_EQ(row.costs.map_bytes % row.costs.texels, 0u);
    EXPECT_FALSE(row.machine.renderer.empty());
    EXPECT_FALSE(row.machine.cpu.empty());
    EXPECT_EQ(row.pictures.mask.empty(), row.frame == 0) << "pictures of the flight's middle alone";
  }
  for (const char* file : {"report.html", "summary.csv", "frames.csv", "charts/error_time_scene0.svg",
                           "pictures/scene0_truth.png", "pictures/scene0_technique3_difference.png"})
    EXPECT_TRUE(fs::exists(whole() / file)) << file;
}

TEST(Compare, measures_local_lights_against_their_own_shadows) {
  for (const char* light : {"spot", "point"}) {
    const TemporaryFolder folder;
    // Splits and cascades mean nothing under a local light: no row twice.
    const Finished finished = run_gnomon({"compare",     "builtin:hangar",
                                          "--warps",     "none",
                                          "--splits",    "uniform,auto",
                                          "--cascades",  "1,4",
                                          "--filters",   "hard,pcss",
                                          "--frames",    "1",
                                          "--size",      "96x54",
                                          "--map-sizes", "1024",
                                          "--rounds",    "1",
                                          "--light",     light,
                                          "--context",   "osmesa",
                                          "--out",       folder.path().string()});
    ASSERT_EQ(finished.exit_code, 0) << finished.err;
    const std::vector<report::Row> rows = report::read_rows(folder.path());
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[1].truth, "area");
    for (const report::Row& row : rows) {
      EXPECT_EQ(row.light, light);
      EXPECT_EQ(row.plan_status, "ok");
      EXPECT_GT(row.errors.pixels, 1000u);
      EXPECT_LT(row.errors.false_lit + row.errors.false_shadow, 0.1) << light << " " << row.technique.name();
      EXPECT_GT(row.aliasing.p95, 0.1);
    }
  }
}

TEST(Compare, says_the_same_in_every_run_but_for_times) {
  const TemporaryFolder folder;
  expect_success(small_sweep(folder.path()));
  EXPECT_EQ(lasting(folder.path()), lasting(whole()));
}

TEST(Compare, shards_merge_into_the_whole) {
  const TemporaryFolder folder;
  std::vector<std::string> merge{"merge", "--out", (folder.path() / "merged").string()};
  for (const char* shard : {"1", "2", "3"}) {
    const fs::path out = folder.path() / shard;
    expect_success(small_sweep(out, {"--shard", std::string(shard) + "/3"}));
    EXPECT_FALSE(fs::exists(out / "report.html")) << "a part is no whole";
    merge.push_back(out.string());
  }
  const Finished merged = run_gnomon(merge);
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(lasting(folder.path() / "merged"), lasting(whole()));
  EXPECT_TRUE(fs::exists(folder.path() / "merged/report.html"));
  EXPECT_TRUE(fs::exists(folder.path() / "merged/pictures/scene0_technique3_mask.png"));
}

TEST(Compare, a_killed_run_goes_on_where_it_was) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = small_sweep(folder.path());
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const int nowhere = ::open("/dev/null", O_WRONLY);
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
    std::vector<char*> argv{const_cast<char*>(GNOMON_PROGRAM)};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    ::execv(GNOMON_PROGRAM, argv.data());
    ::_exit(127);
  }
  // Killed as soon as it has written something, or at its end if it is faster than the look.
  const fs::path file = folder.path() / report::kRowsFile;
  std::error_code ignored;
  while (::waitpid(child, nullptr, WNOHANG) == 0) {
    if (fs::exists(file, ignored) && fs::file_size(file, ignored) > 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  const std::size_t before = report::read_rows(folder.path()).size();
  EXPECT_GT(before, 0u);
  // And as if it had been within a line.
  std::ofstream(file, std::ios::app) << "{\"schema\":";
  const Finished resumed = run_gnomon(small_sweep(folder.path(), {"--resume"}));
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_EQ(lasting(folder.path()), lasting(whole()));
}

TEST(Compare, does_not_write_over_results_unasked) {
  const Finished finished = run_gnomon(small_sweep(whole()));
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_NE(finished.err.find("--resume"), std::string::npos);
  EXPECT_EQ(report::read_rows(whole()).size(), kSmallRows);
}

TEST(Compare, frames_that_are_not_timed_have_the_same_errors_and_no_time) {
  const TemporaryFolder folder;
  const Finished finished = run_gnomon(small_sweep(folder.path(), {"--timed-frames", "1"}));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  const std::vector<report::Row> timed = report::read_rows(whole()), rows = report::read_rows(folder.path());
  ASSERT_EQ(rows.size(), kSmallRows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(without_times(rows[i]), without_times(timed[i]));
    EXPECT_EQ(rows[i].times.known(), rows[i].frame == 0) << i;
    EXPECT_EQ(rows[i].times.rounds > 0, rows[i].frame == 0) << i;
  }
}

TEST(Compare, a_finished_sweep_that_is_resumed_measures_nothing) {
  const std::vector<report::Row> before = report::read_rows(whole());
  expect_success(small_sweep(whole(), {"--resume"}));
  const std::vector<report::Row> after = report::read_rows(whole());
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(to_json_line(after[i]), to_json_line(before[i]));
}

/// A triangle on the ground, with its corners in a file of their own.
std::string write_triangle(const TemporaryFolder& folder, float height) {
  const float corners[] = {0, height, 0, 0, height, 5, 5, height, 0};
  (void)folder.write("corners.bin", {reinterpret_cast<const char*>(corners), sizeof corners});
  return folder.write(
      "triangle.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("buffers":[{"byteLength":36,"uri":"corners.bin"}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
}

TEST(Compare, does_not_go_on_with_a_scene_whose_files_have_changed) {
  const TemporaryFolder folder;
  const auto compare = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = small_sweep(folder.path() / out, more);
    arguments[1] = write_triangle(folder, out == "raised" ? 2.0f : 1.0f);
    return run_gnomon(arguments);
  };
  ASSERT_EQ(compare("first", {}).exit_code, 0);
  EXPECT_EQ(compare("first", {"--resume"}).exit_code, 0) << "written anew, with the same bytes";
  // A file that the scene names has changed, and the scene's own has not.
  ASSERT_EQ(compare("raised", {}).exit_code, 0);
  const Finished changed = run_gnomon([&] {
    std::vector<std::string> arguments = small_sweep(folder.path() / "first", {"--resume"});
    arguments[1] = write_triangle(folder, 2.0f);
    return arguments;
  }());
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_NE(changed.err.find("triangle.gltf has changed since it was measured"), std::string::npos)
      << changed.err;
  EXPECT_EQ(std::count(changed.err.begin(), changed.err.end(), '\n'), 1) << changed.err;
  const fs::path merged = folder.path() / "merged";
  const Finished both = run_gnomon({"merge", (folder.path() / "first").string(),
                                    (folder.path() / "raised").string(), "--out", merged.string()});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_NE(both.err.find("triangle.gltf is not the one that was measured before"), std::string::npos)
      << both.err;
  EXPECT_FALSE(fs::exists(merged)) << "nothing is written for a merge that is refused";
}

TEST(Compare, refuses_a_scene_that_cannot_be_loaded_before_it_measures_another) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const Finished broken = run_gnomon(small_sweep(out, {folder.write("broken.gltf", "{")}));
  EXPECT_EQ(broken.exit_code, 2);
  EXPECT_NE(broken.err.find("broken.gltf: JSON"), std::string::npos) << broken.err;
  std::vector<std::string> limited = small_sweep(out, {"--max-triangles", "1"});
  limited[1] = write_triangle(folder, 0.0f);
  expect_success(limited);
  const std::string two = folder.write("two.gltf", [&] {
    std::ifstream in(write_triangle(folder, 0.0f));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string once = R"("nodes":[{"mesh":0}])", shown = R"("nodes":[0])";
    text.replace(text.find(once), once.size(), R"("nodes":[{"mesh":0},{"mesh":0}])");
    return text.replace(text.find(shown), shown.size(), R"("nodes":[0,1])");
  }());
  limited[1] = two;
  limited.push_back("--resume");
  const Finished many = run_gnomon(limited);
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_NE(many.err.find("two.gltf: scene: 2 triangles, up to 0 MiB, are above the limit of 1"),
            std::string::npos)
      << many.err;
}

TEST(Compare, measures_maps_that_memory_does_not_take_at_the_size_it_takes) {
  const TemporaryFolder folder;
  // A depth of four bytes a texel: 128 texels a side take 0.0625 MiB, 64 take a quarter of it.
  const Finished finished =
      run_gnomon(small_sweep(folder.path(), {"--map-sizes", "64", "--map-memory-mib", "0.02"}));
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_NE(
      finished.err.find("gnomon: warning: none / auto / 1 x 128 / hard: maps of 128 do not fit (above the "
                        "limit of 0.02 MiB): maps of 64"),
      std::string::npos)
      << finished.err;
  const std::vector<report::Row> rows = report::read_rows(folder.path());
  EXPECT_EQ(rows.size(), kSmallRows) << "what became 64 is the same as what was asked for as 64";
  for (const report::Row& row : rows) {
    EXPECT_EQ(row.technique.map_size, 64);
    EXPECT_EQ(row.costs.texels, 64u * 64u);
  }
  const TemporaryFolder none;
  const Finished refused = run_gnomon(small_sweep(none.path() / "out", {"--map-memory-mib", "0.000001"}));
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("no map fits"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(none.path() / "out"));
}

TEST(Compare, the_same_technique_under_two_names_and_the_same_scene_are_measured_once) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_gnomon({"compare",
                        "builtin:fence",
                        "builtin:fence",
                        "--warps",
                        "none,none",
                        "--splits",
                        "uniform,logarithmic",
                        "--cascades",
                        "1",
                        "--fits",
                        "tight",
                        "stable",
                        "--filters",
                        "hard,pcf:radius=2,unit=texels,pcf:radius=2",
                        "--frames",
                        "1",
                        "--rounds",
                        "1",
                        "--size",
                        "32x32",
                        "--map-sizes",
                        "64",
                        "--context",
                        "osmesa",
                        "--out",
                        folder.path().string()})
                .exit_code,
            0);
  const std::vector<report::Row> rows = report::read_rows(folder.path());
  EXPECT_EQ(rows.size(), 4u) << "two fits of two filters";
  // Of maps that may be drawn from those of a viewer's frame before it is told what that saves.
  for (const report::Row& row : rows) {
    std::int64_t from_before = 0;
    for (const report::LeftOut& l : row.left_out)
      if (l.rule == "held_maps" || l.rule == "scrolled_maps") from_before += l.saves_texels;
    EXPECT_EQ(from_before > 0, row.technique.fit == "stable") << row.technique.name();
    EXPECT_LE(from_before, static_cast<std::int64_t>(row.costs.texels));
  }
}

TEST(Compare, measures_every_filter_of_the_registry_against_its_own_truth) {
  const std::vector<report::Row> rows =
      rows_of_one_small_map({"builtin:fence", "--warps", "optimal", "--filters", "all"});
  ASSERT_EQ(rows.size(), render::all_filters().size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const render::Filter& filter = *render::all_filters()[i];
    const bool knows_lights = render::default_settings(filter).value("angle_deg") > 0.0;
    EXPECT_EQ(rows[i].technique.filter, filter.info.name);
    EXPECT_EQ(rows[i].truth, knows_lights ? "area" : "filtered") << filter.info.name;
    // 256 texels are coarse for a fence: a tenth of its pixels may be wrong, and no filter halves the light.
    EXPECT_LT(rows[i].errors.false_lit + rows[i].errors.false_shadow, 0.1) << filter.info.name;
    EXPECT_LT(rows[i].errors.darkening, 0.05) << filter.info.name;
  }
}

TEST(Compare, objectives_are_rows_beside_the_warps_also_with_shapes) {
  const std::vector<report::Row> rows =
      rows_of_one_small_map({"builtin:terrain", "--warps", "psm,optimal,optimal:storage", "--shapes",
                             "linear,logarithmic", "--filters", "hard"});
  const auto row = [&](std::string_view warp) {
    const auto at = std::find_if(rows.begin(), rows.end(),
                                 [&](const report::Row& r) { return r.technique.warp == warp; });
    EXPECT_NE(at, rows.end()) << warp;
    return at == rows.end() ? report::Row() : *at;
  };
  EXPECT_NE(row("optimal").aliasing.p95, row("optimal:storage").aliasing.p95);
  EXPECT_NE(row("optimal:logarithmic").aliasing.p95, row("optimal:storage:logarithmic").aliasing.p95);
}

TEST(Compare, shapes_are_rows_beside_the_warps_with_an_even_error) {
  const std::vector<report::Row> rows = rows_of_one_small_map(
      {"builtin:terrain", "--warps", "none,psm", "--shapes", "all", "--filters", "hard"});
  // Without a warp there is none to undo, and parallel rays have no angles to even out.
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[1].technique.warp, "none:rectilinear");
  EXPECT_EQ(rows[2].technique.warp, "psm");
  EXPECT_EQ(rows[3].technique.warp, "psm:logarithmic");
  EXPECT_EQ(rows[4].technique.warp, "psm:rectilinear");
  EXPECT_LT(rows[1].aliasing.p95, 0.5 * rows[0].aliasing.p95);
  EXPECT_LT(rows[3].aliasing.p95, 0.5 * rows[2].aliasing.p95);
  for (const std::size_t bent : {1u, 3u, 4u})
    EXPECT_LT(rows[bent].errors.false_lit + rows[bent].errors.false_shadow, 0.02);
}

TEST(Compare, shapes_that_a_light_has_no_use_for_are_refused_where_nothing_else_is_left) {
  const TemporaryFolder folder;
  const Finished finished = run_gnomon(
      {"compare", "builtin:fence", "--shapes", "paraboloid", "--out", (folder.path() / "none").string()});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_NE(finished.err.find("--shapes: this light's maps take none of them"), std::string::npos)
      << finished.err;
  EXPECT_FALSE(fs::exists(folder.path() / "none"));
}

TEST(Compare, refuses_bad_input_before_it_measures) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::vector<std::string>& more) {
    const Finished finished = run_gnomon(small_sweep(folder.path() / "none", more));
    EXPECT_EQ(finished.exit_code, 2) << more.back();
    EXPECT_EQ(finished.lines().size(), 0u);
    EXPECT_FALSE(fs::exists(folder.path() / "none"));
    return finished.err;
  };
  EXPECT_NE(refusal({"--shard", "4/3"}).find("--shard 4/3: wants"), std::string::npos);
  EXPECT_NE(refusal({"--shard", "x"}).find("--shard x: wants"), std::string::npos);
  EXPECT_EQ(run_gnomon({"compare", "builtin:nowhere", "--out", (folder.path() / "none").string()}).exit_code,
            2);
  EXPECT_EQ(run_gnomon({"compare", "/nowhere.glb", "--out", (folder.path() / "none").string()}).exit_code, 2);
  for (const auto& [option, value] :
       std::vector<std::pair<std::string, std::string>>{{"--warps", "bent"},
                                                        {"--warps", "psm:nope"},
                                                        {"--shapes", "round"},
                                                        {"--splits", "even"},
                                                        {"--fits", "loose"},
                                                        {"--filters", "soap"},
                                                        {"--cascades", "0"},
                                                        {"--cascades", "9"},
                                                        {"--map-sizes", "3"},
                                                        {"--size", "64"},
                                                        {"--light-elevation-deg", "nan"},
                                                        {"--light-azimuth-deg", "nan"},
                                                        {"--map-memory-mib", "nan"},
                                                        {"--context", "glfw"}}) {
    const Finished finished =
        run_gnomon({"compare", "builtin:fence", option, value, "--out", (folder.path() / "none").string()});
    EXPECT_EQ(finished.exit_code, 2) << option;
    EXPECT_NE(finished.err.find(option), std::string::npos) << finished.err;
    EXPECT_NE(finished.err.find(value), std::string::npos) << finished.err;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "none"));
}

TEST(Compare, runs_under_gnu_parallel) {
  if (std::system("parallel --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "GNU parallel is not installed";
  const TemporaryFolder folder;
  std::string command = "parallel --will-cite -j2 " GNOMON_PROGRAM;
  for (const std::string& argument : small_sweep(folder.path() / "{}", {"--shard", "{}/3"}))
    command += " " + argument;
  ASSERT_EQ(std::system((command + " ::: 1 2 3 >/dev/null").c_str()), 0);
  std::vector<std::string> merge{"merge", "--out", (folder.path() / "merged").string()};
  for (const char* shard : {"1", "2", "3"}) merge.push_back((folder.path() / shard).string());
  expect_success(merge);
  EXPECT_EQ(lasting(folder.path() / "merged"), lasting(whole()));
}

}  // namespace
}  // namespace gnomon::test
