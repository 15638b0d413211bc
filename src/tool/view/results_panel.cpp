// The panel's chart of what `gnomon compare` measured: error against time, with the present setting in it.
#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

#include "app.hpp"
#include "widgets.hpp"

namespace gnomon::tool::view {
namespace {

// Okabe and Ito's colours, which everybody tells apart.
constexpr ImU32 kPoint = IM_COL32(86, 180, 233, 255), kFront = IM_COL32(0, 158, 115, 255),
                kNow = IM_COL32(240, 228, 66, 255), kBeen = IM_COL32(240, 228, 66, 90),
                kGrid = IM_COL32(70, 72, 80, 255), kText = IM_COL32(168, 172, 180, 255),
                kPaper = IM_COL32(24, 24, 28, 255);
constexpr std::size_t kMaxBeen = 24;

/// One axis by powers of ten.
struct Axis {
  double low = 0.0, high = 1.0;      ///< decimal logarithms
  float from = 0.0f, length = 1.0f;  ///< window units; a negative length goes up
  [[nodiscard]] float at(double value) const noexcept {
    const double share = (std::log10(value) - low) / (high - low);
    return from + length * static_cast<float>(std::clamp(share, 0.0, 1.0));
  }
};

struct Chart {
  Axis ratio, wrong;
  double least_wrong = 1e-6;  ///< shares below stand on the lower edge, no misclassified pixel among them
  [[nodiscard]] ImVec2 at(double of_ratio, double of_wrong) const noexcept {
    return {ratio.at(of_ratio), wrong.at(std::max(of_wrong, least_wrong))};
  }
};

/// Around all points and the present one.
Chart chart_of(const SceneResults& results, const ChartPlace& now, const ImVec2& corner, const ImVec2& size) {
  double ratio_low = 1e300, ratio_high = 0.0, wrong_low = 1.0, wrong_high = 0.0;
  const auto add = [&](double ratio, double wrong) {
    if (!(ratio > 0.0)) return;
    ratio_low = std::min(ratio_low, ratio);
    ratio_high = std::max(ratio_high, ratio);
    if (wrong > 0.0) wrong_low = std::min(wrong_low, wrong);
    wrong_high = std::max(wrong_high, wrong);
  };
  for (const ResultPoint& point : results.points) add(point.ratio, point.wrong);
  add(now.ratio, now.wrong);
  wrong_high = std::max(wrong_high, wrong_low);
  constexpr double kRoom = 0.08;  // decades on each side
  Chart chart;
  chart.least_wrong = wrong_low * 0.5;
  chart.ratio = {std::log10(ratio_low) - kRoom, std::log10(ratio_high) + kRoom, corner.x, size.x};
  chart.wrong = {std::log10(chart.least_wrong) - kRoom, std::log10(wrong_high) + kRoom, corner.y + size.y,
                 -size.y};
  return chart;
}

/// Lines at 1, 2 and 5 of each decade, with their numbers.
void draw_grid(ImDrawList& list, const Chart& chart, const ImVec2& corner, const ImVec2& size) {
  list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, kPaper);
  const auto lines = [](const Axis& axis, auto&& draw) {
    for (double decade = std::floor(axis.low); decade <= axis.high; decade += 1.0) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double value = digit * std::pow(10.0, decade), place = std::log10(value);
        if (place > axis.low && place < axis.high) draw(value);
      }
    }
  };
  const float line = ImGui::GetTextLineHeight();
  lines(chart.ratio, [&](double value) {
    const float x = chart.ratio.at(value);
    list.AddLine({x, corner.y}, {x, corner.y + size.y}, kGrid);
    list.AddText({x + 2.0f, corner.y + size.y - line}, kText, fmt::format("{:g}", value).c_str());
  });
  lines(chart.wrong, [&](double value) {
    const float y = chart.wrong.at(value);
    list.AddLine({corner.x, y}, {corner.x + size.x, y}, kGrid);
    list.AddText({corner.x + 2.0f, y - line}, kText, fmt::format("{:g} %", 100.0 * value).c_str());
  });
}

void draw_points(ImDrawList& list, const Chart& chart, const SceneResults& results) {
  const ResultPoint* before = nullptr;
  for (const ResultPoint& point : results.points) {
    if (!point.on_front) continue;
    if (before != nullptr)
      list.AddLine(chart.at(before->ratio, before->wrong), chart.at(point.ratio, point.wrong), kFront, 1.5f);
    before = &point;
  }
  for (const ResultPoint& point : results.points)
    list.AddCircleFilled(chart.at(point.ratio, point.wrong), 4.0f, point.on_front ? kFront : kPoint, 12);
}

/// The point under the cursor; nullptr: none is near.
const ResultPoint* under_cursor(const Chart& chart, const SceneResults& results) {
  constexpr float kNear = 8.0f;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ResultPoint* nearest = nullptr;
  float least = kNear;
  for (const ResultPoint& point : results.points) {
    const ImVec2 at = chart.at(point.ratio, point.wrong);
    const float distance = std::hypot(at.x - mouse.x, at.y - mouse.y);
    if (distance >= least) continue;
    least = distance;
    nearest = &point;
  }
  return nearest;
}

