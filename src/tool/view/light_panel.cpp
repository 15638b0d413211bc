// The panel's tab Light: sun, spot or point, and where it is.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app.hpp"
#include "file_choice.hpp"
#include "widgets.hpp"

namespace gnomon::tool::view {
namespace {

void file_lights(App& app) {
  if (app.drawing.stage == nullptr) return;
  bool& all = app.document.state.light.all;
  if (all || !app.drawing.stage->loaded().scene.lights.empty()) {
    ImGui::Checkbox("all lights of the file", &all);
    tooltip("each with its colour and intensity; in the view lit");
    const Side& side = app.drawing.stage->side(0);
    if (all && side.lights) ImGui::TextWrapped("%s", to_string(side.lights_drawn).c_str());
  }
  choose_of_file(
      "light of the file", app.drawing.stage->loaded().scene.lights, app.display,
      [&](const SceneLight& light, std::size_t) { app.document.state.light = light_state(light); });
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

}  // namespace

void light_tab(App& app) {
  LightState& light = app.document.state.light;
  file_lights(app);
  if (light.all) return;
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

}  // namespace gnomon::tool::view
