// What the window keeps from frame to frame: what is set, what is drawn of it, and what is shown around that.
#pragma once

#include <array>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmark.hpp"
#include "gauge.hpp"
#include "options.hpp"
#include "probe.hpp"
#include "session.hpp"
#include "stage.hpp"
#include "sweep_results.hpp"

struct GLFWwindow;

namespace gnomon::tool::view {

/// A tab of the panel.
enum class Tab : std::uint8_t { view, light, maps, filter, compare, curves, file };
inline constexpr int kTabCount = 7;

/// The last values of one figure.
struct Curve {
  static constexpr int kLength = 240;
  std::array<float, kLength> value{};
  int next = 0, count = 0;
  void add(double v) noexcept {
    value[static_cast<std::size_t>(next)] = static_cast<float>(v);
    next = (next + 1) % kLength;
    count = std::min(count + 1, kLength);
  }
  [[nodiscard]] float last() const noexcept {
    return count == 0 ? 0.0f : value[static_cast<std::size_t>((next + kLength - 1) % kLength)];
  }
};
/// Figures of side A over the frames that were drawn.
struct Curves {
  Curve plan, maps, prefilter, lookup, m_p95, texels, pages, flips;
};

/// A measured setting in the chart of results.
struct ChartPlace {
  double ratio = 0.0, wrong = 0.0;
};

/// A rectangle of the framebuffer, pixels from its upper left corner.
struct Area {
  int x = 0, y = 0, width = 1, height = 1;
};

/// A key that went down or up, as GLFW names it.
struct KeyEvent {
  int key = 0, modifiers = 0;
  bool down = false;
};

/// Earlier and later states, as text.
struct History {
  std::string now;  ///< the state as it last came to rest
  std::vector<std::string> undo, redo;
};

/// The camera's way while it is recorded as a path.
struct PathRecording {
  CameraPath path;
  double seconds = 0.0;  ///< since its last key
};

/// What is set. Panel, keys and files write it.
struct Document {
  State state;
  History history = {};
  std::optional<PathRecording> recording = {};
  int side = 0;  ///< that panel and keys edit, where two are compared
  std::string file = "gnomon_view.json";

