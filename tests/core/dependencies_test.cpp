// Does the core reach for nothing but GLM and the standard library? No OpenGL header, no heap container.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
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

/// What an #include line names, with its quotes or brackets; empty for other lines.
std::string included(const std::string& line) {
  const std::size_t hash = line.find_first_not_of(" \t");
  if (hash == std::string::npos || line[hash] != '#') return {};
  if (line.find("include", hash) == std::string::npos) return {};
  const std::size_t begin = line.find_first_of("<\"", hash);
  const std::size_t end = begin == std::string::npos ? begin : line.find_first_of(">\"", begin + 1);
  return end == std::string::npos ? std::string{} : line.substr(begin, end + 1 - begin);
}

bool allowed(const std::string& name) {
  // Of the standard library: no strings, streams or containers that allocate.
  static const std::set<std::string> standard = {
      "<algorithm>", "<array>",       "<bit>",         "<cfloat>",  "<cmath>",   "<cstddef>",
      "<cstdint>",   "<cstdio>",      "<cstdlib>",     "<cstring>", "<limits>",  "<numbers>",
      "<span>",      "<string_view>", "<type_traits>", "<utility>", "<variant>", "<immintrin.h>"};
  // Its own headers are of one of its own folders: none below gnomon/ but the core's.
  if (name.starts_with("\"")) {
    const std::string path = name.substr(1, name.size() - 2);
    const std::size_t folders = path.starts_with("gnomon/") ? 7 : (path.starts_with("../") ? 3 : 0);
    return path.find('/', folders) == std::string::npos;
  }
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

TEST(Dependencies, the_check_knows_what_it_looks_for) {
  EXPECT_EQ(included("#include <GL/gl.h>  // no"), "<GL/gl.h>");
  EXPECT_EQ(included("  #  include \"gnomon/render/context.hpp\""), "\"gnomon/render/context.hpp\"");
  EXPECT_EQ(included("// #include <vector>"), "");
  for (const char* name : {"<GL/gl.h>", "<vector>", "<string>", "<iostream>", "\"gnomon/render/context.hpp\"",
                           "\"scene/load.hpp\"", "<glad/gl.h>"}) {
    EXPECT_FALSE(allowed(name)) << name;
  }
  for (const char* name :
       {"<glm/vec3.hpp>", "\"gnomon/plan.hpp\"", "\"vector.hpp\"", "\"../vector.hpp\"", "<cmath>"}) {
    EXPECT_TRUE(allowed(name)) << name;
  }
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
