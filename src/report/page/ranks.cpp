// Do two errors rank the techniques alike, and what is each of them for?
#include "ranks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "text.hpp"

namespace gnomon::report {
namespace {

struct Answer {
  std::string_view error, question;
};
constexpr Answer kAnswers[] = {
    {"misclassified",
     "Is the shadow on the right side of its edge, at the middle of each pixel? Counts nothing "
     "that is finer than a pixel."},
    {"pixel error",
     "Is the pixel as bright as the light over all of it? The one that counts where texels are "
     "smaller than pixels: a fence far away, foliage."},
    {"of one surface",
     "The same without edges between surfaces, where one look-up per pixel cannot be right."},
    {"mean error",
     "Does the filter average as it says, over its own kernel? Rows of different kernels do not "
     "compare."},
    {"too dark, too light", "Where are acne and leaks, also faint ones?"},
    {"flicker", "Do texels move over surfaces at rest? Counts nothing of what passes between the pixels."},
    {"twinkling", "Do pixels change that should not while the camera moves?"},
};

std::vector<double> values_of(const Summary& summary, std::size_t scene, std::string_view measure) {
  std::vector<double> values;
  for (const Cell& cell : summary.cells[scene])
    values.push_back(cell.measured ? cell.values[measure_index(measure)]
                                   : std::numeric_limits<double>::quiet_NaN());
  return values;
}

bool has_pixel_errors(const Summary& summary, std::size_t scene) {
  const std::vector<double> values = values_of(summary, scene, "pixel_error");
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

std::string rank_table(const Summary& summary, std::size_t scene) {
  std::vector<std::vector<std::size_t>> places;
  std::string head;
  for (const std::string_view key : kRankedErrors) {
    places.push_back(places_by(summary, scene, key));
    head += "<th>" + escaped(measures()[measure_index(key)].column) + "</th><th>place</th>";
  }
  std::vector<std::size_t> order;
  for (std::size_t t = 0; t < summary.techniques.size(); ++t)
    if (places[1][t] > 0) order.push_back(t);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return places[1][a] < places[1][b]; });
  std::string out = scroll_box("Places by each error", true) + "<table><thead><tr><th>technique</th>" + head +
                    "</tr></thead><tbody>\n";
  for (const std::size_t t : order) {
    out += "<tr><td>" + escaped(summary.techniques[t].name()) + "</td>";
    for (std::size_t k = 0; k < std::size(kRankedErrors); ++k) {
      const std::size_t m = measure_index(kRankedErrors[k]);
      out += "<td>" + escaped(measures()[m].text(summary.cells[scene][t].values[m])) + "</td><td>" +
             std::to_string(places[k][t]) + "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string agreement(const Summary& summary, std::size_t scene) {
  const double of_pixels = rank_agreement(summary, scene, "wrong", "pixel_error"),
               of_change = rank_agreement(summary, scene, "flips", "twinkle");
  const auto text = [](double value) { return std::isfinite(value) ? short_number(value) : "none"; };
  return "Rank correlation of misclassified pixels and pixel error: " + text(of_pixels) +
         "; of flicker and twinkling: " + text(of_change) + ".";
}

}  // namespace

std::vector<std::size_t> places_by(const Summary& summary, std::size_t scene, std::string_view measure) {
  const std::vector<double> values = values_of(summary, scene, measure);
  std::vector<std::size_t> places;
  for (const double value : values)
    places.push_back(std::isfinite(value)
                         ? 1 + static_cast<std::size_t>(std::count_if(values.begin(), values.end(),
                                                                      [&](double v) { return v < value; }))
                         : 0);
  return places;
}

double rank_agreement(const Summary& summary, std::size_t scene, std::string_view measure,
                      std::string_view other) {
  const std::vector<double> all_a = values_of(summary, scene, measure),
                            all_b = values_of(summary, scene, other);
  std::vector<double> a, b;
  for (std::size_t t = 0; t < all_a.size(); ++t) {
    if (!std::isfinite(all_a[t]) || !std::isfinite(all_b[t])) continue;
    a.push_back(all_a[t]);
    b.push_back(all_b[t]);
  }
  return rank_correlation(a, b);
}

std::string rank_part(const Summary& summary, std::size_t first_scene) {
  bool any = false;
  for (std::size_t scene = first_scene; scene < summary.scenes.size(); ++scene)
    any = any || has_pixel_errors(summary, scene);
  if (!any) return {};
  std::string out = "<h3>Questions and errors</h3>\n" + scroll_box("Questions and errors") +
                    "<table class=\"words\"><thead><tr><th>error</th><th>question</th></tr></thead><tbody>\n";
  for (const Answer& answer : kAnswers)
    out +=
        "<tr><td>" + std::string(answer.error) + "</td><td>" + std::string(answer.question) + "</td></tr>\n";
  out +=
      "</tbody></table></div>\n<h3>Places by each error</h3>\n<p class=\"note\">1 is the least error. Where "
      "the places of two errors differ, they belong to different questions.</p>\n";
  for (std::size_t scene = first_scene; scene < summary.scenes.size(); ++scene) {
    if (!has_pixel_errors(summary, scene)) continue;
    out += "<div class=\"by-scene\" data-scene=\"" + std::to_string(scene) + "\">\n<p><b>" +
           escaped(summary.titles[scene]) + "</b>: " + agreement(summary, scene) + "</p>\n" +
           rank_table(summary, scene) + "</div>\n";
  }
  return out;
}

std::string rank_line(const Summary& summary, std::size_t scene) {
  return has_pixel_errors(summary, scene) ? agreement(summary, scene) + "\n\n" : std::string();
}

}  // namespace gnomon::report
