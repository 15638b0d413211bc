// Rows as a sweep would write them.
#include "sample_rows.hpp"

#include <stdlib.h>

#include <fstream>
#include <iterator>
#include <string>

namespace gnomon::report {

Row sample_row(std::uint64_t index) {
  Row row;
  const double x = static_cast<double>(index);
  row.index = index;
  row.scene = "builtin:fence";
  row.frame = 1;
  row.frames = 2;
  row.width = 320;
  row.height = 180;
  row.light = "sun";
  row.light_elevation_deg = 38;
  row.light_azimuth_deg = 140;
  row.technique = {"none", "auto", "tight", "hard", 1 + static_cast<int>(index % 4), 1024};
  row.plan_status = "ok";
  row.truth = "filtered";
  row.errors = {50'000, 0.01 / (1 + x), 0.002, 0.03 / (1 + x), 0.001, 9000, 0.0005, 30'000};
  row.undecided_pixels = 3;
  row.flips = 0.004;
  row.aliasing = {1.5, 3.0, 40.0, 0.75, 48'000};
  row.costs = {4, 12, 34'567, 4'194'304, 16'777'216};
  row.times.plan_ns = {21'000, 20'000, 25'000};
  row.times.depth_ms = {10 + x, 9 + x, 11 + x};
  row.times.prefilter_ms = {0, 0, 0};
  row.times.shade_ms = {3, 2, 4};
  row.times.total_ms = {13 + x, 12 + x, 15 + x};
  row.times.baseline_ms = 6.5;
  row.times.rounds = 5;
  row.left_out = {{"cascade 3", "no receiver between depths 120 and 500", 1'048'576}};
  row.machine = {"llvmpipe", "OSMesa", "some cpu", "0.1.0-3-gabcdef", "embree", true, 2, 0.5};
  return row;
}

std::vector<Row> sample_rows(int scenes, int techniques) {
  std::vector<Row> rows;
  for (int scene = 0; scene < scenes; ++scene) {
    for (int frame = 0; frame < 2; ++frame) {
      for (int t = 0; t < techniques; ++t) {
        Row row = sample_row(static_cast<std::uint64_t>(t));
        row.index = rows.size();
        row.scene = "scene" + std::to_string(scene);
        row.frame = frame;
        row.technique.map_size = 256 << (t % 3);
        row.technique.filter = t % 2 == 0 ? "hard" : "pcf";
        row.technique.warp = "warp" + std::to_string(t / 6);
        rows.push_back(row);
      }
    }
  }
  return rows;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "gnomon_report_XXXXXX").string();
  path_ = ::mkdtemp(name.data());
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace gnomon::report
