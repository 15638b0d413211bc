// The same flight in a window: fly yourself, and switch warp, filter and view while looking.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "command.hpp"
#include "flight.hpp"
#include "frame_plan.hpp"
#include "gnomon/render/picture.hpp"
#include "gnomon/render/renderer.hpp"
#include "gnomon/render/window.hpp"
#include "gnomon/scene/image.hpp"
#include "steering.hpp"

namespace gnomon::tool::fly {
namespace {

using render::Renderer;

constexpr const char* kKeys =
    "WASD move, Q E down up, mouse or arrows look, shift faster, V warp, F filter, H heat map, C cascade "
    "tint,\n"
    "T stable, P path on and off, Tab frees the mouse, Esc ends";

/// What the keys change.
struct Viewer {
  Viewer(const Options& from_options, Flight& over, GLFWwindow* in)
      : options(from_options), flight(over), window(in), renderer(over.scene) {}
  Options options;
  Flight& flight;
  GLFWwindow* window;
  Renderer renderer;
  std::size_t warp = 0;    ///< 0: auto, then all_warps()
  std::size_t filter = 0;  ///< of all_filters()
  Renderer::Picture picture = Renderer::Picture::lit;
  CameraKey eye;  ///< where the user is, and what is looked at
  bool on_path = true, mouse_held = false;
  double path_time = 0.0;
  double seconds = 0.0;  ///< since the first frame, of the animation
  glm::dvec2 mouse{0.0};
  Image legend;
  PlanHistory history;
};

bool down(const Viewer& viewer, int key) {
  return glfwGetKey(viewer.window, key) == GLFW_PRESS;
}

void show_title(const Viewer& viewer, double frame_ms) {
  const std::string_view warp = viewer.warp == 0 ? "auto" : all_warps()[viewer.warp - 1]->name;
  glfwSetWindowTitle(viewer.window,
                     fmt::format("{}: warp {} (V), filter {} (F), {} (T), heat H, maps C, path P: {:.1f} ms",
                                 program_name(), warp, render::all_filters()[viewer.filter]->info.name,
                                 to_string(viewer.options.plan.fit), frame_ms)
                         .c_str());
}

void apply(Viewer& viewer) {
  viewer.options.plan.warp.warp = viewer.warp == 0 ? nullptr : all_warps()[viewer.warp - 1];
  // Other than the command line's filter, each as it is by default.
  const render::Filter* filter = render::all_filters()[viewer.filter];
  if (viewer.options.filter.filter != filter) viewer.options.filter = render::default_settings(*filter);
  render::set_margin(viewer.options.filter, viewer.options.plan);
  viewer.history.clear();
}

void on_key(GLFWwindow* window, int key, int, int action, int) {
  if (action != GLFW_PRESS) return;
  Viewer& viewer = *static_cast<Viewer*>(glfwGetWindowUserPointer(window));
  const auto toggle = [&viewer](Renderer::Picture picture) {
    viewer.picture = viewer.picture == picture ? Renderer::Picture::lit : picture;
  };
  switch (key) {
    case GLFW_KEY_ESCAPE:
      glfwSetWindowShouldClose(window, GLFW_TRUE);
      break;
    case GLFW_KEY_V:
      viewer.warp = (viewer.warp + 1) % (all_warps().size() + 1);
      break;
    case GLFW_KEY_F:
      viewer.filter = (viewer.filter + 1) % render::all_filters().size();
      break;
    case GLFW_KEY_H:
      toggle(Renderer::Picture::heat_map);
      break;
    case GLFW_KEY_C:
      toggle(Renderer::Picture::cascade_tint);
      break;
    case GLFW_KEY_P:
      viewer.on_path = !viewer.on_path;
      break;
    case GLFW_KEY_TAB:
      viewer.mouse_held = !viewer.mouse_held;
      glfwSetInputMode(window, GLFW_CURSOR, viewer.mouse_held ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
      glfwGetCursorPos(window, &viewer.mouse.x, &viewer.mouse.y);
      break;
    case GLFW_KEY_T:
      viewer.options.plan.fit = viewer.options.plan.fit == Fit::stable ? Fit::tight : Fit::stable;
      break;
    default:
      break;
  }
  apply(viewer);
}

/// The camera where the user is.
Camera camera_at(const Viewer& viewer, int width, int height) {
  CameraPath still = viewer.flight.path;
  still.keys = {viewer.eye};
  return still.at(0.0, width, height);
}

void steer(Viewer& viewer, double seconds) {
  constexpr double kRadiansPerPixel = 0.003, kRadiansPerSecond = 1.2;
  glm::dvec2 mouse{0.0};
  glfwGetCursorPos(viewer.window, &mouse.x, &mouse.y);
  if (viewer.mouse_held) {
    turn(viewer.eye, (mouse.x - viewer.mouse.x) * kRadiansPerPixel,
         (viewer.mouse.y - mouse.y) * kRadiansPerPixel);
  }
  viewer.mouse = mouse;
  const auto axis = [&viewer](int plus, int minus) {
    return 1.0 * down(viewer, plus) - 1.0 * down(viewer, minus);
  };
  turn(viewer.eye, axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT) * kRadiansPerSecond * seconds,
       axis(GLFW_KEY_UP, GLFW_KEY_DOWN) * kRadiansPerSecond * seconds);

  const CameraAxes axes = camera_axes(camera_at(viewer, 1, 1));
  const glm::dvec3 step = axes.forward * axis(GLFW_KEY_W, GLFW_KEY_S) +
                          axes.right * axis(GLFW_KEY_D, GLFW_KEY_A) +
                          glm::dvec3(0.0, axis(GLFW_KEY_E, GLFW_KEY_Q), 0.0);
  // A scene's depth in twenty seconds, whatever its units.
  const double speed = viewer.flight.path.far_depth / 20.0 * (down(viewer, GLFW_KEY_LEFT_SHIFT) ? 4.0 : 1.0);
  move(viewer.eye, step * (speed * seconds));
}

Camera next_camera(Viewer& viewer, int width, int height, double seconds) {
  if (viewer.on_path) {
    constexpr double kFlightSeconds = 30.0;
    if (!viewer.options.frames_given)
      viewer.path_time = std::fmod(viewer.path_time + seconds / kFlightSeconds, 1.0);
    const Camera camera = viewer.flight.path.at(viewer.path_time, width, height);
    const CameraAxes axes = camera_axes(camera);
    viewer.eye = camera_key(camera.position, axes.forward, axes.up);
    return camera;
  }
  steer(viewer, seconds);
  return camera_at(viewer, width, height);
}

void draw(Viewer& viewer, double seconds) {
  int width = 0, height = 0;
  glfwGetFramebufferSize(viewer.window, &width, &height);
  width = std::max(width, 16);
  height = std::max(height, 16);
  const Camera camera = next_camera(viewer, width, height, seconds);
  viewer.seconds += seconds;
  pose_flight(viewer.options, viewer.flight, viewer.seconds, &viewer.renderer);
  const Light light = light_of(viewer.options, viewer.flight.scene);
  const render::PreparedFilter filter = viewer.renderer.prepare(viewer.options.filter);
  const VisibleDepths depths = frame_depths(viewer.options, viewer.flight, viewer.renderer, filter, camera);
  const ShadowPlan plan = plan_frame(viewer.options, viewer.flight, light, camera, depths, viewer.history);
  render::FrameOptions frame;
  frame.transition = viewer.options.transition;
  frame.depth_layer = viewer.options.layer;
  frame.map_passes = viewer.options.map_passes;
  frame.time_passes = false;
  frame.light = &light;
  frame.prune = viewer.options.prune;
  frame.aliasing = frame.heat_map = viewer.picture == Renderer::Picture::heat_map;
  frame.cascade_tint = viewer.picture == Renderer::Picture::cascade_tint;
  viewer.renderer.draw(plan, camera, filter, frame);
  viewer.renderer.show(viewer.picture, width, height);
  if (viewer.picture == Renderer::Picture::heat_map) {
    if (viewer.legend.width == 0) viewer.legend = render::heat_legend(width);
    viewer.renderer.show_overlay(viewer.legend);
  }
  glfwSwapBuffers(viewer.window);
  gnomon::render::check_context();
}

void look_around(Viewer& viewer) {
  auto before = std::chrono::steady_clock::now();
  double since_title = 1.0;
  while (glfwWindowShouldClose(viewer.window) == GLFW_FALSE) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - before).count();
    before = now;
    draw(viewer, std::min(seconds, 0.25));
    since_title += seconds;
    if (since_title > 0.5) show_title(viewer, seconds * 1e3);
    if (since_title > 0.5) since_title = 0.0;
    glfwPollEvents();
  }
}

