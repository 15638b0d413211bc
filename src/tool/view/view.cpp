// The words of `gnomon view`, and the picture without a window.
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>

#include "camera_words.hpp"
#include "command.hpp"
#include "edit_words.hpp"
#include "filter_words.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "identifier_word.hpp"
#include "named_in.hpp"
#include "offscreen_context.hpp"
#include "options.hpp"
#include "output.hpp"
#include "picture_words.hpp"
#include "plan_option.hpp"
#include "progress.hpp"
#include "scene_words.hpp"
#include "stage.hpp"

namespace gnomon::tool::view {
namespace {

/// The command line: options, with words that stand for others or name files.
struct Request {
  Options options;
  std::string state, plan_json, out, screenshot, tour, benchmark;
  CameraWords camera;
  std::string light_of_file;  ///< by name or number; empty: none
  std::optional<glm::dvec3> light_position, light_direction;
  double light_outer_deg = 0.0, light_range = 0.0;
  bool size_given = false;
  /// Options that set a part of the state, and whether each is given; on the heap, as their addresses are
  /// kept.
  std::vector<std::pair<std::string, std::unique_ptr<bool>>> settings;
};

void resolve_light(const Request& request, LightState& light) {
  if (!request.light_position) {
    if (request.light_direction || request.light_outer_deg > 0.0 || request.light_range > 0.0)
      throw std::runtime_error(
          "--light-direction, --light-outer-deg and --light-range need --light-position");
    return;
  }
  if (light.sun.kind == LightKind::sun)
    throw std::runtime_error("--light-position: the sun has none; give --light spot or --light point");
  constexpr double kRadians = 3.14159265358979323846 / 180.0;
  const glm::dvec3 position = *request.light_position;
  if (light.sun.kind == LightKind::point) {
    light.point = PointLight{position, request.light_range};
    return;
  }
  const glm::dvec3 down{0.0, -1.0, 0.0};
  SpotLight spot{position, request.light_direction.value_or(down), SpotLight{}.outer_radians,
                 request.light_range};
  if (spot.direction == glm::dvec3(0.0)) throw std::runtime_error("--light-direction: must not be zero");
  if (request.light_outer_deg > 0.0) spot.outer_radians = request.light_outer_deg * kRadians;
  light.spot = spot;
}

void resolve_camera(const CameraWords& words, State& state) {
  check_camera(words);
  if (!words.path.empty()) {
    const CameraPath path = load_camera_path(words.path);
    if (path.keys.size() > kMaxPathKeys)
      throw std::runtime_error(fmt::format("--path: at most {} keys", kMaxPathKeys));
    state.path = path.keys;
    if (path.closed) state.path.push_back(path.keys.front());
    state.fov_y_deg = std::clamp(path.fov_y_radians * kDegrees, kLeastFovDeg, kMostFovDeg);
    state.height_world = path.height_world;
    state.near_depth = path.near_depth;
    state.far_depth = path.far_depth;
  }
  if (words.height_world > 0.0) state.height_world = words.height_world;
  if (words.near_depth > 0.0) state.near_depth = words.near_depth;
  if (words.far_depth > 0.0) state.far_depth = words.far_depth;
  if (words.eye) state.eye = eye_key(words);
}

/// Camera and light of the scene's file, for which it is read.
void resolve_scene_words(const Request& request, Options& options) {
  State& state = options.state;
  const std::string &camera = request.camera.of_file, &light_word = request.light_of_file;
  state.light.all = light_word == kAllLights;
  const bool one_light = !light_word.empty() && !state.light.all;
  if (camera.empty() && !one_light) return;
  Scene scene = load_scene(state.scene, limits_of_triangles(request.options.max_triangles));
  turn_up(state.edits.up, scene);
  if (one_light) {
    const SceneLight& light = named_in(scene.lights, light_word, "--scene-light", "light");
    try {
      state.light = light_state(light);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(std::string("--scene-light ") + error.what());
    }
  }
  if (camera.empty()) return;
  take_camera(camera_path(request.camera, scene), state);
  // A window's picture is as wide as the window leaves it.
  if (!options.out.empty())
    fit_picture(request.camera, scene, request.size_given, options.width, options.height);
}

bool is_given(const Request& request, std::string_view setting) {
  return std::any_of(request.settings.begin(), request.settings.end(),
                     [setting](const auto& one) { return one.first == setting && *one.second; });
}

void resolve_playing(const Request& request, Playing& playing) {
  const bool animate = is_given(request, "--animate");
  if (playing.animation.empty() && (animate || is_given(request, "--animation-time")))
    playing.animation = "0";
  playing.on = animate && playing.speed != 0.0;
}

/// The fields that only --options carries, taken from its text; the others are as the command line has them.
void resolve_plan(const Request& request, PlanOptions& plan) {
  if (request.plan_json.empty()) return;
  PlanOptions read;
  try {
    read = read_plan_options(request.plan_json);
  } catch (const CaseError& error) {
    throw std::runtime_error(std::string("--options: ") + error.what());
  }
  const PlanOptions words = plan;
  plan = read;
  for (const auto& [name, given] : request.settings) {
    std::string key = name.substr(2);
    std::replace(key.begin(), key.end(), '-', '_');
    const auto fields = plan_fields();
    const auto field =
        std::find_if(fields.begin(), fields.end(), [&key](const PlanField& f) { return f.key == key; });
    if (!*given || field == fields.end()) continue;
    PlanOptions from = words;
    std::visit(
        [&](const auto& place) {
          using Place = std::remove_cvref_t<decltype(place)>;
          if constexpr (std::is_same_v<Place, PlanChoice>) {
            (void)place.set(place.get(from), plan);
          } else {
            place(plan) = place(from);
          }
        },
        field->place);
  }
}

/// What is written replaces nothing that is read.
void check_files(const Request& request, const Options& options) {
  const std::vector<std::filesystem::path> read{options.state.scene, request.state, request.camera.path,
                                                options.state.edits.proxies};
  for (const auto& [option, file] : {std::pair("--out", request.out),
                                     {"--screenshot", request.screenshot},
                                     {"--benchmark", request.benchmark}}) {
    if (!file.empty()) check_file(option, file, read);
  }
}

Options resolved(const Request& request) {
  Options options = request.options;
  options.out = request.out;
  options.screenshot = request.screenshot;
  options.tour = request.tour;
  options.benchmark = request.benchmark;
  if (!request.benchmark.empty() && !request.tour.empty())
    throw std::runtime_error("--benchmark and --tour: give one of them, each ends by itself");
  if (!request.state.empty()) {
    for (const auto& [name, given] : request.settings)
      if (*given)
        throw std::runtime_error(name +
                                 ": --state has all settings already; change them in the window or the file");
    const std::string scene = options.state.scene;
    const bool other = options.scene_given;
    options.state = load_state(request.state);
    if (other) options.state.scene = scene;
    options.scene_given = true;
  }
  check_scene_word("scene", options.state.scene);
  check_files(request, options);
  if (!request.state.empty()) return options;
  State& state = options.state;
  resolve_plan(request, state.a.plan);
  resolve_lambda(is_given(request, "--lambda"), is_given(request, "--split"), state.a.plan);
  check_page_size(state.a.pages);
  state.b = state.a;
  resolve_light(request, state.light);
  resolve_camera(request.camera, state);
  resolve_scene_words(request, options);
  resolve_playing(request, state.playing);
  return options;
}

/// What is opened, and what becomes of it.
std::vector<Option> run_options(Request& request) {
  Options& options = request.options;
  return {
      {.name = "scene",
       .target = &options.state.scene,
       .help = scene_help(),
       .names = builtin_scene_words(),
       .only_names = false,
       .completion = Completion::files,
       .given = &options.scene_given},
      {.name = "--state",
       .target = &request.state,
       .help = "open this state, a file that the window saved",
       .completion = Completion::files},
      {.name = "--out",
       .target = &request.out,
       .help = "draw the picture into this PNG file and open no window",
       .completion = Completion::files,
       .excludes = {"--exit-after", "--screenshot", "--tour", "--benchmark", "--results"}},
      size_option(options.width, options.height,
                  "size of the window, or of the picture of --out, in pixels, WIDTHxHEIGHT",
                  &request.size_given),
      context_option(options.context, " of --out"),
      {.name = "--exit-after",
       .target = &options.exit_after,
       .help = "close the window after this many frames with the scene; 0: stay open",
       .range = {{0, 1e9}}},
      {.name = "--screenshot",
       .target = &request.screenshot,
       .help = "write what the window shows last to this PNG file",
       .completion = Completion::files},
      {.name = "--tour",
       .target = &request.tour,
       .help =
           "go through all views and panels, write a picture of the window of each into this folder, and end",
       .completion = Completion::folders},
      {.name = "--benchmark",
       .target = &request.benchmark,
       .help = "fly along the path, write each frame's figures to this CSV file, and end",
       .completion = Completion::files},
      {.name = "--frames", .target = &options.frames, .help = "frames of --benchmark", .range = {{1, 1e6}}},
      {.name = "--results",
       .target = &options.results,
       .help = "show these results of gnomon compare, and where the present setting lies among them",
       .completion = Completion::folders},
      {.name = "--ui-scale",
       .target = &options.ui_scale,
       .help = "size of text and widgets; 0: as the display has it",
       .range = {{0.0, 8.0}}},
      {.name = "--panes",
       .target = &options.state.panes,
       .help = "let translucent surfaces tint the light, as docs/panes.md says; they rest"},
      max_triangles_option(options.max_triangles)};
}

/// Everything that --state has as well.
std::vector<Option> setting_options(Request& request) {
  State& state = request.options.state;
  std::vector<Option> options;
  for (const PlanField& field : plan_fields())
    if (is_spoken(field.key)) options.push_back(plan_option(field.key, state.a.plan));
  std::vector<std::string> views;
  for (const Named& one : view_names()) views.emplace_back(one.name);
  Settings& settings = state.a;
  const auto set_filter = [&settings](const std::string& word) {
    settings.identifiers = identifier_test(word, "--filter");
    if (!settings.identifiers) settings.filter = filter_word("--filter", word);
    return true;
  };
  const std::vector<Option> of_picture{
      {.name = "--options",
       .target = &request.plan_json,
       .help = "further options of the plan, as \"options\" of a case file has them, in JSON; options of "
               "the command line win over it",
       .word = "JSON"},
      {.name = "--filter",
       .target = ParsedWord{set_filter, render::to_string(settings.filter)},
       .help = "shadow filter, with options as in pcf:radius=2,unit=texels; gnomon filters lists all; or "
               "identifiers, as in identifiers:of=triangle,neighbours=1",
       .names = names_in(render::all_filters())},
      {.name = "--transition",
       .target = enum_word(settings.transition, transition_names()),
       .help = "transition between cascades, over --split-overlap",
       .names = transition_names()},
      layer_option(settings.layer),
      {.name = "--linear-depth",
       .target = &settings.linear_depth,
       .help = "store depths that grow evenly along the light; docs/bias.md says when they pay"},
      map_passes_option(settings.map_passes),
      {.name = "--history",
       .target = &settings.history,
       .help = "change texel density smoothly from frame to frame"},
      {.name = "--visible-depths",
       .target = &settings.visible_depths,
       .help = "draw each frame twice, and plan the second for the depths that the first shows"}};
  const std::vector<Option> of_pages = page_setting_options(settings.pages);
  const std::vector<Option> of_light = light_options(state.light.sun);
  const std::vector<Option> others{
      scene_light_option(request.light_of_file),
      point_option("--light-position", request.light_position,
                   "position of the spot or point light, world units"),
      point_option("--light-direction", request.light_direction, "direction of the spot light"),
      {.name = "--light-outer-deg",
       .target = &request.light_outer_deg,
       .help = "half angle of the spot light's cone, degrees",
       .range = {{0.0, 179.9}}},
      {.name = "--light-range",
       .target = &request.light_range,
       .help = "distance that the local light reaches, world units; 0: all of the scene",
       .range = {{0.0, 1e30}}},
      {.name = "--animation",
       .target = &state.playing.animation,
       .help = "animation that poses the scene, by name or number",
       .word = "NAME"},
      {.name = "--animation-time",
       .target = &state.playing.time_s,
       .help = "time within the animation, seconds; it repeats",
       .range = {{-1e9, 1e9}}},
      {.name = "--animate",
       .target = &state.playing.speed,
       .help = "play it, the first without --animation, at this speed; "
               "below 0: backwards",
       .range = {{-100.0, 100.0}}},
      {.name = "--view",
       .target = enum_word(state.view, views),
       .help = "what the picture shows: " + any_of_text(views),
       .names = views}};
  const std::vector<Option> of_camera = camera_options(request.camera), of_scene = edit_options(state.edits);
  for (const auto* part : {&of_scene, &of_pages, &of_picture, &of_light, &of_camera, &others})
    options.insert(options.end(), part->begin(), part->end());
  for (Option& option : options) {
    request.settings.emplace_back(option.name, std::make_unique<bool>(false));
    option.given = request.settings.back().second.get();
  }
  return options;
}

}  // namespace

int draw_to_file(const Options& options) {
  const auto context = render::create_context(options.context);
  Stage stage(load(options.state.scene, options.max_triangles, options.state.panes, options.state.edits));
  warn_of(stage.loaded().scene);
  const auto draw = [&] {
    const std::string refusal = stage.draw(options.state, options.width, options.height, true);
    if (!refusal.empty()) throw std::runtime_error(refusal);
  };
  draw();
  if (const auto progress = stage.truth_progress()) {
    Progress bar("gnomon view, rows of exact rays", (*progress)[1]);
    stage.finish_truth([&](int rows, int) { bar.set(rows); });
    bar.clear();
    draw();
  }
  if (const LightsDrawn& lights = stage.side(0).lights_drawn; lights.drawn < lights.of_file)
    warn("--scene-light all: " + to_string(lights));
  const Image image = stage.canvas().image();
  render::check_context();
  if (options.out.has_parent_path()) make_folder("--out", options.out.parent_path());
  write_png(image, options.out);
  return 0;
}

}  // namespace gnomon::tool::view

namespace gnomon::tool {

std::function<int()> declare_view(Arguments& arguments) {
  const auto request = std::make_shared<view::Request>();
  request->options.max_triangles = LoadLimits{}.triangles;
  for (const auto& part : {view::run_options, view::setting_options}) {
    for (Option& option : part(*request)) arguments.options.push_back(std::move(option));
  }
  arguments.footer = "Keys are listed in the window: press F1 or H. docs/viewer.md shows each view.\n";
  return [request] {
    const view::Options options = view::resolved(*request);
    try {
      const int code = options.out.empty() ? view::open_window(options) : view::draw_to_file(options);
      flush_output();
      return code;
    } catch (const SceneError& error) {
      throw std::runtime_error(error.what());
    }
  };
}

}  // namespace gnomon::tool
