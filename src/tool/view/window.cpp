// The viewer's window: one loop that loads, draws and shows; nothing of the user's work is lost by an error.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/core.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "app.hpp"
#include "command.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/window.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "output.hpp"
#include "scene_words.hpp"

namespace gnomon::tool::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostUndo = 200;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

void on_drop(GLFWwindow* window, int count, const char** files) {
  App& app = *static_cast<App*>(glfwGetWindowUserPointer(window));
  if (count > 0) open_file(app, files[0]);
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  if (action != GLFW_REPEAT)
    static_cast<App*>(glfwGetWindowUserPointer(window))
        ->key_events.push_back({key, modifiers, action == GLFW_PRESS});
  ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, modifiers);
}

/// ImGui for as long as the window lives.
class Widgets {
 public:
  explicit Widgets(GLFWwindow* window) : window_(window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the panel has one place
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    glfwSetKeyCallback(window, on_key);
    ImGui_ImplOpenGL3_Init("#version 450");
  }
  ~Widgets() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  Widgets(const Widgets&) = delete;
  Widgets& operator=(const Widgets&) = delete;

  /// Text as large as the display wants it; `asked`: 0, or what the user wants. Returns the scale in window
  /// units.
  double fit(double asked) {
    float display = 1.0f;
    glfwGetWindowContentScale(window_, &display, nullptr);
    int width = 0, pixels = 0;
    glfwGetWindowSize(window_, &width, nullptr);
    glfwGetFramebufferSize(window_, &pixels, nullptr);
    // Where window units are larger than pixels, text made for units is scaled by the system already.
    const double ratio = width > 0 && pixels > 0 ? 1.0 * pixels / width : 1.0;
    const double pixel_scale = asked > 0.0 ? asked * ratio : std::max(static_cast<double>(display), ratio);
    if (pixel_scale == pixel_scale_ && ratio == ratio_) return pixel_scale / ratio;
    pixel_scale_ = pixel_scale;
    ratio_ = ratio;
    constexpr double kTextPixels = 13.0;
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    ImFontConfig font;
    font.SizePixels = static_cast<float>(std::round(kTextPixels * pixel_scale));
    io.Fonts->AddFontDefault(&font);
    io.FontGlobalScale = static_cast<float>(1.0 / ratio);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = style.FrameRounding = 2.0f;
    style.ScaleAllSizes(static_cast<float>(pixel_scale / ratio));
    ImGui::GetStyle() = style;
    return pixel_scale / ratio;
  }

 private:
  GLFWwindow* window_;
  double pixel_scale_ = 0.0, ratio_ = 0.0;
};

