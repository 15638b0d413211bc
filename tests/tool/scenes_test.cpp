// Does `gnomon scenes` list and write what it can, and do commands have the options that docs/files.md says?
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <tuple>

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

/// A triangle in the plane z = 0, and these nodes beside it.
std::string triangle_and(const std::string& nodes, const std::string& more = "") {
  const int count = static_cast<int>(std::count(nodes.begin(), nodes.end(), '{'));
  std::string roots = "0";
  for (int n = 1; n <= count; ++n) roots += "," + std::to_string(n);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)" + roots +
         R"(]}],"nodes":[{"mesh":0},)" + nodes +
         R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" + more +
         R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],)" +
         R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,)" +
         R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

// Each command that opens a scene, in a flight or picture as short as it takes.
TEST(Scenes, are_opened_with_a_line_for_each_fault_by_every_command) {
  const TemporaryFolder folder;
  const std::string file = folder.write("broken.gltf", triangle_and(R"({"camera":3})"));
  const std::vector<std::vector<std::string>> commands{
      {"view", "--out", (folder.path() / "view.png").string()},
      {"fly", "--frames", "1", "--map-size", "64", "--out", (folder.path() / "fly").string()},
      {"compare", "--warps", "none", "--filters", "hard", "--frames", "1", "--out",
       (folder.path() / "compare").string()},
      {"accumulate", "--frames", "1"},
      {"bias", "--layers", "front"},
      {"panes", "--frames", "1", "--rounds", "1"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.begin() + 1, file);
    words.insert(words.end(), {"--size", "32x18", "--context", "osmesa"});
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 0) << words[0] << ": " << finished.err;
    const std::string line = "gnomon: warning: nodes[1].camera: names cameras[3], there are 0, skipped\n";
    const auto at = finished.err.find(line);
    ASSERT_NE(at, std::string::npos) << words[0] << ": " << finished.err;
    EXPECT_EQ(finished.err.find(line, at + 1), std::string::npos) << words[0] << " says it twice";
  }
}

// A camera turned about the line of sight by an angle whose sine is 0.96, and one that looks down with west
// at its top.
TEST(Scenes, whose_camera_is_rolled_have_the_picture_of_the_same_camera_by_hand) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "cameras.gltf",
      triangle_and(
          R"({"name":"level","camera":0,"translation":[0.2,0,3]},)"
          R"({"name":"rolled","camera":0,"translation":[0.2,0,3],"rotation":[0,0,0.6,0.8]},)"
          R"({"name":"down","camera":0,"translation":[0.2,3,0.1],"rotation":[-0.7071067811865476,0,0,0.7071067811865476]},)"
          R"({"name":"down turned","camera":0,"translation":[0.2,3,0.1],"rotation":[-0.5,0.5,0.5,0.5]})",
          R"("cameras":[{"type":"perspective","perspective":{"yfov":1.0471975511965976,"znear":0.1,"zfar":9}}],)"));
  const auto picture = [&](const std::vector<std::string>& camera) {
    const fs::path out = folder.path() / "view.png";
    std::vector<std::string> words{"view",      file,     "--ground", "--size",    "96x54",
                                   "--context", "osmesa", "--out",    out.string()};
    words.insert(words.end(), camera.begin(), camera.end());
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    EXPECT_EQ(finished.err, "");
    return content_of(out);
  };
  const auto by_path = [&](const std::string& key) {
    return picture({"--path", folder.write("path.json", R"({"keys":[)" + key + R"(],"near":0.1,"far":9})")});
  };
  const std::string level = picture({"--camera", "level"}), rolled = picture({"--camera", "rolled"});
  EXPECT_TRUE(level != rolled);
  EXPECT_TRUE(level == by_path(R"({"position":[0.2,0,3],"target":[0.2,0,2]})"));
  EXPECT_TRUE(rolled == by_path(R"({"position":[0.2,0,3],"target":[0.2,0,2],"up":[-0.96,0.28,0]})"));
  EXPECT_TRUE(rolled == picture({"--eye=0.2,0,3", "--target=0.2,0,2", "--eye-up=-0.96,0.28,0", "--near",
                                 "0.1", "--far", "9"}));
  const std::string down = picture({"--camera", "down"}), turned = picture({"--camera", "down turned"});
  EXPECT_TRUE(down != turned);
  EXPECT_TRUE(turned == by_path(R"({"position":[0.2,3,0.1],"target":[0.2,2,0.1],"up":[-1,0,0]})"));
}

