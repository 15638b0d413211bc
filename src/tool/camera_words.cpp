// The camera on a command line: a path's file, or an eye and its target, and where sight begins and ends.
#include "camera_words.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "base/fnv.hpp"
#include "gnomon/casefile/casefile.hpp"
#include "named_in.hpp"
#include "picture_words.hpp"

namespace gnomon::tool {
namespace {

std::string point_text(const glm::dvec3& point) {
  return fmt::format("{},{},{}", point.x, point.y, point.z);
}

/// All of a path as text, to the last digit.
std::string path_text(const CameraPath& path) {
  std::string text =
      fmt::format("{} {} {} {}", path.closed, path.fov_y_radians, path.near_depth, path.far_depth);
  if (path.height_world > 0.0) text += fmt::format(" orthographic {}", path.height_world);
  for (const CameraKey& key : path.keys) {
    text += " " + point_text(key.position) + " " + point_text(key.target);
    if (key.up != CameraKey().up) text += " up " + point_text(key.up);
  }
  return text;
}

void check_depths(const CameraWords& words, double near_depth, double far_depth) {
  if (near_depth < far_depth) return;
  throw std::runtime_error(fmt::format("{}: sight would begin at {:g} and end at {:g}",
                                       words.near_depth > 0.0 ? "--near" : "--far", near_depth, far_depth));
}

std::vector<Box> boxes_seen(const Scene& scene) {
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances)
    if (instance.shown) boxes.push_back(instance.bounds_world);
  return boxes;
}

/// The path of one key that shows what a camera of the file does.
CameraPath path_of(const SceneCamera& camera, const Scene& scene) {
  CameraPath path;
  path.keys = {camera_key(camera.position, camera.forward, camera.up)};
  if (camera.orthographic)
    path.height_world = camera.height_world;
  else
    path.fov_y_radians = camera.fov_y_radians;
  path.far_depth =
      std::isfinite(camera.far_depth)
          ? camera.far_depth
          : std::max(sight_from(camera.position, boxes_seen(scene)).far_depth, 2.0 * camera.near_depth);
  // An orthographic camera may see from its own place on, and a path begins beyond.
  constexpr double kLeast = 1e-6;
  path.near_depth = std::max(camera.near_depth, kLeast * path.far_depth);
  return path;
}

}  // namespace

glm::dvec3 point_word(const std::string& option, const std::string& word) {
  glm::dvec3 point{0.0};
  const char* at = word.data();
  const char* const end = word.data() + word.size();
  const auto refuse = [&] {
    throw std::runtime_error(fmt::format("{} {}: wants three numbers, as in 1,2.5,-3", option, word));
  };
  for (int i = 0; i < 3; ++i) {
    const auto [next, error] = std::from_chars(at, end, point[i]);
    if (error != std::errc{} || !(std::abs(point[i]) <= 1e30)) refuse();
    at = next;
    if (i < 2 && (at == end || *at++ != ',')) refuse();
  }
  if (at != end) refuse();
  return point;
}

Option point_option(std::string name, std::optional<glm::dvec3>& point, std::string help) {
  const auto set = [name, &point](const std::string& word) {
    point = point_word(name, word);
    return true;
  };
  return {.name = std::move(name), .target = ParsedWord{set, {}}, .help = std::move(help), .word = "X,Y,Z"};
}

std::vector<Option> camera_options(CameraWords& words) {
  Option up = point_option("--eye-up", words.eye_up,
                           "direction that points to the top of the picture of --eye; without it 0,1,0");
  up.needs = "--eye";
  return {{.name = "--path",
           .target = &words.path,
           .help = "camera path, a JSON file, in place of the scene's own",
           .completion = Completion::files},
          {.name = "--camera",
           .target = &words.of_file,
           .help = "camera of the scene's file, by name or number, in place of the scene's path",
           .word = "NAME"},
          point_option("--eye", words.eye, "position of the camera, world units; needs --target"),
          point_option("--target", words.target, "point that the camera looks at"),
          std::move(up),
          {.name = "--orthographic",
           .target = &words.height_world,
           .help = "world units from the bottom of the picture to its top, by parallel rays; 0: of the path",
           .word = "HEIGHT",
           .range = {{0.0, 1e30}}},
          {.name = "--near",
           .target = &words.near_depth,
           .help = "view depth at which sight begins, world units; 0: of the path",
           .range = {{0.0, 1e30}}},
          {.name = "--far",
           .target = &words.far_depth,
           .help = "view depth at which sight ends, world units; 0: of the path",
           .range = {{0.0, 1e30}}}};
}