void take_loaded(App& app) {
  if (!app.loading.valid() || app.loading.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  try {
    const std::shared_ptr<const Loaded> loaded = app.loading.get();
    // The new stage first: where it fails, the old one is still there.
    auto stage = std::make_unique<Stage>(loaded);
    const bool other = app.stage != nullptr && app.stage->loaded().name != loaded->name;
    app.stage = std::move(stage);
    if (other && app.state.scene != loaded->name) {
      app.state.eye.reset();
      app.state.frozen.reset();
      app.state.path.clear();
      app.state.playing = {};
      app.state.light.spot.reset();
      app.state.light.point.reset();
    }
    app.state.scene = loaded->name;
    remember_scene(app.session, loaded->name);
    for (const std::string& warning : loaded->scene.warnings) show_message(app, warning, false);
  } catch (const std::exception& error) {
    if (app.stage != nullptr) app.state.scene = app.stage->loaded().name;
    show_message(app, error.what(), true);
  }
}

/// Moves what moves by itself; true where anything does.
bool play(App& app, double seconds) {
  State& state = app.state;
  if (state.motion.camera)
    state.path_time = std::fmod(state.path_time + seconds / state.motion.path_seconds, 1.0);
  if (state.motion.sun && state.light.sun.kind == LightKind::sun) turn_sun(state, seconds);
  const bool animated = play_animation(app, seconds);
  return state.motion.camera || state.motion.sun || animated;
}

void add_curves(App& app) {
  const Side& side = app.stage->side(0);
  std::uint64_t drawn = 0;
  for (int i = 0; i < side.stats.map_count; ++i) {
    const render::MapStats& map = side.stats.map[static_cast<std::size_t>(i)];
    drawn += map.held ? 0 : map.texels;
  }
  app.curves.plan.add(side.plan_ms * 1e3);
  app.curves.maps.add(side.stats.ms(render::Pass::shadow_maps));
  app.curves.prefilter.add(side.stats.ms(render::Pass::prefilter));
  app.curves.lookup.add(side.stats.ms(render::Pass::mask));
  app.curves.m_p95.add(side.m.p95);
  app.curves.texels.add(static_cast<double>(drawn) / 1e6);
  app.curves.pages.add(side.stats.pages_drawn);
  if (side.flips) app.curves.flips.add(100.0 * *side.flips);
}

void keep_for_undo(App& app, const std::string& now) {
  if (app.undo_now == now) return;
  if (!app.undo_now.empty()) {
    app.undo.push_back(app.undo_now);
    if (app.undo.size() > kMostUndo) app.undo.erase(app.undo.begin());
    app.redo.clear();
  }
  app.undo_now = now;
}

/// Where the picture lies beside the panel and above the status line.
Area picture_area(const App& app) {
  const int left = static_cast<int>(std::lround(panel_width(app) * app.pixel_ratio));
  const int status =
      static_cast<int>(std::lround(static_cast<double>(ImGui::GetFrameHeight()) * app.pixel_ratio));
  return {left, 0, std::max(app.window_width - left, 16), std::max(app.window_height - status, 16)};
}

void record(App& app) {
  const std::filesystem::path file =
      std::filesystem::path("gnomon_record") / fmt::format("{:05}.png", app.recorded++);
  try {
    make_folder("record", file.parent_path());
    write_png(app.stage->canvas().image(), file);
  } catch (const std::exception& error) {
    app.recording = false;
    show_message(app, error.what(), true);
  }
}

/// What decides whether the picture is drawn again.
struct Shown {
  std::string state;
  int width = 0, height = 0, truth_rows = -1;
  const Stage* stage = nullptr;
  bool settled = false, has_tracer = false, counts = false;
  Clock::time_point when;
};

/// How long the loop may sleep, seconds; 0: there is more to do at once.
constexpr double kRestSeconds = 0.1, kRaysSeconds = 0.02;

class Loop {
 public:
  Loop(App& app, Widgets& widgets) : app_(app), widgets_(widgets) {}

  /// One frame. Returns how long nothing needs the next one, seconds; kRestSeconds: until the user does
  /// something.
  double frame() {
    const auto begin = Clock::now();
    const double seconds = std::min(std::chrono::duration<double>(begin - before_).count(), 0.25);
    before_ = begin;
    take_loaded(app_);
    begin_widgets();
    handle_input(app_, seconds);
    app_.picture = picture_area(app_);  // a key may have hidden the panel
    const bool moving = place_benchmark(app_) || play(app_, seconds);
    record_path(app_, seconds);
    const auto panel_begin = Clock::now();
    draw_panel(app_);
    draw_overlay(app_);
    ImGui::Render();
    double panel_ms = ms_since(panel_begin);
    const bool drew = draw_picture(moving);
    if (app_.benchmark && drew && !app_.compiling) take_benchmark(app_);
    if (app_.wants_picture && !app_.compiling && (app_.stage == nullptr || !app_.stage->unfinished())) {
      app_.wants_picture = false;
      save_picture(app_);
    }
    clear_window(app_.window_width, app_.window_height);
    if (app_.stage != nullptr) app_.stage->canvas().show(app_.picture.x, app_.picture.y, app_.window_height);
    finish_gl();
    const auto widgets_begin = Clock::now();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    finish_gl();
    panel_ms += ms_since(widgets_begin);
    app_.panel_ms += (panel_ms - app_.panel_ms) * 0.1;
    if (const unsigned error = last_gl_error(); error != 0)
      show_message(app_, fmt::format("OpenGL error {}", error), true);
    if (app_.stage == nullptr || app_.loading.valid()) return kRaysSeconds;
    if (drew || moving) return 0.0;
    // The rays first: they take the cores that a software driver would be timed on.
    const auto progress = app_.stage->truth_progress();
    if (progress && (*progress)[0] < (*progress)[1]) return kRaysSeconds;
    return shows_results(app_) && gauge_frame(app_) ? 0.0 : kRestSeconds;
  }

 private:
  void begin_widgets() {
    app_.scale = widgets_.fit(app_.options.ui_scale > 0.0 ? app_.options.ui_scale : app_.session.ui_scale);
    glfwGetFramebufferSize(app_.window, &app_.window_width, &app_.window_height);
    int width = 0;
    glfwGetWindowSize(app_.window, &width, nullptr);
    app_.pixel_ratio = width > 0 ? 1.0 * app_.window_width / width : 1.0;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    if (app_.pointer)
      ImGui::GetIO().MousePos = {static_cast<float>(app_.pointer->x / app_.pixel_ratio),
                                 static_cast<float>(app_.pointer->y / app_.pixel_ratio)};
    ImGui::NewFrame();
    app_.picture = picture_area(app_);
  }

  /// The filter's program takes a while to compile: the status line says so for a frame before.
  bool wait_for_filter() {
    const bool both = app_.state.comparison != Comparison::off;
    const bool unknown =
        !app_.stage->is_compiled(app_.state.a) || (both && !app_.stage->is_compiled(app_.state.b));
    const bool wait = unknown && !app_.compiling;
    app_.compiling = wait;
    return wait;
  }

  /// Exact rays that arrived are shown now and then, not row by row.
  [[nodiscard]] bool shows_rays(const std::optional<std::array<int, 2>>& progress) const {
    if (!progress) return false;
    if (!shown_.settled) return true;
    constexpr double kEveryMs = 300.0;
    const bool more =
        (*progress)[0] != shown_.truth_rows || (app_.stage->tracer() != nullptr) != shown_.has_tracer;
    return more && ((*progress)[0] == (*progress)[1] || ms_since(shown_.when) > kEveryMs);
  }

  bool draw_picture(bool moving) {
    if (app_.stage == nullptr) return false;
    app_.stage->poll();
    const std::string text = state_text(app_.state);
    const auto progress = app_.stage->truth_progress();
    const bool settled = text == shown_.state, has_tracer = app_.stage->tracer() != nullptr;
    const bool counts = shows_results(app_);
    app_.stage->count_errors(counts);
    app_.stage->count_flips(app_.panel && app_.tab == Tab::curves && app_.shimmering && !app_.benchmark);
    const bool same = settled && counts == shown_.counts && app_.picture.width == shown_.width &&
                      app_.picture.height == shown_.height && app_.stage.get() == shown_.stage;
    if (same && !moving) app_.stage->want_tracer();
    // A page policy that reads the picture takes more rounds once nothing moves.
    const bool unfinished = same && !shown_.settled && app_.stage->unfinished();
    if (same && !moving && !shows_rays(progress) && !unfinished) {
      if (!app_.looking && !app_.wiping && !app_.placing) keep_for_undo(app_, text);
      return false;
    }
    if (wait_for_filter()) return true;
    if (!same) restart_gauge(app_);
    const auto begin = Clock::now();
    app_.refusal = app_.stage->draw(app_.state, app_.picture.width, app_.picture.height, settled);
    app_.frame_ms = ms_since(begin);
    shown_ = {text,
              app_.picture.width,
              app_.picture.height,
              progress ? (*progress)[0] : -1,
              app_.stage.get(),
              settled,
              has_tracer,
              counts,
              Clock::now()};
    if (app_.refusal.empty() && !(same && progress)) add_curves(app_);
    if (app_.recording) record(app_);
    show_title();
    return true;
  }

  /// The scene's name, from its first picture on.
  void show_title() {
    const std::string& name = app_.stage->loaded().name;
    if (title_ == name) return;
    title_ = name;
    glfwSetWindowTitle(app_.window, ("gnomon view: " + name).c_str());
  }

  App& app_;
  Widgets& widgets_;
  Shown shown_;
  std::string title_;  ///< the scene in the window's title
  Clock::time_point before_ = Clock::now();
};

/// No person is at this window.
bool is_driven(const Options& options) {
  return options.exit_after > 0 || !options.tour.empty() || !options.benchmark.empty();
}

/// Filters that nobody has used yet are compiled while nobody waits: those of maps or of pages, whichever the
/// state draws, then the others. False where all are compiled.
bool compile_one_ahead(App& app) {
  const bool pages = app.state.a.pages.on();
  return app.stage->compile_ahead(pages) || app.stage->compile_ahead(!pages);
}

void run_loop(App& app, Loop& loop) {
  int frames = 0;
  bool ahead = true, flown = false;
  while (glfwWindowShouldClose(app.window) == GLFW_FALSE) {
    const double rest = loop.frame();
    const bool last =
        app.options.exit_after > 0 && app.stage != nullptr && ++frames >= app.options.exit_after;
    if (last && !app.options.screenshot.empty())
      write_png(window_image(app.window_width, app.window_height), app.options.screenshot);
    glfwSwapBuffers(app.window);
    const bool no_scene = app.stage == nullptr && !app.loading.valid() && app.message_is_error;
    if (last || (no_scene && is_driven(app.options))) break;
    if (!app.options.benchmark.empty() && app.stage != nullptr) {
      if (flown && !app.benchmark) break;
      if (!flown) toggle_benchmark(app, app.options.benchmark);
      flown = true;
    }
    const bool idle = rest == kRestSeconds;
    if (idle && ahead && !is_driven(app.options)) ahead = compile_one_ahead(app);
    if (rest > 0.0 && !(idle && ahead)) {
      glfwWaitEventsTimeout(rest);
    } else {
      glfwPollEvents();
    }
  }
}

/// Shows each stop until nothing changes any more, and writes what the window shows.
void run_tour(App& app, Loop& loop) {
  make_folder("--tour", app.options.tour);
  constexpr int kStill = 4,
                kMostFrames = 20'000;  // still frames in a row: ImGui places a window in its second
  const auto settle = [&] {
    int still = 0;
    for (int i = 0; i < kMostFrames && still < kStill && glfwWindowShouldClose(app.window) == GLFW_FALSE;
         ++i) {
      const double rest = loop.frame();
      still = rest == kRestSeconds && app.stage->tracer() != nullptr ? still + 1 : 0;
      if (still < kStill) glfwSwapBuffers(app.window);
      glfwWaitEventsTimeout(std::max(still > 0 ? 0.0 : rest, 1e-3));
      if (app.message_is_error) throw std::runtime_error("tour: " + app.message);
    }
  };
  app.pointer = glm::dvec2(-1.0);
  settle();
  std::size_t pictures = 0;
  for (const TourStop& stop : tour_stops()) {
    if (stop.needs_results && !app.results) continue;
    stop.set(app);
    settle();
    if (stop.moving_frames > 0) {
      app.state.motion.sun = true;
      for (int i = 0; i < stop.moving_frames; ++i) {
        (void)loop.frame();
        glfwSwapBuffers(app.window);
      }
      app.state.motion.sun = false;
      settle();
    }
    if (glfwWindowShouldClose(app.window) != GLFW_FALSE) return;
    write_png(window_image(app.window_width, app.window_height),
              app.options.tour / (std::string(stop.name) + ".png"));
    glfwSwapBuffers(app.window);
    ++pictures;
  }
  fmt::print("{} pictures in {}\n", pictures, app.options.tour.string());
}

void close_session(const App& app) {
  if (is_driven(app.options)) return;
  for (const std::string& why :
       {save_session(app.session, session_file()), save_text(state_text(app.state), last_state_file())})
    if (!why.empty()) warn("the session is not kept: " + why);
}

}  // namespace

