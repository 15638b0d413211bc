// Charts in SVG: axes, lines, marks and a legend, for a page with its own colours and for files of their own.
#include "chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "text.hpp"

namespace gnomon::report {
namespace {

// Pixels of the drawing's own coordinates. Mirrored in page/script.js, which redraws the first chart.
constexpr double kWidth = 940, kHeight = 460, kLeft = 74, kRight = 660, kTop = 34, kBottom = 400;
constexpr double kLegendLeft = 684, kLegendLine = 19, kNameLeft = kLegendLeft + 20;

std::string coordinate(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

/// A line of the legend, squeezed to what fits beside the plot. Names that are longer still are cut between
/// characters of UTF-8.
std::string name_beside(const std::string& name, double y) {
  constexpr std::size_t kFits = 34, kSqueezed = 50;
  std::size_t end = name.size() > kSqueezed ? kSqueezed - 1 : name.size();
  while (end < name.size() && end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;
  const std::string shown = name.substr(0, end) + (end < name.size() ? "\xE2\x80\xA6" : "");
  return "<text x=\"" + coordinate(kNameLeft) + "\" y=\"" + coordinate(y + 4) + "\"" +
         (name.size() > kFits
              ? " textLength=\"" + coordinate(kWidth - kNameLeft - 6) + "\" lengthAdjust=\"spacingAndGlyphs\""
              : "") +
         ">" + escaped(shown) + "</text>\n";
}

std::string element_end(const std::string& tip, const char* name) {
  return "><title>" + escaped(tip) + "</title></" + name + ">\n";
}

// Colours that differ in brightness as well as hue (after Okabe and Ito 2008, and four more), for files.
constexpr const char* kStyle =
    "<style>svg{background:#fff;font-family:system-ui,sans-serif;font-size:12px;fill:#222}"
    ".grid{stroke:#ddd}.frame{stroke:#777;fill:none}.title{font-weight:600;font-size:14px}"
    ".line{fill:none;stroke-width:1.6}.front{fill:none;stroke:#111;stroke-width:1.4;stroke-dasharray:5 3}"
    ".mark{stroke:#fff;stroke-width:.8}.mark,.key{fill:currentColor}.line{stroke:currentColor}"
    ".again{fill:#fff;stroke:currentColor;stroke-width:1.6}.line.again{fill:none;stroke-dasharray:9 3}"
    ".c0{color:#0072b2}.c1{color:#d55e00}.c2{color:#009e73}.c3{color:#cc79a7}.c4{color:#e69f00}"
    ".c5{color:#56b4e9}.c6{color:#8c6d1f}.c7{color:#7a4fbf}.c8{color:#c23b4b}.c9{color:#4d7f17}"
    ".c10{color:#777}.c11{color:#23297a}.plain{fill:#777}</style>\n";

}  // namespace

std::string color_class(std::size_t color) {
  return "c" + std::to_string(color % kColors) + (color < kColors ? "" : " again");
}

std::string_view mark_path(std::size_t kind) noexcept {
  constexpr std::array<std::string_view, kMarks> kPaths{
      "M-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z",
      "M-4.6,-4.6h9.2v9.2h-9.2z",
      "M0,-6L5.6,4.4H-5.6z",
      "M0,-6.4L6.4,0L0,6.4L-6.4,0z",
      "M0,6L5.6,-4.4H-5.6z",
      "M-2,-6h4v4h4v4h-4v4h-4v-4h-4v-4h4z",
      "M-3,-5.5h6L6,0L3,5.5h-6L-6,0z",
      "M-6.4,-2h12.8v4h-12.8z",
      "M-2,-6.4h4v12.8h-4z",
      "M-4,-6L0,-2L4,-6L6,-4L2,0L6,4L4,6L0,2L-4,6L-6,4L-2,0L-6,-4z"};
  return kPaths[kind % kMarks];
}

void Axis::fit(const std::vector<double>& values) {
  // Beyond these, ranges overflow and steps between ticks vanish; nothing measured comes near.
  constexpr double kLeast = 1e-30, kMost = 1e30;
  bool any = false;
  for (const double value : values) {
    if (!(std::abs(value) <= kMost) || (logarithmic && value < kLeast)) continue;
    low = any ? std::min(low, value) : value;
    high = any ? std::max(high, value) : value;
    any = true;
  }
  if (!any) {
    low = logarithmic ? 0.1 : 0.0;
    high = 1.0;
  }
  if (logarithmic) {
    constexpr double kRoom = 1.25;
    low /= kRoom;
    high *= kRoom;
  } else {
    low = std::min(low, 0.0);
    // A step must still be a step when added to the lower end.
    if (high - low < std::max(kLeast, -1e-6 * low)) high = low + std::max(1.0, -low);
    constexpr double kRoom = 0.06;
    if (!whole) high += kRoom * (high - low);
  }
}

double Axis::place(double value) const noexcept {
  double at = 0.0;
  if (logarithmic) {
    at = value > 0.0 ? std::log(value / low) / std::log(high / low) : 0.0;
  } else {
    at = (value - low) / (high - low);
  }
  return std::clamp(std::isnan(at) ? 0.0 : at, 0.0, 1.0);
}

std::vector<double> Axis::ticks() const {
  std::vector<double> all;
  if (!logarithmic) {
    const double rough = (high - low) / 5.0, unit = std::pow(10.0, std::floor(std::log10(rough)));
    const double even = unit * (rough / unit < 2.0 ? 2.0 : rough / unit < 5.0 ? 5.0 : 10.0);
    const double step = whole ? std::max(1.0, even) : even;
    for (int i = 0; low + i * step <= high * (1.0 + 1e-9); ++i) all.push_back(low + i * step);
    return all;
  }
  // The wider the range, the fewer within a decade.
  const double decades = std::log10(high / low);
  const std::vector<double> within =
      decades > 4.0   ? std::vector<double>{1.0}
      : decades > 1.5 ? std::vector<double>{1.0, 3.0}
      : decades > 0.8
          ? std::vector<double>{1.0, 1.5, 2.0, 3.0, 5.0, 7.0}
          : std::vector<double>{1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0, 3.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};
  // More labels than this would run into each other.
  constexpr double kMaxDecades = 12.0;
  const int every = std::max(1, static_cast<int>(std::ceil(decades / kMaxDecades)));
  for (int e = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, e) <= high; ++e) {
    if (e % every != 0) continue;
    for (const double digit : within) {
      const double value = digit * std::pow(10.0, e);
      if (value >= low && value <= high) all.push_back(value);
    }
  }
  return all;
}

Chart::Chart(std::string title, Axis x, Axis y)
    : title_(std::move(title)), x_(std::move(x)), y_(std::move(y)) {}

double Chart::x_of(double value) const noexcept {
  return kLeft + (kRight - kLeft) * x_.place(value);
}

double Chart::y_of(double value) const noexcept {
  return kBottom - (kBottom - kTop) * y_.place(value);
}

void Chart::mark(const Point& at, std::size_t color, std::size_t mark, const std::string& tip,
                 std::size_t id) {
  plot_ += "<path class=\"mark " + color_class(color) + "\" data-id=\"" + std::to_string(id) +
           "\" transform=\"translate(" + coordinate(x_of(at.x)) + "," + coordinate(y_of(at.y)) + ")\" d=\"" +
           std::string(mark_path(mark)) + "\"" + element_end(tip, "path");
}

void Chart::line(const std::vector<Point>& points, std::size_t color, std::string_view classes,
                 const std::string& tip) {
  if (points.empty()) return;
  plot_ += "<path class=\"" + std::string(classes) + " " + color_class(color) + "\" d=\"";
  for (std::size_t i = 0; i < points.size(); ++i)
    plot_ += (i == 0 ? "M" : "L") + coordinate(x_of(points[i].x)) + "," + coordinate(y_of(points[i].y));
  plot_ += "\"" + element_end(tip, "path");
}

void Chart::steps(const std::vector<Point>& points, std::size_t color, std::string_view classes,
                  const std::string& tip) {
  std::vector<Point> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) corners.push_back({points[i].x, points[i - 1].y});
    corners.push_back(points[i]);
  }
  line(corners, color, classes, tip);
}

