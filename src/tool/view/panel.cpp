// The panel: tabs with every option of the state.
#include <fmt/core.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>

#include "app.hpp"
#include "camera_words.hpp"
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

void drawn_switches(Drawn& drawn) {
  ImGui::Checkbox("frustum", &drawn.frustum);
  tooltip("the frozen camera's frustum");
  ImGui::SameLine();
  ImGui::Checkbox("bodies", &drawn.bodies);
  tooltip("the receivers' body of each map, in the map's colour");
  ImGui::SameLine();
  ImGui::Checkbox("maps", &drawn.maps);
  tooltip("the volume that each map shows");
  ImGui::SameLine();
  ImGui::Checkbox("culling", &drawn.culling);
  tooltip("the part of the scene within the planes that each map's casters are culled by");
  ImGui::SameLine();
  ImGui::Checkbox("casters", &drawn.casters);
  tooltip("boxes of casters: in the colour of the first map that draws them; grey: culled");
}

void lens_part(State& state, const CameraPath& path) {
  bool orthographic = state.height_world > 0.0;
  if (ImGui::Checkbox("orthographic", &orthographic)) {
    const CameraKey& key = path.keys.front();
    state.height_world =
        orthographic ? 2.0 * std::tan(0.5 * path.fov_y_radians) * glm::length(key.target - key.position)
                     : 0.0;
  }
  tooltip("parallel rays, as for a map or an elevation; the wheel changes the picture's height");
  if (!orthographic) return;
  constexpr double kStep = 0.01, kMax = 1e30;  // of the height, for each unit of the mouse
  double height = state.height_world;
  ImGui::DragScalar("height of the picture", ImGuiDataType_Double, &height,
                    static_cast<float>(kStep * height), nullptr, nullptr, "%.4g");
  if (height > 0.0) state.height_world = std::min(height, kMax);
}

void camera_part(Document& document, const Stage* stage, Display& display) {
  State& state = document.state;
  if (ImGui::Checkbox("fly along the path", &state.motion.camera) && state.motion.camera) state.eye.reset();
  tooltip("P; any key that moves the camera ends it");
  ImGui::DragScalar("path seconds", ImGuiDataType_Double, &state.motion.path_seconds, 0.2f, nullptr, nullptr,
                    "%.3g");
  state.motion.path_seconds = std::clamp(state.motion.path_seconds, 1.0, 3600.0);
  if (stage != nullptr) lens_part(state, stage->loaded().path);
  double fov = state.fov_y_deg > 0.0 || stage == nullptr ? state.fov_y_deg
                                                         : stage->loaded().path.fov_y_radians * kDegrees;
  constexpr double kNarrow = 5.0, kWide = 150.0;
  if (ImGui::SliderScalar("field of view", ImGuiDataType_Double, &fov, &kNarrow, &kWide, "%.0f degrees"))
    state.fov_y_deg = std::clamp(fov, 1.0, 170.0);
  if (ImGui::Button(document.recording ? "end the recording (K)" : "record a path (K)"))
    toggle_path_recording(document, stage, display);
  tooltip(
      "fly, and the camera's way becomes the path; it is written as gnomon_path_0001.json and on, which "
      "gnomon fly --path measures");
  ImGui::SameLine();
  if (ImGui::Button("camera of the path")) {
    state.eye.reset();
    state.fov_y_deg = state.height_world = 0.0;
  }
  if (!state.path.empty() && ImGui::Button("the scene's own path")) {
    state.path.clear();
    state.near_depth = state.far_depth = 0.0;  // may be those of the path's file
  }
  bool frozen = state.frozen.has_value();
  if (ImGui::Checkbox("freeze the plan's camera", &frozen)) toggle_freeze(state, stage);
  tooltip("F2: the maps stay as they are for this camera while you fly away");
  if (frozen) drawn_switches(state.drawn);
}

/// A list of what the scene's file has; nothing where it has none. `take` is called with the entry that was
/// chosen.
template <class Entry, class Take>
void choose_of_file(const char* label, const std::vector<Entry>& entries, Display& display,
                    const Take& take) {
  if (entries.empty() || !ImGui::BeginCombo(label, "choose")) return;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(entries[i].name.c_str())) {
      try {
        take(entries[i], i);
      } catch (const std::exception& error) {
        show_message(display, error.what(), true);
      }
    }
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void file_cameras(App& app) {
  if (app.drawing.stage == nullptr) return;
  const Scene& scene = app.drawing.stage->loaded().scene;
  choose_of_file("camera of the file", scene.cameras, app.display,
                 [&](const SceneCamera&, std::size_t number) {
                   CameraWords words;
                   words.of_file = std::to_string(number);
                   take_camera(camera_path(words, scene), app.document.state);
                   app.document.state.motion.camera = false;
                 });
}

void file_lights(App& app) {
  if (app.drawing.stage == nullptr) return;
  choose_of_file(
      "light of the file", app.drawing.stage->loaded().scene.lights, app.display,
      [&](const SceneLight& light, std::size_t) { app.document.state.light = light_state(light); });
}