  /// The settings of that side.
  [[nodiscard]] Settings& edited() noexcept {
    return side == 1 && state.comparison != Comparison::off ? state.b : state.a;
  }
};

/// A scene on its way.
struct Loading {
  std::future<std::shared_ptr<const Loaded>> scene;  ///< valid while one is
  std::string name;
  double since = 0.0;      ///< of ImGui's seconds
  bool announced = false;  ///< it is read, and the window says that the renderer is made ready for it
};

/// Pictures that go into files.
struct Saving {
  bool every = false;  ///< all that are drawn
  int count = 0;       ///< of them, so far
  bool next = false;   ///< one, once it shows the present state
};

/// What is drawn of it. The loop of frames writes it.
struct Drawing {
  std::unique_ptr<Stage> stage;  ///< nullptr until the first scene is there
  Loading loading;
  Area area;               ///< where the picture lies in the framebuffer
  std::string refusal;     ///< why the present state is not the one that is shown; empty: it is
  bool compiling = false;  ///< a filter is compiled after this frame
  double frame_ms = 0.0;
  Curves curves;
  Gauge gauge;                         ///< of the state that is shown
  std::vector<ChartPlace> been;        ///< where settings before were
  std::optional<Benchmark> benchmark;  ///< while one runs
  Saving saving;
  std::string renderer;  ///< GL_RENDERER
};

/// What went wrong, or what was written where.
struct Message {
  std::string text;
  bool is_error = false;
  double until = 0.0;  ///< of ImGui's seconds
};

/// Keys, by their events.
struct Keys {
  std::vector<KeyEvent> events;  ///< that no frame has taken yet, in their order
  std::vector<int> down;         ///< by the events that were taken
};

/// What the mouse's button moves.
struct Mouse {
  bool looking = false, wiping = false, placing = false;
  [[nodiscard]] bool moves() const noexcept { return looking || wiping || placing; }
};

/// What is shown around the picture. Widgets, keys and mouse write it.
struct Display {
  int width = 1, height = 1;  ///< of the framebuffer, pixels
  double pixel_ratio = 1.0;   ///< framebuffer pixels in a window unit
  double scale = 1.0;         ///< of widgets, in window units
  Message message;
  bool panel = true, help = false, probing = true;
  bool shimmering = true;  ///< is counted while the tab of curves is visible
  Tab tab = Tab::view;
  bool select_tab = false;      ///< the panel shows `tab` in its next frame
  std::array<char, 64> find{};  ///< text that an option's name must hold
  double panel_ms = 0.0;
  Keys keys;
  Mouse mouse;
  std::optional<Probed> probed;
  std::optional<glm::dvec2> pointer;    ///< of the tour, framebuffer pixels
  std::optional<SweepResults> results;  ///< of `gnomon compare`, shown in the tab of curves
  std::string results_folder = "out/compare";
};

struct App {
  explicit App(const Options& from) : options(from), document{from.state} {}
  const Options& options;
  GLFWwindow* window = nullptr;
  Session session;
  Document document;
  Drawing drawing;
  Display display;
};

/// Tabs with every option; changes the document's state.
void draw_panel(App& app);
/// Its tab View: what is drawn, and from where.
void view_tab(App& app);
/// Its tab Light.
void light_tab(App& app);
/// Widgets that choose and play the scene's animation; none where it has none.
void playing_part(State& state, const Stage* stage);
/// Plays the animation, the first where none is chosen, or pauses it.
void toggle_playing(State& state, const Stage* stage);
/// Takes the animation further; true where it plays.
bool play_animation(State& state, const Stage* stage, double seconds);
/// Time and error of the last frames as curves, with the results below, or above where some are open.
void curves_part(App& app);
/// The results of `gnomon compare` as a chart with the present setting in it; a click loads a technique.
void results_part(App& app);
/// Reads results and shows their tab. Throws report::ReportError, in which case the last ones stay.
void open_results(Display& display, Drawing& drawing, const std::string& path);
/// True where the chart is visible, so that the present setting is to be measured.
[[nodiscard]] bool shows_results(const App& app);
/// Draws one of the gauge's frames; false where all are done.
bool gauge_frame(Drawing& drawing, const State& state);
/// The picture changed: the gauge starts again.
void restart_gauge(Drawing& drawing);
/// Begins a benchmark into `file`, or into the first free name; ends one that runs, without a file.
void toggle_benchmark(App& app, const std::filesystem::path& file = {});
/// Puts the benchmark's next frame into the state; false where none runs.
bool place_benchmark(App& app);
/// Takes the figures of the frame that was drawn; after the last one writes the file.
void take_benchmark(App& app);
/// The status line, the help page, the probe's text and the light's handle.
void draw_overlay(App& app);
/// Width of the panel in window units; 0 where it is hidden.
[[nodiscard]] double panel_width(const Display& display);

/// Keys and the mouse over the picture.
void handle_input(App& app, double seconds);
/// Where the local light is visible in the picture, and where its axis points, pixels; none for the sun and
/// for a light behind the eye.
[[nodiscard]] std::optional<ScreenLine> light_handle(const State& state, const Stage* stage);
/// Every key with what it does, for the help page.
struct KeyHelp {
  const char *key, *what;
};
[[nodiscard]] std::span<const KeyHelp> key_help() noexcept;

/// Begins to load a scene, and keeps the present one until it is there.
void open_scene(App& app, const std::string& scene);
/// Opens a file by its ending: a state (.json) or a scene.
void open_file(App& app, const std::string& file);
/// Writes the state into the document's file.
void save_state(const Document& document, Display& display);
/// Writes the picture without the panel beside the program's working folder's other pictures.
void save_picture(const Drawing& drawing, Display& display);
/// Begins to record the camera's way; where that is going on, ends it, writes the path's file, and from then
/// on the state flies along it.
void toggle_path_recording(Document& document, const Stage* stage, Display& display);
/// The next frame of such a recording, `seconds` after the last: a key every half second in which the camera
/// moved.
void record_path(Document& document, const Stage* stage, double seconds);
/// `state`, with the eye named where the command could not name it otherwise.
[[nodiscard]] State spoken_state(State state, const Stage* stage);
void show_message(Display& display, const std::string& text, bool error);
void undo(App& app, bool forward);
/// The camera of the state, which from now on is the user's own.
[[nodiscard]] CameraKey& own_eye(State& state, const Stage& stage);
/// Freezes the plan's camera where it is, or lets it follow the eye again.
void toggle_freeze(State& state, const Stage* stage);
/// Goes on to another state, from the next frame on without what plans remember.
void set_state(App& app, const State& state);

/// One stop of the tour.
struct TourStop {
  const char* name;  ///< of the picture's file
  void (*set)(App& app);
  int moving_frames = 0;       ///< under a turning sun, before the picture is taken
  bool needs_results = false;  ///< of `gnomon compare`; skipped without them
};
[[nodiscard]] std::span<const TourStop> tour_stops() noexcept;

}  // namespace gnomon::tool::view
