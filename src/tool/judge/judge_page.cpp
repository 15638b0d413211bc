// The page of a judgement: figures, findings and the picture that they are about.
#include "judge/judge_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "page_files.hpp"
#include "text.hpp"

namespace gnomon::tool {
namespace {

using report::escaped;
using report::short_number;

/// Colours by m, from fine texels to coarse ones: distinct to any eye.
struct HeatClass {
  double below;
  std::string_view color, name;
};
constexpr std::array<HeatClass, 8> kHeat{{{0.5, "#313695", "below 0.5"},
                                          {1.0, "#74add1", "0.5 to 1"},
                                          {1.5, "#e0f3f8", "1 to 1.5"},
                                          {2.0, "#fee090", "1.5 to 2"},
                                          {3.0, "#fdae61", "2 to 3"},
                                          {5.0, "#f46d43", "3 to 5"},
                                          {10.0, "#d73027", "5 to 10"},
                                          {1e300, "#7f0000", "above 10"}}};
constexpr std::string_view kNoMap = "#000", kNothing = "#888";

std::string style() {
  std::string css(report::page_style());
  css +=
      ".seen{display:block;width:100%;height:auto;background:#c9cbd0}.seen text{font:600 13px "
      "system-ui,sans-serif;fill:#fff;"
      "text-anchor:middle;dominant-baseline:central}.spot{fill:#22252b;stroke:#fff;stroke-width:1.5}"
      ".scale{display:flex;flex-wrap:wrap;gap:4px 14px;font-size:13px}.scale "
      "svg{vertical-align:-1px;margin-right:5px}"
      "ol.faults{padding-left:0;list-style:none}ol.faults li{border-left:4px solid "
      "var(--c1);background:var(--box);padding:8px 14px;"
      "margin:10px 0}.faults b{display:block}.kind{color:var(--soft);font-size:13px}.good{font-size:17px}";
  return css;
}

/// Squares of one colour, as one path.
std::string squares(const std::vector<glm::dvec2>& at, double size, std::string_view color) {
  if (at.empty()) return {};
  std::string path = "<path fill=\"" + std::string(color) + "\" d=\"";
  const std::string side = short_number(size);
  for (const glm::dvec2& pixel : at)
    path += "M" + std::to_string(std::lround(pixel.x - 0.5 * size)) + " " +
            std::to_string(std::lround(pixel.y - 0.5 * size)) + "h" + side + "v" + side + "h-" + side + "z";
  return path + "\"/>";
}

/// A share of the image that one point stands for: the points are all over it.
double square_side(const Camera& camera, std::size_t points) {
  constexpr double kRays = double{judge::kRayColumns} * judge::kRayRows;
  const double each =
      static_cast<double>(camera.width) * camera.height / std::max(static_cast<double>(points), kRays);
  return std::ceil(std::sqrt(each));
}

std::string picture(const Camera& camera, const std::vector<judge::SeenError>& seen, bool planned,
                    const std::string& marks, const std::string& title) {
  std::array<std::vector<glm::dvec2>, kHeat.size()> of;
  std::vector<glm::dvec2> none, nothing;
  for (const judge::SeenError& at : seen) {
    const double m = planned ? at.planned_m : at.m;
    if (m < 0.0) {
      nothing.push_back(at.pixel);
    } else if (!std::isfinite(m)) {
      none.push_back(at.pixel);
    } else {
      std::size_t k = 0;
      while (k + 1 < kHeat.size() && m > kHeat[k].below) ++k;
      of[k].push_back(at.pixel);
    }
  }
  const double side = square_side(camera, seen.size());
  std::string out = "<figure><figcaption>" + escaped(title) +
                    "</figcaption><svg class=\"seen\" role=\"img\" aria-label=\"" + escaped(title) +
                    "\" viewBox=\"0 0 " + std::to_string(camera.width) + " " + std::to_string(camera.height) +
                    "\">";
  for (std::size_t k = 0; k < kHeat.size(); ++k) out += squares(of[k], side, kHeat[k].color);
  out += squares(none, side, kNoMap) + squares(nothing, side, kNothing) + marks + "</svg></figure>";
  return out;
}

std::string legend() {
  std::string out = "<p class=\"scale\"><span>m, screen pixels per texel:</span>";
  const auto entry = [&](std::string_view color, std::string_view name) {
    out +=
        "<span><svg width=\"12\" height=\"12\" aria-hidden=\"true\"><rect width=\"12\" height=\"12\" "
        "fill=\"" +
        std::string(color) + "\"/></svg>" + std::string(name) + "</span>";
  };
  for (const HeatClass& heat : kHeat) entry(heat.color, heat.name);
  entry(kNoMap, "in no map");
  return out + "</p>";
}

/// Beside marks that are there, and whole.
glm::dvec2 free_place(const glm::dvec2& pixel, double radius, const Camera& camera,
                      const std::vector<glm::dvec2>& taken) {
  const glm::dvec2 low(radius), high = glm::dvec2(camera.width, camera.height) - radius;
  glm::dvec2 place = glm::clamp(pixel, low, high);
  const auto hides = [&](const glm::dvec2& other) { return glm::distance(place, other) < 2.0 * radius; };
  for (std::size_t i = 0; i < taken.size() && std::any_of(taken.begin(), taken.end(), hides); ++i) {
    place.x += 2.0 * radius;
    if (place.x > high.x) place = {low.x, std::min(place.y + 2.0 * radius, high.y)};
  }
  return place;
}

/// Numbers of the findings where they are in the first frame's image.
std::string marks_of(const judge::Judgement& judgement, int light, const Camera& camera) {
  std::string out;
  std::vector<glm::dvec2> taken;
  const double radius = 0.016 * camera.width, scale = radius / 10.0;
  for (std::size_t i = 0; i < judgement.findings.size(); ++i) {
    const judge::Finding& finding = judgement.findings[i];
    if (finding.light != light || finding.frame != 0 || !finding.pixel) continue;
    const glm::dvec2 place = free_place(*finding.pixel, radius, camera, taken);
    taken.push_back(place);
    out += "<g transform=\"translate(" + short_number(place.x) + " " + short_number(place.y) + ") scale(" +
           short_number(scale) + ")\"><title>" + escaped(finding.what) +
           "</title><circle class=\"spot\" r=\"10\"/><text>" + std::to_string(i + 1) + "</text></g>";
  }
  return out;
}

std::string error_cells(const AliasingStats& error) {
  if (error.samples == 0) return "<td>-</td><td>-</td><td>-</td>";
  return "<td>" + short_number(error.p50) + "</td><td>" + short_number(error.p95) + "</td><td>" +
         short_number(error.max) + "</td>";
}

std::string figures_table(const judge::LightFigures& light) {
  std::string out = report::scroll_box("Errors of light " + std::to_string(light.light)) +
                    "<table><thead><tr><th>maps</th><th>texels</th><th>m p50</th><th>p95</th>"
                    "<th>max</th><th>not in their map</th></tr></thead><tbody>";
  const auto row = [](const std::string& name, const std::string& texels, const AliasingStats& error,
                      const std::string& missed) {
    return "<td>" + name + "</td><td>" + texels + "</td>" + error_cells(error) + "<td>" + missed +
           "</td></tr>";
  };
  const auto whole = [&](const std::string& name, std::int64_t texels, const AliasingStats& error) {
    return row(name, std::to_string(texels), error, report::percent(judge::share_missed(error)));
  };
  out += "<tr>" + whole("the capture's " + std::to_string(light.plan.map_count), light.texels, light.error);
  if (light.of_map.size() > 1) {
    for (const judge::LightFigures::OfMap& map : light.of_map)
      out += "<tr>" + row("&nbsp; map " + std::to_string(map.map), "", map.error, "");
  }
  for (const judge::LightFigures::Planned* planned : light.planned())
    out += "<tr class=\"best\">" + whole("gnomon's " + std::to_string(planned->plan.map_count) + ", fit " +
                                             std::string(to_string(planned->fit)),
                                         planned->texels, planned->error);
  return out + "</tbody></table>" + std::string(report::kScrollBoxEnd);
}

std::string place_of(const judge::Capture& capture, const judge::Finding& finding) {
  std::string out = std::string(to_string(finding.kind)) + (judge::is_waste(finding.kind) ? " (waste)" : "") +
                    " · light " + std::to_string(finding.light);
  if (finding.map >= 0) out += (finding.also.empty() ? ", map " : ", maps ") + std::to_string(finding.map);
  if (!finding.also.empty()) out += " (worst)";
  for (const int map : finding.also) out += ", " + std::to_string(map);
  if (capture.frames.size() > 1)
    out += " · " + std::to_string(finding.frames) + " of " + std::to_string(capture.frames.size()) +
           " frames, worst in " + std::to_string(finding.frame);
  if (finding.pixel)
    out += " · pixel " + std::to_string(std::lround(finding.pixel->x)) + ", " +
           std::to_string(std::lround(finding.pixel->y));
  if (finding.unit == "share") return out + " · " + report::percent(finding.size);
  return out + " · " + short_number(finding.size) + " " + std::string(finding.unit);
}

std::string findings_list(const judge::Capture& capture, const judge::Judgement& judgement) {
  if (judgement.findings.empty()) return "<p class=\"good\">Nothing was found.</p>\n";
  std::string out = "<ol class=\"faults\">\n";
  for (std::size_t i = 0; i < judgement.findings.size(); ++i) {
    const judge::Finding& finding = judgement.findings[i];
    out += "<li><b>" + std::to_string(i + 1) + ". " + escaped(finding.what) + "</b>" +
           escaped(finding.change) + "<br><span class=\"kind\">" + escaped(place_of(capture, finding)) +
           "</span></li>\n";
  }
  return out + "</ol>\n";
}

std::string drawn_picture(const std::string& png, const DrawnErrors& errors, const std::string& title) {
  return "<figure><figcaption>" + escaped(title) + ": " + report::percent(errors.wrong) +
         " misclassified</figcaption><img alt=\"" + escaped(title) + "\" src=\"data:image/png;base64," +
         report::base64(png) + "\"></figure>";
}

/// Pixels that are wrong where the scene was at hand.
std::string drawn_section(const DrawnLightErrors& drawn) {
  std::string out =
      "<h3>Drawn, against exact rays</h3>\n<p class=\"note\">Hard comparison with gnomon's default bias, so "
      "that "
      "maps alone differ. Orange: false light. Blue: false shadow. Violet: rounding decides.</p>\n<div "
      "class=\"pair\">" +
      drawn_picture(drawn.picture, drawn.captured, "The capture's maps");
  if (drawn.planned) out += drawn_picture(drawn.planned_picture, *drawn.planned, "gnomon's plan, fit tight");
  return out + "</div>\n";
}

std::string light_section(const judge::Capture& capture, const judge::Judgement& judgement,
                          const judge::LightFigures& light) {
  const Camera& camera = capture.frames.front().camera;
  std::string out = "<h2>Light " + std::to_string(light.light) + "</h2>\n" + figures_table(light);
  if (light.seen.empty()) return out;
  out += "<div class=\"pair\">" + picture(camera, light.seen, false, marks_of(judgement, light.light, camera),
                                          "The capture's maps, frame 0");
  if (light.tight) out += picture(camera, light.seen, true, "", "gnomon's plan, fit tight, as many texels");
  return out + "</div>\n" + legend();
}

}  // namespace

std::string judge_page(const judge::Capture& capture, const SceneJudgement& result) {
  const judge::Judgement& judgement = result.judgement;
  const std::string css = style(), name = capture.name.empty() ? std::string("Shadow maps") : capture.name;
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src '" +
      report::policy_hash(css) +
      "'; base-uri 'none'; form-action 'none'\">\n<meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<title>gnomon: " +
      escaped(name) + "</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>" + css +
      "</style>\n</head>\n<body>\n";
  out += "<header>\n<h1>" + escaped(name) + "</h1>\n<p class=\"sub\">" + escaped(capture.engine) +
         (capture.engine.empty() ? "" : ", ") + report::counted(capture.frames.size(), "frame") + ", " +
         report::counted(judgement.findings.size(), "finding") + "</p>\n</header>\n<main>\n";
  out += "<h2>Findings</h2>\n" + findings_list(capture, judgement);
  for (const judge::LightFigures& light : judgement.lights) {
    out += light_section(capture, judgement, light);
    if (const DrawnLightErrors* drawn = result.drawn_of(light)) out += drawn_section(*drawn);
  }
  if (!judgement.notes.empty()) {
    out += "<h2>Not checked</h2>\n<ul>\n";
    for (const std::string& note : judgement.notes) out += "<li>" + escaped(note) + "</li>\n";
    out += "</ul>\n";
  }
  return out + "</main>\n</body>\n</html>\n";
}

}  // namespace gnomon::tool
