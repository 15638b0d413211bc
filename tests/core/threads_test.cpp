// Is the tracer still the only part that starts threads? What has none needs no thread sanitizer.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_with_threads() {
  std::vector<std::string> found;
  for (const char* part : {"include", "src", "samples"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(GNOMON_SOURCE_DIR) / part)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp") continue;
      std::ifstream in(entry.path());
      const std::string text{std::istreambuf_iterator<char>(in), {}};
      for (const char* word : {"std::jthread", "std::async", "pthread_create", "std::thread ", "std::thread(",
                               "std::thread{", "<execution>", "thread>"}) {
        if (text.find(word) == std::string::npos) continue;
        found.push_back(fs::relative(entry.path(), GNOMON_SOURCE_DIR).string());
        break;
      }
    }
  }
  return found;
}

// src/tool/machine.cpp asks how many cores there are, and starts nothing. The viewer's window goes on while
// scenes load and exact rays are traced. Pages have their error per pixel from the CPU, on all cores.
TEST(Threads, are_started_by_the_tracer_the_viewer_and_the_pictures_of_pages_alone) {
  std::vector<std::string> found = files_with_threads();
  std::erase_if(found, [](const std::string& file) {
    return file == "src/tool/machine.cpp" || file == "src/tool/pages/page_aliasing.cpp" ||
           file.starts_with("src/tool/view/");
  });
  EXPECT_EQ(found, std::vector<std::string>{"src/trace/sampling.cpp"});
}

}  // namespace
}  // namespace gnomon::test
