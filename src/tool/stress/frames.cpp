// `gnomon stress --frames`: random frames, drawn and checked, and the smallest that fails of each kind as
// files.
#include "stress/frames.hpp"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "check_frame.hpp"
#include "frame_scene.hpp"
#include "frame_setting.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "run_frames.hpp"
#include "state.hpp"
#include "stress/random.hpp"

namespace gnomon::tool {
namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

/// What the viewer shows of the frame: the place where it fails, at rest. False where it has no such camera.
bool view_state(const Json& frame, const std::string& scene, view::State& state) {
  const stress::FrameSetting setting = stress::read_frame(frame);
  const Camera& camera = setting.input.camera;
  if (camera.orthographic) return false;
  const CameraAxes axes = camera_axes(camera);
  state.scene = scene;
  state.panes = setting.panes;
  state.eye = camera_key(camera.position, axes.forward, axes.up);
  state.fov_y_deg = 2.0 * view::kDegrees * std::atan(camera.top);
  state.near_depth = camera.near_depth;
  state.far_depth = camera.far_depth;
  state.light = view::light_state(setting.input.light);
  state.a.plan = setting.input.options;
  state.a.filter = setting.filter;
  state.a.transition = setting.options.transition;
  state.a.layer = setting.options.depth_layer;
  state.a.linear_depth = setting.options.linear_depth;
  state.a.map_passes = setting.options.map_passes;
  if (setting.source.kind == render::SourceKind::identifiers) state.a.identifiers = setting.source.test;
  if (setting.source.kind == render::SourceKind::pages) {
    state.a.pages.policy = setting.pages.policy;
    state.a.pages.page_texels = setting.pages.page_texels;
    state.a.pages.capacity = setting.pages.capacity;
    state.a.pages.target_m = setting.pages.target_m;
  }
  state.view = view::View::misclassified;
  return true;
}

std::string write_failure(const fs::path& folder, const stress::KindFound& found) {
  const std::string name(found.kind);
  const fs::path file = folder / (name + ".json"), scene = folder / (name + ".glb");
  const Json frame = Json::parse(found.case_file);
  write_file(file, found.case_file);
  write_file(scene, stress::glb_of(frame));
  std::string text = "wrote " + shown_name(file) + ", " + shown_name(scene);
  view::State state;
  if (view_state(frame, fs::absolute(scene).string(), state)) {
    const fs::path shown = folder / (name + ".view.json");
    write_file(shown, view::state_text(state));
    text += ", " + shown_name(shown);
  }
  return text + "\n";
}

}  // namespace

bool is_frame_file(const std::string& text) {
  const Json value = Json::parse(text, nullptr, false);
  return value.is_object() && value.contains("objects");
}

bool replay_frame(const std::string& text, const std::string& name, render::ContextKind context_kind) {
  const std::unique_ptr<render::Context> context = render::create_context(context_kind);
  stress::FrameVerdict verdict;
  try {
    verdict = stress::check_frame(Json::parse(text));
  } catch (const CaseError& error) {
    throw CaseError(name + ": " + error.what());
  }
  for (const stress::Finding& f : verdict.findings)
    print_line(name + ": " + std::string(f.kind) + ": " + f.text);
  if (verdict.findings.empty()) print_line(name + ": keeps every promise");
  return !verdict.findings.empty();
}

int run_frame_stress(const FrameStressRequest& request) {
  const fs::path folder = failure_folder(request.out, request.seed);
  const std::unique_ptr<render::Context> context = render::create_context(request.context);
  const stress::FrameOptionsOfRun options{static_cast<long long>(request.frames), request.seed, true};
  Progress progress("gnomon stress --frames", options.frames);
  const stress::FramesResult result =
      stress::run_frames(options, [&](long long done) { progress.set(done); });
  progress.clear();
  std::string text = stress::summary(options, result);
  if (!result.kinds.empty()) make_folder("--out", folder);
  for (const stress::KindFound& found : result.kinds) text += write_failure(folder, found);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  print_line(text);
  flush_output();
  return result.kinds.empty() ? 0 : 1;
}

}  // namespace gnomon::tool