TEST(Scenes, give_a_picture_its_width_over_height_by_their_camera_unless_a_size_is_given) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "cameras.gltf", triangle_and(R"({"name":"tall","camera":0,"translation":[0,0,3]},)"
                                   R"({"name":"wide","camera":1,"translation":[0,0,3]},)"
                                   R"({"name":"free","camera":2,"translation":[0,0,3]})",
                                   R"("cameras":[{"perspective":{"yfov":0.8,"znear":0.1,"aspectRatio":0.5}},)"
                                   R"({"orthographic":{"xmag":8,"ymag":-2,"znear":0.1,"zfar":9}},)"
                                   R"({"perspective":{"yfov":0.8,"znear":0.1}}],)"));
  const auto size_of = [&](const char* command, const char* camera, bool given, std::string& err) {
    const fs::path out = folder.path() / command;
    const bool fly = command == std::string("fly");
    std::vector<std::string> words{
        command,  file,         "--camera", camera,  "--context",
        "osmesa", "--map-size", "64",       "--out", out.string() + (fly ? "" : ".png")};
    if (fly) words.insert(words.end(), {"--frames", "1"});
    if (given) words.insert(words.end(), {"--size", "96x54"});
    const Finished finished = run_gnomon(words);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    err = finished.err;
    // Width and height stand in the header of a PNG file.
    const std::string bytes =
        content_of(fly ? out / "frame_0000_image.png" : fs::path(out.string() + ".png"));
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes.at(at + i));
      return value;
    };
    return std::pair(number(16), number(20));
  };
  std::string err;
  EXPECT_EQ(size_of("fly", "tall", false, err), std::pair(270, 540));
  EXPECT_EQ(size_of("fly", "wide", false, err), std::pair(960, 240));
  EXPECT_EQ(size_of("fly", "free", false, err), std::pair(960, 540));
  EXPECT_EQ(err, "");
  const auto [width, height] = size_of("view", "tall", false, err);
  EXPECT_EQ(2 * width, height);
  for (const char* command : {"fly", "view"}) {
    EXPECT_EQ(size_of(command, "tall", true, err), std::pair(96, 54));
    EXPECT_EQ(err,
              "gnomon: warning: --camera tall: its width over height, 0.5, is not followed: --size 96x54 is "
              "given\n");
  }
}

/// Lights by their JSON, each held by a node over the triangle.
std::string triangle_under(const std::vector<std::string>& lights) {
  std::string nodes, list;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    nodes += R"({"translation":[0.4,0.3,1],"extensions":{"KHR_lights_punctual":{"light":)" +
             std::to_string(i) + "}}},";
    list += (i > 0 ? "," : "") + lights[i];
  }
  std::string text = triangle_and(R"({"name":"front","camera":0,"translation":[0.3,0.3,2]})",
                                  R"("cameras":[{"perspective":{"yfov":0.8,"znear":0.1,"zfar":9}}],)"
                                  R"("extensions":{"KHR_lights_punctual":{"lights":[)" +
                                      list + "]}},");
  // Nodes of lights come last, and each is a root of its own.
  const std::string last = R"("nodes":[{"mesh":0},)";
  text.insert(text.find(last) + last.size(), nodes);
  std::string roots = "0,1";
  for (std::size_t i = 0; i < lights.size(); ++i) roots += "," + std::to_string(i + 2);
  const std::string first = R"("scenes":[{"nodes":[)";
  const std::size_t at = text.find(first) + first.size();
  return text.replace(at, text.find(']', at) - at, roots);
}

const char* const kSun = R"({"type":"directional","name":"sun","intensity":3})";
const char* const kOff = R"({"type":"point","name":"off","intensity":0})";
const char* const kNamedAll = R"({"type":"point","name":"all","color":[1,0.5,0],"intensity":2})";

