// The flythrough program from outside: what it writes, and how it refuses.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out, error;
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Flythrough : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              ("flythrough_" + std::to_string(::getpid()) + "_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path out() const { return folder_ / "pictures"; }
  /// `before`: of the shell, in front of the program.
  [[nodiscard]] Outcome run(const std::string& arguments, const std::string& before = "",
                            const std::string& folder = "") const {
    const std::string command = before + " env -u DISPLAY -u WAYLAND_DISPLAY " FLYTHROUGH " --out " +
                                (folder.empty() ? out().string() : folder) + " " + arguments + " > " +
                                (folder_ / "out").string() + " 2> " + (folder_ / "error").string();
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder_ / "out"),
            text_of(folder_ / "error")};
  }

  fs::path folder_;
};

/// Fields of a line of CSV, quotes taken off.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

TEST_F(Flythrough, refuses_bad_input_with_one_line_and_writes_nothing) {
  const struct {
    const char* arguments;
    const char* named;
  } kCases[] = {{"no_such_file.glb", "no_such_file.glb"},
                {"builtin:nowhere", "nowhere"},
                {"--warp bent", "bent"},
                {"--compare-warps none,bent", "bent"},
                {"--filter soap", "soap"},
                {"--split even", "even"},
                {"--light candle", "candle"},
                {"--filter vsm:bleed=2", "bleed=2"},
                {"--resolution blurry", "blurry"},
                {"--resolution perceptual", "--resolution perceptual"},
                {"--resolution perceptual --filter hard:radius=1,unit=world", "hard"},
                {"--resolution perceptual --filter pcf:radius=0.000001,unit=world", "widen the kernel"},
                {"--blocker-distance nan", "--blocker-distance"},
                {"--budget-ms 5", "--cost-model"},
                {"--budget-ms 5 --cost-model no_such_model.json", "no_such_model.json"},
                {"--target-error nan", "--target-error"},
                {"--target-error 1 --resolution perceptual --filter pcss", "--resolution perceptual"},
                {"--prune everything", "--prune everything"},
                {"--fit loose", "--fit loose"},
                {"--size 640", "640"},
                {"--size 640x", "640x"},
                {"--frames 0", "--frames"},
                {"--cascades 99", "--cascades"},
                {"--lambda nan", "--lambda"},
                {"--context vulkan", "vulkan"},
                {"--path no_such_path.json", "no_such_path.json"},
                {"--context glfw builtin:fence", "--context glfw"},
                {"--no-such-option", "--no-such-option"}};
  for (const auto& c : kCases) {
    const Outcome outcome = run(c.arguments);
    EXPECT_EQ(outcome.code, 2) << c.arguments;
    EXPECT_NE(outcome.error.find(c.named), std::string::npos) << c.arguments << ": " << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_FALSE(fs::exists(out())) << c.arguments;
  }
}

TEST_F(Flythrough, lets_the_filter_store_less_within_a_bound_and_says_so) {
  const std::string flight = "builtin:hangar --frames 1 --size 96x64 --map-size 128 --filter esm ";
  const auto told = [&](const std::string& more) {
    const Outcome outcome = run(flight + more);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    std::ifstream csv(out() / "frames.csv");
    const std::string text{std::istreambuf_iterator<char>(csv), {}};
    return text.find("esm:format=unorm16 does for esm") != std::string::npos;
  };
  EXPECT_TRUE(told("--filter-precision 0.5"));
  EXPECT_FALSE(told("--filter-precision 0"));
}

TEST_F(Flythrough, tells_its_version_and_its_options) {
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

TEST_F(Flythrough, chooses_maps_that_keep_to_an_error) {
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
  const auto [few, coarse] = texels_and_error(1.0);
  const auto [many, fine] = texels_and_error(0.2);
  // The mean is kept to; half of the pixels lie below it, or nearly so.
  EXPECT_LT(coarse, 1.1);
  EXPECT_GT(coarse, 0.3) << "no more than what was asked for";
  EXPECT_LT(fine, 0.22);
  EXPECT_LT(few, many);
}

TEST_F(Flythrough, passes_from_map_to_map_as_asked_and_refuses_what_it_does_not_know) {
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

TEST_F(Flythrough, tells_of_each_map_what_was_drawn_how_old_it_is_and_its_error) {
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

/// A file that calls itself a library: what asks for it by this name does not get it.
std::string without_libraries(const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) std::ofstream(folder / name) << "no library";
  return "LD_LIBRARY_PATH=" + folder.string();
}

constexpr const char* kOneFrame = "builtin:fence --frames 1 --size 64x32 --map-size 64 --cascades 1 ";

TEST_F(Flythrough, takes_the_next_context_where_one_is_refused_and_says_why) {
  const std::string no_osmesa =
      without_libraries(folder_, {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
  const Outcome other = run(kOneFrame, no_osmesa);
  EXPECT_EQ(other.code, 0) << other.error;
  // Taken only where no GPU is.
  if (other.out.find("software") != std::string::npos) {
    EXPECT_NE(other.out.find("not taken: OSMesa: libOSMesa.so.8 is not installed"), std::string::npos)
        << other.out;
  }
  const Outcome none = run(kOneFrame, without_libraries(folder_, {"libEGL.so.1"}));
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.error.find("libOSMesa.so.8 is not installed"), std::string::npos) << none.error;
  EXPECT_NE(none.error.find("libEGL.so.1 is not installed"), std::string::npos) << none.error;
}

TEST_F(Flythrough, halves_maps_that_memory_does_not_take_and_says_so) {
  const Outcome outcome =
      run("builtin:fence --frames 1 --size 64x32 --map-size 1024 --cascades 2 --filter hard --prune none "
          "--map-memory-mib 0.6");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.error.find("maps of 1024 do not fit (above the limit of 0.6 MiB): maps of 256, 0.5 MiB"),
            std::string::npos)
      << outcome.error;
  std::ifstream csv(out() / "frames.csv");
  std::string head, row;
  std::getline(csv, head);
  std::getline(csv, row);
  EXPECT_NE(row.find("," + std::to_string(2 * 256 * 256) + ","), std::string::npos) << row;
  // Maps smaller than the least that halving comes to are as good as any.
  const Outcome tiny = run("builtin:fence --frames 1 --size 64x32 --map-size 8 --cascades 1 --filter hard");
  EXPECT_EQ(tiny.code, 0) << tiny.error;
  const Outcome none = run(std::string(kOneFrame) + "--map-memory-mib 0.000001");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.error.find("no map fits"), std::string::npos) << none.error;
}

TEST_F(Flythrough, leaves_no_half_file_where_the_disk_is_full) {
  // 512 or 1024 bytes a block: less than any picture.
  const Outcome outcome =
      run("builtin:fence --frames 1 --size 640x320 --map-size 64 --cascades 1", "ulimit -f 4; ");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.error.find("cannot be written"), std::string::npos) << outcome.error;
  EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  for (const auto& entry : fs::directory_iterator(out())) ADD_FAILURE() << entry.path() << " is left";
}

