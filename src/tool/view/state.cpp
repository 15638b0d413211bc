// Defaults, names and presets of the viewer's state.
#include "state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "identifier_word.hpp"
#include "plan_option.hpp"

namespace gnomon::tool::view {
namespace {

constexpr std::array<Named, kViewCount> kViews{{
    {"lit", "the shaded scene"},
    {"heat", "aliasing error m, screen pixels per texel: white is 1, red too coarse, blue finer than needed"},
    {"mask", "visibility as the filter returns it: white lit, black in shadow"},
    {"misclassified", "false light (orange) and false shadow (blue) against exact rays"},
    {"cascades", "which map serves which part; of pages which level"},
    {"checker", "squares of 8 x 8 texels of the map that serves each point"},
    {"map", "the depth map itself, with its border, the receivers' body and the casters; of pages one level"},
    {"truth", "the exact hard shadow, one ray a pixel"},
    {"kept", "which maps or pages were kept from earlier frames (blue), and which were drawn (orange)"},
}};
constexpr std::array<Named, 3> kComparisons{{
    {"off", "A alone"},
    {"wipe", "A left of a line, B right of it: drag the line"},
    {"difference", "how far A and B differ, times the gain"},
}};

Settings with(const char* filter, const char* key = nullptr, const char* choice = nullptr) {
  Settings settings;
  settings.filter = render::parse_filter(filter).settings;
  if (key != nullptr) (void)set_plan_choice(key, choice, settings.plan);
  return settings;
}

constexpr std::array<Preset, 7> kPresets{{
    {"defaults", "every option as it is by default", [](State& s) { s.a = {}; }},
    {"one map, no warp against the chosen warp",
     "what the warp gains at equal texels: drag the line. It is chosen by objective picture, the fewest "
     "misclassified "
     "pixels: m may rise where no shadow edge shows it",
     [](State& s) {
       s.a = with("hard", "warp", "none");
       s.b = with("hard", "warp", "auto");
       s.b.plan.warp.objective = Objective::picture;
       s.a.plan.cascades = s.b.plan.cascades = 1;
       s.comparison = Comparison::wipe;
       s.view = View::heat;
     }},
    {"stable cascades", "texel-snapped maps, as most engines have them",
     [](State& s) { s.a = with("pcf:radius=2", "fit", "stable"); }},
    {"pages", "virtual shadow maps: m of at most 1 at visible points, kept while the camera moves",
     [](State& s) {
       s.a = with("pcf", "fit", "stable");
       s.a.pages.policy = &page_policies::resolution;
     }},
    {"soft contact shadows", "pcss, whose penumbra grows with the distance from the caster",
     [](State& s) { s.a = with("pcss"); }},
    {"variance shadows", "vsm, to look for light bleeding in the misclassified view",
     [](State& s) {
       s.a = with("vsm:radius=3");
       s.view = View::misclassified;
     }},
    {"cheapest", "one small map without a warp, nearest texel",
     [](State& s) {
       s.a = with("hard", "warp", "none");
       s.a.plan.cascades = 1;
       s.a.plan.resolution.max_size = 512;
     }},
}};

}  // namespace

std::span<const Named> view_names() noexcept {
  return kViews;
}

std::span<const Named> comparison_names() noexcept {
  return kComparisons;
}

std::span<const Preset> presets() noexcept {
  return kPresets;
}

Light light_of(const LightState& light, const Box& scene) noexcept {
  const auto ranged = [&scene](auto local) {
    if (local.range == 0.0) local.range = covering_range(local.position, scene);
    return local;
  };
  if (light.sun.kind == LightKind::spot && light.spot) return ranged(*light.spot);
  if (light.sun.kind == LightKind::point && light.point) return ranged(*light.point);
  return default_light(light.sun, scene);
}

LightState light_state(const Light& light) noexcept {
  LightState state;
  if (const auto* sun = std::get_if<DirectionalLight>(&light)) {
    const glm::dvec3 to_light = -glm::normalize(sun->direction);
    state.sun.elevation_deg = std::asin(std::clamp(to_light.y, -1.0, 1.0)) * kDegrees;
    state.sun.azimuth_deg = std::atan2(to_light.x, -to_light.z) * kDegrees;
  } else if (const auto* spot = std::get_if<SpotLight>(&light)) {
    state.sun.kind = LightKind::spot;
    state.spot = *spot;
  } else {
    state.sun.kind = LightKind::point;
    state.point = std::get<PointLight>(light);
  }
  return state;
}

LightState light_state(const SceneLight& light) {
  const LightState state = light_state(light.light);
  constexpr double kLeastDegrees = 0.1;
  if (state.sun.kind == LightKind::sun && state.sun.elevation_deg < kLeastDegrees)
    throw std::runtime_error(light.name + ": shines from below the horizon");
  return state;
}

void take_camera(const CameraPath& path, State& state) noexcept {
  state.eye = path.keys.front();
  state.fov_y_deg = std::clamp(path.fov_y_radians * kDegrees, kLeastFovDeg, kMostFovDeg);
  state.height_world = path.height_world;
  state.near_depth = path.near_depth;
  state.far_depth = path.far_depth;
}

void turn_sun(State& state, double seconds) noexcept {
  constexpr double kTurn = 360.0, kHalf = 180.0;
  const double turned = state.light.sun.azimuth_deg + seconds * state.motion.sun_degrees_per_second;
  state.light.sun.azimuth_deg = turned - kTurn * std::floor((turned + kHalf) / kTurn);
}

CameraPath path_of(const State& state, const CameraPath& scenes) {
  CameraPath path = scenes;
  if (!state.path.empty()) {
    path.keys = state.path;
    path.closed = false;
  }
  if (state.fov_y_deg > 0.0) path.fov_y_radians = state.fov_y_deg * (std::numbers::pi / 180.0);
  path.height_world = state.height_world;
  if (state.near_depth > 0.0) path.near_depth = state.near_depth;
  if (state.far_depth > 0.0) path.far_depth = state.far_depth;
  return path;
}

Camera eye_camera(const State& state, const CameraPath& scenes, std::span<const Box> boxes, int width,
                  int height) {
  CameraPath path = path_of(state, scenes);
  if (state.eye) {
    path.keys = {*state.eye};
    const Sight sight = sight_from(state.eye->position, boxes);
    if (!(state.near_depth > 0.0)) path.near_depth = sight.near_depth;
    if (!(state.far_depth > 0.0)) path.far_depth = sight.far_depth;
  }
  const bool bounded = state.near_depth > 0.0 || state.far_depth > 0.0;
  if (path.height_world > 0.0 && !bounded) see_all(path, boxes);
  if (!(path.near_depth < path.far_depth)) {
    // One is given, and the other lies on its wrong side.
    constexpr double kApart = 1000.0;
    if (state.near_depth > 0.0)
      path.far_depth = path.near_depth * kApart;
    else
      path.near_depth = path.far_depth / kApart;
  }
  return path.at(state.path_time, width, height);
}

Camera frozen_camera(const State& state, const CameraPath& scenes, int width, int height) {
  CameraPath path = path_of(state, scenes);
  path.keys = {*state.frozen};
  if (state.frozen_sight.near_depth > 0.0) {
    path.near_depth = state.frozen_sight.near_depth;
    path.far_depth = state.frozen_sight.far_depth;
  }
  return path.at(state.path_time, width, height);
}

std::string filter_text(const Settings& settings) {
  return settings.identifiers ? to_string(*settings.identifiers) : render::to_string(settings.filter);
}

PlanOptions plan_options_of(const Settings& settings) noexcept {
  PlanOptions options = settings.plan;
  // Identifiers read one texel, as hard shadows do.
  render::set_margin(settings.identifiers ? render::default_settings(render::filters::hard) : settings.filter,
                     options);
  return options;
}

}  // namespace gnomon::tool::view
