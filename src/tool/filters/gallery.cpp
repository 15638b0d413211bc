// Writes the figures of the filters' papers: strips of pictures, and one page with their tables.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "figures.hpp"
#include "filters.hpp"
#include "gnomon/render/picture.hpp"
#include "output.hpp"

namespace gnomon::tool {
namespace {

namespace fs = std::filesystem;

constexpr int kGap = 4, kCaption = 14, kColumns = 4;

void write_strip(const std::vector<Panel>& panels, const fs::path& file) {
  constexpr render::Color kPaper{255, 255, 255}, kInk{20, 20, 20};
  const int count = static_cast<int>(panels.size()), columns = std::min(count, kColumns);
  const int rows = (count + columns - 1) / columns;
  const int width = panels[0].image.width + kGap, height = panels[0].image.height + kCaption + kGap;
  Image sheet = render::blank_image(columns * width, rows * height, kPaper);
  for (int i = 0; i < count; ++i) {
    const Panel& panel = panels[static_cast<std::size_t>(i)];
    const int x = i % columns * width, y = i / columns * height;
    // Before the picture, which covers what a long caption has too much.
    render::draw_text(sheet, x + 2, y + 3, panel.caption, kInk);
    render::paste(sheet, panel.image, x, y + kCaption);
  }
  write_png(sheet, file);
  print_line(file.string());
}

std::string table_of(const Figure& figure) {
  std::string text = "|", rule = "|";
  for (const std::string& column : figure.columns) {
    text += " " + column + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const Figure::Row& row : figure.rows) {
    text += "| " + row.label;
    for (const double value : row.values) {
      char number[32];
      std::snprintf(number, sizeof number, " | %.4g", value);
      text += number;
    }
    text += " |\n";
  }
  return text;
}

}  // namespace

void write_filter_gallery(const std::string& folder, const std::string& scene) {
  make_folder("--gallery", folder);
  std::string text =
      "# Shadow filters\n\nTruth: the mean of 4 x 4 hard samples a pixel out of a map of 4096 texels.\n";
  const auto add = [&](const Figure& figure) {
    text += "\n## " + figure.title + "\n\n" + table_of(figure);
    if (figure.panels.empty()) return;
    write_strip(figure.panels, fs::path(folder) / (figure.name + ".png"));
    text += "\n![" + figure.title + "](" + figure.name + ".png)\n";
  };
  const FigureSize size;
  add(convolution_orders(size));
  add(bleeding_bars(size));
  add(bleeding_fence(size));
  add(minification(size));
  add(exponential_failures(size));
  add(matching_samples(size));
  add(contacts(size));
  add(overlaps(size));
  add(bits(size));
  add(memory_of_filters());
  add(one_scene(scene, size));
  write_file(fs::path(folder) / "gallery.md", text);
  print_line((fs::path(folder) / "gallery.md").string());
  flush_output();
}

}  // namespace gnomon::tool