TEST_F(Flythrough, standard_output_that_cannot_be_written_is_an_error) {
  for (const std::string& arguments : {std::string("--help"), kOneFrame + ("--out " + out().string())}) {
    const fs::path error = folder_ / "error";
    const int status =
        std::system((FLYTHROUGH " " + arguments + " > /dev/full 2> " + error.string()).c_str());
    EXPECT_EQ(WEXITSTATUS(status), 2) << arguments;
    EXPECT_EQ(text_of(error), "flythrough: standard output cannot be written\n");
  }
}

TEST_F(Flythrough, refuses_a_folder_that_cannot_be_written) {
  const fs::path file = folder_ / "file";
  std::ofstream(file) << "in the way";
  for (const std::string& folder : {file.string() + "/below", std::string("/proc/none")}) {
    const Outcome outcome = run(kOneFrame, "", folder);
    EXPECT_EQ(outcome.code, 2) << folder;
    EXPECT_NE(outcome.error.find(folder), std::string::npos) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  }
}

TEST_F(Flythrough, ends_with_130_and_whole_files_when_interrupted) {
  const std::string command =
      "env -u DISPLAY " FLYTHROUGH " --out " + out().string() +
      " builtin:fence --frames 5000 --size 320x160 --map-size 64 --cascades 1 > /dev/null 2> " +
      (folder_ / "error").string() + " & pid=$!; i=0; while [ ! -e " +
      (out() / "frame_0001_image.png").string() +
      " ] && [ $i -lt 3000 ]; do sleep 0.01; i=$((i+1)); done; kill -TERM $pid; wait $pid";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130) << text_of(folder_ / "error");
  EXPECT_EQ(text_of(folder_ / "error"), "flythrough: interrupted\n");
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(out())) {
    EXPECT_EQ(entry.path().extension(), ".png") << entry.path();
    const std::string bytes = text_of(entry.path());
    EXPECT_NE(bytes.find("IEND", bytes.size() - std::min<std::size_t>(bytes.size(), 12)), std::string::npos)
        << entry.path();
    ++files;
  }
  EXPECT_GE(files, 4u);
}

TEST_F(Flythrough, draws_a_scene_without_triangles) {
  const fs::path scene = folder_ / "empty.gltf";
  std::ofstream(scene) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}]})";
  const Outcome outcome = run(scene.string() + " --frames 2 --size 64x32 --map-size 64");
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("0 triangles"), std::string::npos) << outcome.out;
  EXPECT_TRUE(fs::exists(out() / "frame_0001_image.png"));
}

TEST_F(Flythrough, refuses_more_triangles_than_asked_for_before_it_makes_them) {
  const Outcome refused = run("builtin:fence --frames 1 --max-triangles 10");
  EXPECT_EQ(refused.code, 0) << "scenes of our own have no limit";
  // One triangle, four times over.
  const fs::path scene = folder_ / "many.gltf";
  const std::string text =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2,3]}],)"
      R"("buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
      R"("nodes":[{"mesh":0},{"mesh":0},{"mesh":0},{"mesh":0}]})";
  std::ofstream(scene) << text;
  const Outcome limited = run(scene.string() + " --frames 1 --size 64x32 --max-triangles 3");
  EXPECT_EQ(limited.code, 2);
  EXPECT_NE(limited.error.find("many.gltf: scene: 4 triangles, up to 0 MiB, are above the limit of 3"),
            std::string::npos)
      << limited.error;
  const Outcome raised = run(scene.string() + " --frames 1 --size 64x32 --map-size 64 --max-triangles 4");
  EXPECT_EQ(raised.code, 0) << raised.error;
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