void fly_once(Viewer& viewer) {
  const int frames = viewer.options.frames;
  for (int frame = 0; frame < frames && glfwWindowShouldClose(viewer.window) == GLFW_FALSE; ++frame) {
    viewer.path_time = frames == 1 ? 0.5 : 1.0 * frame / (viewer.flight.path.closed ? frames : frames - 1);
    // Each view in turn, so that a run without hands shows all of them.
    viewer.picture = static_cast<Renderer::Picture>(frame % 3);
    viewer.seconds = frame / viewer.options.animation_fps;
    draw(viewer, 0.0);
    show_title(viewer, 0.0);
    glfwPollEvents();
    const auto file = viewer.options.out / fmt::format("window_{:04}.png", frame);
    write_png(viewer.renderer.screen(), file);
  }
  fmt::print("what the window showed: {}\n", (viewer.options.out / "window_0000.png").string());
}

}  // namespace

int fly_in_window(const Options& asked, Flight& flight) {
  Options options = asked;
  const auto window = [&options] {
    try {
      return render::create_window(options.width, options.height, std::string(program_name()));
    } catch (const render::RenderError& error) {
      throw std::runtime_error(fmt::format("--context glfw: {}", error.what()));
    }
  }();
  fmt::print("context:  {}\n{}\n", window->info().description(), kKeys);
  fit_maps_to_memory(options);
  Viewer viewer(options, flight, window->handle());
  for (std::size_t i = 0; i < all_warps().size(); ++i) {
    if (all_warps()[i] == options.plan.warp.warp) viewer.warp = i + 1;
  }
  for (std::size_t i = 0; i < render::all_filters().size(); ++i) {
    if (render::all_filters()[i] == options.filter.filter) viewer.filter = i;
  }
  glfwSetWindowUserPointer(window->handle(), &viewer);
  glfwSetKeyCallback(window->handle(), on_key);
  if (options.frames_given) {
    std::filesystem::create_directories(options.out);
    fly_once(viewer);
  } else {
    look_around(viewer);
  }
  return 0;
}

}  // namespace gnomon::tool::fly
