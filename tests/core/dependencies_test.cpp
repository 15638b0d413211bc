// Does the core reach for nothing but GLM and the standard library? No OpenGL header, no heap container.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
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
  for (const auto& entry : fs::directory_iterator(root / "include/gnomon")) {
    if (entry.path().extension() == ".hpp") files.push_back(entry.path());
  }
  return files;
}

TEST(Dependencies, the_core_includes_glm_itself_and_the_standard_library_alone) {
  // Of the standard library: no strings, streams or containers that allocate.
  const std::regex allowed(
      "<glm/[a-z0-9_/]+\\.hpp>|\"(gnomon/)?[a-z0-9_]+\\.(hpp|def)\"|\"\\.\\./[a-z0-9_]+\\.hpp\"|\"gnomon/"
      "warps\\.def\"|"
      "<(algorithm|array|bit|cfloat|cmath|cstddef|cstdint|cstdio|cstdlib|cstring|limits|numbers|span|string_"
      "view|"
      "type_traits|"
      "utility|variant|immintrin\\.h)>");
  const std::regex include("^\\s*#\\s*include\\s*([<\"][^>\"]+[>\"])");
  const auto files = core_sources();
  ASSERT_GT(files.size(), 20u);
  int includes = 0;
  for (const fs::path& path : files) {
    std::ifstream file(path);
    ASSERT_TRUE(file) << path;
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      ++includes;
      EXPECT_TRUE(std::regex_match(match[1].str(), allowed)) << path << " includes " << match[1];
    }
  }
  EXPECT_GT(includes, 50);
}

TEST(Dependencies, no_glm_function_is_used_whose_meaning_a_macro_changes) {
  const std::regex ambiguous(
      "glm::(ortho|perspective|frustum|infinitePerspective|lookAt|project|unProject)\\s*\\(");
  for (const fs::path& path : core_sources()) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
      EXPECT_FALSE(std::regex_search(line, ambiguous)) << path << line;
  }
}

}  // namespace
}  // namespace gnomon::test