void load_technique(Document& document, Display& display, const report::Technique& technique) {
  try {
    document.edited() = settings_of(technique, document.state.light.sun.kind);
    show_message(display, technique.name(), false);
  } catch (const std::exception& error) {
    show_message(display, error.what(), true);
  }
}

/// Where side A stands. Ratio 0: not measured yet; wrong below 0: the exact shadow is not there yet.
ChartPlace present(const Drawing& drawing) {
  const auto& errors = drawing.stage->side(0).errors;
  const double wrong = errors && errors->pixels > 0 ? errors->false_lit + errors->false_shadow : -1.0;
  return {drawing.gauge.ratio(), wrong};
}

void chart_part(App& app, const SceneResults& results) {
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size{width, std::min(width * 0.8f, 420.0f)};
  const ChartPlace now = present(app.drawing);
  const Chart chart = chart_of(results, now, corner, size);
  ImGui::InvisibleButton("chart", size);
  const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
  draw_grid(list, chart, corner, size);
  draw_points(list, chart, results);
  for (const ChartPlace& place : app.drawing.been)
    list.AddCircle(chart.at(place.ratio, place.wrong), 5.0f, kBeen, 12);
  if (now.ratio > 0.0 && now.wrong >= 0.0) {
    const ImVec2 at = chart.at(now.ratio, now.wrong);
    list.AddCircleFilled(at, 6.5f, kPaper, 16);
    list.AddCircleFilled(at, 5.0f, kNow, 16);
  }
  list.PopClipRect();
  ImGui::TextWrapped(
      "Across: shadow time in times of one unwarped map with hard shadows. Up: misclassified pixels. "
      "Green: the front. Yellow: side A here and now.");
  if (now.ratio > 0.0 && now.wrong >= 0.0)
    ImGui::Text("now: %.3g x, %.3g %% misclassified", now.ratio, 100.0 * now.wrong);
  else
    ImGui::TextUnformatted(now.wrong < 0.0 ? "now: waits for exact rays" : "now: time is measured at rest");
  if (!hovered) return;
  const ResultPoint* point = under_cursor(chart, results);
  if (point == nullptr) return;
  tooltip(fmt::format("{}\n{:.3g} x, {:.3g} ms, {:.3g} % misclassified\nclick: load it",
                      point->technique.name(), point->ratio, point->ms, 100.0 * point->wrong));
  if (clicked) load_technique(app.document, app.display, point->technique);
}

}  // namespace

bool shows_results(const App& app) {
  const bool chart = app.display.panel && app.display.tab == Tab::curves && app.display.results;
  return chart && app.drawing.stage != nullptr && !app.drawing.benchmark &&
         results_of(*app.display.results, app.document.state.scene) != nullptr;
}

void restart_gauge(Drawing& drawing) {
  if (drawing.gauge.done()) {
    const ChartPlace place = present(drawing);
    if (place.wrong >= 0.0) drawing.been.push_back(place);
    if (drawing.been.size() > kMaxBeen) drawing.been.erase(drawing.been.begin());
  }
  drawing.gauge = {};
}

bool gauge_frame(Drawing& drawing, const State& state) {
  Gauge& gauge = drawing.gauge;
  // Frames of this view live on the one before, which the gauge's own would replace.
  if (gauge.done() || state.view == View::kept || !drawing.refusal.empty()) return false;
  gauge.take(drawing.stage->time_frame(
      state, gauge.wants_baseline() ? Stage::Timed::baseline : Stage::Timed::side_a));
  return true;
}

void open_results(Display& display, Drawing& drawing, const std::string& path) {
  display.results = read_sweep_results(path);
  display.results_folder = path;
  drawing.been.clear();
  display.tab = Tab::curves;
  display.select_tab = true;
}

void results_part(App& app) {
  if (!ImGui::CollapsingHeader("error against time", ImGuiTreeNodeFlags_DefaultOpen)) return;
  ImGui::InputText("results", &app.display.results_folder);
  tooltip("folder that gnomon compare --out wrote; a click on one of its points loads that technique");
  ImGui::SameLine();
  if (ImGui::Button("open##results")) {
    try {
      open_results(app.display, app.drawing, app.display.results_folder);
    } catch (const std::exception& error) {
      show_message(app.display, error.what(), true);
    }
  }
  if (!app.display.results || app.drawing.stage == nullptr) return;
  if (const SceneResults* results = results_of(*app.display.results, app.document.state.scene)) {
    chart_part(app, *results);
    return ImGui::TextWrapped("measured at %s", app.display.results->measured.c_str());
  }
  ImGui::TextWrapped("Nothing of this scene is in these results. They have:");
  for (const SceneResults& one : app.display.results->scenes)
    if (ImGui::SmallButton(one.scene.c_str())) open_scene(app, one.scene);
}

}  // namespace gnomon::tool::view