void view_tab(App& app) {
  State& state = app.document.state;
  const Stage* const stage = app.drawing.stage.get();
  int view = static_cast<int>(state.view);
  for (int i = 0; i < kViewCount; ++i) {
    const Named& one = view_names()[static_cast<std::size_t>(i)];
    if (i % 2 == 1) ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.5f);
    if (ImGui::RadioButton(fmt::format("{} {}", i + 1, one.name).c_str(), &view, i))
      state.view = static_cast<View>(i);
    tooltip(one.help);
  }
  if (state.view == View::map && stage != nullptr) {
    const int maps = std::max(stage->side(0).picture_count(), 1);
    ImGui::SliderInt(stage->side(0).pages ? "level" : "map", &state.map, 0, maps - 1, "%d",
                     ImGuiSliderFlags_AlwaysClamp);
  }
  ImGui::Checkbox("probe under the cursor", &app.display.probing);
  tooltip("I: the aliasing error, the map and the exact shadow at the point under the cursor");
  ImGui::Separator();
  playing_part(state, stage);
  camera_part(app.document, stage, app.display);
  file_cameras(app);
  ImGui::Separator();
  ImGui::TextUnformatted("presets");
  for (const Preset& preset : presets()) {
    if (ImGui::Button(std::string(preset.name).c_str(), {-1.0f, 0.0f})) preset.set(state);
    tooltip(preset.help);
  }
}

void local_light(LightState& state, const Box& scene) {
  const Light now = light_of(state, scene);
  const glm::dvec3 size = scene.max - scene.min;
  const double speed = std::max({size.x, size.y, size.z, 1e-6}) / 1000.0;
  ImGui::TextWrapped(
      "Drag the light in the picture (with Shift along the view), drag the values, or press L to hang it "
      "over the point under the cursor.");
  const auto range = [&](double& value) {
    ImGui::DragScalar("range", ImGuiDataType_Double, &value, static_cast<float>(speed * 5.0), nullptr,
                      nullptr, "%.4g");
    value = std::isfinite(value) ? std::clamp(value, 1e-6, 1e30) : 1.0;
    tooltip("distance that the light reaches, world units");
  };
  if (state.sun.kind == LightKind::point) {
    PointLight light = std::get<PointLight>(now);
    const PointLight before = light;
    edit_vector("position", light.position, speed, "world units");
    range(light.range);
    if (light.position != before.position || light.range != before.range) state.point = light;
    return;
  }
  SpotLight light = std::get<SpotLight>(now);
  const SpotLight before = light;
  edit_vector("position", light.position, speed, "world units");
  edit_vector("direction", light.direction, 0.01, "direction of travel, any length");
  if (light.direction == glm::dvec3(0.0)) light.direction = before.direction;
  constexpr double kNarrow = 1.0, kWide = 179.0;
  double outer = light.outer_radians * kDegrees;
  if (ImGui::SliderScalar("cone", ImGuiDataType_Double, &outer, &kNarrow, &kWide, "%.1f degrees",
                          ImGuiSliderFlags_AlwaysClamp))
    light.outer_radians = outer / kDegrees;
  tooltip("half angle of the cone");
  range(light.range);
  if (light.position != before.position || light.direction != before.direction ||
      light.range != before.range || light.outer_radians != before.outer_radians)
    state.spot = light;
}

void light_tab(App& app) {
  LightState& light = app.document.state.light;
  file_lights(app);
  int kind = static_cast<int>(light.sun.kind);
  for (const LightKind one : {LightKind::sun, LightKind::spot, LightKind::point}) {
    if (one != LightKind::sun) ImGui::SameLine();
    if (ImGui::RadioButton(std::string(to_string(one)).c_str(), &kind, static_cast<int>(one)))
      light.sun.kind = one;
  }
  if (light.sun.kind != LightKind::sun) {
    if (app.drawing.stage != nullptr) local_light(light, app.drawing.stage->loaded().scene.bounds_world);
    if (ImGui::Button("back to its default place")) light.spot.reset(), light.point.reset();
    return;
  }
  edit_sun_dome(light.sun, ImGui::GetContentRegionAvail().x * 0.72f);
  constexpr double kLeast = 0.1, kZenith = 90.0, kTurn = 180.0, kBack = -180.0;
  ImGui::SliderScalar("elevation", ImGuiDataType_Double, &light.sun.elevation_deg, &kLeast, &kZenith,
                      "%.1f degrees", ImGuiSliderFlags_AlwaysClamp);
  tooltip("above the horizon");
  ImGui::SliderScalar("azimuth", ImGuiDataType_Double, &light.sun.azimuth_deg, &kBack, &kTurn, "%.1f degrees",
                      ImGuiSliderFlags_AlwaysClamp);
  tooltip("0 is -Z, 90 is +X");
  Motion& motion = app.document.state.motion;
  ImGui::Checkbox("turning sun", &motion.sun);
  tooltip("O: watch for shimmering while the light moves");
  ImGui::DragScalar("degrees a second", ImGuiDataType_Double, &motion.sun_degrees_per_second, 0.2f, nullptr,
                    nullptr, "%.3g");
  motion.sun_degrees_per_second = std::clamp(motion.sun_degrees_per_second, -360.0, 360.0);
  constexpr double kOff = 0.0, kMaxHold = kMaxHoldPixels;
  double& hold = motion.hold_sun_pixels;
  ImGui::SliderScalar("hold the sun", ImGuiDataType_Double, &hold, &kOff, &kMaxHold,
                      hold > 0.0 ? "%.2f pixels" : "off",
                      ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  tooltip(
      "keep the direction of a turning sun, and with it pages and stable maps, until a shadow edge could err "
      "by so much");
  if (ImGui::Button("reset light")) light = {};
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
    tooltip("texel density changes smoothly from frame to frame");
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
