// The panel: tabs with every option of the state.
#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "app.hpp"
#include "edit_words.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/scene/load.hpp"
#include "identifier_word.hpp"
#include "picture_words.hpp"
#include "widgets.hpp"

namespace gnomon::tool::view {
namespace {

constexpr std::array<const char*, kTabCount> kTabs{"View", "Light",  "Maps", "Filter",
                                                   "A|B",  "Curves", "File"};

std::vector<std::string> names_of(std::span<const Named> all, bool help) {
  std::vector<std::string> texts;
  for (const Named& one : all) texts.emplace_back(help ? one.help : one.name);
  return texts;
}

/// Which side the tabs Maps and Filter change.
void side_row(Document& document) {
  State& state = document.state;
  if (state.comparison == Comparison::off) return;
  ImGui::TextUnformatted("change:");
  for (int side = 0; side < 2; ++side) {
    ImGui::SameLine();
    ImGui::RadioButton(side == 0 ? "A" : "B", &document.side, side);
  }
  ImGui::SameLine();
  if (ImGui::SmallButton("copy to the other"))
    (document.side == 0 ? state.b : state.a) = document.side == 0 ? state.a : state.b;
  ImGui::Separator();
}

void maps_tab(App& app) {
  side_row(app.document);
  Settings& settings = app.document.edited();
  std::array<char, 64>& find = app.display.find;
  edit_pages(settings.pages);
  ImGui::InputTextWithHint("##find", "find an option", find.data(), find.size());
  ImGui::SameLine();
  if (ImGui::SmallButton("reset all")) {
    settings.plan = {};
    settings.pages = {};
  }
  ImGui::BeginChild("options", {0.0f, 0.0f});
  ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.48f);
  for (const PlanField& field : plan_fields()) {
    const bool found =
        find[0] == '\0' || std::string_view(field.key).find(find.data()) != std::string_view::npos;
    if (found) edit_plan_field(field, settings.plan);
  }
  if (find[0] == '\0') {
    ImGui::Separator();
    int transition = static_cast<int>(settings.transition);
    if (choose("transition", transition, transition_names()))
      settings.transition = static_cast<render::SplitTransition>(transition);
    tooltip("between cascades, over split_overlap of each");
    int layer = static_cast<int>(settings.layer);
    if (choose("layer", layer, layer_names())) settings.layer = static_cast<render::DepthLayer>(layer);
    tooltip("the depth that the maps store: the first surface, the back, the second, or what lies between");
    ImGui::Checkbox("linear_depth", &settings.linear_depth);
    tooltip("stored depths grow evenly along the light: for maps that begin close to a local light");
    int passes = static_cast<int>(settings.map_passes);
    if (choose("map_passes", passes, map_passes_names()))
      settings.map_passes = static_cast<render::MapPasses>(passes);
    tooltip("one pass for each map, or one layered pass for all of one size; the depths are the same");
    ImGui::Checkbox("history", &settings.history);
    tooltip("texel density changes smoothly from frame to frame; stable fits have it always");
    ImGui::Checkbox("visible_depths", &settings.visible_depths);
    tooltip("each frame is drawn twice: the second is planned for the depths that the first shows");
  }
  ImGui::PopItemWidth();
  ImGui::EndChild();
}

/// What reads the maps: identifiers, or else the filter.
void edit_reader(Settings& settings) {
  int at = static_cast<int>(identifier_index(settings.identifiers));
  int neighbours = settings.identifiers ? settings.identifiers->neighbours : 0;
  if (choose("identifiers", at, identifier_names(),
             {"the filter reads depths", "lit is what belongs to the instance that its texel names: no bias",
              "lit is what belongs to the triangle that its texel names"}))
    settings.identifiers = identifier_test(static_cast<std::size_t>(at), neighbours);
  tooltip("shadows by who is nearest to the light, in place of how near; docs/bias.md");
  ImGui::Separator();
  if (!settings.identifiers) return edit_filter(settings.filter);
  ImGui::SliderInt("neighbours", &neighbours, 0, render::kMaxIdentifierNeighbours, "%d",
                   ImGuiSliderFlags_AlwaysClamp);
  settings.identifiers->neighbours = neighbours;
  tooltip("texels to either side that count as well: less false shadow, smaller shadows");
  ImGui::TextWrapped("No filter reads the maps. Only the normal offset of the bias has an effect.");
}

void figure_row(const char* name, const char* help, const std::string& a, const std::string& b) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(name);
  tooltip(help);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(a.c_str());
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(b.c_str());
}

