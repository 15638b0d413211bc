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
#include <utility>

#include "app.hpp"
#include "command.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "gnomon/render/context.hpp"
#include "gnomon/render/window.hpp"
#include "gnomon/scene/image.hpp"
#include "gnomon/scene/load.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "scene_words.hpp"

namespace gnomon::tool::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxUndo = 200;

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
        ->display.keys.events.push_back({key, modifiers, action == GLFW_PRESS});
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
  std::future<std::shared_ptr<const Loaded>>& scene = app.drawing.loading.scene;
  if (!scene.valid() || scene.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  // What follows takes seconds in which no frame is drawn: this one says what for.
  if (!std::exchange(app.drawing.loading.announced, true)) return;
  State& state = app.document.state;
  std::unique_ptr<Stage>& shown = app.drawing.stage;
  try {
    const std::shared_ptr<const Loaded> loaded = scene.get();
    // The new stage first: where it fails, the old one is still there.
    auto stage = std::make_unique<Stage>(loaded);
    const bool other = shown != nullptr && shown->loaded().name != loaded->name;
    shown = std::move(stage);
    if (other && state.scene != loaded->name) {
      state.eye.reset();
      state.frozen.reset();
      state.path.clear();
      state.playing = {};
      state.light.spot.reset();
      state.light.point.reset();
    }
    state.scene = loaded->name;
    add_recent(app.session, loaded->name);
    for (const std::string& warning : loaded->scene.warnings) show_message(app.display, warning, false);
  } catch (const std::exception& error) {
    if (shown != nullptr) state.scene = shown->loaded().name;
    show_message(app.display, error.what(), true);
  }
}

/// Moves what moves by itself; true where anything does.
bool play(State& state, const Stage* stage, double seconds) {
  if (state.motion.camera)
    state.path_time = std::fmod(state.path_time + seconds / state.motion.path_seconds, 1.0);
  if (state.motion.sun && state.light.sun.kind == LightKind::sun) turn_sun(state, seconds);
  const bool animated = play_animation(state, stage, seconds);
  return state.motion.camera || state.motion.sun || animated;
}

void add_curves(Curves& curves, const Side& side) {
  std::uint64_t drawn = 0;
  for (int i = 0; i < side.stats.map_count; ++i) {
    const render::MapStats& map = side.stats.map[static_cast<std::size_t>(i)];
    drawn += map.held ? 0 : map.texels;
  }
  curves.plan.add(side.plan_ms * 1e3);
  curves.maps.add(side.stats.ms(render::Pass::shadow_maps));
  curves.prefilter.add(side.stats.ms(render::Pass::prefilter));
  curves.lookup.add(side.stats.ms(render::Pass::mask));
  curves.m_p95.add(side.m.p95);
  curves.texels.add(static_cast<double>(drawn) / 1e6);
  curves.pages.add(side.stats.pages_drawn);
  if (side.flips) curves.flips.add(100.0 * *side.flips);
}

void keep_for_undo(History& history, const std::string& now) {
  if (history.now == now) return;
  if (!history.now.empty()) {
    history.undo.push_back(history.now);
    if (history.undo.size() > kMaxUndo) history.undo.erase(history.undo.begin());
    history.redo.clear();
  }
  history.now = now;
}

/// Where the picture lies beside the panel and above the status line.
Area picture_area(const Display& display) {
  const int left = static_cast<int>(std::lround(panel_width(display) * display.pixel_ratio));
  const int status =
      static_cast<int>(std::lround(static_cast<double>(ImGui::GetFrameHeight()) * display.pixel_ratio));
  return {left, 0, std::max(display.width - left, 16), std::max(display.height - status, 16)};
}

