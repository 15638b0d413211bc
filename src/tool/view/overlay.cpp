// What lies over the picture: the status line, the help page, the probe's text, the light's handle.
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>

#include "app.hpp"
#include "identifier_word.hpp"
#include "widgets.hpp"

namespace gnomon::tool::view {
namespace {

const ImVec4 kError{1.0f, 0.55f, 0.45f, 1.0f}, kQuiet{0.66f, 0.68f, 0.72f, 1.0f};
constexpr ImGuiWindowFlags kTextWindow = kFixedWindow | ImGuiWindowFlags_NoInputs |
                                         ImGuiWindowFlags_AlwaysAutoResize |
                                         ImGuiWindowFlags_NoFocusOnAppearing;

/// A pixel of the picture, in window units.
ImVec2 in_window(const Area& area, double pixel_ratio, const glm::dvec2& pixel) {
  return {static_cast<float>((pixel.x + area.x) / pixel_ratio),
          static_cast<float>((pixel.y + area.y) / pixel_ratio)};
}

std::string waiting_text(const Drawing& drawing, const Settings& settings) {
  const Loading& loading = drawing.loading;
  if (loading.scene.valid() && loading.announced)
    return fmt::format("compiling shaders for {} ... {:.1f} s", loading.name,
                       ImGui::GetTime() - loading.since);
  if (loading.scene.valid())
    return fmt::format("loading {} ... {:.1f} s", loading.name, ImGui::GetTime() - loading.since);
  if (drawing.compiling)
    return fmt::format("compiling {} ...",
                       settings.identifiers ? kIdentifiers : settings.filter.filter->info.name);
  if (drawing.stage == nullptr) return "compiling shaders ...";
  if (const auto progress = drawing.stage->truth_progress(); progress && (*progress)[0] < (*progress)[1]) {
    return drawing.stage->tracer() == nullptr
               ? std::string("sorting triangles for exact rays ...")
               : fmt::format("exact rays: {} of {} rows", (*progress)[0], (*progress)[1]);
  }
  return {};
}

void status_line(const State& state, const Drawing& drawing, const Display& display) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const auto left = static_cast<float>(panel_width(display));
  const Message& message = display.message;
  const std::string& refusal = drawing.refusal;
  std::string text = waiting_text(drawing, state.a);
  if (!refusal.empty()) text = refusal + " (the last good picture stays)";
  const bool error = !refusal.empty() || (message.is_error && ImGui::GetTime() < message.until);
  if (ImGui::GetTime() < message.until && refusal.empty()) text = message.text;
  if (text.empty() && drawing.stage != nullptr)
    text = fmt::format("{}   {:.1f} ms   F1 keys   Tab panel   WASD move   drag to look   1-9 views",
                       view_names()[static_cast<std::size_t>(state.view)].name, drawing.frame_ms);
  ImGui::SetNextWindowPos({left, size.y}, ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::SetNextWindowSize({size.x - left, ImGui::GetFrameHeight()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8.0f, 2.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
  ImGui::Begin("status", nullptr, kFixedWindow | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoScrollbar);
  ImGui::TextColored(error ? kError : kQuiet, "%s", text.c_str());
  if (error && ImGui::CalcTextSize(text.c_str()).x > size.x - left) {
    ImGui::SetNextWindowPos({left + 8.0f, size.y - ImGui::GetFrameHeight()}, ImGuiCond_Always, {0.0f, 1.0f});
    ImGui::SetNextWindowSize({std::max(size.x - left - 16.0f, 64.0f), 0.0f});
    ImGui::Begin("message", nullptr, kFixedWindow | ImGuiWindowFlags_NoInputs);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::End();
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
}

void help_page(bool& open) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x * 0.5f, size.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {size.x, size.y});
  ImGui::Begin("keys", &open,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoSavedSettings);
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const KeyHelp& one : key_help()) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(one.key);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(one.what);
    }
    ImGui::EndTable();
  }
  ImGui::TextColored(kQuiet, "Options: point at a name for its help, right click it to reset.");
  ImGui::End();
}

