// Does the core reach for nothing but GLM and the standard library? No OpenGL header, no heap container.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> core_sources() {
  std::vector<fs::path> files;
  const fs::path root = GNOMON_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root / "src/core")) {
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp")
      files.push_back(entry.path());
  }
  for (const char* folder : {"include/gnomon", "include/gnomon/extend", "include/gnomon/study"}) {
    for (const auto& entry : fs::directory_iterator(root / folder))
      if (entry.path().extension() == ".hpp") files.push_back(entry.path());
  }
  return files;
}

/// What an #include line names, with its quotes or brackets; empty for other lines.
std::string included(const std::string& line) {
  const std::size_t hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line[hash] != '#') return {};
  const std::size_t word = line.find_first_not_of(" \t", hash + 1);
  if (word == std::string::npos || line.compare(word, 7, "include") != 0) return {};
  const std::size_t begin = line.find_first_of("<\"", hash);
  const std::size_t end = begin == std::string::npos ? begin : line.find_first_of(">\"", begin + 1);
  return end == std::string::npos ? std::string{} : line.substr(begin, end + 1 - begin);
}

/// The stages of src/core in the order in which they may include each other.
constexpr std::array<std::string_view, 12> kStages = {"lanes",   "resolve", "geometry", "split",
                                                      "warp",    "cull",    "map",      "plan",
                                                      "measure", "pages",   "lights",   "study"};

/// Which stage a path begins with; -1: none.
int level_of(std::string_view path) {
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    if (path.starts_with(kStages[i]) && path.substr(kStages[i].size()).starts_with("/"))
      return static_cast<int>(i);
  }
  return -1;
}

bool allowed(const std::string& name) {
  // Of the standard library: no strings, streams or containers that allocate.
  static const std::set<std::string> standard = {
      "<algorithm>", "<array>",       "<bit>",         "<cfloat>",      "<cmath>",   "<cstddef>",
      "<cstdint>",   "<cstdio>",      "<cstdlib>",     "<cstring>",     "<limits>",  "<numbers>",
      "<optional>",  "<span>",        "<string_view>", "<type_traits>", "<utility>", "<variant>",
      "<iterator>",  "<immintrin.h>", "<new>"};  // for records made in place; another test counts allocations
  // Its own headers are of one of its own folders: none below gnomon/ but the core's.
  if (name.starts_with("\"")) {
    const std::string path = name.substr(1, name.size() - 2);
    if (level_of(path) >= 0) return fs::exists(fs::path(GNOMON_SOURCE_DIR) / "src/core" / path);
    for (const std::string_view folder : {"gnomon/extend/", "gnomon/study/"})
      if (path.starts_with(folder)) return path.find('/', folder.size()) == std::string::npos;
    return path.starts_with("gnomon/") && path.find('/', 7) == std::string::npos;
  }
  // What stops a compiler that is set below C++20.
  if (name.starts_with("<gnomon needs C++20")) return true;
  return name.starts_with("<glm/") || standard.count(name) > 0;
}

TEST(Dependencies, the_core_includes_glm_itself_and_the_standard_library_alone) {
  const auto files = core_sources();
  ASSERT_GT(files.size(), 20u);
  int includes = 0;
  for (const fs::path& path : files) {
    std::ifstream file(path);
    ASSERT_TRUE(file) << path;
    for (std::string line; std::getline(file, line);) {
      const std::string name = included(line);
      if (name.empty()) continue;
      ++includes;
      EXPECT_TRUE(allowed(name)) << path << " includes " << name;
    }
  }
  EXPECT_GT(includes, 50);
}

/// The include of a higher stage in a file of `stage`; empty where there is none.
std::string upward_include(std::string_view stage_folder, std::istream& file) {
  const int own = level_of(std::string(stage_folder) + "/");
  for (std::string line; std::getline(file, line);) {
    const std::string name = included(line);
    if (name.size() > 2 && level_of(std::string_view(name).substr(1)) > own) return name;
  }
  return {};
}

TEST(Dependencies, includes_go_down_the_pipeline_only) {
  const fs::path root = fs::path(GNOMON_SOURCE_DIR) / "src/core";
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file() || entry.path().filename() == "CMakeLists.txt") continue;
    const fs::path folder = entry.path().parent_path().lexically_relative(root);
    ASSERT_GE(level_of(folder.string() + "/"), 0) << entry.path() << " lies in no stage";
    std::ifstream file(entry.path());
    EXPECT_EQ(upward_include(folder.string(), file), "") << entry.path();
    ++files;
  }
  EXPECT_GT(files, 50);
  std::istringstream upward("#include <cmath>\n#include \"plan/budget.hpp\"\n");
  EXPECT_EQ(upward_include("map", upward), "\"plan/budget.hpp\"");
}

TEST(Dependencies, the_check_knows_what_it_looks_for) {
  EXPECT_EQ(included("#include <GL/gl.h>  // no"), "<GL/gl.h>");
  EXPECT_EQ(included("  #  include \"gnomon/render/context.hpp\""), "\"gnomon/render/context.hpp\"");
  EXPECT_EQ(included("// #include <vector>"), "");
  for (const char* name : {"<GL/gl.h>", "<vector>", "<string>", "<iostream>", "\"gnomon/render/context.hpp\"",
                           "\"scene/load.hpp\"", "<glad/gl.h>"}) {
    EXPECT_FALSE(allowed(name)) << name;
  }
  for (const char* name : {"<glm/vec3.hpp>", "\"gnomon/plan.hpp\"", "\"gnomon/study/dpds.hpp\"",
                           "\"geometry/vector.hpp\"", "<cmath>"}) {
    EXPECT_TRUE(allowed(name)) << name;
  }
}

TEST(Dependencies, vector_instructions_are_named_in_one_file) {
  const std::regex instruction("\\b_mm\\w+\\(|<immintrin\\.h>|__m128|__SSE2__");
  int files = 0;
  for (const fs::path& path : core_sources()) {
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!std::regex_search(text, instruction)) continue;
    EXPECT_TRUE(path.generic_string().ends_with("src/core/lanes/pair.hpp")) << path;
    ++files;
  }
  EXPECT_EQ(files, 1);
}

TEST(Dependencies, what_is_ignored_is_decided_in_one_place) {
  const std::regex entry("IgnoredOption::|option_ignored|_in_stable_fit");
  int files = 0;
  for (const fs::path& path : core_sources()) {
    const std::string name = path.generic_string();
    // Their definition, and their text.
    if (name.find("/include/gnomon/") != std::string::npos || name.ends_with("plan/omission.cpp")) continue;
    std::ifstream file(path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!std::regex_search(text, entry)) continue;
    EXPECT_NE(name.find("src/core/resolve/"), std::string::npos) << path;
    ++files;
  }
  EXPECT_GT(files, 0);
}

TEST(Dependencies, no_glm_function_is_used_whose_meaning_a_macro_changes) {
  for (const fs::path& path : core_sources()) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
      for (const char* name :
           {"ortho", "perspective", "frustum", "infinitePerspective", "lookAt", "project", "unProject"}) {
        EXPECT_EQ(line.find(std::string("glm::") + name + "("), std::string::npos) << path << ": " << line;
      }
    }
  }
}

}  // namespace
}  // namespace gnomon::test
