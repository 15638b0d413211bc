// What does the flythrough program refuse, and what does it leave behind when it cannot go on?
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "flythrough_program.hpp"

namespace flythrough_test {
namespace {

TEST_F(Flythrough, refuses_bad_input_with_one_line_and_writes_nothing) {
  const struct {
    const char* arguments;
    const char* named;
  } kCases[] = {
      {"no_such_file.glb", "no_such_file.glb"},
      {"builtin:nowhere", "nowhere"},
      {"--warp bent", "bent"},
      {"--compare-warps none,bent", "bent"},
      {"--filter soap", "soap"},
      {"--split even", "even"},
      {"--light candle", "candle"},
      {"--filter vsm:bleed=2", "bleed=2"},
      {"--resolution blurry", "blurry"},
      {"--resolution perceptual", "--resolution perceptual"},
      {"--resolution perceptual --filter hard", "hard"},
      {"--filter hard:radius=1", "radius: hard knows contacts"},
      {"--resolution perceptual --filter pcf:radius=0.000001,unit=world", "widen the kernel"},
      {"--blocker-distance nan", "--blocker-distance"},
      {"--blocker-distance 5 --filter pcss", "--blocker-distance requires --resolution"},
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
      {"--lambda 0.5 --split uniform", "--lambda"},
      {"--cost-model model.json", "--cost-model requires"},
      {"--context vulkan", "vulkan"},
      {"--path no_such_path.json", "no_such_path.json"},
      {"--context glfw builtin:fence", "--context glfw"},
      {"--pages resoluton", "did you mean 'resolution'?"},
      {"--pages resolution --page-size 96", "--page-size 96: wants 64, 128 or 256"},
      {"--page-target 1", "--page-target requires --pages"},
      {"--pages resolution --filter savsm", "no pages with savsm: sums up the texels of whole maps"},
      {"--pages resolution --page-capacity 3", "page_capacity 3: this light needs at least 4"},
      {"--pages resolution --context glfw", "gnomon view --pages"},
      {"--pages resolution --history", "--pages: --history is for whole maps"},
      {"--pages resolution --compare-warps none", "--pages: --compare-warps is for whole maps"},
      {"--no-such-option", "--no-such-option"}};
  for (const auto& c : kCases) {
    const Outcome outcome = run(c.arguments);
    EXPECT_EQ(outcome.code, 2) << c.arguments;
    EXPECT_NE(outcome.error.find(c.named), std::string::npos) << c.arguments << ": " << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_FALSE(fs::exists(out())) << c.arguments;
  }
}

/// A file that calls itself a library: what asks for it by this name does not get it.
std::string without_libraries(const fs::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) std::ofstream(folder / name) << "no library";
  return "LD_LIBRARY_PATH=" + folder.string();
}

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
    EXPECT_EQ(text_of(error), "flythrough: standard output: No space left on device\n");
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

TEST_F(Flythrough, refuses_the_folder_before_it_loads_the_scene) {
  const fs::path file = folder_ / "file";
  std::ofstream(file) << "in the way";
  const Outcome outcome = run("no_such_file.glb", "", file.string() + "/below");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.error.find("--out"), std::string::npos) << outcome.error;
  EXPECT_EQ(outcome.error.find("no_such_file"), std::string::npos) << outcome.error;
}

TEST_F(Flythrough, suggests_names_that_nearly_match) {
  const struct {
    const char *arguments, *meant;
  } kCases[] = {{"--warp lispms", "'lispsm'"},      {"--filter pfc:radius=2", "'pcf'"},
                {"builtin:ctiy", "'builtin:city'"}, {"--compare-warps none,lispms", "'lispsm'"},
                {"--fit tigt", "'tight'"},          {"--filer pcf", "'--filter'"}};
  for (const auto& c : kCases) {
    const Outcome outcome = run(c.arguments);
    EXPECT_EQ(outcome.code, 2) << c.arguments;
    EXPECT_NE(outcome.error.find(std::string("did you mean ") + c.meant), std::string::npos) << outcome.error;
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
  // The rows of the frames that were drawn are not lost.
  const std::string rows = text_of(out() / "frames.csv");
  EXPECT_GE(std::count(rows.begin(), rows.end(), '\n'), 2) << "a head and a row at least";
  EXPECT_EQ(rows.find("frame,"), 0u);
  EXPECT_EQ(rows.back(), '\n');
  for (const auto& entry : fs::directory_iterator(out())) {
    if (entry.path().filename() == "frames.csv") continue;
    EXPECT_EQ(entry.path().extension(), ".png") << entry.path();
    const std::string bytes = text_of(entry.path());
    EXPECT_NE(bytes.find("IEND", bytes.size() - std::min<std::size_t>(bytes.size(), 12)), std::string::npos)
        << entry.path();
    ++files;
  }
  EXPECT_GE(files, 4u);
}

#ifdef GNOMON_LOST_OSMESA
TEST_F(Flythrough, ends_with_one_line_and_what_it_has_where_the_driver_is_reset) {
  // The third frame asks more often than that.
  const Outcome outcome =
      run("builtin:fence --frames 5 --size 64x32 --map-size 64 --cascades 1 --context osmesa",
          "LD_LIBRARY_PATH=" GNOMON_LOST_OSMESA " GNOMON_TEST_RESET_AFTER=10");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.error,
            "flythrough: the OpenGL context was lost: the driver was reset for an unknown reason\n");
  EXPECT_TRUE(fs::exists(out() / "frame_0001_cascades.png"));
  EXPECT_FALSE(fs::exists(out() / "frame_0004_image.png"));
  const std::string numbers = text_of(out() / "frames.csv");
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), '\n'), 3) << "a head and two frames: " << numbers;
}
#endif

TEST_F(Flythrough, refuses_more_triangles_than_allowed_before_it_makes_them) {
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

}  // namespace
}  // namespace flythrough_test