/// Both sides' figures; B's column is empty where there is no B.
void figures(const State& state, const Stage& stage) {
  if (!ImGui::BeginTable("figures", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("", 0, 1.5f);
  ImGui::TableSetupColumn("A");
  ImGui::TableSetupColumn("B");
  ImGui::TableHeadersRow();
  const bool both = state.comparison != Comparison::off && !state.b_is_truth;
  const auto row = [&](const char* name, const char* help, auto&& text) {
    figure_row(name, help, text(stage.side(0)), both ? text(stage.side(1)) : std::string());
  };
  const auto pass = [&](const char* name, render::Pass which, const char* help) {
    row(name, help, [which](const Side& s) { return fmt::format("{:.2f} ms", s.stats.ms(which)); });
  };
  row("plan", "time of make_plan, or of plan_pages",
      [](const Side& s) { return fmt::format("{:.1f} us", s.plan_ms * 1e3); });
  pass("draw maps", render::Pass::shadow_maps, "drawing the depth maps");
  pass("prefilter", render::Pass::prefilter, "what the filter stores, blurs and sums");
  pass("look-up", render::Pass::mask, "reading the maps for every pixel");
  row("maps", "texels drawn over all maps; with pages: resident, drawn in this frame, their texels",
      [](const Side& s) {
        if (s.pages)
          return fmt::format("{} pages, {} drawn / {:.2f} M", s.stats.pages, s.stats.pages_drawn,
                             static_cast<double>(s.stats.texels) / 1e6);
        return fmt::format("{} / {:.2f} M", s.plan.map_count, static_cast<double>(s.stats.texels) / 1e6);
      });
  row("memory", "of depth maps and of what the filter keeps", [](const Side& s) {
    return fmt::format("{:.1f} MiB", static_cast<double>(s.stats.map_bytes) / 1048576.0);
  });
  row("m median", "aliasing error m over what the camera sees of the boxes, pixels per texel",
      [](const Side& s) { return fmt::format("{:.3g}", s.m.p50); });
  row("m p95", "95 % of it stays below", [](const Side& s) { return fmt::format("{:.3g}", s.m.p95); });
  row("m max", "the largest", [](const Side& s) { return fmt::format("{:.3g}", s.m.max); });
  row("casters", "instances drawn, over all maps", [](const Side& s) {
    std::uint64_t count = 0;
    for (int i = 0; i < s.stats.map_count; ++i) count += s.stats.map[static_cast<std::size_t>(i)].instances;
    return std::to_string(count);
  });
  const auto error = [&row](const char* name, const char* of, double report::MaskErrors::*member) {
    row(name, of, [member](const Side& s) {
      return s.errors ? fmt::format("{:.3f} %", 100.0 * (*s.errors).*member) : std::string("-");
    });
  };
  error("false light", "of the pixels that a ray decides; in the misclassified view",
        &report::MaskErrors::false_lit);
  error("false shadow", "of the pixels that a ray decides; in the misclassified view",
        &report::MaskErrors::false_shadow);
  row("expected", "misclassified pixels that hard comparison in these maps is to have, without drawing them",
      [](const Side& s) {
        return s.expected_wrong ? fmt::format("{:.3f} %", 100.0 * *s.expected_wrong) : std::string("-");
      });
  error("too light", "leaks: brighter by over a tenth within exact shadow, of the same pixels",
        &report::MaskErrors::too_light);
  error("too dark", "acne: darker by over a tenth within exact light, of the same pixels",
        &report::MaskErrors::too_dark);
  ImGui::EndTable();
}

void compare_tab(App& app) {
  State& state = app.document.state;
  int comparison = static_cast<int>(state.comparison);
  if (choose("compare", comparison, names_of(comparison_names(), false), names_of(comparison_names(), true)))
    state.comparison = static_cast<Comparison>(comparison);
  if (state.comparison != Comparison::off) {
    ImGui::Checkbox("B is the exact shadow", &state.b_is_truth);
    tooltip("B shows one ray a pixel, best beside the mask view");
    constexpr double kNone = 0.0, kAll = 1.0, kMaxGain = 64.0;
    if (state.comparison == Comparison::wipe)
      ImGui::SliderScalar("wipe", ImGuiDataType_Double, &state.wipe, &kNone, &kAll, "%.2f",
                          ImGuiSliderFlags_AlwaysClamp);
    else
      ImGui::SliderScalar("gain", ImGuiDataType_Double, &state.gain, &kAll, &kMaxGain, "%.1f",
                          ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::Button("swap A and B")) std::swap(state.a, state.b);
    ImGui::SameLine();
    if (ImGui::Button("A to B")) state.b = state.a;
    ImGui::TextWrapped("The tabs Maps and Filter change A or B.");
  }
  ImGui::Separator();
  if (app.drawing.stage == nullptr) return;
  figures(state, *app.drawing.stage);
  const auto omitted = app.drawing.stage->side(0).omitted();
  if (omitted.empty() || !ImGui::TreeNode("omitted by the plan")) return;
  for (const Omission& omission : omitted) {
    const OmissionText text = describe(omission);
    ImGui::TextWrapped("%s: %s", text.what.data(), text.why.data());
  }
  ImGui::TreePop();
}

void scene_part(App& app) {
  ImGui::TextWrapped("scene: %s", app.document.state.scene.c_str());
  if (ImGui::BeginCombo("built-in", "open ...")) {
    for (const BuiltinScene& scene : builtin_scenes()) {
      const std::string name = "builtin:" + std::string(scene.name);
      if (ImGui::Selectable(name.c_str(), name == app.document.state.scene)) open_scene(app, name);
      tooltip(scene.summary);
    }
    ImGui::EndCombo();
  }
  if (ImGui::BeginCombo("recent", app.session.recent.empty() ? "none yet" : "open ...")) {
    const std::vector<std::string> recent = app.session.recent;
    for (const std::string& scene : recent)
      if (ImGui::Selectable(scene.c_str())) open_scene(app, scene);
    ImGui::EndCombo();
  }
  State edited = app.document.state;
  if (ImGui::Checkbox("ground under it", &edited.edits.ground)) set_state(app, edited);
  if (app.drawing.stage != nullptr && !app.drawing.stage->loaded().grounded)
    ImGui::TextWrapped("Nothing lies under this scene that its shadow could fall on.");
  if (ImGui::Checkbox("sky casts no shadow", &edited.edits.open_sky)) set_state(app, edited);
  if (app.drawing.stage != nullptr && app.drawing.stage->loaded().shaded_by_sky)
    ImGui::TextWrapped("A sky round this scene casts on all of it.");
  bool z_up = edited.edits.up == UpAxis::z;
  if (ImGui::Checkbox("z points up in its file", &z_up)) {
    edited.edits.up = z_up ? UpAxis::z : UpAxis::y;
    set_state(app, edited);
  }
  if (app.drawing.stage != nullptr)
    if (const std::string text = proxies_text(app.drawing.stage->loaded().scene); !text.empty())
      ImGui::TextWrapped("%s", text.c_str());
  ImGui::TextWrapped("Or drop a .gltf, .glb, state file or folder of results on the window.");
}

void file_tab(App& app) {
  scene_part(app);
  ImGui::Separator();
  ImGui::InputText("state file", &app.document.file);
  if (ImGui::Button("save (F5)")) save_state(app.document, app.display);
  ImGui::SameLine();
  if (ImGui::Button("open (F9)")) open_file(app, app.document.file);
  ImGui::SameLine();
  if (ImGui::Button("last session")) open_file(app, last_state_file().string());
  if (ImGui::Button("undo")) undo(app, false);
  ImGui::SameLine();
  if (ImGui::Button("redo")) undo(app, true);
  ImGui::SameLine();
  if (ImGui::Button("reset all")) {
    State state;
    state.scene = app.document.state.scene;
    state.edits = app.document.state.edits;
    app.document.state = state;
  }
  ImGui::Separator();
  ImGui::TextUnformatted("the command with this picture");
  std::string command = command_text(spoken_state(app.document.state, app.drawing.stage.get()));
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(command.c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::Button("copy command")) ImGui::SetClipboardText(command.c_str());
  ImGui::Separator();
  if (ImGui::Button("benchmark (F7)")) toggle_benchmark(app);
  tooltip("a flight along the path in fixed steps; a row of figures for each frame goes into a CSV file");
  ImGui::SameLine();
  if (ImGui::Button("picture (F12)")) app.drawing.saving.next = true;
  ImGui::SameLine();
  ImGui::Checkbox("record (F11)", &app.drawing.saving.every);
  tooltip("every picture that is drawn goes into the folder gnomon_record");
  float scale = static_cast<float>(app.session.ui_scale);
  if (ImGui::SliderFloat("text size", &scale, 0.0f, 3.0f, scale < 0.5f ? "of the display" : "%.2f"))
    app.session.ui_scale = scale < 0.5f ? 0.0 : std::clamp(static_cast<double>(scale), 0.5, 8.0);
  ImGui::Text("panel %.1f ms, frame %.1f ms", app.display.panel_ms, app.drawing.frame_ms);
}

void tabs(App& app) {
  if (!ImGui::BeginTabBar("tabs")) return;
  static constexpr std::array<void (*)(App&), kTabCount> kContents{view_tab,
                                                                   light_tab,
                                                                   maps_tab,
                                                                   [](App& a) {
                                                                     side_row(a.document);
                                                                     edit_reader(a.document.edited());
                                                                   },
                                                                   compare_tab,
                                                                   curves_part,
                                                                   file_tab};
  Display& display = app.display;
  const bool select = display.select_tab;
  const Tab wanted = display.tab;
  for (int i = 0; i < kTabCount; ++i) {
    const bool to_front = select && static_cast<Tab>(i) == wanted;
    if (!ImGui::BeginTabItem(kTabs[static_cast<std::size_t>(i)], nullptr,
                             to_front ? ImGuiTabItemFlags_SetSelected : 0))
      continue;
    if (!select) display.tab = static_cast<Tab>(i);
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.55f);
    kContents[static_cast<std::size_t>(i)](app);
    ImGui::PopItemWidth();
    ImGui::EndTabItem();
  }
  if (select) display.select_tab = false;
  ImGui::EndTabBar();
}

}  // namespace

double panel_width(const Display& display) {
  if (!display.panel) return 0.0;
  constexpr double kWidth = 380.0, kMaxShare = 0.6;
  return std::floor(std::min(kWidth * display.scale, kMaxShare * display.width / display.pixel_ratio));
}

void draw_panel(App& app) {
  if (!app.display.panel) return;
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize({static_cast<float>(panel_width(app.display)), ImGui::GetIO().DisplaySize.y});
  ImGui::Begin("panel", nullptr, kFixedWindow | ImGuiWindowFlags_NoBringToFrontOnFocus);
  tabs(app);
  ImGui::End();
}

}  // namespace gnomon::tool::view
