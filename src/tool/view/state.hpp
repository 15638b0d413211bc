// Everything that decides what the viewer shows: plain data, without OpenGL and without a window.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/light.hpp"
#include "gnomon/plan.hpp"
#include "gnomon/render/filter.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/scene/camera_path.hpp"
#include "gnomon/scene/default_light.hpp"
#include "gnomon/scene/edit.hpp"
#include "gnomon/scene/scene.hpp"
#include "page_setting.hpp"

namespace gnomon::tool::view {

inline constexpr double kDegrees = 180.0 / std::numbers::pi;  ///< in a radian

/// What a pixel of the picture shows.
enum class View : std::uint8_t {
  lit,            ///< the shaded scene
  heat,           ///< the aliasing error m as colours
  mask,           ///< visibility as the filter returns it
  misclassified,  ///< false shadow and false light against exact rays
  cascades,       ///< the scene tinted by map
  checker,        ///< squares of kCheckerTexels texels on the surfaces
  map,            ///< the depth map itself, with what lies in it
  truth,          ///< the exact hard shadow
  kept,           ///< which maps or pages were kept from earlier frames, and which were drawn
};
inline constexpr int kViewCount = 9;
inline constexpr int kCheckerTexels = 8;

/// How two settings are compared.
enum class Comparison : std::uint8_t { off, wipe, difference };

/// A name on command lines and in files, and half a line for help.
struct Named {
  std::string_view name, help;
};
/// By View and by Comparison.
[[nodiscard]] std::span<const Named> view_names() noexcept;
[[nodiscard]] std::span<const Named> comparison_names() noexcept;

/// One side of a comparison: how shadows are planned and filtered.
struct Settings {
  PlanOptions plan;
  PageSetting pages;  ///< in place of maps; off by default
  render::FilterSettings filter = render::default_settings(render::filters::pcf);
  render::SplitTransition transition = render::SplitTransition::cut;
  std::optional<render::IdentifierTest> identifiers;     ///< in place of the filter; none: off
  render::DepthLayer layer = render::DepthLayer::front;  ///< that the maps store
  bool linear_depth = false;                             ///< the maps' depths grow evenly along the light
  render::MapPasses map_passes = render::MapPasses::automatic;
  bool history = false;         ///< texel density changes smoothly from frame to frame
  bool visible_depths = false;  ///< each frame is drawn twice, the second for the depths that the first shows
};

/// The light. Local lights lie where default_light() puts them until they are moved. A range of 0 covers the
/// scene, until the light is moved.
struct LightState {
  LightPlacement sun;  ///< its kind decides which of these is used
  std::optional<SpotLight> spot;
  std::optional<PointLight> point;
  bool all = false;  ///< in place of it all lights of the scene's file shine, each as the file has it
};

/// The lines that are drawn over the picture while the plan's camera is frozen.
struct Drawn {
  bool frustum = true;   ///< the frozen camera's frustum, with the splits
  bool bodies = true;    ///< the receivers' body of each map
  bool maps = false;     ///< the volume of each map
  bool culling = false;  ///< the part of the scene within the planes that each map's casters are culled by
  bool casters = false;  ///< the boxes of drawn and of culled casters
};

/// What moves by itself in a window.
struct Motion {
  bool camera = false, sun = false;
  double path_seconds = 30.0;            ///< of one flight along the scene's path
  double sun_degrees_per_second = 10.0;  ///< azimuth
  /// A sun that turns is held until a shadow edge could err by more screen pixels, so that maps and pages are
  /// kept meanwhile (hold_sun). 0: each frame has its own.
  double hold_sun_pixels = 0.0;
};

inline constexpr double kMaxHoldPixels = 64.0;

/// The animation that poses the scene.
struct Playing {
  std::string animation;  ///< name or number, as find_animation() takes it; empty: the scene is at rest
  double time_s = 0.0;    ///< it repeats
  bool on = false;        ///< time goes on, in a window
  double speed = 1.0;     ///< seconds of the animation in a second, -100..100
};

/// Half a second each: most of ten minutes.
inline constexpr std::size_t kMaxPathKeys = 1024;
/// Full vertical angles that a state may have, degrees.
inline constexpr double kLeastFovDeg = 1e-3, kMostFovDeg = 179.99;

struct State {
  std::string scene = "builtin:city";
  bool panes = false;            ///< translucent surfaces tint light in place of stopping it
  SceneEdits edits;              ///< of the scene, as it is loaded
  std::optional<CameraKey> eye;  ///< none: the path at `path_time`
  std::vector<CameraKey> path;   ///< recorded; empty: the scene's path
  double path_time = 0.5;        ///< 0..1
  double fov_y_deg = 0.0;        ///< 0: of the scene's path
  double height_world = 0.0;     ///< of an orthographic picture, from bottom to top; 0: perspective
  /// Where sight begins and ends, world units. 0: of the scene's path, or for an eye of its own as
  /// sight_from().
  double near_depth = 0.0, far_depth = 0.0;
  std::optional<CameraKey> frozen;  ///< the plan's camera, where it is not the eye
  Sight frozen_sight{0.0, 0.0};     ///< its depths; 0: of the path
  LightState light;
  Settings a, b;
  View view = View::lit;
  int map = 0;  ///< View::map: which one; with pages which level
  Comparison comparison = Comparison::off;
  bool b_is_truth = false;  ///< B is the exact hard shadow
  double wipe = 0.5;        ///< share of the picture's width that shows A
  double gain = 4.0;        ///< of the difference picture
  Drawn drawn;
  Motion motion;
  Playing playing;
};

/// The light of a state over a scene with these bounds.
[[nodiscard]] Light light_of(const LightState& light, const Box& scene) noexcept;
/// The state whose light this is, over any scene.
[[nodiscard]] LightState light_state(const Light& light) noexcept;
/// The same of a light of the scene's file. Throws std::runtime_error for a sun that shines from below.
[[nodiscard]] LightState light_state(const SceneLight& light);
/// The eye, its field of view or height, and its depths become those of the path's first key.
void take_camera(const CameraPath& path, State& state) noexcept;
/// Turns the sun by `seconds` of its motion; its azimuth stays in [-180, 180) degrees.
void turn_sun(State& state, double seconds) noexcept;
/// The path that the state flies along: the recorded one, or the scene's, with the state's field of view and
/// depths.
[[nodiscard]] CameraPath path_of(const State& state, const CameraPath& scenes);
/// The eye's camera in a scene of these boxes.
[[nodiscard]] Camera eye_camera(const State& state, const CameraPath& scenes, std::span<const Box> boxes,
                                int width, int height);
/// The plan's camera where it is frozen.
[[nodiscard]] Camera frozen_camera(const State& state, const CameraPath& scenes, int width, int height);
/// The filter that reads the maps, or the identifiers, as a command line has them.
[[nodiscard]] std::string filter_text(const Settings& settings);
/// The plan's options with the border that the filter needs.
[[nodiscard]] PlanOptions plan_options_of(const Settings& settings) noexcept;

/// A state that shows something worth knowing, over the present scene and camera.
struct Preset {
  std::string_view name, help;
  void (*set)(State& state);
};
[[nodiscard]] std::span<const Preset> presets() noexcept;

/// The state as JSON text, which read_state() reads back to the same state.
[[nodiscard]] std::string state_text(const State& state);
/// Throws std::runtime_error with the key and what is wrong.
[[nodiscard]] State read_state(std::string_view text);
/// The same from a file; the message begins with its name.
[[nodiscard]] State load_state(const std::string& file);
/// Fields of a plan whose value no option of the command line carries, as the text of --options; empty where
/// all have their default.
[[nodiscard]] std::string unspoken_options(const PlanOptions& options);
/// True where the field `key` of a plan has an option of the command line of its own.
[[nodiscard]] bool is_spoken(std::string_view key);
/// The command that shows the same picture.
[[nodiscard]] std::string command_text(const State& state);

}  // namespace gnomon::tool::view
