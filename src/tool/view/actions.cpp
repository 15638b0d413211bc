// Actions of panel and keys on the state: scenes and files opened and saved, undo, freezing, recorded
// camera paths.
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <stdexcept>

#include "app.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/scene/image.hpp"

namespace gnomon::tool::view {
namespace {

constexpr double kMessageSeconds = 6.0, kErrorSeconds = 15.0;
// Between keys of a recorded path, seconds.
constexpr double kPathStep = 0.5;

/// The camera of the frame that was drawn last.
CameraKey drawn_eye(const Stage& stage) {
  const CameraAxes axes = camera_axes(stage.camera());
  CameraKey key = camera_key(stage.camera().position, axes.forward, axes.up);
  key.target = key.position + stage.camera().forward;
  return key;
}

void add_path_key(PathRecording& recording, const Stage& stage) {
  const CameraKey key = drawn_eye(stage);
  std::vector<CameraKey>& keys = recording.path.keys;
  recording.seconds = 0.0;
  const bool moved = keys.empty() || keys.back().position != key.position || keys.back().target != key.target;
  if (moved && keys.size() < kMaxPathKeys) keys.push_back(key);
}

/// The first name with a number that no file has yet.
std::filesystem::path free_name(fmt::format_string<int&> pattern) {
  constexpr int kMost = 9999;
  int i = 1;
  while (i < kMost && std::filesystem::exists(fmt::format(pattern, i))) ++i;
  return fmt::format(pattern, i);
}

}  // namespace

void record_path(Document& document, const Stage* stage, double seconds) {
  if (!document.recording || stage == nullptr) return;
  document.recording->seconds += seconds;
  if (document.recording->seconds >= kPathStep) add_path_key(*document.recording, *stage);
}

void show_message(Display& display, const std::string& text, bool error) {
  display.message = {text, error, ImGui::GetTime() + (error ? kErrorSeconds : kMessageSeconds)};
}

void open_scene(App& app, const std::string& scene) {
  Loading& loading = app.drawing.loading;
  if (loading.scene.valid()) return show_message(app.display, "still loading " + loading.name, true);
  const State& state = app.document.state;
  loading = {std::async(std::launch::async, load, scene, app.options.max_triangles, state.panes, state.edits),
             scene, ImGui::GetTime()};
}

void set_state(App& app, const State& state) {
  Stage* const stage = app.drawing.stage.get();
  const std::string scene = stage != nullptr ? stage->loaded().name : app.document.state.scene;
  const bool panes = stage != nullptr ? stage->loaded().parted : app.document.state.panes;
  const SceneEdits edits = stage != nullptr ? stage->loaded().edits : app.document.state.edits;
  app.document.state = state;
  if (stage != nullptr) stage->cut();
  if (state.scene != scene || state.panes != panes || state.edits != edits) open_scene(app, state.scene);
}

void open_file(App& app, const std::string& file) {
  const bool results =
      std::filesystem::is_directory(file) || std::filesystem::path(file).extension() == ".jsonl";
  if (!results && !std::filesystem::path(file).extension().string().starts_with(".json"))
    return open_scene(app, file);
  try {
    if (results) return open_results(app.display, app.drawing, file);
    set_state(app, load_state(file));
    app.document.file = file;
    show_message(app.display, "opened " + shown_name(file), false);
  } catch (const std::exception& error) {
    show_message(app.display, error.what(), true);
  }
}

void save_state(const Document& document, Display& display) {
  const std::string name = shown_name(document.file),
                    why = save_text(state_text(document.state), document.file);
  show_message(display, why.empty() ? "saved " + name : name + ": " + why, !why.empty());
}

void toggle_path_recording(Document& document, const Stage* stage, Display& display) {
  if (stage == nullptr) return;
  if (!document.recording) {
    PathRecording& recording = document.recording.emplace();
    recording.path = path_of(document.state, stage->loaded().path);
    recording.path.keys.clear();
    recording.path.closed = false;
    add_path_key(recording, *stage);
    return show_message(display, "the camera's path is recorded; K ends it", false);
  }
  add_path_key(*document.recording, *stage);
  const CameraPath path = std::move(document.recording->path);
  document.recording.reset();
  if (path.keys.size() < 2) return show_message(display, "the camera did not move: no path", true);
  document.state.path = path.keys;
  document.state.motion.path_seconds =
      std::clamp(kPathStep * static_cast<double>(path.keys.size() - 1), 1.0, 3600.0);
  const std::filesystem::path file = free_name("gnomon_path_{:04}.json");
  try {
    save_camera_path(path, file);
    show_message(display,
                 fmt::format("P flies along the path; wrote {}", std::filesystem::absolute(file).string()),
                 false);
  } catch (const std::exception& error) {
    show_message(display, error.what(), true);
  }
}

void toggle_benchmark(App& app, const std::filesystem::path& file) {
  Drawing& drawing = app.drawing;
  if (drawing.stage == nullptr) return;
  if (drawing.benchmark) {
    const State before = drawing.benchmark->before();
    drawing.benchmark.reset();
    set_state(app, before);
    return show_message(app.display, "the benchmark was ended; nothing is written", false);
  }
  const std::filesystem::path to = file.empty() ? free_name("gnomon_benchmark_{:04}.csv") : file;
  drawing.stage->cut();
  drawing.benchmark.emplace(app.document.state, app.options.frames, to, drawing.renderer);
}

bool place_benchmark(App& app) {
  const std::optional<Benchmark>& benchmark = app.drawing.benchmark;
  if (!benchmark) return false;
  app.document.state = benchmark->next();
  show_message(
      app.display,
      fmt::format("benchmark: frame {} of {}; F7 ends it", benchmark->frame() + 1, benchmark->frames()),
      false);
  return true;
}

void take_benchmark(App& app) {
  Drawing& drawing = app.drawing;
  if (!drawing.refusal.empty()) {
    set_state(app, drawing.benchmark->before());
    drawing.benchmark.reset();
    return show_message(app.display, "benchmark: " + drawing.refusal, true);
  }
  drawing.benchmark->take(*drawing.stage, drawing.frame_ms);
  if (!drawing.benchmark->done()) return;
  const Benchmark ended = std::move(*drawing.benchmark);
  drawing.benchmark.reset();
  set_state(app, ended.before());
  const std::string why = save_text(ended.text(), ended.file());
  if (!why.empty()) return show_message(app.display, ended.file().string() + ": " + why, true);
  show_message(app.display,
               fmt::format("wrote {}: {}", std::filesystem::absolute(ended.file()).string(), ended.summary()),
               false);
}

State spoken_state(State state, const Stage* stage) {
  const bool usual = state.path.empty() && state.path_time == State().path_time;
  if (!state.eye && !usual && stage != nullptr) state.eye = drawn_eye(*stage);
  return state;
}

void save_picture(const Drawing& drawing, Display& display) {
  if (drawing.stage == nullptr) return;
  const std::filesystem::path file = free_name("gnomon_view_{:04}.png");
  try {
    write_png(drawing.stage->canvas().image(), file);
    show_message(display, "wrote " + std::filesystem::absolute(file).string(), false);
  } catch (const std::exception& error) {
    show_message(display, error.what(), true);
  }
}

void undo(App& app, bool forward) {
  History& history = app.document.history;
  std::vector<std::string>&from = forward ? history.redo : history.undo,
  &to = forward ? history.undo : history.redo;
  if (from.empty()) return show_message(app.display, forward ? "nothing to redo" : "nothing to undo", false);
  to.push_back(state_text(app.document.state));
  history.now = from.back();
  from.pop_back();
  set_state(app, read_state(history.now));
}

CameraKey& own_eye(State& state, const Stage& stage) {
  state.motion.camera = false;
  if (!state.eye) state.eye = drawn_eye(stage);
  return *state.eye;
}

void toggle_freeze(State& state, const Stage* stage) {
  if (stage == nullptr) return;
  if (state.frozen) {
    state.frozen.reset();
  } else {
    const Camera& camera = stage->camera();
    (void)own_eye(state, *stage);
    state.frozen = drawn_eye(*stage);
    state.frozen_sight = {camera.near_depth, camera.far_depth};
  }
}

}  // namespace gnomon::tool::view
