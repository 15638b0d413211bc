// Keys, and the mouse over the picture.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app.hpp"
#include "framing.hpp"
#include "steering.hpp"

namespace gnomon::tool::view {
namespace {

constexpr KeyHelp kKeys[] = {
    {"W A S D, Q E", "move; with Shift four times as fast"},
    {"drag, arrows", "look around; the wheel moves along the view"},
    {"1 ... 9", "lit, heat, mask, misclassified, cascades, checker, map, truth, kept"},
    {"Tab", "panel on and off"},
    {"F1, H", "this page"},
    {"F2", "freeze the plan's camera, and fly away from it"},
    {"F3", "compare: off, wipe, difference; drag the line"},
    {"F4", "change A or B in the panel"},
    {"F5, F9", "save the state file, open it"},
    {"F6", "arrows and Enter move in the panel, and again in the scene"},
    {"F7", "benchmark: fly along the path, and write a row of figures for each frame"},
    {"F11, F12", "record pictures, save one picture"},
    {"V, F", "next warp, next filter; with Shift the one before"},
    {"G", "pages: off, next policy; with Shift the one before"},
    {"T", "stable fit on and off"},
    {"+, -", "one cascade more, one less"},
    {"PageUp, PageDown", "maps of twice the size, of half the size"},
    {"M", "next map or level of the map view"},
    {"I", "probe under the cursor on and off"},
    {"drag the light", "move it across the view, with Shift along it"},
    {"L", "hang the spot or point light over the point under the cursor"},
    {"P, O", "fly along the path, turn the sun"},
    {"Space", "play the scene's animation, or pause it"},
    {"K", "record the camera's way as the path, into a file; K ends it"},
    {"C", "come to what lies under the cursor, until it fills the picture"},
    {"R, Home", "camera of the path"},
    {"Ctrl+C", "copy the command with this picture"},
    {"Ctrl+Z, Ctrl+Y", "undo, redo"},
    {"Ctrl+Q", "quit; the state is kept as the last session"},
    {"Esc", "close this page; nothing is lost"},
};

/// The events of one frame: up to a key that went down twice. Its second press is the next frame's, with all
/// that came after it.
std::vector<KeyEvent> take_events(std::vector<KeyEvent>& waiting) {
  auto end = waiting.begin();
  const auto repeats = [&](const KeyEvent& event) {
    return event.down && std::any_of(waiting.begin(), end,
                                     [&](const KeyEvent& one) { return one.down && one.key == event.key; });
  };
  while (end != waiting.end() && !repeats(*end)) ++end;
  std::vector<KeyEvent> now(waiting.begin(), end);
  waiting.erase(waiting.begin(), end);
  return now;
}

/// Keys in one frame. ImGui has them as they are now: it forgets one that goes down and up between two
/// frames, which are half a second apart in software, and knows of others before their turn.
class Presses {
 public:
  /// Takes the next events.
  explicit Presses(Keys& keys) : events_(take_events(keys.events)), down_(keys.down) {
    for (const KeyEvent& event : events_) {
      std::erase(keys.down, event.key);
      if (event.down && !has_control(event)) keys.down.push_back(event.key);
    }
  }
  [[nodiscard]] bool operator()(int key, bool control = false) const {
    const KeyEvent* const press = press_of(key);
    return press != nullptr && has_control(*press) == control;
  }
  /// 1 where the key went down, -1 where it did with Shift, 0 where it did not.
  [[nodiscard]] int step(int key) const {
    if (!(*this)(key)) return 0;
    return (press_of(key)->modifiers & GLFW_MOD_SHIFT) != 0 ? -1 : 1;
  }
  /// Down after this frame's events, or between them.
  [[nodiscard]] bool held(int key) const {
    return std::find(down_.begin(), down_.end(), key) != down_.end() || (*this)(key);
  }
  [[nodiscard]] bool shift() const { return held(GLFW_KEY_LEFT_SHIFT) || held(GLFW_KEY_RIGHT_SHIFT); }
  [[nodiscard]] bool control() const { return held(GLFW_KEY_LEFT_CONTROL) || held(GLFW_KEY_RIGHT_CONTROL); }