std::string page_text(const Probed& probed, const FramePages& pages) {
  const auto index = static_cast<std::size_t>(probed.map);
  const bool drawn = index < pages.drawn().size() && pages.drawn()[index];
  return fmt::format("page {} of {}, {}\nlevel {} of {}, column {}, row {}\ntexel {:.1f} {:.1f}\n",
                     probed.map, pages.plan().pages.size(), drawn ? "drawn in this frame" : "kept",
                     probed.page->level, pages.plan().levels.size(), probed.page->column, probed.page->row,
                     probed.texel.x, probed.texel.y);
}

std::string map_text(const Probed& probed, const FramePages* pages) {
  if (probed.map < 0) return pages != nullptr ? "no page serves this point" : "no map serves this point";
  const PointAliasing& m = probed.aliasing;
  const std::string where =
      pages != nullptr && probed.page
          ? page_text(probed, *pages)
          : fmt::format("map {}, texel {:.1f} {:.1f}\n", probed.map, probed.texel.x, probed.texel.y);
  if (m.status == PointAliasing::Status::faces_away) return where + "turned from the light";
  if (m.status != PointAliasing::Status::ok) return where + "m: no value";
  return where + fmt::format("m {:.3g}   m_s {:.3g}   m_t {:.3g}\nanisotropy {:.3g}", m.m_max, m.m_s, m.m_t,
                             m.anisotropy);
}

void probe_text(const Probed& probed, const Drawing& drawing, double pixel_ratio) {
  if (!probed.hit) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos, size = ImGui::GetIO().DisplaySize;
  constexpr float kAside = 18.0f;
  // On the side of the cursor where there is room.
  const ImVec2 pivot{mouse.x > size.x * 0.7f ? 1.0f : 0.0f, mouse.y > size.y * 0.7f ? 1.0f : 0.0f};
  ImGui::SetNextWindowPos(
      {mouse.x + (pivot.x > 0.0f ? -kAside : kAside), mouse.y + (pivot.y > 0.0f ? -kAside : kAside)},
      ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("probe", nullptr, kTextWindow);
  ImGui::TextUnformatted(map_text(probed, drawing.stage->side(0).pages.get()).c_str());
  ImGui::Text("depth %.4g   exact: %s", probed.view_depth,
              probed.turned_away ? "turned away"
              : probed.shadow    ? "shadow"
                                 : "lit");
  ImGui::End();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const ScreenLine& line : on_screen(probed.footprint, drawing.stage->camera()))
    list.AddLine(in_window(drawing.area, pixel_ratio, line.from),
                 in_window(drawing.area, pixel_ratio, line.to), IM_COL32(230, 159, 0, 255), 2.0f);
}

void draw_light(const State& state, const Drawing& drawing, const Display& display) {
  const std::optional<ScreenLine> handle = light_handle(state, drawing.stage.get());
  if (!handle) return;
  const ImVec2 from = in_window(drawing.area, display.pixel_ratio, handle->from),
               to = in_window(drawing.area, display.pixel_ratio, handle->to);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  constexpr ImU32 kLight = IM_COL32(255, 214, 90, 255), kEdge = IM_COL32(20, 20, 24, 255);
  const auto radius = static_cast<float>(8.0 * display.scale);
  list.AddLine(from, to, kEdge, 4.0f);
  list.AddLine(from, to, kLight, 2.0f);
  list.AddCircleFilled(from, radius + 1.5f, kEdge, 24);
  list.AddCircleFilled(from, radius, kLight, 24);
}

void waiting_page(const Drawing& drawing, const Display& display, const Settings& settings) {
  if (drawing.stage != nullptr) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const auto left = static_cast<float>(panel_width(display));
  ImGui::SetNextWindowPos({(left + size.x) * 0.5f, size.y * 0.45f}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("waiting", nullptr, kTextWindow);
  const bool failed = display.message.is_error && !drawing.loading.scene.valid();
  const std::string text = failed ? display.message.text : waiting_text(drawing, settings);
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
}

}  // namespace

void draw_overlay(App& app) {
  const State& state = app.document.state;
  Display& display = app.display;
  draw_light(state, app.drawing, display);
  if (display.probed) probe_text(*display.probed, app.drawing, display.pixel_ratio);
  waiting_page(app.drawing, display, state.a);
  status_line(state, app.drawing, display);
  if (display.help) help_page(display.help);
}

}  // namespace gnomon::tool::view