void check_camera(const CameraWords& words) {
  if (words.eye.has_value() != words.target.has_value())
    throw std::runtime_error("--eye and --target: give both, or neither");
  if (words.eye && *words.eye == *words.target) throw std::runtime_error("--target: must differ from --eye");
  if (words.eye_up && *words.eye_up == glm::dvec3(0.0))
    throw std::runtime_error("--eye-up: must not be zero");
  if (words.eye && !words.path.empty()) throw std::runtime_error("--eye: not with --path, which has its own");
  if (!words.of_file.empty() && (words.eye || !words.path.empty()))
    throw std::runtime_error("--camera: not with --path or --eye, which place another");
  if (words.near_depth > 0.0 && words.far_depth > 0.0) check_depths(words, words.near_depth, words.far_depth);
  if (words.path.empty()) return;
  const CameraPath path = load_camera_path(words.path);
  check_depths(words, words.near_depth > 0.0 ? words.near_depth : path.near_depth,
               words.far_depth > 0.0 ? words.far_depth : path.far_depth);
}

CameraPath camera_path(const CameraWords& words, const Scene& scene, double aspect) {
  check_camera(words);
  CameraPath path = words.path.empty() ? default_path(scene, aspect) : load_camera_path(words.path);
  const std::vector<Box> boxes = boxes_seen(scene);
  if (!words.of_file.empty())
    path = path_of(named_in(scene.cameras, words.of_file, "--camera", "camera"), scene);
  if (words.eye) {
    path.keys = {eye_key(words)};
    path.closed = false;
    const Sight sight = sight_from(*words.eye, boxes);
    path.near_depth = sight.near_depth;
    path.far_depth = sight.far_depth;
  }
  if (words.height_world > 0.0) {
    path.height_world = words.height_world;
    if (words.path.empty() && !(words.near_depth > 0.0) && !(words.far_depth > 0.0)) see_all(path, boxes);
  }
  if (words.near_depth > 0.0) path.near_depth = words.near_depth;
  if (words.far_depth > 0.0) path.far_depth = words.far_depth;
  check_depths(words, path.near_depth, path.far_depth);
  return path;
}

CameraKey eye_key(const CameraWords& words) {
  CameraKey key{*words.eye, *words.target};
  if (words.eye_up) key.up = *words.eye_up;
  return key;
}

void fit_picture(const CameraWords& words, const Scene& scene, bool size_given, int& width, int& height) {
  if (words.of_file.empty()) return;
  const double aspect = named_in(scene.cameras, words.of_file, "--camera", "camera").aspect;
  if (!(aspect > 0.0)) return;
  const auto side = [](double pixels) {
    return static_cast<int>(std::lround(std::clamp(pixels, 1.0 * kLeastPictureSide, 1.0 * kMaxPictureSide)));
  };
  const int narrower = std::min(width, side(height * aspect)), lower = std::min(height, side(width / aspect));
  if (narrower == width && lower == height) return;
  if (size_given)
    return warn(
        fmt::format("--camera {}: its width over height, {:.4g}, is not followed: --size {}x{} is given",
                    one_line(words.of_file), aspect, width, height));
  width = narrower;
  height = lower;
}

std::string camera_text(const CameraWords& words) {
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : " ") + part; };
  if (!words.path.empty())
    add(fmt::format("path {} {:016x}", std::filesystem::path(words.path).filename().string(),
                    fnv_of(path_text(load_camera_path(words.path)))));
  if (!words.of_file.empty()) add("camera " + one_line(words.of_file));
  if (words.eye) add("eye " + point_text(*words.eye) + " target " + point_text(*words.target));
  if (words.eye_up) add("up " + point_text(*words.eye_up));
  if (words.height_world > 0.0) add(fmt::format("orthographic {}", words.height_world));
  if (words.near_depth > 0.0) add(fmt::format("near {}", words.near_depth));
  if (words.far_depth > 0.0) add(fmt::format("far {}", words.far_depth));
  return text;
}

}  // namespace gnomon::tool