 private:
  static bool has_control(const KeyEvent& event) { return (event.modifiers & GLFW_MOD_CONTROL) != 0; }
  /// The only one that a frame takes; nullptr: none.
  [[nodiscard]] const KeyEvent* press_of(int key) const {
    const auto press = std::find_if(events_.begin(), events_.end(),
                                    [key](const KeyEvent& event) { return event.down && event.key == key; });
    return press != events_.end() ? &*press : nullptr;
  }

  std::vector<KeyEvent> events_;
  const std::vector<int>& down_;
};

/// The entry of a registry that is so many steps behind `now`, round and round. nullptr is an entry as well,
/// where `off` is set: before the first.
template <class Registry, class Entry>
const Entry* stepped(const Registry& all, const Entry* now, int step, bool off) {
  const std::ptrdiff_t before = off ? 1 : 0, count = static_cast<std::ptrdiff_t>(all.size()) + before;
  const std::ptrdiff_t at =
      now == nullptr ? 0 : std::find(all.begin(), all.end(), now) - all.begin() + before;
  const std::ptrdiff_t next = (at + step + count) % count - before;
  return next < 0 ? nullptr : all[static_cast<std::size_t>(next)];
}

/// Over the point under the cursor, at the height that the light has above the scene's floor.
void hang_light(LightState& light, const Probed& probed, const Box& bounds) {
  if (!probed.hit || light.sun.kind == LightKind::sun) return;
  const double up = 0.4 * (bounds.max.y - bounds.min.y);
  const glm::dvec3 position = probed.point + glm::dvec3(0.0, up, 0.0);
  Light now = light_of(light, bounds);
  if (auto* point = std::get_if<PointLight>(&now)) {
    point->position = position;
    light.point = *point;
  } else if (auto* spot = std::get_if<SpotLight>(&now)) {
    spot->position = position;
    spot->direction = {0.0, -1.0, 0.0};
    light.spot = *spot;
  }
}

/// Where the cursor is within the picture, pixels; nothing where it is off it, or over the panel.
std::optional<glm::dvec2> cursor_in(const Drawing& drawing, const Display& display) {
  const ImGuiIO& io = ImGui::GetIO();
  const Area& area = drawing.area;
  const double x = static_cast<double>(io.MousePos.x) * display.pixel_ratio - area.x,
               y = static_cast<double>(io.MousePos.y) * display.pixel_ratio - area.y;
  if (io.WantCaptureMouse || !(x >= 0.0 && y >= 0.0 && x < area.width && y < area.height))
    return std::nullopt;
  return glm::dvec2(x, y);
}

void frame_under_cursor(App& app) {
  Stage* const stage = app.drawing.stage.get();
  const std::optional<glm::dvec2> cursor = cursor_in(app.drawing, app.display);
  if (stage == nullptr || !cursor || app.document.state.view == View::map) return;
  if (stage->tracer() == nullptr) {
    stage->want_tracer();
    return show_message(app.display, "sorting triangles for exact rays: press C again", false);
  }
  const Camera& camera = stage->camera();
  const Probed probed = probe(*stage->tracer(), stage->side(0).drawn, camera, stage->light(), cursor->x,
                              cursor->y, stage->side(0).page_plan());
  if (!probed.hit) return show_message(app.display, "nothing lies under the cursor", false);
  State& state = app.document.state;
  const Box& object = stage->boxes()[probed.instance];
  const double edge = std::min(camera.right - camera.left, camera.top - camera.bottom) * 0.5;
  constexpr double kUsual = 0.5;  // radians: parallel rays have no angle
  frame(own_eye(state, *stage), object, probed.point, camera.orthographic ? kUsual : std::atan(edge));
  if (camera.orthographic) state.height_world *= framed_share(object, edge);
}

void control_keys(App& app, const Presses& pressed) {
  constexpr bool kControl = true;
  if (pressed(GLFW_KEY_Q, kControl)) glfwSetWindowShouldClose(app.window, GLFW_TRUE);
  if (pressed(GLFW_KEY_C, kControl)) {
    ImGui::SetClipboardText(command_text(spoken_state(app.document.state, app.drawing.stage.get())).c_str());
    show_message(app.display, "the command is in the clipboard", false);
  }
  if (pressed(GLFW_KEY_Z, kControl)) undo(app, false);
  if (pressed(GLFW_KEY_Y, kControl)) undo(app, true);
}

void setting_keys(App& app, const Presses& pressed) {
  State& state = app.document.state;
  Settings& settings = app.document.edited();
  const Stage* const stage = app.drawing.stage.get();
  int& cascades = settings.plan.cascades;
  int& size = settings.plan.resolution.max_size;
  const Warp*& warp = settings.plan.warp.warp;
  if (const int step = pressed.step(GLFW_KEY_V); step != 0) warp = stepped(all_warps(), warp, step, true);
  if (const int step = pressed.step(GLFW_KEY_F); step != 0) {
    settings.filter =
        render::default_settings(*stepped(render::all_filters(), settings.filter.filter, step, false));
    settings.identifiers.reset();
  }
  if (const int step = pressed.step(GLFW_KEY_G); step != 0)
    settings.pages.policy = stepped(all_page_policies(), settings.pages.policy, step, true);
  if (pressed(GLFW_KEY_T)) settings.plan.fit = settings.plan.fit == Fit::stable ? Fit::tight : Fit::stable;
  if (pressed(GLFW_KEY_EQUAL) || pressed(GLFW_KEY_KP_ADD)) cascades = std::min(cascades + 1, kMaxMaps);
  if (pressed(GLFW_KEY_MINUS) || pressed(GLFW_KEY_KP_SUBTRACT)) cascades = std::max(cascades - 1, 1);
  if (pressed(GLFW_KEY_PAGE_UP)) size = std::min(size * 2, kMaxMapSize);
  if (pressed(GLFW_KEY_PAGE_DOWN)) size = std::max(size / 2, kLeastMapSize);
  if (pressed(GLFW_KEY_L) && app.display.probed)
    hang_light(state.light, *app.display.probed, stage->loaded().scene.bounds_world);
  if (pressed(GLFW_KEY_K)) toggle_path_recording(app.document, stage, app.display);
  if (pressed(GLFW_KEY_SPACE)) toggle_playing(state, stage);
  if (pressed(GLFW_KEY_O)) state.motion.sun = !state.motion.sun;
  if (pressed(GLFW_KEY_M) && stage != nullptr)
    state.map = (state.map + 1) % std::max(stage->side(0).picture_count(), 1);
  if (pressed(GLFW_KEY_P)) {
    state.motion.camera = !state.motion.camera;
    if (state.motion.camera) state.eye.reset();
  }
  if (pressed(GLFW_KEY_C)) frame_under_cursor(app);
  if (pressed(GLFW_KEY_R) || pressed(GLFW_KEY_HOME)) state.eye.reset();
}

void function_keys(App& app, const Presses& pressed) {
  State& state = app.document.state;
  Display& display = app.display;
  for (int i = 0; i < kViewCount; ++i)
    if (pressed(GLFW_KEY_1 + i)) state.view = static_cast<View>(i);
  if (pressed(GLFW_KEY_F1) || pressed(GLFW_KEY_H)) display.help = !display.help;
  if (pressed(GLFW_KEY_TAB)) display.panel = !display.panel;
  if (pressed(GLFW_KEY_F2)) toggle_freeze(state, app.drawing.stage.get());
  if (pressed(GLFW_KEY_F3))
    state.comparison = static_cast<Comparison>((static_cast<int>(state.comparison) + 1) % 3);
  if (pressed(GLFW_KEY_F4)) app.document.side = 1 - app.document.side;
  if (pressed(GLFW_KEY_F5)) save_state(app.document, display);
  if (pressed(GLFW_KEY_F9)) open_file(app, app.document.file);
  if (pressed(GLFW_KEY_F6)) ImGui::GetIO().ConfigFlags ^= ImGuiConfigFlags_NavEnableKeyboard;
  if (pressed(GLFW_KEY_F7)) toggle_benchmark(app);
  if (pressed(GLFW_KEY_F11)) app.drawing.saving.every = !app.drawing.saving.every;
  if (pressed(GLFW_KEY_F12)) app.drawing.saving.next = true;
  if (pressed(GLFW_KEY_I)) display.probing = !display.probing;
  if (pressed(GLFW_KEY_ESCAPE)) display.help = false;
}

void steer(State& state, const Stage& stage, const Presses& pressed, double seconds) {
  const auto axis = [&pressed](int plus, int minus) {
    return 1.0 * pressed.held(plus) - 1.0 * pressed.held(minus);
  };
  const bool arrows = (ImGui::GetIO().ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) == 0;
  const glm::dvec3 way(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                       axis(GLFW_KEY_W, GLFW_KEY_S));
  const glm::dvec2 look =
      arrows ? glm::dvec2(axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT), axis(GLFW_KEY_UP, GLFW_KEY_DOWN))
             : glm::dvec2(0.0);
  if (way == glm::dvec3(0.0) && look == glm::dvec2(0.0)) return;
  CameraKey& eye = own_eye(state, stage);
  constexpr double kRadiansPerSecond = 1.2;
  turn(eye, look.x * kRadiansPerSecond * seconds, look.y * kRadiansPerSecond * seconds);
  Camera camera = stage.camera();
  camera.forward = eye.target - eye.position;
  const CameraAxes axes = camera_axes(camera);
  // A scene's depth in twenty seconds, whatever its units.
  constexpr double kSeconds = 20.0, kFast = 4.0;
  const double speed = stage.loaded().path.far_depth / kSeconds * (pressed.shift() ? kFast : 1.0);
  move(eye, (axes.right * way.x + glm::dvec3(0.0, way.y, 0.0) + axes.forward * way.z) * (speed * seconds));
}

/// Moves the local light with the mouse: across the view, or with Shift along it.
void place_light(LightState& state, const Stage& stage, double pixel_ratio) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseDelta.x == 0.0f && io.MouseDelta.y == 0.0f) return;
  Light light = stage.light();
  const Camera& camera = stage.camera();
  const CameraAxes axes = camera_axes(camera);
  const auto moved = [&](glm::dvec3& position) {
    const double depth = glm::dot(position - camera.position, axes.forward);
    const double step =
        (camera.right - camera.left) / camera.width * (camera.orthographic ? 1.0 : depth) * pixel_ratio;
    const double right = static_cast<double>(io.MouseDelta.x) * step,
                 down = static_cast<double>(io.MouseDelta.y) * step;
    position += io.KeyShift ? axes.forward * -down : axes.right * right - axes.up * down;
  };
  if (auto* point = std::get_if<PointLight>(&light)) {
    moved(point->position);
    state.point = *point;
  } else if (auto* spot = std::get_if<SpotLight>(&light)) {
    moved(spot->position);
    state.spot = *spot;
  }
}