void Chart::legend_color(const std::string& name, std::size_t color) {
  const double y = kTop + 6 + kLegendLine * legend_lines_++;
  legend_ += "<rect class=\"key " + color_class(color) + "\" x=\"" + coordinate(kLegendLeft) + "\" y=\"" +
             coordinate(y - 6) + "\" width=\"12\" height=\"12\"/>" + name_beside(name, y);
}

void Chart::legend_mark(const std::string& name, std::size_t mark) {
  const double y = kTop + 6 + kLegendLine * legend_lines_++;
  legend_ += "<path class=\"plain\" transform=\"translate(" + coordinate(kLegendLeft + 6) + "," +
             coordinate(y) + ")\" d=\"" + std::string(mark_path(mark)) + "\"/>" + name_beside(name, y);
}

std::string Chart::axes() const {
  std::string out =
      "<text class=\"title\" x=\"" + coordinate(kLeft) + "\" y=\"20\">" + escaped(title_) + "</text>\n";
  for (const double tick : x_.ticks()) {
    const std::string x = coordinate(x_of(tick));
    out += "<path class=\"grid\" d=\"M" + x + "," + coordinate(kTop) + "V" + coordinate(kBottom) +
           "\"/><text text-anchor=\"middle\" x=\"" + x + "\" y=\"" + coordinate(kBottom + 18) + "\">" +
           short_number(tick) + "</text>\n";
  }
  for (const double tick : y_.ticks()) {
    const std::string y = coordinate(y_of(tick));
    out += "<path class=\"grid\" d=\"M" + coordinate(kLeft) + "," + y + "H" + coordinate(kRight) +
           "\"/><text text-anchor=\"end\" x=\"" + coordinate(kLeft - 8) + "\" y=\"" +
           coordinate(y_of(tick) + 4) + "\">" + short_number(tick) + "</text>\n";
  }
  out += "<rect class=\"frame\" x=\"" + coordinate(kLeft) + "\" y=\"" + coordinate(kTop) + "\" width=\"" +
         coordinate(kRight - kLeft) + "\" height=\"" + coordinate(kBottom - kTop) + "\"/>\n";
  out += "<text text-anchor=\"middle\" x=\"" + coordinate(0.5 * (kLeft + kRight)) + "\" y=\"" +
         coordinate(kBottom + 42) + "\">" + escaped(x_.label) + "</text>\n";
  const std::string middle = coordinate(0.5 * (kTop + kBottom));
  out += "<text text-anchor=\"middle\" transform=\"translate(16," + middle + ")rotate(-90)\">" +
         escaped(y_.label) + "</text>\n";
  return out;
}

std::string Chart::body() const {
  return "<g class=\"axes\">\n" + axes() + "</g>\n<g class=\"plot\">\n" + plot_ +
         "</g>\n<g class=\"legend\">\n" + legend_ + "</g>\n";
}

double Chart::height() const noexcept {
  return std::max(kHeight, kTop + kLegendLine * (legend_lines_ + 1));
}

std::string Chart::embedded(std::string_view id) const {
  return scroll_box(title_) + "<svg id=\"" + escaped(id) + "\" class=\"chart\" role=\"img\" aria-label=\"" +
         escaped(title_) + "\" viewBox=\"0 0 " + coordinate(kWidth) + " " + coordinate(height()) + "\">\n" +
         body() + "</svg>\n" + std::string(kScrollBoxEnd);
}

std::string Chart::standalone() const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + coordinate(kWidth) + "\" height=\"" +
         coordinate(height()) + "\" viewBox=\"0 0 " + coordinate(kWidth) + " " + coordinate(height()) +
         "\">\n" + kStyle + "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + body() + "</svg>\n";
}

}  // namespace gnomon::report
