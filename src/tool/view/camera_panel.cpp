// The panel's tab View: what is drawn, and from where.
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>

#include "app.hpp"
#include "camera_words.hpp"
#include "file_choice.hpp"
#include "widgets.hpp"

namespace gnomon::tool::view {
namespace {

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
  if (ImGui::SliderScalar("field of view", ImGuiDataType_Double, &fov, &kNarrow, &kWide, "%.3g degrees"))
    state.fov_y_deg = std::clamp(fov, kLeastFovDeg, kMostFovDeg);
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

}  // namespace

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

}  // namespace gnomon::tool::view