void record(Drawing& drawing, Display& display) {
  const std::filesystem::path file =
      std::filesystem::path("gnomon_record") / fmt::format("{:05}.png", drawing.saving.count++);
  try {
    make_folder("record", file.parent_path());
    write_png(drawing.stage->canvas().image(), file);
  } catch (const std::exception& error) {
    drawing.saving.every = false;
    show_message(display, error.what(), true);
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
  Loop(App& app, Widgets& widgets)
      : app_(app), document_(app.document), drawing_(app.drawing), display_(app.display), widgets_(widgets) {}

  /// One frame. Returns how long nothing needs the next one, seconds; kRestSeconds: until the user does
  /// something.
  double frame() {
    const auto begin = Clock::now();
    const double seconds = std::min(std::chrono::duration<double>(begin - before_).count(), 0.25);
    before_ = begin;
    take_loaded(app_);
    begin_widgets();
    handle_input(app_, seconds);
    drawing_.area = picture_area(display_);  // a key may have hidden the panel
    const bool moving = place_benchmark(app_) || play(document_.state, drawing_.stage.get(), seconds);
    record_path(document_, drawing_.stage.get(), seconds);
    const auto panel_begin = Clock::now();
    draw_panel(app_);
    draw_overlay(app_);
    ImGui::Render();
    double panel_ms = ms_since(panel_begin);
    const bool drew = draw_picture(moving);
    if (drawing_.benchmark && drew && !drawing_.compiling) take_benchmark(app_);
    const bool finished = drawing_.stage == nullptr || !drawing_.stage->unfinished();
    if (drawing_.saving.next && !drawing_.compiling && finished) {
      drawing_.saving.next = false;
      save_picture(drawing_, display_);
    }
    clear_window(display_.width, display_.height);
    if (drawing_.stage != nullptr)
      drawing_.stage->canvas().show(drawing_.area.x, drawing_.area.y, display_.height);
    finish_gl();
    const auto widgets_begin = Clock::now();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    finish_gl();
    panel_ms += ms_since(widgets_begin);
    display_.panel_ms += (panel_ms - display_.panel_ms) * 0.1;
    if (const unsigned error = last_gl_error(); error != 0)
      show_message(display_, fmt::format("OpenGL error {}", error), true);
    if (drawing_.stage == nullptr || drawing_.loading.scene.valid()) return kRaysSeconds;
    if (drew || moving) return 0.0;
    // The rays first: they take the cores that a software driver would be timed on.
    const auto progress = drawing_.stage->truth_progress();
    if (progress && (*progress)[0] < (*progress)[1]) return kRaysSeconds;
    return shows_results(app_) && gauge_frame(drawing_, document_.state) ? 0.0 : kRestSeconds;
  }

  /// Whether the present scene has been drawn.
  [[nodiscard]] bool shows_scene() const noexcept {
    return drawing_.stage != nullptr && shown_.stage == drawing_.stage.get();
  }

 private:
  void begin_widgets() {
    display_.scale =
        widgets_.fit(app_.options.ui_scale > 0.0 ? app_.options.ui_scale : app_.session.ui_scale);
    glfwGetFramebufferSize(app_.window, &display_.width, &display_.height);
    int width = 0;
    glfwGetWindowSize(app_.window, &width, nullptr);
    display_.pixel_ratio = width > 0 ? 1.0 * display_.width / width : 1.0;
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    if (display_.pointer)
      ImGui::GetIO().MousePos = {static_cast<float>(display_.pointer->x / display_.pixel_ratio),
                                 static_cast<float>(display_.pointer->y / display_.pixel_ratio)};
    ImGui::NewFrame();
    drawing_.area = picture_area(display_);
  }

  /// The filter's program takes a while to compile: the status line says so for a frame before.
  bool wait_for_filter() {
    const State& state = document_.state;
    const bool both = state.comparison != Comparison::off;
    const bool unknown = !drawing_.stage->is_compiled(state.a, state.light.all) ||
                         (both && !drawing_.stage->is_compiled(state.b, state.light.all));
    const bool wait = unknown && !drawing_.compiling;
    drawing_.compiling = wait;
    return wait;
  }

  /// Exact rays that arrived are shown now and then, not row by row.
  [[nodiscard]] bool shows_rays(const std::optional<std::array<int, 2>>& progress) const {
    if (!progress) return false;
    if (!shown_.settled) return true;
    constexpr double kEveryMs = 300.0;
    const bool more =
        (*progress)[0] != shown_.truth_rows || (drawing_.stage->tracer() != nullptr) != shown_.has_tracer;
    return more && ((*progress)[0] == (*progress)[1] || ms_since(shown_.when) > kEveryMs);
  }

  bool draw_picture(bool moving) {
    if (drawing_.stage == nullptr) return false;
    drawing_.stage->poll();
    const std::string text = state_text(document_.state);
    const auto progress = drawing_.stage->truth_progress();
    const bool settled = text == shown_.state, has_tracer = drawing_.stage->tracer() != nullptr;
    const bool counts = shows_results(app_);
    drawing_.stage->count_errors(counts);
    const bool shows_curves = display_.panel && display_.tab == Tab::curves;
    drawing_.stage->count_flips(shows_curves && display_.shimmering && !drawing_.benchmark);
    const bool same = settled && counts == shown_.counts && drawing_.area.width == shown_.width &&
                      drawing_.area.height == shown_.height && drawing_.stage.get() == shown_.stage;
    if (same && !moving) drawing_.stage->want_tracer();
    // A page policy that reads the picture takes more rounds once nothing moves.
    const bool unfinished = same && !shown_.settled && drawing_.stage->unfinished();
    if (same && !moving && !shows_rays(progress) && !unfinished) {
      if (!display_.mouse.moves()) keep_for_undo(document_.history, text);
      return false;
    }
    if (wait_for_filter()) return true;
    if (!same) restart_gauge(drawing_);
    const auto begin = Clock::now();
    drawing_.refusal =
        drawing_.stage->draw(document_.state, drawing_.area.width, drawing_.area.height, settled);
    drawing_.frame_ms = ms_since(begin);
    shown_ = {text,
              drawing_.area.width,
              drawing_.area.height,
              progress ? (*progress)[0] : -1,
              drawing_.stage.get(),
              settled,
              has_tracer,
              counts,
              Clock::now()};
    if (drawing_.refusal.empty() && !(same && progress)) add_curves(drawing_.curves, drawing_.stage->side(0));
    if (drawing_.saving.every) record(drawing_, display_);
    show_title();
    return true;
  }

  /// The scene's name, from its first picture on.
  void show_title() {
    const std::string& name = drawing_.stage->loaded().name;
    if (title_ == name) return;
    title_ = name;
    glfwSetWindowTitle(app_.window, ("gnomon view: " + name).c_str());
  }

  App& app_;
  Document& document_;
  Drawing& drawing_;
  Display& display_;
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
bool compile_one_ahead(Stage& stage, const State& state) {
  const bool pages = state.a.pages.on();
  return stage.compile_ahead(pages) || stage.compile_ahead(!pages);
}

void run_loop(App& app, Loop& loop) {
  int frames = 0;
  bool ahead = true, flown = false;
  while (glfwWindowShouldClose(app.window) == GLFW_FALSE) {
    const double rest = loop.frame();
    const bool last = app.options.exit_after > 0 && loop.shows_scene() && ++frames >= app.options.exit_after;
    if (last && !app.options.screenshot.empty())
      write_png(window_image(app.display.width, app.display.height), app.options.screenshot);
    glfwSwapBuffers(app.window);
    const bool no_scene =
        app.drawing.stage == nullptr && !app.drawing.loading.scene.valid() && app.display.message.is_error;
    if (last || (no_scene && is_driven(app.options))) break;
    if (!app.options.benchmark.empty() && app.drawing.stage != nullptr) {
      if (flown && !app.drawing.benchmark) break;
      if (!flown) toggle_benchmark(app, app.options.benchmark);
      flown = true;
    }
    const bool idle = rest == kRestSeconds;
    if (idle && ahead && !is_driven(app.options))
      ahead = compile_one_ahead(*app.drawing.stage, app.document.state);
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
                kMaxFrames = 20'000;  // still frames in a row: ImGui places a window in its second
  const auto settle = [&] {
    int still = 0;
    for (int i = 0; i < kMaxFrames && still < kStill && glfwWindowShouldClose(app.window) == GLFW_FALSE;
         ++i) {
      const double rest = loop.frame();
      still = rest == kRestSeconds && app.drawing.stage->tracer() != nullptr ? still + 1 : 0;
      if (still < kStill) glfwSwapBuffers(app.window);
      glfwWaitEventsTimeout(std::max(still > 0 ? 0.0 : rest, 1e-3));
      if (app.display.message.is_error) throw std::runtime_error("tour: " + app.display.message.text);
    }
  };
  app.display.pointer = glm::dvec2(-1.0);
  settle();
  std::size_t pictures = 0;
  Progress progress("gnomon view --tour", static_cast<long long>(tour_stops().size()));
  for (const TourStop& stop : tour_stops()) {
    progress.set(static_cast<long long>(pictures));
    if (stop.needs_results && !app.display.results) continue;
    stop.set(app);
    settle();
    if (stop.moving_frames > 0) {
      app.document.state.motion.sun = true;
      for (int i = 0; i < stop.moving_frames; ++i) {
        (void)loop.frame();
        glfwSwapBuffers(app.window);
      }
      app.document.state.motion.sun = false;
      settle();
    }
    if (glfwWindowShouldClose(app.window) != GLFW_FALSE) return;
    write_png(window_image(app.display.width, app.display.height),
              app.options.tour / (std::string(stop.name) + ".png"));
    glfwSwapBuffers(app.window);
    ++pictures;
  }
  progress.clear();
  fmt::print("{} pictures in {}\n", pictures, app.options.tour.string());
}

void close_session(const App& app) {
  if (is_driven(app.options)) return;
  for (const std::string& why : {save_session(app.session, session_file()),
                                 save_text(state_text(app.document.state), last_state_file())})
    if (!why.empty()) warn("the session is not kept: " + why);
}

}  // namespace

int open_window(const Options& options) {
  if (!options.tour.empty()) check_folder("--tour", options.tour);
  const auto window = [&options] {
    try {
      return render::create_window(options.width, options.height, "gnomon view");
    } catch (const render::RenderError& error) {
      throw std::runtime_error(std::string("view: ") + error.what() + "; --out FILE.png needs no display");
    }
  }();
  App app(options);
  app.window = window->handle();
  app.drawing.renderer = window->info().renderer;
  app.display.panel = options.benchmark.empty();  // the picture alone
  app.session = load_session(session_file());
  glfwSetWindowUserPointer(app.window, &app);
  glfwSetDropCallback(app.window, on_drop);
  glfwSetWindowSizeLimits(app.window, 64, 64, GLFW_DONT_CARE, GLFW_DONT_CARE);
  Widgets widgets(app.window);
  open_scene(app, options.state.scene);
  if (!options.results.empty()) open_results(app.display, app.drawing, options.results);
  Loop loop(app, widgets);
  if (options.tour.empty()) {
    run_loop(app, loop);
  } else {
    run_tour(app, loop);
  }
  if (app.drawing.loading.scene.valid()) app.drawing.loading.scene.wait();
  const bool flown = !options.benchmark.empty();
  const bool failed = app.display.message.is_error && (app.drawing.stage == nullptr || flown);
  app.drawing.stage.reset();  // while its context is current
  close_session(app);
  if (failed && is_driven(options)) throw std::runtime_error(app.display.message.text);
  if (flown && glfwWindowShouldClose(app.window) == GLFW_FALSE) fmt::print("{}\n", app.display.message.text);
  return 0;
}

}  // namespace gnomon::tool::view