TEST(Scenes, show_all_lights_of_their_file_at_once_and_count_those_that_are_omitted) {
  const TemporaryFolder folder;
  const std::string file = folder.write("lit.gltf", triangle_under({kSun, kOff, kNamedAll}));
  const auto run = [&](std::vector<std::string> words, const std::string& light) {
    words.insert(words.begin() + 1, file);
    words.insert(words.end(),
                 {"--camera", "front", "--scene-light", light, "--size", "96x54", "--context", "osmesa"});
    return run_gnomon(words);
  };
  const std::string out = (folder.path() / "fly").string(), picture = (folder.path() / "view.png").string();
  const auto fly = [&](const std::string& light, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"fly", "--frames", "1", "--out", out});
    return run(more, light);
  };
  const Finished all = fly("all", {"--json"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_NE(all.out.find(R"("lights":{"of_file":3,"drawn":2,"out_of_view":0,"dark":1,"beyond_limit":0})"),
            std::string::npos)
      << all.out;
  const std::string of_all = content_of(folder.path() / "fly/frame_0000_image.png");
  EXPECT_NE(fly("all").out.find("lights:   2 of 3 drawn, 1 without intensity or colour\n"),
            std::string::npos);
  // The viewer has the same picture.
  const Finished viewed = run({"view", "--out", picture}, "all");
  EXPECT_EQ(viewed.exit_code, 0) << viewed.err;
  EXPECT_EQ(viewed.err, "gnomon: warning: --scene-light all: 2 of 3 drawn, 1 without intensity or colour\n");
  EXPECT_EQ(content_of(picture), of_all);
  // The light that is called so is there by its number.
  EXPECT_EQ(fly("2").exit_code, 0);
  EXPECT_NE(content_of(folder.path() / "fly/frame_0000_image.png"), of_all);
  for (const std::vector<std::string>& beside :
       std::vector<std::vector<std::string>>{{"--compare-warps", "none"},
                                             {"--history"},
                                             {"--visible-depths"},
                                             {"--pages", "resolution"},
                                             {"--shadow-only"}}) {
    const Finished refused = fly("all", beside);
    EXPECT_EQ(refused.exit_code, 2) << beside[0];
    EXPECT_TRUE(refused.err.starts_with("gnomon: --scene-light all: " + beside[0])) << refused.err;
  }
  const Finished stores = fly("all", {"--filter", "vsm"});
  EXPECT_EQ(stores.exit_code, 2);
  EXPECT_NE(stores.err.find("filter vsm: stores texels"), std::string::npos) << stores.err;
  for (const std::vector<std::string>& beside :
       std::vector<std::vector<std::string>>{{"--view", "heat"},
                                             {"--view", "truth"},
                                             {"--pages", "resolution"},
                                             {"--history"},
                                             {"--linear-depth"}}) {
    std::vector<std::string> words{"view", "--out", picture};
    words.insert(words.end(), beside.begin(), beside.end());
    const Finished refused = run(words, "all");
    EXPECT_EQ(refused.exit_code, 2) << beside[0];
    EXPECT_NE(refused.err.find("all lights of the file"), std::string::npos) << refused.err;
  }
}

TEST(Scenes, without_a_light_that_shines_are_refused_where_all_are_wanted) {
  const TemporaryFolder folder;
  for (const auto& [name, lights, line] :
       std::vector<std::tuple<const char*, std::vector<std::string>, std::string>>{
           {"none.gltf", {}, "--scene-light all: the file has no light\n"},
           {"dark.gltf",
            {kOff, kOff},
            "--scene-light all: the file's 2 lights have no intensity or colour\n"}}) {
    const std::string file = folder.write(name, triangle_under(lights));
    const Finished fly =
        run_gnomon({"fly", file, "--scene-light", "all", "--frames", "1", "--size", "32x18", "--context",
                    "osmesa", "--json", "--out", (folder.path() / "fly").string()});
    EXPECT_EQ(fly.exit_code, 2);
    EXPECT_EQ(fly.err, "gnomon: " + line);
    const Finished view = run_gnomon({"view", file, "--scene-light", "all", "--size", "32x18", "--context",
                                      "osmesa", "--out", (folder.path() / "view.png").string()});
    EXPECT_EQ(view.exit_code, 2);
    EXPECT_EQ(view.err, "gnomon: " + line);
  }
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::stringstream stream(row.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(cell);
  return cells;
}

std::vector<std::string> quoted_in(const std::string& cell) {
  std::vector<std::string> words;
  const std::regex quoted("`([^`]+)`");
  for (std::sregex_iterator at(cell.begin(), cell.end(), quoted), end; at != end; ++at)
    words.push_back((*at)[1]);
  return words;
}

TEST(Scenes, are_opened_by_commands_with_the_options_that_the_page_has_in_its_table) {
  std::stringstream page(content_of(fs::path(GNOMON_CAPTURES) / "../../docs/files.md"));
  std::vector<std::vector<std::string>> options;  // by column
  int checked = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("| command | `--path`")) {
      for (const std::string& cell : cells_of(line)) options.push_back(quoted_in(cell));
      std::getline(page, line);  // the rule
      continue;
    }
    if (options.empty()) continue;
    if (!line.starts_with("|")) break;
    const std::vector<std::string> cells = cells_of(line);
    ASSERT_GE(cells.size(), options.size());
    const std::string command = quoted_in(cells[0]).at(0), help = run_gnomon({command, "--help"}).out;
    for (std::size_t column = 1; column < options.size(); ++column) {
      for (const std::string& option : options[column]) {
        const bool has = std::regex_search(help, std::regex("\\n  " + option + "( |\\n)"));
        EXPECT_EQ(has, cells[column] == " yes ") << command << " " << option;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 100);
}

}  // namespace
}  // namespace gnomon::test
