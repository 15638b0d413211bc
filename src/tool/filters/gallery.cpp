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

/// Red where the panel is lighter than the truth, blue where it is darker, at half its size.
Image difference_of(const Panel& panel) {
  Image image = render::blank_image(panel.image.width, panel.image.height, {255, 255, 255});
  for (std::size_t i = 0; i < panel.off.size(); ++i) {
    const float off = std::clamp(panel.off[i], -1.0f, 1.0f);
    const auto rest = static_cast<std::uint8_t>(255.0f * (1.0f - std::abs(off)));
    std::uint8_t* pixel = &image.rgba[4 * i];
    pixel[1] = rest;
    pixel[off > 0.0f ? 2 : 0] = rest;
  }
  return render::shrunk(image, std::max(image.width / 2, 1), std::max(image.height / 2, 1));
}

/// A window of the picture at half the picture's size.
Image zoomed(const Image& image, const Figure::Window& window) {
  Image result = render::blank_image(std::max(image.width / 2, 1), std::max(image.height / 2, 1), {});
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const int from_x = window.x + x * window.width / result.width,
                from_y = window.y + y * window.height / result.height;
      std::copy_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(4) * (from_y * image.width + from_x), 4,
                  result.rgba.begin() + static_cast<std::ptrdiff_t>(4) * (y * result.width + x));
    }
  }
  return result;
}

void draw_frame(Image& image, const Figure::Window& window) {
  constexpr render::Color kFrame{250, 200, 0};
  const int right = window.x + window.width - 1, bottom = window.y + window.height - 1;
  for (const int y : {window.y, bottom}) render::fill_rectangle(image, window.x, y, window.width, 1, kFrame);
  for (const int x : {window.x, right}) render::fill_rectangle(image, x, window.y, 1, window.height, kFrame);
}

/// The picture; below it the window enlarged and the difference to the truth, where there is one.
Image sheet_of(const Panel& panel, const Figure::Window& window) {
  if (window.width == 0) return panel.image;
  const int width = panel.image.width, height = panel.image.height;
  Image sheet = render::blank_image(width, height + height / 2, {255, 255, 255});
  render::paste(sheet, panel.image, 0, 0);
  draw_frame(sheet, window);
  render::paste(sheet, zoomed(panel.image, window), 0, height);
  if (!panel.off.empty()) render::paste(sheet, difference_of(panel), width / 2, height);
  return sheet;
}

void write_strip(const Figure& figure, const fs::path& file) {
  constexpr render::Color kPaper{255, 255, 255}, kInk{20, 20, 20};
  const std::vector<Panel>& panels = figure.panels;
  const Figure::Window window = figure.worst_window();
  const int count = static_cast<int>(panels.size()), columns = std::min(count, kColumns);
  const int rows = (count + columns - 1) / columns;
  const Image first = sheet_of(panels[0], window);
  const int width = first.width + kGap, height = first.height + kCaption + kGap;
  Image sheet = render::blank_image(columns * width, rows * height, kPaper);
  for (int i = 0; i < count; ++i) {
    const Panel& panel = panels[static_cast<std::size_t>(i)];
    const int x = i % columns * width, y = i / columns * height;
    // Before the picture, which covers what a long caption has too much.
    render::draw_text(sheet, x + 2, y + 3, panel.caption, kInk);
    render::paste(sheet, sheet_of(panel, window), x, y + kCaption);
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
      "# Shadow filters\n\n"
      "Truth: the mean of 4 x 4 hard samples a pixel out of a map of 4096 texels. Below each picture: the\n"
      "framed part enlarged, and the difference to the truth (where 32 bits are compared with fewer: to\n"
      "32 bits), red too light, blue too dark. The frame is where the pictures of a strip differ by most.\n";
  const auto add = [&](const Figure& figure) {
    text += "\n## " + figure.title + "\n\n" + table_of(figure);
    if (figure.panels.empty()) return;
    write_strip(figure, fs::path(folder) / (figure.name + ".png"));
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
  add(half_resolution(size));
  add(bits(size));
  add(memory_of_filters());
  add(one_scene(scene, size));
  write_file(fs::path(folder) / "gallery.md", text);
  print_line((fs::path(folder) / "gallery.md").string());
  flush_output();
}

}  // namespace gnomon::tool
