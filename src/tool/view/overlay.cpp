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
ImVec2 in_window(const App& app, const glm::dvec2& pixel) {
  return {static_cast<float>((pixel.x + app.picture.x) / app.pixel_ratio),
          static_cast<float>((pixel.y + app.picture.y) / app.pixel_ratio)};
}

std::string waiting_text(const App& app) {
  if (app.loading.valid())
    return fmt::format("loading {} ... {:.1f} s", app.loading_name, ImGui::GetTime() - app.loading_since);
  if (app.compiling)
    return fmt::format("compiling {} ...",
                       app.state.a.identifiers ? kIdentifiers : app.state.a.filter.filter->info.name);
  if (app.stage == nullptr) return "compiling shaders ...";
  if (const auto progress = app.stage->truth_progress(); progress && (*progress)[0] < (*progress)[1]) {
    return app.stage->tracer() == nullptr
               ? std::string("sorting triangles for exact rays ...")
               : fmt::format("exact rays: {} of {} rows", (*progress)[0], (*progress)[1]);
  }
  return {};
}

void status_line(const App& app) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const auto left = static_cast<float>(panel_width(app));
  std::string text = waiting_text(app);
  if (!app.refusal.empty()) text = app.refusal + " (the last good picture stays)";
  const bool error = !app.refusal.empty() || (app.message_is_error && ImGui::GetTime() < app.message_until);
  if (ImGui::GetTime() < app.message_until && app.refusal.empty()) text = app.message;
  if (text.empty() && app.stage != nullptr)
    text = fmt::format("{}   {:.1f} ms   F1 keys   Tab panel   WASD move   drag to look   1-9 views",
                       view_names()[static_cast<std::size_t>(app.state.view)].name, app.frame_ms);
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

void help_page(App& app) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x * 0.5f, size.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {size.x, size.y});
  ImGui::Begin("keys", &app.help,
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

void probe_text(App& app) {
  if (!app.probed || !app.probed->hit) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos, size = ImGui::GetIO().DisplaySize;
  constexpr float kAside = 18.0f;
  // On the side of the cursor where there is room.
  const ImVec2 pivot{mouse.x > size.x * 0.7f ? 1.0f : 0.0f, mouse.y > size.y * 0.7f ? 1.0f : 0.0f};
  ImGui::SetNextWindowPos(
      {mouse.x + (pivot.x > 0.0f ? -kAside : kAside), mouse.y + (pivot.y > 0.0f ? -kAside : kAside)},
      ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("probe", nullptr, kTextWindow);
  ImGui::TextUnformatted(map_text(*app.probed, app.stage->side(0).pages.get()).c_str());
  ImGui::Text("depth %.4g   exact: %s", app.probed->view_depth,
              app.probed->turned_away ? "turned away"
              : app.probed->shadow    ? "shadow"
                                      : "lit");
  ImGui::End();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const ScreenLine& line : on_screen(app.probed->footprint, app.stage->camera()))
    list.AddLine(in_window(app, line.from), in_window(app, line.to), IM_COL32(230, 159, 0, 255), 2.0f);
}

void draw_light(const App& app) {
  const std::optional<ScreenLine> handle = light_handle(app);
  if (!handle) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  constexpr ImU32 kLight = IM_COL32(255, 214, 90, 255), kEdge = IM_COL32(20, 20, 24, 255);
  const auto radius = static_cast<float>(8.0 * app.scale);
  list.AddLine(in_window(app, handle->from), in_window(app, handle->to), kEdge, 4.0f);
  list.AddLine(in_window(app, handle->from), in_window(app, handle->to), kLight, 2.0f);
  list.AddCircleFilled(in_window(app, handle->from), radius + 1.5f, kEdge, 24);
  list.AddCircleFilled(in_window(app, handle->from), radius, kLight, 24);
}

void waiting_page(const App& app) {
  if (app.stage != nullptr) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const auto left = static_cast<float>(panel_width(app));
  ImGui::SetNextWindowPos({(left + size.x) * 0.5f, size.y * 0.45f}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("waiting", nullptr, kTextWindow);
  const std::string text = waiting_text(app);
  ImGui::TextUnformatted(app.message_is_error && !app.loading.valid() ? app.message.c_str() : text.c_str());
  ImGui::End();
}

}  // namespace

void draw_overlay(App& app) {
  draw_light(app);
  probe_text(app);
  waiting_page(app);
  status_line(app);
  if (app.help) help_page(app);
}

}  // namespace gnomon::tool::view
