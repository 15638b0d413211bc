// Charts in SVG: axes, lines, marks and a legend, for a page with its own colours and for files of their own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::report {

struct Axis {
  std::string label;
  bool logarithmic = true;
  double low = 0.1, high = 1.0;  ///< set by fit()
  bool whole = false;            ///< only whole numbers are ticks

  /// The range round these values, rounded outwards; zero, negative and infinite ones do not count on a
  /// logarithmic axis.
  void fit(const std::vector<double>& values);
  /// 0 at the low end .. 1 at the high one, clamped.
  [[nodiscard]] double place(double value) const noexcept;
  [[nodiscard]] std::vector<double> ticks() const;
};

/// A colour that comes again is hollow in marks and dashed in lines. Marks come again as they are.
inline constexpr std::size_t kColors = 12, kMarks = 10;

struct Point {
  double x = 0.0, y = 0.0;
};

class Chart {
 public:
  Chart(std::string title, Axis x, Axis y);

  /// `id` is written as data-id; `tip` is shown on hovering.
  void mark(const Point& at, std::size_t color, std::size_t mark, const std::string& tip, std::size_t id);
  /// `classes` as in the page's style: "front", or "line".
  void line(const std::vector<Point>& points, std::size_t color, std::string_view classes,
            const std::string& tip);
  /// First `y` from `x` on, then straight down or up to the next: what holds until a better one is reached.
  void steps(const std::vector<Point>& points, std::size_t color, std::string_view classes,
             const std::string& tip);
  /// Names that are too long for the margin are squeezed, and longer ones cut.
  void legend_color(const std::string& name, std::size_t color);
  void legend_mark(const std::string& name, std::size_t mark);

  /// For the page: colours come from its style.
  [[nodiscard]] std::string embedded(std::string_view id) const;
  /// For a file.
  [[nodiscard]] std::string standalone() const;

 private:
  [[nodiscard]] double x_of(double value) const noexcept;
  [[nodiscard]] double y_of(double value) const noexcept;
  [[nodiscard]] double height() const noexcept;
  [[nodiscard]] std::string axes() const;
  [[nodiscard]] std::string body() const;

  std::string title_;
  Axis x_, y_;
  std::string plot_, legend_;
  int legend_lines_ = 0;
};

/// Classes of a mark, line or key of this colour.
[[nodiscard]] std::string color_class(std::size_t color);
/// Path data of mark `kind` round (0, 0).
[[nodiscard]] std::string_view mark_path(std::size_t kind) noexcept;

}  // namespace gnomon::report
