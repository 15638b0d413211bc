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

void add_path_key(App& app) {
  const Camera& camera = app.stage->camera();
  const CameraKey key{camera.position, camera.position + camera.forward};
  std::vector<CameraKey>& keys = app.recorded_path->keys;
  app.path_seconds = 0.0;
  const bool moved = keys.empty() || keys.back().position != key.position || keys.back().target != key.target;
  if (moved && keys.size() < kMostPathKeys) keys.push_back(key);
}

/// The first name with a number that no file has yet.
std::filesystem::path free_name(fmt::format_string<int&> pattern) {
  constexpr int kMost = 9999;
  int i = 1;
  while (i < kMost && std::filesystem::exists(fmt::format(pattern, i))) ++i;
  return fmt::format(pattern, i);
}

}  // namespace

void record_path(App& app, double seconds) {
  if (!app.recorded_path || app.stage == nullptr) return;
  app.path_seconds += seconds;
  if (app.path_seconds >= kPathStep) add_path_key(app);
}

void show_message(App& app, const std::string& text, bool error) {
  app.message = text;
  app.message_is_error = error;
  app.message_until = ImGui::GetTime() + (error ? kErrorSeconds : kMessageSeconds);
}

void open_scene(App& app, const std::string& scene) {
  if (app.loading.valid()) return show_message(app, "still loading " + app.loading_name, true);
  app.loading_name = scene;
  app.loading_since = ImGui::GetTime();
  app.loading = std::async(std::launch::async, load, scene, app.options.max_triangles, app.state.panes);
}

void set_state(App& app, const State& state) {
  const std::string scene = app.stage != nullptr ? app.stage->loaded().name : app.state.scene;
  const bool panes = app.stage != nullptr ? app.stage->loaded().parted : app.state.panes;
  app.state = state;
  if (app.stage != nullptr) app.stage->cut();
  if (state.scene != scene || state.panes != panes) open_scene(app, state.scene);
}

void open_file(App& app, const std::string& file) {
  const bool results =
      std::filesystem::is_directory(file) || std::filesystem::path(file).extension() == ".jsonl";
  if (!results && !std::filesystem::path(file).extension().string().starts_with(".json"))
    return open_scene(app, file);
  try {
    if (results) return open_results(app, file);
    set_state(app, load_state(file));
    app.state_file = file;
    show_message(app, "opened " + shown_name(file), false);
  } catch (const std::exception& error) {
    show_message(app, error.what(), true);
  }
}

void save_state(App& app, const std::string& file) {
  const std::string why = save_text(state_text(app.state), file);
  show_message(app, why.empty() ? "saved " + shown_name(file) : shown_name(file) + ": " + why, !why.empty());
}

void toggle_path_recording(App& app) {
  if (app.stage == nullptr) return;
  if (!app.recorded_path) {
    app.recorded_path = path_of(app.state, app.stage->loaded().path);
    app.recorded_path->keys.clear();
    app.recorded_path->closed = false;
    add_path_key(app);
    return show_message(app, "the camera's path is recorded; K ends it", false);
  }
  add_path_key(app);
  const CameraPath path = std::move(*app.recorded_path);
  app.recorded_path.reset();
  if (path.keys.size() < 2) return show_message(app, "the camera did not move: no path", true);
  app.state.path = path.keys;
  app.state.motion.path_seconds =
      std::clamp(kPathStep * static_cast<double>(path.keys.size() - 1), 1.0, 3600.0);
  const std::filesystem::path file = free_name("gnomon_path_{:04}.json");
  try {
    save_camera_path(path, file);
    show_message(app,
                 fmt::format("P flies along the path; wrote {}", std::filesystem::absolute(file).string()),
                 false);
  } catch (const std::exception& error) {
    show_message(app, error.what(), true);
  }
}

void toggle_benchmark(App& app, const std::filesystem::path& file) {
  if (app.stage == nullptr) return;
  if (app.benchmark) {
    const State before = app.benchmark->before();
    app.benchmark.reset();
    set_state(app, before);
    return show_message(app, "the benchmark was ended; nothing is written", false);
  }
  const std::filesystem::path to = file.empty() ? free_name("gnomon_benchmark_{:04}.csv") : file;
  app.stage->cut();
  app.benchmark.emplace(app.state, app.options.frames, to, app.renderer);
}

bool place_benchmark(App& app) {
  if (!app.benchmark) return false;
  app.state = app.benchmark->next();
  show_message(app,
               fmt::format("benchmark: frame {} of {}; F7 ends it", app.benchmark->frame() + 1,
                           app.benchmark->frames()),
               false);
  return true;
}

void take_benchmark(App& app) {
  if (!app.refusal.empty()) {
    set_state(app, app.benchmark->before());
    app.benchmark.reset();
    return show_message(app, "benchmark: " + app.refusal, true);
  }
  app.benchmark->take(*app.stage, app.frame_ms);
  if (!app.benchmark->done()) return;
  const Benchmark ended = std::move(*app.benchmark);
  app.benchmark.reset();
  set_state(app, ended.before());
  const std::string why = save_text(ended.text(), ended.file());
  if (!why.empty()) return show_message(app, ended.file().string() + ": " + why, true);
  show_message(app,
               fmt::format("wrote {}: {}", std::filesystem::absolute(ended.file()).string(), ended.summary()),
               false);
}

State spoken_state(const App& app) {
  State state = app.state;
  const bool usual = state.path.empty() && state.path_time == State().path_time;
  if (!state.eye && !usual && app.stage != nullptr) {
    const Camera& camera = app.stage->camera();
    state.eye = CameraKey{camera.position, camera.position + camera.forward};
  }
  return state;
}

void save_picture(App& app) {
  if (app.stage == nullptr) return;
  const std::filesystem::path file = free_name("gnomon_view_{:04}.png");
  try {
    write_png(app.stage->canvas().image(), file);
    show_message(app, "wrote " + std::filesystem::absolute(file).string(), false);
  } catch (const std::exception& error) {
    show_message(app, error.what(), true);
  }
}

void undo(App& app, bool forward) {
  std::vector<std::string>&from = forward ? app.redo : app.undo, &to = forward ? app.undo : app.redo;
  if (from.empty()) return show_message(app, forward ? "nothing to redo" : "nothing to undo", false);
  to.push_back(state_text(app.state));
  app.undo_now = from.back();
  from.pop_back();
  set_state(app, read_state(app.undo_now));
}

CameraKey& own_eye(App& app) {
  app.state.motion.camera = false;
  if (!app.state.eye) {
    const Camera& camera = app.stage->camera();
    app.state.eye = CameraKey{camera.position, camera.position + camera.forward};
  }
  return *app.state.eye;
}

void toggle_freeze(App& app) {
  if (app.stage == nullptr) return;
  if (app.state.frozen) {
    app.state.frozen.reset();
  } else {
    app.state.frozen = own_eye(app);
  }
}

}  // namespace gnomon::tool::view
