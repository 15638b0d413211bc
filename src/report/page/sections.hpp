// The parts of the report's page, each as HTML.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gpu.hpp"
#include "stability.hpp"
#include "summary.hpp"

namespace gnomon::report {

/// What `gnomon stress` writes into a folder.
inline constexpr const char* kStabilityFile = "stability.jsonl";

/// All that the page is made of.
struct PageInput {
  std::filesystem::path folder;
  std::vector<Row> rows;
  Summary summary;
  Stability stability;
  std::vector<GpuRun> gpus;
  std::size_t start_scene = 0;        ///< which the page shows first
  std::vector<std::string> warnings;  ///< what of the rows misleads, or could not be read
};

[[nodiscard]] PageInput page_input(const std::filesystem::path& folder, std::vector<Row> rows);

/// Pictures that go into the page, each once.
struct PagePictures {
  struct OfTechnique {
    std::size_t mask = 0, difference = 0, heat = 0;
  };
  struct OfScene {
    bool any = false;
    int frame = 0;
    std::size_t truth = 0, image = 0, first = 0;
    std::map<std::size_t, OfTechnique> of;  ///< by technique
  };
  std::vector<std::string> base64;
  std::vector<OfScene> scenes;  ///< as in the summary
  std::size_t left_out = 0;     ///< techniques whose pictures lie in the folder alone
};
/// Reads them, the techniques of each scene's front first, until the page holds some 16 MiB.
[[nodiscard]] PagePictures page_pictures(const PageInput& input);

[[nodiscard]] std::string section_error_time(const PageInput& input);
[[nodiscard]] std::string section_summary(const PageInput& input);
[[nodiscard]] std::string section_viewers(const PageInput& input, const PagePictures& pictures);
[[nodiscard]] std::string section_flight(const PageInput& input);
[[nodiscard]] std::string section_stability(const PageInput& input);
[[nodiscard]] std::string section_left_out(const PageInput& input);
[[nodiscard]] std::string section_method(const PageInput& input);
/// What the page's script reads, as JSON.
[[nodiscard]] std::string page_data(const PageInput& input, const PagePictures& pictures);
/// All of it: the file of HTML.
[[nodiscard]] std::string whole_page(const PageInput& input);

}  // namespace gnomon::report
