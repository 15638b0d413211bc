// Writes rows and pictures as a sweep would, with names that try to break out of a page, and their report.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "gnomon/report/page.hpp"
#include "gnomon/report/rows_file.hpp"
#include "sample_rows.hpp"

namespace {

/// A PNG of one grey pixel.
constexpr unsigned char kPixel[] = {
    0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0,    0,    13,  'I',  'H',  'D',  'R',  0,
    0,    0,    1,    0,    0,    0,    1,    8,    0,    0,    0,    0,   0x3a, 0x7e, 0x9b, 0x55, 0,
    0,    0,    10,   'I',  'D',  'A',  'T',  0x78, 0x9c, 0x63, 0x68, 0,   0,    0,    0x82, 0,    0x81,
    0x77, 0xcd, 0x72, 0xb6, 0,    0,    0,    0,    'I',  'E',  'N',  'D', 0xae, 0x42, 0x60, 0x82};

constexpr const char* kHostile = "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'&\xff";

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder / "pictures");
    std::ofstream(folder / "pictures/pixel.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(kPixel), sizeof kPixel);
    std::filesystem::remove(folder / gnomon::report::kRowsFile);
    gnomon::report::RowsFile file(folder / gnomon::report::kRowsFile);
    for (gnomon::report::Row row : gnomon::report::sample_rows(2, 8)) {
      if (row.scene == "scene1") row.scene = kHostile;
      if (row.technique.filter == "pcf") row.technique.filter = kHostile;
      row.machine.cpu = kHostile;
      row.left_out[0].why = kHostile;
      if (row.frame == 1) {
        const std::string pixel = "pictures/pixel.png";
        row.pictures = {pixel, pixel, pixel, pixel, pixel};
      }
      file.append(row);
    }
    std::ofstream(folder / "stability.jsonl") << "{\"what\":\"<b>bold</b>\",\"value\":0.25}\n";
    std::printf("%s\n", gnomon::report::write_report(folder).c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