void mouse(State& state, const Drawing& drawing, Display& display) {
  const ImGuiIO& io = ImGui::GetIO();
  const Stage& stage = *drawing.stage;
  const Area& area = drawing.area;
  Mouse& button = display.mouse;
  const std::optional<glm::dvec2> cursor = cursor_in(drawing, display);
  const bool over = cursor.has_value();
  const double x = static_cast<double>(io.MousePos.x) * display.pixel_ratio - area.x,
               y = static_cast<double>(io.MousePos.y) * display.pixel_ratio - area.y;
  constexpr double kNear = 8.0;  // pixels from the line that the button still takes hold of
  if (over && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    button.wiping = state.comparison == Comparison::wipe && std::abs(x - state.wipe * area.width) < kNear;
    const auto handle = light_handle(state, &stage);
    button.placing = handle && glm::length(handle->from - glm::dvec2(x, y)) < 2.0 * kNear;
    button.looking = !button.wiping && !button.placing;
  }
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) button = {};
  // The pointer's way to where it was pressed is no drag, and a hand that clicks is never quite still.
  if (button.placing && !ImGui::IsMouseClicked(ImGuiMouseButton_Left))
    place_light(state.light, stage, display.pixel_ratio);
  if (button.wiping) state.wipe = std::clamp(x / area.width, 0.0, 1.0);
  constexpr double kRadiansPerUnit = 0.003;
  if (button.looking && ImGui::IsMouseDragging(ImGuiMouseButton_Left) &&
      (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f))
    turn(own_eye(state, stage), static_cast<double>(io.MouseDelta.x) * kRadiansPerUnit,
         -static_cast<double>(io.MouseDelta.y) * kRadiansPerUnit);
  if (over && io.MouseWheel != 0.0f && state.height_world > 0.0) {
    constexpr double kStep = 0.9, kLeast = 1e-30, kMost = 1e30;
    state.height_world =
        std::clamp(state.height_world * std::pow(kStep, static_cast<double>(io.MouseWheel)), kLeast, kMost);
  } else if (over && io.MouseWheel != 0.0f) {
    CameraKey& eye = own_eye(state, stage);
    constexpr double kSteps = 60.0;  // of the wheel, through the scene's depth
    move(eye, glm::normalize(eye.target - eye.position) *
                  (static_cast<double>(io.MouseWheel) * stage.loaded().path.far_depth / kSteps));
  }
  display.probed.reset();
  if (over && display.probing && !button.moves() && stage.tracer() != nullptr && state.view != View::map &&
      !state.light.all)
    display.probed = probe(*stage.tracer(), stage.side(0).drawn, stage.camera(), stage.light(), x, y,
                           stage.side(0).page_plan());
}

}  // namespace