int open_window(const Options& options) {
  if (!options.tour.empty()) check_folder("--tour", options.tour);
  if (!options.benchmark.empty())
    check_folder("--benchmark", options.benchmark.has_parent_path() ? options.benchmark.parent_path() : ".");
  const auto window = [&options] {
    try {
      return render::create_window(options.width, options.height, "gnomon view");
    } catch (const render::RenderError& error) {
      throw std::runtime_error(std::string("view: ") + error.what() + "; --out FILE.png needs no display");
    }
  }();
  App app(options);
  app.window = window->handle();
  app.renderer = window->info().renderer;
  app.panel = options.benchmark.empty();  // the picture alone
  app.session = load_session(session_file());
  glfwSetWindowUserPointer(app.window, &app);
  glfwSetDropCallback(app.window, on_drop);
  glfwSetWindowSizeLimits(app.window, 64, 64, GLFW_DONT_CARE, GLFW_DONT_CARE);
  Widgets widgets(app.window);
  open_scene(app, options.state.scene);
  if (!options.results.empty()) open_results(app, options.results);
  Loop loop(app, widgets);
  if (options.tour.empty()) {
    run_loop(app, loop);
  } else {
    run_tour(app, loop);
  }
  if (app.loading.valid()) app.loading.wait();
  const bool flown = !options.benchmark.empty();
  const bool failed = app.message_is_error && (app.stage == nullptr || flown);
  app.stage.reset();  // while its context is current
  close_session(app);
  if (failed && is_driven(options)) throw std::runtime_error(app.message);
  if (flown && glfwWindowShouldClose(app.window) == GLFW_FALSE) fmt::print("{}\n", app.message);
  return 0;
}

}  // namespace gnomon::tool::view