std::optional<ScreenLine> light_handle(const State& state, const Stage* stage) {
  if (stage == nullptr || state.view == View::map || state.light.all) return {};
  const Light& light = stage->light();
  const Camera& camera = stage->camera();
  WorldLine axis;
  if (const auto* spot = std::get_if<SpotLight>(&light)) {
    axis.from = spot->position;
    axis.to = spot->position + glm::normalize(spot->direction) * (0.3 * spot->range);
  } else if (const auto* point = std::get_if<PointLight>(&light)) {
    axis.from = point->position;
    axis.to = point->position - glm::dvec3(0.0, 0.05 * point->range, 0.0);
  } else {
    return {};
  }
  // Cut lines begin elsewhere: the handle is the light's own place, or none.
  if (on_screen({{axis.from, axis.from + camera_axes(camera).right * 1e-9, {}, 1.0}}, camera).empty())
    return {};
  const std::vector<ScreenLine> visible = on_screen({axis}, camera);
  if (visible.empty()) return {};
  return visible.front();
}

std::span<const KeyHelp> key_help() noexcept {
  return kKeys;
}

void handle_input(App& app, double seconds) {
  const Presses pressed(app.display.keys);
  if (!ImGui::GetIO().WantTextInput) {
    control_keys(app, pressed);
    function_keys(app, pressed);
    setting_keys(app, pressed);
    if (app.drawing.stage != nullptr && !pressed.control())
      steer(app.document.state, *app.drawing.stage, pressed, seconds);
  }
  if (app.drawing.stage != nullptr) mouse(app.document.state, app.drawing, app.display);
}

}  // namespace gnomon::tool::view
